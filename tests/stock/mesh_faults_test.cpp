#include "stock/polyhedral/mesh_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace frustum::stock {
namespace {

using ::testing::HasSubstr;

// A cube of this size at a corner, as part of a mesh.
void add_cube(SurfaceMesh& mesh, const Vec3& corner, double size, bool inwards = false) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int c = 0; c < 8; ++c) {
    mesh.vertices.push_back(corner + size * Vec3(c & 1, c >> 1 & 1, c >> 2 & 1));
  }
  constexpr std::array<std::array<std::uint32_t, 3>, 12> kFacets{{{0, 2, 1},
                                                                  {1, 2, 3},
                                                                  {4, 5, 6},
                                                                  {5, 7, 6},
                                                                  {0, 1, 4},
                                                                  {1, 5, 4},
                                                                  {2, 6, 3},
                                                                  {3, 6, 7},
                                                                  {0, 4, 2},
                                                                  {2, 4, 6},
                                                                  {1, 3, 5},
                                                                  {3, 7, 5}}};
  for (auto facet : kFacets) {
    if (inwards) std::swap(facet[1], facet[2]);
    mesh.triangles.push_back({first + facet[0], first + facet[1], first + facet[2]});
  }
}

std::string fault_of(const SurfaceMesh& mesh) {
  const Diagnostics found = mesh_faults(mesh);
  return found.empty() ? "none" : found.front().message;
}

TEST(MeshFaults, ABodyWithAVoidHasNone) {
  SurfaceMesh mesh;
  add_cube(mesh, Vec3::Zero(), 10.0);
  EXPECT_EQ(fault_of(mesh), "none");
  add_cube(mesh, Vec3(4, 4, 4), 2.0, true);
  EXPECT_EQ(fault_of(mesh), "none");
}

TEST(MeshFaults, TellsHolesWithCountAndPlace) {
  SurfaceMesh mesh;
  add_cube(mesh, Vec3::Zero(), 10.0);
  mesh.triangles.erase(mesh.triangles.begin() + 3);
  EXPECT_THAT(fault_of(mesh), HasSubstr("open: 1 hole with 3 edges around"));
  EXPECT_THAT(fault_of(mesh), HasSubstr("10) mm"));
}

TEST(MeshFaults, TellsFacetsAgainstEachOther) {
  SurfaceMesh mesh;
  add_cube(mesh, Vec3::Zero(), 10.0);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  EXPECT_THAT(fault_of(mesh), HasSubstr("3 edges with facets that face against each other"));
}

TEST(MeshFaults, TellsWhatIsInsideOut) {
  SurfaceMesh mesh;
  add_cube(mesh, Vec3::Zero(), 10.0, true);
  EXPECT_THAT(fault_of(mesh), HasSubstr("inside out: 1 shell"));
}

TEST(MeshFaults, TellsSeveralBodiesCrossingOnesAndLooseVoids) {
  SurfaceMesh apart;
  add_cube(apart, Vec3::Zero(), 10.0);
  SurfaceMesh crossing = apart;
  SurfaceMesh loose = apart;
  add_cube(apart, Vec3(20, 0, 0), 10.0);
  EXPECT_THAT(fault_of(apart), HasSubstr("2 bodies apart"));
  add_cube(crossing, Vec3(5, 5, 5), 10.0);
  EXPECT_THAT(fault_of(crossing), HasSubstr("pairs of facets cross"));
  add_cube(loose, Vec3(20, 0, 0), 2.0, true);
  EXPECT_THAT(fault_of(loose), HasSubstr("do not bound one body"));
}

}  // namespace
}  // namespace frustum::stock
