// CGAL's corefinement with exact numbers: the hulls united by halves, then taken from the blank.
#include "bench/peers/peer_programs.hpp"
#include "stock/polyhedral/convex_hull.hpp"
#include "stock/polyhedral/exact_solid.hpp"

namespace frustum::bench {
namespace {

using Hulls = std::vector<std::vector<Vec3>>;

// Neighbours overlap. What CGAL cannot unite stays apart.
std::vector<stock::ExactSolid> union_of_hulls(const Hulls& hulls, std::size_t first,
                                              std::size_t last) {
  std::vector<stock::ExactSolid> solids;
  if (last - first == 1) {
    solids.emplace_back(stock::convex_hull(hulls[first]));
    return solids;
  }
  const std::size_t middle = first + (last - first) / 2;
  solids = union_of_hulls(hulls, first, middle);
  for (stock::ExactSolid& next : union_of_hulls(hulls, middle, last)) {
    if (auto both = solids.back().united(next)) {
      solids.back() = std::move(*both);
    } else {
      solids.push_back(std::move(next));
    }
  }
  return solids;
}

}  // namespace

std::optional<stock::SurfaceMesh> cgal_mesh(const PeerScene& scene, int facets, Facing facing) {
  const Box box = scene.blank.bounds();
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                         i & 4 ? box.max.z() : box.min.z());
  }
  stock::ExactSolid left(stock::convex_hull(corners));
  const Hulls hulls = hulls_of_blocks(scene, facets, facing);
  for (const stock::ExactSolid& removed : union_of_hulls(hulls, 0, hulls.size())) {
    auto less = left.minus(removed);
    if (!less) return std::nullopt;
    left = std::move(*less);
  }
  return left.rounded();
}

}  // namespace frustum::bench
