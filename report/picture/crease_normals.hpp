// Normals for shading that round what is round and keep edges sharp.
//
// Model : a corner has the normal that the picture knows at its vertex; at an edge, where it knows
//         none, the mean of what it knows at the triangle's other corners. Failing both, the
//         area-weighted mean of the faces around the vertex that lean less than the crease angle
//         against its own face. Slivers face where the largest triangle around them does
// Units : coordinates in any one unit; crease angle in rad
// Shape : three unit normals for each triangle, in the order of its corners
// Errors: none for a valid picture (SurfacePicture::is_valid); a triangle without area gets +z
// Accuracy: for pictures, single precision
// Source: common practice
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "report/run_report.hpp"

namespace frustum::report {

using CornerNormals = std::array<Eigen::Vector3f, 3>;

[[nodiscard]] std::vector<CornerNormals> crease_normals(const SurfacePicture& picture,
                                                        double crease_angle);

}  // namespace frustum::report
