// Manifold: the blank minus all hulls in one batch, or minus their union by halves of the program.
#include <manifold/manifold.h>

#include <numeric>

#include "bench/peers/peer_programs.hpp"

namespace frustum::bench {
namespace {

// Neighbours overlap, so that what is inside goes early. Each union is done before the next begins.
manifold::Manifold union_by_halves(const std::vector<manifold::Manifold>& hulls, std::size_t first,
                                   std::size_t last) {
  if (last - first == 1) return hulls[first];
  const std::size_t middle = first + (last - first) / 2;
  const manifold::Manifold both =
      union_by_halves(hulls, first, middle) + union_by_halves(hulls, middle, last);
  static_cast<void>(both.NumTri());  // asking makes it
  return both;
}

}  // namespace

std::optional<stock::SurfaceMesh> manifold_mesh(const PeerScene& scene, const PeerCase& each) {
  const Box box = scene.blank.bounds();
  const Vec3 size = box.max - box.min;
  const auto block = manifold::Manifold::Cube({size.x(), size.y(), size.z()})
                         .Translate({box.min.x(), box.min.y(), box.min.z()});
  std::vector<manifold::Manifold> hulls;
  std::vector<manifold::vec3> points;
  for (const std::vector<Vec3>& hull : hulls_of_blocks(scene, each.facets, each.facing)) {
    points.clear();
    for (const Vec3& p : hull) points.emplace_back(p.x(), p.y(), p.z());
    hulls.push_back(manifold::Manifold::Hull(points));
  }
  manifold::Manifold left;
  if (each.by_halves) {
    left = block - union_by_halves(hulls, 0, hulls.size());
  } else {
    hulls.insert(hulls.begin(), block);
    left = manifold::Manifold::BatchBoolean(hulls, manifold::OpType::Subtract);
  }
  if (left.Status() != manifold::Manifold::Error::NoError) return std::nullopt;
  const manifold::MeshGL64 given = left.GetMeshGL64();

  // Vertices that are one but for their properties are made one.
  std::vector<std::uint32_t> kept(given.NumVert());
  std::iota(kept.begin(), kept.end(), 0U);
  for (std::size_t i = 0; i < given.mergeFromVert.size(); ++i) {
    kept[given.mergeFromVert[i]] = static_cast<std::uint32_t>(given.mergeToVert[i]);
  }
  stock::SurfaceMesh mesh;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    const auto at = v * given.numProp;
    mesh.vertices.emplace_back(given.vertProperties[at], given.vertProperties[at + 1],
                               given.vertProperties[at + 2]);
  }
  for (std::size_t t = 0; t < given.NumTri(); ++t) {
    mesh.triangles.push_back({kept[given.triVerts[3 * t]], kept[given.triVerts[3 * t + 1]],
                              kept[given.triVerts[3 * t + 2]]});
  }
  return mesh;
}

}  // namespace frustum::bench
