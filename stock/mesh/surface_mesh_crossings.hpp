// The grid edges that the surface crosses, with the exact point and normal of each crossing.
//
// A grid node is inside the material when the Z ray through it says so; the X and Y rays only say
// where. So the three directions cannot contradict each other: where an X or Y ray, by rounding,
// does not see the crossing that the nodes demand, the node in dispute is on the surface within
// rounding, and the nearest interval end of the three rays through it gives point and normal. Edges
// are kept by columns of the grid: (i, j) at index i + nodes_x * j, upwards in a column.
// Units: mm. Errors: none. Threads: built on oneTBB, the same bits for any number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "stock/dexel/tri_dexel.hpp"
#include "stock/dexel/tri_dexel_solid.hpp"

namespace frustum::stock {

// A point of the exact surface and its outward unit normal.
struct HermiteSample {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  EndTag tag = -1;  // what made the surface there, if it is known
};

// An edge from node (i, j, level) one step along its axis.
struct CrossingEdge {
  std::int32_t level = 0;
  bool lower_inside = false;
};

class Crossings {
 public:
  Crossings(SolidView solid, const TriDexel& dexels) : Crossings(solid, dexels, Known{}) {}
  // The same, where much is known of the solid: where a ray ends as it did, its point and normal
  // are those found then. Both of one grid.
  struct Known {
    const Crossings* crossings = nullptr;
    const TriDexel* dexels = nullptr;
  };
  Crossings(SolidView solid, const TriDexel& dexels, const Known& known);

  [[nodiscard]] const DexelGrid& grid() const { return grid_; }
  // Edges of one axis that start in column (i, j), by rising level.
  [[nodiscard]] std::span<const CrossingEdge> edges(int axis, int i, int j) const;
  [[nodiscard]] const HermiteSample& sample(std::size_t edge, int axis) const {
    return families_[static_cast<std::size_t>(axis)].samples[edge];
  }
  [[nodiscard]] bool lower_inside(std::size_t edge, int axis) const {
    return families_[static_cast<std::size_t>(axis)].edges[edge].lower_inside;
  }
  // Whether the sample is, bit for bit, what was known of that edge.
  [[nodiscard]] bool is_known(std::size_t edge, int axis) const {
    return families_[static_cast<std::size_t>(axis)].known[edge] != 0;
  }
  // Number, within its axis, of the first edge of column (i, j), and of the edge at (i, j, level).
  [[nodiscard]] std::size_t first(int axis, int i, int j) const;
  [[nodiscard]] std::optional<std::size_t> find(int axis, int i, int j, int level) const;
  [[nodiscard]] std::size_t count(int axis) const {
    return families_[static_cast<std::size_t>(axis)].edges.size();
  }
  [[nodiscard]] bool inside(int i, int j, int k) const;

 private:
  struct Family {
    std::vector<std::size_t> first;
    std::vector<CrossingEdge> edges;
    std::vector<HermiteSample> samples;
    std::vector<std::uint8_t> known;
  };
  [[nodiscard]] std::size_t column(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(grid_.nodes[0]) +
           static_cast<std::size_t>(i);
  }
  void find_edges(const TriDexel& dexels, int axis);
  void sample_edges(SolidView solid, const TriDexel& dexels, int axis, const Known& known);

  DexelGrid grid_;
  std::array<Family, 3> families_;
};

}  // namespace frustum::stock
