#include "stock/mesh/surface_mesh_cells.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace frustum::stock {
namespace {

// A face of a cell: its four corners in order around it, and the edge from each to the next.
struct CellFace {
  std::array<int, 4> corners{};
  std::array<int, 4> edges{};
};

// The face across `axis` on the low (side 0) or high (side 1) end.
constexpr CellFace cell_face(int axis, int side) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const int base = side << axis;
  CellFace face;
  face.corners = {base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v};
  // An edge along u has a = its place along u + 1 = v, b = along u + 2 = axis; one along v has a =
  // its place along axis, b = along u.
  face.edges = {4 * u + 2 * side, 4 * v + side + 2, 4 * u + 1 + 2 * side, 4 * v + side};
  return face;
}

constexpr bool alternates(const Cell& cell, const CellFace& face) {
  return cell.inside(face.corners[0]) != cell.inside(face.corners[1]) &&
         cell.inside(face.corners[0]) == cell.inside(face.corners[2]) &&
         cell.inside(face.corners[1]) == cell.inside(face.corners[3]);
}

// Twelve edges in sets; the representative of a set is its lowest edge.
class EdgeSets {
 public:
  constexpr EdgeSets() {
    for (int edge = 0; edge < 12; ++edge) parent_[static_cast<std::size_t>(edge)] = edge;
  }
  [[nodiscard]] constexpr int root(int edge) const {
    while (parent_[static_cast<std::size_t>(edge)] != edge) {
      edge = parent_[static_cast<std::size_t>(edge)];
    }
    return edge;
  }
  constexpr void unite(int a, int b) {
    const int low = std::min(root(a), root(b));
    const int high = std::max(root(a), root(b));
    parent_[static_cast<std::size_t>(high)] = low;
  }

 private:
  std::array<int, 12> parent_{};
};

// Adds the arcs of a face. Around corner c run the edges c and c - 1 of the face.
constexpr void add_arcs(EdgeSets& sets, const Cell& cell, const CellFace& face, bool joined) {
  if (alternates(cell, face)) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (cell.inside(face.corners[c]) != joined)
        sets.unite(face.edges[c], face.edges[(c + 3) % 4]);
    }
    return;
  }
  int open = -1;
  for (const int edge : face.edges) {
    if (!cell.crosses(edge)) continue;
    if (open >= 0) sets.unite(open, edge);
    open = edge;
  }
}

// The pieces that a cell's edges are of, by whose arcs they are joined.
constexpr void number_pieces(const EdgeSets& sets, Cell& cell) {
  cell.pieces = 0;
  cell.piece_count = 0;
  std::array<std::uint32_t, 12> piece_of_root{};
  for (int edge = 0; edge < 12; ++edge) {
    if (!cell.crosses(edge)) continue;
    const int root = sets.root(edge);
    auto& piece = piece_of_root[static_cast<std::size_t>(root)];
    if (root == edge) piece = cell.piece_count++;
    cell.pieces |= piece << 2 * edge;
  }
}

// What the corners of a cell say of it; where a face alternates, its pieces are not known by them.
struct CornerCase {
  std::uint32_t pieces = 0;
  std::uint8_t piece_count = 0;
  std::uint8_t alternating = 0;  // a bit 2 axis + side for each face
};
constexpr std::array<CornerCase, 256> kCornerCases = [] {
  std::array<CornerCase, 256> cases{};
  for (int corners = 0; corners < 256; ++corners) {
    Cell cell{.corners = static_cast<std::uint8_t>(corners)};
    EdgeSets sets;
    CornerCase& here = cases[static_cast<std::size_t>(corners)];
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const CellFace face = cell_face(axis, side);
        add_arcs(sets, cell, face, false);
        if (alternates(cell, face))
          here.alternating = static_cast<std::uint8_t>(here.alternating | 1 << (2 * axis + side));
      }
    }
    number_pieces(sets, cell);
    here.pieces = cell.pieces;
    here.piece_count = cell.piece_count;
  }
  return cases;
}();

bool alternates(const Cell& cell, int axis, int side) {
  return (kCornerCases[cell.corners].alternating >> (2 * axis + side) & 1) != 0;
}

// How badly an arc between two crossings leaves their tangent planes.
double misfit(const HermiteSample& a, const HermiteSample& b) {
  const Vec3 chord = b.point - a.point;
  const double at_a = chord.dot(a.normal);
  const double at_b = chord.dot(b.normal);
  return at_a * at_a + at_b * at_b;
}

constexpr std::array<int, 3> node_of(const std::array<int, 3>& place, int corner) {
  return {place[0] + (corner & 1), place[1] + (corner >> 1 & 1), place[2] + (corner >> 2 & 1)};
}

}  // namespace

Cells::Cells(const Crossings& crossings)
    : columns_x_(crossings.grid().nodes[0] - 1), columns_y_(crossings.grid().nodes[1] - 1) {
  find_cells(crossings);
  choose_arcs(crossings);
  part_shared_cycles();
  number_vertices();
}

void Cells::find_cells(const Crossings& crossings) {
  first_.assign(column_index(0, columns_y_) + 1, 0);
  std::vector<std::vector<Cell>> rows(static_cast<std::size_t>(columns_y_));
  tbb::parallel_for(0, columns_y_, [&](int j) {
    std::vector<std::int32_t> levels;
    for (int i = 0; i < columns_x_; ++i) {
      levels.clear();
      for (int edge = 0; edge < 12; ++edge) {
        const CellEdge e = cell_edge(edge);
        const auto node = node_of({i, j, 0}, e.low_corner);
        if (e.axis != 2 && node[2] == 1) continue;  // the edge of the cell above, seen from below
        for (const CrossingEdge& crossing : crossings.edges(e.axis, node[0], node[1])) {
          levels.push_back(crossing.level);
          if (e.axis != 2) levels.push_back(crossing.level - 1);
        }
      }
      std::sort(levels.begin(), levels.end());
      levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
      for (const std::int32_t level : levels) {
        Cell cell{.level = level};
        for (int corner = 0; corner < 8; ++corner) {
          const auto node = node_of({i, j, level}, corner);
          if (!crossings.inside(node[0], node[1], node[2])) continue;
          cell.corners = static_cast<std::uint8_t>(cell.corners | 1 << corner);
        }
        rows[static_cast<std::size_t>(j)].push_back(cell);
      }
      first_[column_index(i, j) + 1] = levels.size();
    }
  });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  cells_.reserve(first_.back());
  for (const auto& row : rows) cells_.insert(cells_.end(), row.begin(), row.end());
}

void Cells::choose_arcs(const Crossings& crossings) {
  const auto for_each_cell = [this](const auto& visit) {
    tbb::parallel_for(0, columns_y_, [&](int j) {
      for (int i = 0; i < columns_x_; ++i) {
        for (std::size_t c = first_[column_index(i, j)]; c < first_[column_index(i, j) + 1]; ++c) {
          visit(c, Place{i, j, cells_[c].level});
        }
      }
    });
  };
  for_each_cell([&](std::size_t c, const Place& place) {
    Cell& cell = cells_[c];
    for (int axis = 0; axis < 3; ++axis) {
      if (!alternates(cell, axis, 0)) continue;
      const CellFace face = cell_face(axis, 0);
      std::array<HermiteSample, 4> samples;
      for (std::size_t k = 0; k < 4; ++k) {
        const CellEdge e = cell_edge(face.edges[k]);
        const auto node = node_of(place, e.low_corner);
        samples[k] = crossings.sample(*crossings.find(e.axis, node[0], node[1], node[2]), e.axis);
      }
      const double round_even = misfit(samples[0], samples[3]) + misfit(samples[1], samples[2]);
      const double round_odd = misfit(samples[0], samples[1]) + misfit(samples[2], samples[3]);
      // A tie goes to round_odd or round_even, whichever goes round the material corners.
      const bool even_inside = cell.inside(face.corners[0]);
      const bool joined = even_inside ? round_odd < round_even : round_even < round_odd;
      if (joined) cell.joined = static_cast<std::uint8_t>(cell.joined | 1 << axis);
    }
  });
  for_each_cell([&](std::size_t c, const Place& place) { trace(c, place); });
}

// Finds the pieces of one cell from the choices made for its faces.
void Cells::trace(std::size_t at, const Place& place) {
  Cell& cell = cells_[at];
  const CornerCase& corners = kCornerCases[cell.corners];
  if (corners.alternating == 0) {
    cell.pieces = corners.pieces;
    cell.piece_count = corners.piece_count;
    return;
  }
  EdgeSets sets;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Cell* owner = &cell;
      if (side == 1 && alternates(cell, axis, side)) {
        Place next = place;
        ++next[static_cast<std::size_t>(axis)];
        owner = &cells_[index_of(next)];
      }
      add_arcs(sets, cell, cell_face(axis, side), (owner->joined >> axis & 1) != 0);
    }
  }
  number_pieces(sets, cell);
  assert(cell.piece_count >= 1 && cell.piece_count <= 4);
}

void Cells::part_shared_cycles() {
  // The four edges of an alternating face in one piece: both its arcs are in one cycle.
  const auto one_piece = [](const Cell& cell, const CellFace& face) {
    return std::all_of(face.edges.begin(), face.edges.end(),
                       [&](int edge) { return cell.piece(edge) == cell.piece(face.edges[0]); });
  };
  for (int j = 0; j < columns_y_; ++j) {
    for (int i = 0; i < columns_x_; ++i) {
      for (std::size_t c = first_[column_index(i, j)]; c < first_[column_index(i, j) + 1]; ++c) {
        for (int axis = 0; axis < 3; ++axis) {
          if (!alternates(cells_[c], axis, 0)) continue;
          const Place place{i, j, cells_[c].level};
          Place below = place;
          --below[static_cast<std::size_t>(axis)];
          const std::size_t other = index_of(below);
          if (!one_piece(cells_[c], cell_face(axis, 0)) ||
              !one_piece(cells_[other], cell_face(axis, 1))) {
            continue;
          }
          cells_[c].joined = static_cast<std::uint8_t>(cells_[c].joined ^ 1 << axis);
          trace(c, place);
          trace(other, below);
        }
      }
    }
  }
}

void Cells::number_vertices() {
  for (Cell& cell : cells_) {
    cell.first_vertex = static_cast<std::uint32_t>(vertex_count_);
    vertex_count_ += cell.piece_count;
  }
  assert(vertex_count_ <= std::numeric_limits<std::uint32_t>::max());
}

const Cell* Cells::find(int i, int j, int level) const {
  const auto cells = column(i, j);
  const auto found = std::partition_point(cells.begin(), cells.end(),
                                          [&](const Cell& cell) { return cell.level < level; });
  return found != cells.end() && found->level == level ? &*found : nullptr;
}

std::size_t Cells::index_of(const Place& place) const {
  const Cell* found = find(place[0], place[1], place[2]);
  assert(found != nullptr);
  return static_cast<std::size_t>(found - cells_.data());
}

std::span<const Cell> Cells::column(int i, int j) const {
  const std::size_t from = first_[column_index(i, j)];
  return std::span(cells_).subspan(from, first_[column_index(i, j) + 1] - from);
}

const Cell& Cells::at(int i, int j, int level) const { return cells_[index_of({i, j, level})]; }

}  // namespace frustum::stock
