// Which rays of a grid, and which places in it, boxes reach.
//
// Model    : the shadow of each box along the three axes, on the cells between the grid's rays. A
//            place is out of reach where its shadow along one axis, on whole cells, meets none:
//            boxes that reach a place are never missed, some that do not are counted
// Units    : mm; frame: that of the grid
// Shape    : memory as the rays of the grid, 4 bytes each, whatever the number of boxes
// Errors   : none; boxes beside the grid reach nothing
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "stock/dexel/tri_dexel.hpp"

namespace frustum::stock {

class ReachedRays {
 public:
  ReachedRays(const DexelGrid& grid, std::span<const Box> boxes);

  // Rays of one axis, as DexelGrid::ray() names them; `last` is one of them.
  struct Rays {
    std::array<int, 2> first{}, last{};  // u, v
  };
  [[nodiscard]] bool any(int axis, const Rays& rays) const;
  [[nodiscard]] bool reaches(int axis, int u, int v) const { return any(axis, {{u, v}, {u, v}}); }
  // Whether a box may reach into this one.
  [[nodiscard]] bool reaches(const Box& place) const;

 private:
  // By cell (u, v), counted from 1 in either direction: how many up to it are in a shadow.
  using Shadow = std::vector<std::uint32_t>;
  [[nodiscard]] std::array<int, 2> nodes_across(int axis) const {
    return {grid_.nodes[static_cast<std::size_t>((axis + 1) % 3)],
            grid_.nodes[static_cast<std::size_t>((axis + 2) % 3)]};
  }
  struct Cells {
    std::array<int, 3> first{}, last{};
  };
  [[nodiscard]] Cells cells_of(const Box& box) const;
  [[nodiscard]] static bool is_none(const Cells& cells);
  void cast(int axis, std::span<const Cells> boxes);

  DexelGrid grid_;
  std::array<Shadow, 3> shadows_;
};

}  // namespace frustum::stock
