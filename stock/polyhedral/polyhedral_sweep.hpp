// The sweep of faceted cutters along a tool path, as convex pieces that together contain it.
//
// Model    : a piece is the convex hull of a convex section of the faceted cutter at both ends of a
//            part of
//            the motion. Two things part such a hull from the true sweep:
//            (1) points at distance rho from the tip run on arcs: a turn by theta takes them up to
//                rho*theta^2/8 off the chord. The motion is halved until that is below a quarter
//                of the tolerance, and the cutter is grown by it: the hull misses nothing.
//            (2) a hull joins points x and y of the body across the motion: it reaches beyond the
//                sweep by up to |M(y - x)|/4, M the linear map from body points to their
//                displacements, where x and y are on one facet or edge whose normal displacement
//                changes sign. (At the mixing ratio l the hull holds (1-l)x + l(y + My), the sweep
//                at time l the same point less l(1-l)M(y - x).) Where this exceeds half the
//                tolerance, walls are cut into sections across the axis, and for end faces the
//                motion is halved.
//            A body of several convex parts makes the pieces of each.
//            Neighbouring segments merge while the poses between stay within a quarter of the
//            tolerance of one straight motion; the cutter grows by their distance.
// Units    : mm; frame: workpiece
// Errors   : a tool number without a cutter, or with a concave one; more pieces than max_pieces
// Accuracy : the union of the pieces contains the sweep of the faceted cutter and leaves it by at
//            most the tolerance, to leading order in theta
#pragma once

#include <map>
#include <vector>

#include "core/result.hpp"
#include "cutter/body/cutter.hpp"
#include "kinematics/path/tool_path.hpp"
#include "stock/polyhedral/polyhedral.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

// The convex hull of these points.
using ConvexPiece = std::vector<Vec3>;

// In program order; pieces that miss `within` are left out.
[[nodiscard]] Result<std::vector<ConvexPiece>> faceted_sweep(
    const kinematics::ToolPath& path, const std::map<int, cutter::Cutter>& cutters,
    const BoundingBox& within, const PolyhedralOptions& options);

}  // namespace frustum::stock
