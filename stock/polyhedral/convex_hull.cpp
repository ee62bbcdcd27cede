#include "stock/polyhedral/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace frustum::stock {

SurfaceMesh convex_hull(const std::vector<Vec3>& points) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> given;
  given.reserve(points.size());
  for (const Vec3& p : points) given.emplace_back(p.x(), p.y(), p.z());
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(given.begin(), given.end(), hull);
  SurfaceMesh mesh;
  std::vector<std::uint32_t> place(hull.num_vertices());
  for (const auto v : hull.vertices()) {
    place[v.idx()] = static_cast<std::uint32_t>(mesh.vertices.size());
    const Point& p = hull.point(v);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : hull.faces()) {
    auto& triangle = mesh.triangles.emplace_back();
    std::size_t corner = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f))) {
      triangle.at(corner++) = place[v.idx()];
    }
  }
  return mesh;
}

}  // namespace frustum::stock
