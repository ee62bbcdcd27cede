// The convex hull of points.
//
// Units    : those of the points
// Shape    : triangles counter-clockwise seen from outside; points within the hull are left out
// Errors   : none; the points must not be in one plane
// Accuracy : exact predicates; the vertices are given points
// Source   : CGAL 5.5, 3D Convex Hulls
#pragma once

#include <vector>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

[[nodiscard]] SurfaceMesh convex_hull(const std::vector<Vec3>& points);

}  // namespace frustum::stock
