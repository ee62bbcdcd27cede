// The grid cells that the surface passes through, and the pieces of surface in each.
//
// On a face of a cell the surface runs in arcs from crossing edge to crossing edge; the arcs of the
// six faces close to cycles, and every cycle is one piece of surface: one vertex of the mesh. A
// face whose corners alternate leaves a choice of how its four edges pair up. Both cells at the
// face make the same one: the pairing whose arcs fit the exact tangents better. Only where that
// would put both arcs into one cycle on both sides, which would give four triangles a common edge,
// the other one is taken; that splits the cycle on either side, so the mesh is manifold whatever
// the signs are.
// Units: none (indices). Errors: none. Threads: built on oneTBB, same bits for any number of
// threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "stock/mesh/surface_mesh_crossings.hpp"

namespace frustum::stock {

// Corner c of a cell is its low node plus bit d of c along axis d. Edge 4 d + a + 2 b runs along
// axis d from the corner at a along d + 1 and b along d + 2 (cyclic).
struct CellEdge {
  int axis = 0;
  int low_corner = 0;
  [[nodiscard]] constexpr int high_corner() const { return low_corner | (1 << axis); }
};
[[nodiscard]] constexpr CellEdge cell_edge(int edge) {
  const int axis = edge / 4;
  const int a = edge % 2;
  const int b = edge / 2 % 2;
  return {axis, a << (axis + 1) % 3 | b << (axis + 2) % 3};
}

struct Cell {
  std::int32_t level = 0;
  std::uint32_t first_vertex = 0;  // the vertices of its pieces follow one another
  std::uint32_t pieces = 0;        // two bits an edge: the piece that a crossing edge belongs to
  std::uint8_t corners = 0;        // a bit a corner: inside
  std::uint8_t joined = 0;  // a bit for the low face of each axis: arcs run round void corners
  std::uint8_t piece_count = 0;

  [[nodiscard]] constexpr bool inside(int corner) const { return (corners >> corner & 1) != 0; }
  [[nodiscard]] constexpr bool crosses(int edge) const {
    const CellEdge e = cell_edge(edge);
    return inside(e.low_corner) != inside(e.high_corner());
  }
  [[nodiscard]] std::uint32_t piece(int edge) const { return pieces >> 2 * edge & 3U; }
};

// But for the numbers of their vertices.
[[nodiscard]] inline bool are_alike(const Cell& a, const Cell& b) {
  return a.level == b.level && a.corners == b.corners && a.joined == b.joined &&
         a.piece_count == b.piece_count && a.pieces == b.pieces;
}

class Cells {
 public:
  explicit Cells(const Crossings& crossings);

  // Cells of column (i, j), by rising level; the one at a level, or null; the one that is there.
  [[nodiscard]] std::span<const Cell> column(int i, int j) const;
  [[nodiscard]] const Cell* find(int i, int j, int level) const;
  [[nodiscard]] const Cell& at(int i, int j, int level) const;
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }

 private:
  using Place = std::array<int, 3>;
  [[nodiscard]] std::size_t column_index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_x_) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] std::size_t index_of(const Place& place) const;
  void find_cells(const Crossings& crossings);
  void choose_arcs(const Crossings& crossings);
  void trace(std::size_t cell, const Place& place);
  void part_shared_cycles();
  void number_vertices();

  int columns_x_ = 0;
  int columns_y_ = 0;
  std::vector<std::size_t> first_;
  std::vector<Cell> cells_;
  std::size_t vertex_count_ = 0;
};

}  // namespace frustum::stock
