#include "stock/mesh/deviation.hpp"

namespace frustum::stock {
namespace {

WorstPoint described(const WorkpieceAt& part, const SurfaceMesh& mesh, std::size_t vertex,
                     Mm tolerance) {
  WorstPoint worst{.deviation = *mesh.deviation[vertex], .point = mesh.vertices[vertex]};
  if (const auto originating_block = originating_block_of(part, worst.point, tolerance)) {
    worst.block = originating_block->block;
    worst.source_line = originating_block->source_line;
    worst.source_file = originating_block->source_file;
  }
  return worst;
}

}  // namespace

void compare(SurfaceMesh& mesh, const SignedDistance& nominal) {
  mesh.deviation.clear();
  mesh.deviation.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.deviation.push_back(nominal(mesh.vertices[i], mesh.normals[i]));
  }
}

WorstDeviations worst_deviations(const WorkpieceAt& part, const SurfaceMesh& mesh, Mm tolerance) {
  WorstDeviations worst;
  std::optional<std::size_t> lowest, highest;
  for (std::size_t i = 0; i < mesh.deviation.size(); ++i) {
    const auto& d = mesh.deviation[i];
    if (!d) continue;
    ++worst.points;
    if (*d < 0.0 && (!lowest || *d < *mesh.deviation[*lowest])) lowest = i;
    if (*d > 0.0 && (!highest || *d > *mesh.deviation[*highest])) highest = i;
  }
  if (lowest) worst.gouge = described(part, mesh, *lowest, tolerance);
  if (highest) worst.excess = described(part, mesh, *highest, tolerance);
  return worst;
}

}  // namespace frustum::stock
