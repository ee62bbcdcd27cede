// How far a finished surface is from a nominal shape given as a closed mesh.
//
// Model    : signed distance of points to the nearest facet: outside (material left: excess)
//            positive, inside (material gone: gouge) negative
// Units    : mm; both in one frame
// Shape    : one deviation a point
// Errors   : none; a nominal without facets gives no deviations
// Accuracy : that of stock/solid/facet_solid.hpp, for the facets; how far these are from the shape
//            that they represent is the file's
// Threads  : runs on oneTBB; the same bits for any number of threads
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {

[[nodiscard]] std::vector<std::optional<double>> deviations_from(const FacetSolid& nominal,
                                                                 std::span<const Vec3> points);

}  // namespace frustum::stock
