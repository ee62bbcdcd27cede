#include "stock/mesh/decimate_surface.hpp"

#include <fmt/format.h>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <cmath>
#include <limits>
#include <vector>

#include "stock/mesh/open_mesh.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {
namespace {

// Faces that turn more than this (rad) at an edge between feature vertices make it sharp: three
// times what extraction takes for smooth, since triangles on a bent face turn too.
constexpr double kSharp = 0.3;
// Within the tolerance a triangle may still turn over; 20 degrees keeps wrinkles out.
constexpr double kMostTurn = 20.0;  // degrees, as OpenMesh asks for it

// OpenMesh holds the vertices taken away against the triangles; what is between those vertices
// gets the rest of the tolerance.
constexpr double kVertexShare = 0.5;

// Corners stay, and sharp edges are only shortened along themselves.
template <typename Mesh>
class KeepFeatures : public OpenMesh::Decimater::ModBaseT<Mesh> {
  using Base = OpenMesh::Decimater::ModBaseT<Mesh>;
  using Info = OpenMesh::Decimater::CollapseInfoT<Mesh>;

 public:
  using Handle = OpenMesh::Decimater::ModHandleT<KeepFeatures>;
  explicit KeepFeatures(Mesh& mesh) : Base(mesh, true) {}
  const std::string& name() const override {
    static const std::string kName = "KeepFeatures";
    return kName;
  }
  void set_kinds(const std::vector<VertexKind>& kinds) { kinds_ = &kinds; }

  float collapse_priority(const Info& info) override {
    if (!is_feature(info.v0)) return Base::LEGAL_COLLAPSE;
    if (!is_feature(info.v1)) return Base::ILLEGAL_COLLAPSE;
    int sharp = 0;
    bool along = false;
    for (const auto half : Base::mesh().voh_range(info.v0)) {
      if (!is_sharp(half)) continue;
      ++sharp;
      along = along || Base::mesh().to_vertex_handle(half) == info.v1;
    }
    return along && sharp == 2 ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE;
  }

 private:
  [[nodiscard]] bool is_feature(typename Mesh::VertexHandle v) const {
    return (*kinds_)[static_cast<std::size_t>(v.idx())] == VertexKind::feature;
  }
  bool is_sharp(typename Mesh::HalfedgeHandle half) {
    Mesh& mesh = Base::mesh();
    if (!is_feature(mesh.to_vertex_handle(half))) return false;
    return std::abs(mesh.calc_dihedral_angle(half)) > kSharp;
  }

  const std::vector<VertexKind>* kinds_ = nullptr;
};

// The centres of the triangles that a collapse leaves stay within the tolerance of the given mesh.
template <typename Mesh>
class StayNear : public OpenMesh::Decimater::ModBaseT<Mesh> {
  using Base = OpenMesh::Decimater::ModBaseT<Mesh>;
  using Info = OpenMesh::Decimater::CollapseInfoT<Mesh>;

 public:
  using Handle = OpenMesh::Decimater::ModHandleT<StayNear>;
  explicit StayNear(Mesh& mesh) : Base(mesh, true) {}
  const std::string& name() const override {
    static const std::string kName = "StayNear";
    return kName;
  }
  void set_given(const FacetSolid& given, double tolerance) {
    given_ = &given;
    tolerance_ = tolerance;
  }

  float collapse_priority(const Info& info) override {
    Mesh& mesh = Base::mesh();
    for (const auto face : mesh.vf_range(info.v0)) {
      if (face == info.fl || face == info.fr) continue;
      Vec3 sum = Vec3::Zero();
      for (const auto v : mesh.fv_range(face)) {
        const auto& p = v == info.v0 ? info.p1 : mesh.point(v);
        sum += Vec3(p[0], p[1], p[2]);
      }
      if (!given_->is_within(sum / 3.0, tolerance_)) return Base::ILLEGAL_COLLAPSE;
    }
    return Base::LEGAL_COLLAPSE;
  }

 private:
  const FacetSolid* given_ = nullptr;
  double tolerance_ = 0.0;
};

SurfaceMesh kept(const SurfaceMesh& from, const OpenMesh3& mesh) {
  constexpr auto kGone = std::numeric_limits<std::uint32_t>::max();
  SurfaceMesh left;
  std::vector<std::uint32_t> number(from.vertices.size(), kGone);
  const auto keep = [&](std::size_t v) {
    if (number[v] != kGone) return;
    number[v] = static_cast<std::uint32_t>(left.vertices.size());
    left.vertices.push_back(from.vertices[v]);
    if (!from.normals.empty()) left.normals.push_back(from.normals[v]);
    if (!from.kinds.empty()) left.kinds.push_back(from.kinds[v]);
    if (!from.deviation.empty()) left.deviation.push_back(from.deviation[v]);
  };
  for (std::size_t v = 0; v < from.vertices.size(); ++v) {
    if (!mesh.status(mesh.vertex_handle(static_cast<unsigned>(v))).deleted()) keep(v);
  }
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    const auto face = mesh.face_handle(static_cast<unsigned>(f));
    if (mesh.status(face).deleted()) continue;
    std::array<std::uint32_t, 3> corners{};
    std::size_t corner = 0;
    for (const auto v : mesh.fv_range(face)) {
      corners.at(corner++) = number[static_cast<std::size_t>(v.idx())];
    }
    left.triangles.push_back(corners);
  }
  return left;
}

}  // namespace

Result<SurfaceMesh> decimate_surface(const SurfaceMesh& mesh, Mm tolerance) {
  if (!std::isfinite(tolerance.value) || tolerance.value <= 0.0) {
    return error("mesh-tolerance"_id,
                 fmt::format("the decimation tolerance is {} mm", tolerance.value),
                 "it must be a finite number above 0");
  }
  const MeshMeasure measured = measure(mesh);
  if (!measured.is_closed || !measured.is_manifold) {
    return error("mesh-open"_id,
                 fmt::format("the mesh to be decimated is {}",
                             measured.is_closed ? "not manifold" : "not closed"),
                 "only closed surfaces without self-contact are decimated");
  }
  OpenMesh3 built = open_mesh_of(mesh);
  built.request_face_normals();
  built.update_face_normals();
  const std::vector<VertexKind> kinds =
      mesh.kinds.size() == mesh.vertices.size()
          ? mesh.kinds
          : std::vector<VertexKind>(mesh.vertices.size(), VertexKind::surface);

  OpenMesh::Decimater::DecimaterT<OpenMesh3> decimater(built);
  OpenMesh::Decimater::ModQuadricT<OpenMesh3>::Handle quadric;
  OpenMesh::Decimater::ModHausdorffT<OpenMesh3>::Handle hausdorff;
  OpenMesh::Decimater::ModNormalFlippingT<OpenMesh3>::Handle flipping;
  KeepFeatures<OpenMesh3>::Handle features;
  StayNear<OpenMesh3>::Handle near;
  decimater.add(quadric);
  decimater.add(features);
  decimater.add(flipping);
  decimater.add(near);
  decimater.add(hausdorff);
  decimater.module(quadric).unset_max_err();
  decimater.module(hausdorff).set_tolerance(kVertexShare * tolerance.value);
  decimater.module(flipping).set_max_normal_deviation(kMostTurn);
  decimater.module(features).set_kinds(kinds);
  const FacetSolid given(mesh.vertices, mesh.triangles);
  decimater.module(near).set_given(given, tolerance.value);
  if (!decimater.initialize())
    return error("mesh-decimation"_id, "OpenMesh cannot decimate the mesh");
  decimater.decimate();
  return kept(mesh, built);
}

}  // namespace frustum::stock
