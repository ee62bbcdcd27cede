// Random blanks cut along random tool paths, degenerate ones among them, and what must hold of
// each.
//
// Units: mm, mm^3; frame: workpiece. Errors: none; a broken law is reported in words.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cutter/body/cutter.hpp"
#include "kinematics/path/tool_path.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::proof {

struct RandomCut {
  stock::Blank blank;
  kinematics::ToolPath path;
  std::map<int, cutter::Cutter> tools;
  double pitch = 1.0;
};

// A function of the seed.
[[nodiscard]] RandomCut random_cut(std::uint64_t seed);

// Cuts and meshes it. Empty, or the first law that does not hold: numbers are finite, the mesh is
// closed and manifold, no volume is negative, and none grows with more segments.
[[nodiscard]] std::string broken_law(const RandomCut& cut);

// Empty, or why the triangles do not bound a solid: each edge once in either direction, one fan a
// vertex.
[[nodiscard]] std::string open_or_not_manifold(const stock::SurfaceMesh& mesh);

}  // namespace frustum::proof
