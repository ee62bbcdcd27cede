#include "stock/mesh/weld_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace frustum::stock {
namespace {

bool is_single(double x) { return x == static_cast<double>(static_cast<float>(x)); }

// Of each vertex; 0 where nothing is near enough to be its equal.
std::vector<double> seams_of(const SurfaceMesh& mesh) {
  Vec3 min = mesh.vertices.front();
  Vec3 max = min;
  bool all_single = true;
  for (const Vec3& v : mesh.vertices) {
    min = min.cwiseMin(v);
    max = max.cwiseMax(v);
    all_single = all_single && is_single(v.x()) && is_single(v.y()) && is_single(v.z());
  }
  const double largest = max.cwiseAbs().cwiseMax(min.cwiseAbs()).maxCoeff();
  // Of the largest coordinate: smaller ones may come of it by a difference.
  constexpr double kLastPlaces = 4.0 * std::numeric_limits<float>::epsilon();
  const double widest = all_single ? kLastPlaces * largest : 1e-9 * (max - min).norm();
  std::vector<double> seams(mesh.vertices.size(), widest);
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3& b = mesh.vertices[t[1]];
    const Vec3& c = mesh.vertices[t[2]];
    const double side = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    for (const std::uint32_t v : t) {
      const double around = mesh.vertices[v].cwiseAbs().maxCoeff() + 20.0 * side;
      seams[v] = std::min(seams[v], all_single ? kLastPlaces * around : 1e-6 * side);
    }
  }
  return seams;
}

// Vertices with seams of about one width, in cells of space that are wide enough that most of the
// vertices are near no border.
class WeldCells {
 public:
  WeldCells(const SurfaceMesh& mesh, const std::vector<double>& seams,
            std::vector<std::uint32_t>& next, double width)
      : vertices_(mesh.vertices), seams_(seams), next_(next), size_(1000.0 * width) {}

  // The first vertex kept here within the narrower seam of both; `vertex` itself when none is.
  [[nodiscard]] std::uint32_t first_near(std::uint32_t vertex) const {
    const Vec3& p = vertices_[vertex];
    const double reach = std::min(seams_[vertex], 1e-3 * size_);
    std::uint32_t first = vertex;
    // Cells are counted in whole numbers: vertices so far off have no seams to tell.
    if (!(reach > 1e-15 * p.cwiseAbs().maxCoeff())) return first;
    const Cell low = cell_of(p - Vec3::Constant(reach));
    const Cell high = cell_of(p + Vec3::Constant(reach));
    Cell at{};
    for (at[0] = low[0]; at[0] <= high[0]; ++at[0]) {
      for (at[1] = low[1]; at[1] <= high[1]; ++at[1]) {
        for (at[2] = low[2]; at[2] <= high[2]; ++at[2]) {
          first = std::min(first, first_in(at, p, reach));
        }
      }
    }
    return first;
  }
  void keep(std::uint32_t vertex) {
    const Vec3& p = vertices_[vertex];
    if (!(seams_[vertex] > 1e-15 * p.cwiseAbs().maxCoeff())) return;
    const auto [place, is_new] = newest_.try_emplace(cell_of(p), vertex);
    if (is_new) return;
    next_[vertex] = place->second;
    place->second = vertex;
  }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

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

  [[nodiscard]] Cell cell_of(const Vec3& p) const {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = static_cast<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(k)] / size_));
    }
    return cell;
  }
  [[nodiscard]] std::uint32_t first_in(const Cell& cell, const Vec3& p, double reach) const {
    const auto found = newest_.find(cell);
    std::uint32_t first = kNone;
    for (std::uint32_t v = found == newest_.end() ? kNone : found->second; v != kNone;
         v = next_[v]) {
      // Later ones in the list came earlier.
      if ((vertices_[v] - p).norm() <= std::min(reach, seams_[v])) first = v;
    }
    return first;
  }

  const std::vector<Vec3>& vertices_;
  const std::vector<double>& seams_;
  std::vector<std::uint32_t>& next_;  // kept before it in its cell
  double size_;
  std::unordered_map<Cell, std::uint32_t, Hash> newest_{};
};

// By the power of ten that the seam is less than: a cell of each has few vertices.
class Weld {
 public:
  explicit Weld(const SurfaceMesh& mesh)
      : mesh_(mesh), seams_(seams_of(mesh)), next_(mesh.vertices.size(), WeldCells::kNone) {}

  // The vertex that this one becomes, after all before it.
  std::uint32_t becomes(std::uint32_t vertex) {
    if (!(seams_[vertex] > 0.0)) return vertex;
    std::uint32_t first = vertex;
    for (const auto& [power, cells] : levels_) first = std::min(first, cells.first_near(vertex));
    if (first != vertex) return first;
    const int power = static_cast<int>(std::ceil(std::log10(seams_[vertex])));
    levels_.try_emplace(power, mesh_, seams_, next_, std::pow(10.0, power))
        .first->second.keep(vertex);
    return vertex;
  }

 private:
  const SurfaceMesh& mesh_;
  std::vector<double> seams_;
  std::vector<std::uint32_t> next_;
  std::map<int, WeldCells> levels_{};
};

}  // namespace

WeldedMesh welded(SurfaceMesh mesh) {
  WeldedMesh done;
  if (!mesh.vertices.empty()) {
    Weld weld(mesh);
    std::vector<std::uint32_t> becomes(mesh.vertices.size());
    for (std::uint32_t v = 0; v < becomes.size(); ++v) {
      becomes[v] = weld.becomes(v);
      const double moved = (mesh.vertices[v] - mesh.vertices[becomes[v]]).norm();
      if (!(moved > 0.0)) continue;
      ++done.moved;
      done.farthest = std::max(done.farthest, moved);
    }
    for (auto& triangle : mesh.triangles) {
      for (std::uint32_t& v : triangle) v = becomes[v];
    }
  }
  done.lost_facets = std::erase_if(
      mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  done.mesh = std::move(mesh);
  return done;
}

}  // namespace frustum::stock
