// Associations that are extreme: minimum zone, largest inscribed, smallest circumscribed, outside
// material.
//
// Model    : association.hpp, with
//              minimum zone: the element is in the middle, max d = -min d; when its size is kept,
//                max |d| is least; form is the zone's width (of a line its diameter, 2 max d)
//              inscribed: the largest whose contacts surround its centre or axis, near the
//                least-squares one (an axis within half a radian); points that leave it open on one
//                side have none
//              circumscribed: points that go around less than half of it have none: the smallest is
//                that over their chord
//              outside material of plane and line: the middle of the zone moved to its outer bound,
//                axis of the plane along `outward`
//              line in a plane: residuals have a sign, positive on its left seen from the tip of
//              the normal circle: the plane is that of least squares, then as in the plane
//            Local minima are compared by restarts, so the result is proven near itself and the
//            best of those
// Units    : mm, rad
// Shape    : points as many as least squares needs; residuals from the element returned; cofactor
//            and covariance are zero, of the size of least_squares.hpp, as contacts tell no scatter
// Errors   : those of least squares, a criterion that the kind does not have, weights, a size that
//            is kept and sought at once, no direction out of the material, nothing proven within
//            1e-9 mm (of parts beyond 100 mm within 1e-11 of them)
// Accuracy : 1e-9 mm for parts of 100 mm; Certificate::gap says how near
// Source   : ISO 5459, ISO 12181-1; Anthony et al. 1996 (contacts that prove a zone)
#pragma once

#include "metrology/fit/association.hpp"

namespace frustum::metrology {

[[nodiscard]] Result<Association> extreme_association(std::string_view name,
                                                      std::span<const Vec3> points,
                                                      const AssociationOptions& options);

}  // namespace frustum::metrology
