#include "stock/mesh/weld_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace frustum::stock {
namespace {

bool is_single(double x) { return x == static_cast<double>(static_cast<float>(x)); }

double seam_of(const std::vector<Vec3>& vertices) {
  Vec3 min = vertices.front();
  Vec3 max = min;
  bool all_single = true;
  for (const Vec3& v : vertices) {
    min = min.cwiseMin(v);
    max = max.cwiseMax(v);
    all_single = all_single && is_single(v.x()) && is_single(v.y()) && is_single(v.z());
  }
  if (!all_single) return 1e-9 * (max - min).norm();
  // Of the largest coordinate: smaller ones may come of it by a difference.
  constexpr double kLastPlace = std::numeric_limits<float>::epsilon();
  return 4.0 * kLastPlace * max.cwiseAbs().cwiseMax(min.cwiseAbs()).maxCoeff();
}

// Vertices in cells of space, wide enough that most of them are near no border.
class WeldCells {
 public:
  WeldCells(const std::vector<Vec3>& vertices, double seam)
      : vertices_(vertices), seam_(seam), size_(1000.0 * seam), next_(vertices.size(), kNone) {}

  // The first vertex kept within the seam; `vertex` itself, which is kept then, when there is none.
  std::uint32_t first_near(std::uint32_t vertex) {
    const Vec3& p = vertices_[vertex];
    const Cell low = cell_of(p - Vec3::Constant(seam_));
    const Cell high = cell_of(p + Vec3::Constant(seam_));
    std::uint32_t first = vertex;
    for (Cell at = low; at[0] <= high[0]; ++at[0]) {
      for (at[1] = low[1]; at[1] <= high[1]; ++at[1]) {
        for (at[2] = low[2]; at[2] <= high[2]; ++at[2]) first = std::min(first, first_in(at, p));
      }
    }
    if (first == vertex) keep(vertex);
    return first;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t mixed = 0;
      for (const std::int64_t x : cell) {
        mixed = (mixed ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U;
        mixed ^= mixed >> 29U;
      }
      return mixed;
    }
  };
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] Cell cell_of(const Vec3& p) const {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = static_cast<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(k)] / size_));
    }
    return cell;
  }
  [[nodiscard]] std::uint32_t first_in(const Cell& cell, const Vec3& p) const {
    const auto found = newest_.find(cell);
    std::uint32_t first = kNone;
    for (std::uint32_t v = found == newest_.end() ? kNone : found->second; v != kNone;
         v = next_[v]) {
      if ((vertices_[v] - p).norm() <= seam_) first = v;  // later ones in the list came earlier
    }
    return first;
  }
  void keep(std::uint32_t vertex) {
    const auto [place, is_new] = newest_.try_emplace(cell_of(vertices_[vertex]), vertex);
    if (is_new) return;
    next_[vertex] = place->second;
    place->second = vertex;
  }

  const std::vector<Vec3>& vertices_;
  double seam_;
  double size_;
  std::unordered_map<Cell, std::uint32_t, Hash> newest_{};
  std::vector<std::uint32_t> next_;  // kept before it in its cell
};

}  // namespace

SurfaceMesh welded(SurfaceMesh mesh) {
  if (mesh.vertices.empty()) return mesh;
  const double seam = seam_of(mesh.vertices);
  // WeldCells are counted in whole numbers; a mesh of one place, or far off for its size, has no
  // seams to tell.
  if (!(seam > 1e-15 * mesh.vertices.front().cwiseAbs().maxCoeff())) return mesh;
  WeldCells cells(mesh.vertices, seam);
  std::vector<std::uint32_t> becomes(mesh.vertices.size());
  for (std::uint32_t v = 0; v < becomes.size(); ++v) becomes[v] = cells.first_near(v);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) v = becomes[v];
  }
  std::erase_if(mesh.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return mesh;
}

}  // namespace frustum::stock
