#include "report/crease_normals.hpp"

#include <cmath>
#include <cstdint>

namespace frustum::report {
namespace {

// Which triangles meet at each vertex: triangles[first[v]] .. triangles[first[v + 1] - 1].
struct VertexFans {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> triangles;
};

VertexFans vertex_fans(const SurfacePicture& picture) {
  VertexFans fans;
  fans.first.assign(picture.vertices.size() + 1, 0);
  for (const auto& triangle : picture.triangles) {
    for (const std::uint32_t corner : triangle) ++fans.first[corner + 1];
  }
  for (std::size_t v = 1; v < fans.first.size(); ++v) fans.first[v] += fans.first[v - 1];
  fans.triangles.resize(fans.first.back());
  std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  for (std::size_t t = 0; t < picture.triangles.size(); ++t) {
    for (const std::uint32_t corner : picture.triangles[t]) {
      fans.triangles[next[corner]++] = static_cast<std::uint32_t>(t);
    }
  }
  return fans;
}

Eigen::Vector3f position(const SurfacePicture& picture, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3f>(picture.vertices[vertex].data());
}

// Known normals that turn away from the triangle's face belong to another face.
constexpr float kOwnFace = 0.5F;  // cosine of 60 deg

Eigen::Vector3f known_normal(const SurfacePicture& picture, std::uint32_t vertex,
                             const Eigen::Vector3f& face) {
  if (picture.normals.empty()) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f normal = Eigen::Map<const Eigen::Vector3f>(picture.normals[vertex].data());
  return normal.dot(face) >= kOwnFace ? normal : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

// Zero for corners of which nothing is known.
CornerNormals known_normals(const SurfacePicture& picture, std::size_t t,
                            const Eigen::Vector3f& face) {
  CornerNormals normals;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    normals[k] = known_normal(picture, picture.triangles[t][k], face);
    sum += normals[k];
  }
  const float length = sum.norm();
  if (length == 0.0F) return normals;
  for (Eigen::Vector3f& normal : normals) {
    if (normal.isZero()) normal = sum / length;
  }
  return normals;
}

}  // namespace

std::vector<CornerNormals> crease_normals(const SurfacePicture& picture, double crease_angle) {
  const std::size_t count = picture.triangles.size();
  std::vector<Eigen::Vector3f> area_normals(count);  // twice the area, along the normal
  std::vector<Eigen::Vector3f> face_normals(count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = picture.triangles[t];
    const Eigen::Vector3f origin = position(picture, a);
    area_normals[t] = (position(picture, b) - origin).cross(position(picture, c) - origin);
    const float length = area_normals[t].norm();
    face_normals[t] = length > 0.0F ? Eigen::Vector3f(area_normals[t] / length)
                                    : Eigen::Vector3f(Eigen::Vector3f::UnitZ());
  }

  const VertexFans fans = vertex_fans(picture);
  const auto limit = static_cast<float>(std::cos(crease_angle));
  std::vector<CornerNormals> normals(count);
  for (std::size_t t = 0; t < count; ++t) {
    normals[t] = known_normals(picture, t, face_normals[t]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!normals[t][k].isZero()) continue;
      const std::uint32_t vertex = picture.triangles[t][k];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::uint32_t i = fans.first[vertex]; i < fans.first[vertex + 1]; ++i) {
        const std::uint32_t neighbour = fans.triangles[i];
        if (face_normals[neighbour].dot(face_normals[t]) >= limit) sum += area_normals[neighbour];
      }
      const float length = sum.norm();
      normals[t][k] = length > 0.0F ? Eigen::Vector3f(sum / length) : face_normals[t];
    }
  }
  return normals;
}

}  // namespace frustum::report
