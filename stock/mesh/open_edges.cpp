#include "stock/mesh/open_edges.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace frustum::stock {
namespace {

struct DirectedEdge {
  std::uint64_t ends = 0;  // the lower vertex above the higher one
  bool rising = true;      // from the lower vertex to the higher
};

DirectedEdge edge_of(std::uint32_t a, std::uint32_t b) {
  const auto [low, high] = std::minmax(a, b);
  return {static_cast<std::uint64_t>(low) << 32U | high, a < b};
}

template <typename Take>
void each_edge(const SurfaceMesh& mesh, const Take& take) {
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) take(edge_of(t[k], t[(k + 1) % 3]));
  }
}

// splitmix64: every bit of the word moves half of the others.
std::uint64_t mixed(std::uint64_t word) {
  word += 0x9E3779B97F4A7C15U;
  word = (word ^ word >> 30U) * 0xBF58476D1CE4E5B9U;
  word = (word ^ word >> 27U) * 0x94D049BB133111EBU;
  return word ^ word >> 31U;
}

}  // namespace

std::optional<OpenEdges> open_edges(const SurfaceMesh& mesh) {
  // Sums to zero where each edge is run as often either way; sorting is for meshes of which not.
  std::uint64_t sum = 0;
  each_edge(mesh, [&sum](const DirectedEdge& edge) {
    sum += edge.rising ? mixed(edge.ends) : 0U - mixed(edge.ends);
  });
  if (sum == 0) return std::nullopt;
  std::vector<std::pair<std::uint64_t, int>> edges;
  edges.reserve(3 * mesh.triangles.size());
  each_edge(mesh, [&edges](const DirectedEdge& edge) {
    edges.emplace_back(edge.ends, edge.rising ? 1 : -1);
  });
  std::ranges::sort(edges);
  std::optional<OpenEdges> found;
  for (std::size_t i = 0; i < edges.size();) {
    const std::uint64_t ends = edges[i].first;
    int balance = 0;
    for (; i < edges.size() && edges[i].first == ends; ++i) balance += edges[i].second;
    if (balance == 0) continue;
    if (!found) {
      found = OpenEdges{0, mesh.vertices[ends >> 32U], mesh.vertices[ends & 0xFFFFFFFFU]};
    }
    ++found->count;
  }
  return found;
}

}  // namespace frustum::stock
