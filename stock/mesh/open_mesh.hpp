// A SurfaceMesh as OpenMesh keeps one. For .cpp files of this room only.
// Units: mm. Errors: none; of a mesh that is not manifold OpenMesh leaves out faces and complains
//        on stderr.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMesh3 = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

// Vertex v of the mesh is vertex v there; triangles that name a vertex twice are left out.
[[nodiscard]] inline OpenMesh3 open_mesh_of(const SurfaceMesh& mesh) {
  OpenMesh3 built;
  built.reserve(mesh.vertices.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) built.add_vertex(OpenMesh3::Point(v.x(), v.y(), v.z()));
  const auto handle = [&](std::uint32_t v) { return built.vertex_handle(v); };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a == b || b == c || c == a) continue;
    built.add_face(handle(a), handle(b), handle(c));
  }
  return built;
}

}  // namespace frustum::stock
