#include "report/picture/scene.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace frustum::report {
namespace {

// Faces that lean less than this against each other are one rounded surface: above the facets of
// a meshed cylinder, below the bevels of test pieces.
constexpr double kCreaseAngle = 25.0 * kRadPerDeg;

// Samples are this far beside the middle of their square: rays exactly through edges, of which a
// view along an axis has many, would see either triangle.
constexpr float kBeside = 0.0137F;

std::vector<Eigen::Vector3f> in_camera(const SurfacePicture& picture, const View& view) {
  std::vector<Eigen::Vector3f> vertices;
  vertices.reserve(picture.vertices.size());
  for (const auto& vertex : picture.vertices) {
    vertices.emplace_back(view.camera_from_workpiece *
                          Eigen::Map<const Eigen::Vector3f>(vertex.data()));
  }
  return vertices;
}

}  // namespace

Eigen::Matrix3f camera_from_workpiece(double azimuth, double elevation) {
  const Eigen::Vector3d towards(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0.0);
  Eigen::Matrix3d rotation;
  rotation.row(0) = right;
  rotation.row(1) = towards.cross(right);
  rotation.row(2) = towards;
  return rotation.cast<float>();
}

Scene::Scene(const SurfacePicture& picture, const View& view, int width, int height, int samples)
    : picture_(picture),
      view_(view),
      samples_(samples),
      columns_(width * samples),
      rows_(height * samples),
      vertices_(in_camera(picture, view)),
      normals_(crease_normals(picture, kCreaseAngle)),
      rays_(vertices_, picture.triangles),
      up_(view.camera_from_workpiece.col(2)) {
  ground_ = picture.vertices.front()[2];
  for (const auto& vertex : picture.vertices) ground_ = std::min(ground_, vertex[2]);
  const auto columns = static_cast<std::size_t>(columns_);
  seen_.resize(columns * static_cast<std::size_t>(rows_));
  const float step = 1.0F / view.pixels_per_mm;
  tbb::parallel_for(0, rows_, [&](int y) {
    rays_.see_row(view.x_at(0.5F + kBeside), step,
                  view.y_at(static_cast<float>(y) + 0.5F - kBeside),
                  std::span(seen_).subspan(static_cast<std::size_t>(y) * columns, columns));
  });
}

Eigen::Vector3f Scene::normal(const Seen& seen) const {
  const CornerNormals& normals = normals_[seen.triangle];
  const std::array<float, 3> weights = weights_of(seen);
  Eigen::Vector3f normal =
      weights[0] * normals[0] + weights[1] * normals[1] + weights[2] * normals[2];
  const float length = normal.norm();
  if (length > 0.0F) normal /= length;
  return view_.camera_from_workpiece * normal;
}

Eigen::Vector3f Scene::facing(const Seen& seen) const {
  const auto& [a, b, c] = picture_.triangles[seen.triangle];
  const Eigen::Vector3f area = (vertices_[b] - vertices_[a]).cross(vertices_[c] - vertices_[a]);
  const float length = area.norm();
  if (!(length > 0.0F)) return Eigen::Vector3f::UnitZ();
  return area / (area.z() < 0.0F ? -length : length);
}

Eigen::Vector3f Scene::place(int x, int y, const Seen& seen) const {
  return {view_.x_at(static_cast<float>(x) + 0.5F + kBeside),
          view_.y_at(static_cast<float>(y) + 0.5F - kBeside), seen.depth};
}

}  // namespace frustum::report
