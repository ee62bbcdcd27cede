#include "report/picture/crease_normals.hpp"

#include <algorithm>
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

// Faces by their triangles; twice the area, along the normal.
struct Faces {
  std::vector<Eigen::Vector3f> areas;
  std::vector<Eigen::Vector3f> normals;  // unit
  std::vector<bool> slivers;
};

// Where a triangle is thinner than that share of its longest side, it faces where chance wants it.
constexpr float kSliver = 0.12F;

Faces faces_of(const SurfacePicture& picture) {
  const std::size_t count = picture.triangles.size();
  Faces faces{std::vector<Eigen::Vector3f>(count), std::vector<Eigen::Vector3f>(count),
              std::vector<bool>(count)};
  for (std::size_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = picture.triangles[t];
    const Eigen::Vector3f ab = position(picture, b) - position(picture, a);
    const Eigen::Vector3f ac = position(picture, c) - position(picture, a);
    faces.areas[t] = ab.cross(ac);
    const float area = faces.areas[t].norm();
    const float longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    faces.slivers[t] = area < kSliver * longest;
    faces.normals[t] = area > 0.0F ? Eigen::Vector3f(faces.areas[t] / area)
                                   : Eigen::Vector3f(Eigen::Vector3f::UnitZ());
  }
  return faces;
}

// Where a triangle faces; a sliver faces where the largest triangle around it does.
Eigen::Vector3f facing_of(const SurfacePicture& picture, const Faces& faces, const VertexFans& fans,
                          std::size_t t) {
  if (!faces.slivers[t]) return faces.normals[t];
  std::size_t largest = t;
  for (const std::uint32_t vertex : picture.triangles[t]) {
    for (std::uint32_t i = fans.first[vertex]; i < fans.first[vertex + 1]; ++i) {
      const std::uint32_t neighbour = fans.triangles[i];
      if (faces.areas[neighbour].squaredNorm() > faces.areas[largest].squaredNorm()) {
        largest = neighbour;
      }
    }
  }
  return faces.normals[largest];
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
  const Faces faces = faces_of(picture);
  const VertexFans fans = vertex_fans(picture);
  const auto limit = static_cast<float>(std::cos(crease_angle));
  std::vector<CornerNormals> normals(picture.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    const Eigen::Vector3f facing = facing_of(picture, faces, fans, t);
    normals[t] = known_normals(picture, t, facing);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!normals[t][k].isZero()) continue;
      const std::uint32_t vertex = picture.triangles[t][k];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::uint32_t i = fans.first[vertex]; i < fans.first[vertex + 1]; ++i) {
        const std::uint32_t neighbour = fans.triangles[i];
        if (faces.normals[neighbour].dot(facing) >= limit) sum += faces.areas[neighbour];
      }
      const float length = sum.norm();
      normals[t][k] = length > 0.0F ? Eigen::Vector3f(sum / length) : facing;
    }
  }
  return normals;
}

}  // namespace frustum::report
