// Manifold's batch Boolean: the blank minus all hulls at once.
#include <manifold/manifold.h>

#include <numeric>

#include "bench/peers/peer_programs.hpp"

namespace frustum::bench {

std::optional<stock::SurfaceMesh> manifold_mesh(const PeerScene& scene, int facets, Facing facing) {
  const Box box = scene.blank.bounds();
  const Vec3 size = box.max - box.min;
  std::vector<manifold::Manifold> operands = {
      manifold::Manifold::Cube({size.x(), size.y(), size.z()})
          .Translate({box.min.x(), box.min.y(), box.min.z()})};
  std::vector<manifold::vec3> points;
  for (const std::vector<Vec3>& hull : hulls_of_blocks(scene, facets, facing)) {
    points.clear();
    for (const Vec3& p : hull) points.emplace_back(p.x(), p.y(), p.z());
    operands.push_back(manifold::Manifold::Hull(points));
  }
  const manifold::Manifold left =
      manifold::Manifold::BatchBoolean(operands, manifold::OpType::Subtract);
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
