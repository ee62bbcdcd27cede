#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/peers/peer_programs.hpp"

namespace frustum::bench {
namespace {

using stock::TriDexel;
using Node = std::array<int, 3>;

constexpr std::uint32_t kNone = 0xffffffffU;

class SurfaceNets {
 public:
  explicit SurfaceNets(const TriDexel& dexels) : dexels_(dexels), nodes_(dexels.grid().nodes) {
    for (auto& layer : inside_) layer.resize(cells_in_layer());
    for (auto& layer : vertices_) layer.resize(cells_in_layer(), kNone);
  }

  // Layer by layer upwards: the edges of a layer of nodes are among the cells below and above it.
  stock::SurfaceMesh run() {
    fill(0);
    for (int k = 0; k + 1 < nodes_[2]; ++k) {
      fill(k + 1);
      std::fill(vertices_[slot(k)].begin(), vertices_[slot(k)].end(), kNone);
      for (int j = 0; j + 1 < nodes_[1]; ++j) {
        for (int i = 0; i + 1 < nodes_[0]; ++i) make_vertex({i, j, k});
      }
      for (int j = 1; j + 1 < nodes_[1]; ++j) {
        for (int i = 1; i + 1 < nodes_[0]; ++i) {
          add_quad({i, j, k}, 2);
          if (k == 0) continue;
          add_quad({i, j, k}, 0);
          add_quad({i, j, k}, 1);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] static std::size_t slot(int k) { return static_cast<std::size_t>(k & 1); }
  [[nodiscard]] std::size_t cells_in_layer() const {
    return static_cast<std::size_t>(nodes_[0]) * static_cast<std::size_t>(nodes_[1]);
  }
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_[0]) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] bool inside(const Node& n) const { return inside_[slot(n[2])][index(n[0], n[1])]; }

  // Which nodes are in the material, as the rays along X see it.
  void fill(int k) {
    auto& layer = inside_[slot(k)];
    std::fill(layer.begin(), layer.end(), std::uint8_t{0});
    const double pitch = dexels_.grid().pitch;
    for (int j = 0; j < nodes_[1]; ++j) {
      for (const Interval& piece : dexels_.material(0, j, k)) {
        const int last = std::min(nodes_[0] - 1, static_cast<int>(std::floor(piece.hi / pitch)));
        for (int i = std::max(0, static_cast<int>(std::ceil(piece.lo / pitch))); i <= last; ++i) {
          layer[index(i, j)] = 1;
        }
      }
    }
  }

  // Where the edge from this node along `axis` crosses the surface; its middle, where the rays of
  // that family see no end there.
  [[nodiscard]] Vec3 crossing(const Node& n, int axis) const {
    const double pitch = dexels_.grid().pitch;
    const auto a = static_cast<std::size_t>(axis);
    const double from = pitch * n[a], to = from + pitch;
    const auto pieces = dexels_.material(axis, n[(a + 1) % 3], n[(a + 2) % 3]);
    const auto next = std::lower_bound(pieces.begin(), pieces.end(), from,
                                       [](const Interval& p, double s) { return p.hi < s; });
    double s = 0.5 * (from + to);
    if (next != pieces.end()) {
      if (next->lo >= from && next->lo <= to) {
        s = next->lo;
      } else if (next->hi <= to) {
        s = next->hi;
      }
    }
    Vec3 at = dexels_.grid().node(n[0], n[1], n[2]);
    at[axis] += s - from;
    return at;
  }

  void make_vertex(const Node& cell) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      for (int corner = 0; corner < 4; ++corner) {
        Node from = cell;
        from[(a + 1) % 3] += corner & 1;
        from[(a + 2) % 3] += corner >> 1;
        Node to = from;
        ++to[a];
        if (inside(from) == inside(to)) continue;
        sum += crossing(from, axis);
        ++count;
      }
    }
    if (count == 0) return;
    vertices_[slot(cell[2])][index(cell[0], cell[1])] =
        static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(sum / count);
  }

  // Of the four cells around the edge from this node along `axis`.
  void add_quad(const Node& n, int axis) {
    const auto a = static_cast<std::size_t>(axis);
    Node to = n;
    ++to[a];
    const bool leaves = inside(n);
    if (leaves == inside(to)) return;
    std::array<std::uint32_t, 4> around{};
    for (std::size_t c = 0; c < 4; ++c) {  // counter-clockwise seen from the far end of the edge
      Node cell = n;
      if (c == 0 || c == 3) --cell[(a + 1) % 3];
      if (c == 0 || c == 1) --cell[(a + 2) % 3];
      around[c] = vertices_[slot(cell[2])][index(cell[0], cell[1])];
    }
    if (!leaves) std::swap(around[1], around[3]);
    mesh_.triangles.push_back({around[0], around[1], around[2]});
    mesh_.triangles.push_back({around[0], around[2], around[3]});
  }

  const TriDexel& dexels_;
  std::array<int, 3> nodes_;
  std::array<std::vector<std::uint8_t>, 2> inside_{};     // of two layers of nodes
  std::array<std::vector<std::uint32_t>, 2> vertices_{};  // of two layers of cells
  stock::SurfaceMesh mesh_{};
};

}  // namespace

stock::SurfaceMesh plain_dexel_mesh(const TriDexel& dexels) { return SurfaceNets(dexels).run(); }

}  // namespace frustum::bench
