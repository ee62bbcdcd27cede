#include "stock/mesh/decimate_surface.hpp"

#include <fmt/format.h>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <array>
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

// Of the tolerance, for the vertices taken away; what is between those vertices gets the rest.
constexpr double kVertexShare = 0.5;
// Of the tolerance: how far a fan that counts as flat may be off its plane. Were one point passed
// over a million times, the tolerance would be used up.
constexpr double kFlatShare = 1e-6;

Vec3 vec(const OpenMesh3::Point& p) { return {p[0], p[1], p[2]}; }

// A triangle with what the distances of many points to it need.
class NearTriangle {
 public:
  NearTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
      : corners_{a, b, c}, normal_((b - a).cross(c - a)) {
    const double square = normal_.squaredNorm();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = corners_.at((k + 1) % 3) - corners_.at(k);
      const double length = edge.squaredNorm();
      edges_.at(k) = edge;
      along_.at(k) = length > 0.0 ? Vec3(edge / length) : Vec3::Zero();
      inward_.at(k) = normal_.cross(edge);
    }
    per_square_ = square > 0.0 ? 1.0 / square : 0.0;
  }
  // Squared; of a triangle without area, to its edges.
  [[nodiscard]] double distance2(const Vec3& p) const {
    bool inside = per_square_ > 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = p - corners_.at(k);
      if (per_square_ > 0.0 && inward_.at(k).dot(from) >= 0.0) continue;
      inside = false;
      const double t = std::clamp(along_.at(k).dot(from), 0.0, 1.0);
      nearest = std::min(nearest, (from - t * edges_.at(k)).squaredNorm());
    }
    if (!inside) return nearest;
    const double height = normal_.dot(p - corners_[0]);
    return height * height * per_square_;
  }

 private:
  std::array<Vec3, 3> corners_;
  Vec3 normal_;
  std::array<Vec3, 3> edges_{};
  std::array<Vec3, 3> along_{};   // edges over their squared lengths
  std::array<Vec3, 3> inward_{};  // across them, in the plane
  double per_square_ = 0.0;
};

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

// Every vertex that has been taken away stays within the tolerance of a triangle. Each is kept with
// the triangle that it is nearest to, as by OpenMesh's Hausdorff module, whose time grows with the
// square of what lies on a flat face: there a collapse moves nothing, and nothing is looked at.
template <typename Mesh>
class HoldRemoved : public OpenMesh::Decimater::ModBaseT<Mesh> {
  using Base = OpenMesh::Decimater::ModBaseT<Mesh>;
  using Info = OpenMesh::Decimater::CollapseInfoT<Mesh>;
  using Face = typename Mesh::FaceHandle;

 public:
  using Handle = OpenMesh::Decimater::ModHandleT<HoldRemoved>;
  explicit HoldRemoved(Mesh& mesh) : Base(mesh, true), held_(mesh.n_faces()) {}
  const std::string& name() const override {
    static const std::string kName = "HoldRemoved";
    return kName;
  }
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }

  float collapse_priority(const Info& info) override {
    if (is_flat(info)) return Base::LEGAL_COLLAPSE;  // unless a triangle turns over
    left_.clear();
    for (const auto face : Base::mesh().vf_range(info.v0)) {
      if (face != info.fl && face != info.fr) left_.push_back(after(info, face));
    }
    if (!is_held(vec(info.p0), 0)) return Base::ILLEGAL_COLLAPSE;
    std::size_t own = 0;  // what lay on a triangle lies most often on what becomes of it
    for (const auto face : Base::mesh().vf_range(info.v0)) {
      for (const Vec3& point : held(face)) {
        if (!is_held(point, own)) return Base::ILLEGAL_COLLAPSE;
      }
      if (face != info.fl && face != info.fr) own = (own + 1) % left_.size();
    }
    return Base::LEGAL_COLLAPSE;
  }

  void preprocess_collapse(const Info& info) override {
    faces_.clear();
    left_.clear();
    loose_.assign(1, vec(info.p0));
    for (const auto face : Base::mesh().vf_range(info.v0)) {
      loose_.insert(loose_.end(), held(face).begin(), held(face).end());
      held(face).clear();
      if (face == info.fl || face == info.fr) continue;
      faces_.push_back(face);
      left_.push_back(after(info, face));
    }
    for (const Vec3& point : loose_) held(faces_.at(nearest_to(point))).push_back(point);
  }

 private:
  std::vector<Vec3>& held(Face face) { return held_[static_cast<std::size_t>(face.idx())]; }

  [[nodiscard]] NearTriangle after(const Info& info, Face face) {
    std::array<Vec3, 3> corners;
    std::size_t corner = 0;
    for (const auto v : Base::mesh().fv_range(face)) {
      corners.at(corner++) = vec(v == info.v0 ? info.p1 : Base::mesh().point(v));
    }
    return {corners[0], corners[1], corners[2]};
  }
  [[nodiscard]] bool is_flat(const Info& info) {
    const Vec3 p0 = vec(info.p0);
    const Vec3 normal = vec(Base::mesh().calc_face_normal(*Base::mesh().cvf_iter(info.v0)));
    for (const auto v : Base::mesh().vv_range(info.v0)) {
      const double height = normal.dot(vec(Base::mesh().point(v)) - p0);
      if (!(std::abs(height) < kFlatShare * tolerance_)) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_held(const Vec3& point, std::size_t own) const {
    const double most = tolerance_ * tolerance_;
    if (left_[own].distance2(point) <= most) return true;
    return std::ranges::any_of(
        left_, [&](const NearTriangle& triangle) { return triangle.distance2(point) <= most; });
  }
  [[nodiscard]] std::size_t nearest_to(const Vec3& point) const {
    constexpr double kOn = 1e-24;  // mm2
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < left_.size() && least > kOn; ++i) {
      const double distance = left_[i].distance2(point);
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    return nearest;
  }

  double tolerance_ = 0.0;
  std::vector<std::vector<Vec3>> held_;  // by triangle: vertices taken away that it is nearest to
  // Of the collapse that is looked at: the triangles that it leaves, and what lay on all of them.
  std::vector<NearTriangle> left_{};
  std::vector<Face> faces_{};
  std::vector<Vec3> loose_{};
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
  HoldRemoved<OpenMesh3>::Handle removed;
  OpenMesh::Decimater::ModNormalFlippingT<OpenMesh3>::Handle flipping;
  KeepFeatures<OpenMesh3>::Handle features;
  StayNear<OpenMesh3>::Handle near;
  decimater.add(quadric);
  decimater.add(features);
  decimater.add(flipping);
  decimater.add(removed);
  decimater.add(near);
  decimater.module(quadric).unset_max_err();
  decimater.module(removed).set_tolerance(kVertexShare * tolerance.value);
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
