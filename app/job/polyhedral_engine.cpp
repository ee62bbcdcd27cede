#include "app/job/polyhedral_engine.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <variant>

#ifdef FRUSTUM_WITH_CGAL
#include "stock/polyhedral/polyhedral.hpp"
#endif

namespace frustum::app {

#ifndef FRUSTUM_WITH_CGAL

Result<FacetedSurface> faceted_surface(const stock::WorkpieceAt&, const PolyhedralFacets&) {
  return error("not-built-in"_id, "this program was built without the polyhedral engine",
               "build with -DFRUSTUM_WITH_CGAL=ON, or use --engine ray");
}

#else

namespace {

using kinematics::ToolPath;

ToolPath path_until(const ToolPath& whole, const stock::ProgramState& program_state) {
  ToolPath path = whole;
  path.segments.resize(program_state.segments);
  return path;
}

std::map<int, cutter::Cutter> cutters_of(const cutter::SweptCutter& swept) {
  std::map<int, cutter::Cutter> cutters;
  for (const auto& block : swept.path().blocks) {
    cutters.emplace(block.tool, swept.tool(block.tool));
  }
  return cutters;
}

// The largest body around which facets are.
double largest_radius(const stock::Blank& blank, const std::map<int, cutter::Cutter>& cutters) {
  double radius = 0.0;
  if (const auto* round = std::get_if<stock::FrustumShape>(&blank.shape())) {
    radius = std::max(round->bottom_radius, round->top_radius);
  }
  for (const auto& [number, tool] : cutters) {
    radius = std::max(radius, tool.body().max_radius());
  }
  return radius;
}

stock::SurfaceMesh mesh_of(const stock::PolyhedralWorkpiece& solid) {
  stock::SurfaceMesh mesh;
  mesh.vertices.assign(solid.vertices().begin(), solid.vertices().end());
  mesh.triangles.assign(solid.facets().begin(), solid.facets().end());
  mesh.normals.assign(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 across = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    for (const std::uint32_t corner : t) mesh.normals[corner] += across;
  }
  for (Vec3& n : mesh.normals) n = n.norm() > 0.0 ? Vec3(n.normalized()) : Vec3(Vec3::UnitZ());
  mesh.kinds.assign(mesh.vertices.size(), stock::VertexKind::feature);
  return mesh;
}

}  // namespace

Result<FacetedSurface> faceted_surface(const stock::WorkpieceAt& part,
                                       const PolyhedralFacets& facets) {
  const stock::Workpiece& whole = part.workpiece();
  const auto cutters = cutters_of(whole.removed());
  const stock::PolyhedralOptions options{.facets = facets.facets,
                                         .arc_facets = std::max(1, facets.facets / 4),
                                         .tolerance = facets.tolerance};
  const auto solid = stock::PolyhedralWorkpiece::cut(
      whole.blank(), path_until(whole.removed().path(), part.program_state()), cutters, options);
  if (!solid) return solid.error();
  return FacetedSurface{mesh_of(*solid), stock::polyhedral_bound(
                                             options, Mm{largest_radius(whole.blank(), cutters)})};
}

#endif

}  // namespace frustum::app
