// The triangles of a closed mesh with their neighbours: for collapsing edges in place.
//
// Model    : half-edge 3 t + k runs from corner k of triangle t to its next corner; across it is
//            the half-edge that runs back. collapse() moves the start of a half-edge to its end:
//            the vertex and two triangles are gone, and the numbers of all others stay. flip()
//            exchanges the diagonal of two triangles; half-edges of these two get other numbers
// Shape    : triangles counter-clockwise seen from outside; of one that is gone, all corners are
//            kGone
// Errors   : linked() gives nothing for a mesh that is not closed and 2-manifold, or names a vertex
//            twice in a triangle
// Threads  : collapses may run at once where the rings of their vertices share no vertex.
//            linked() runs on oneTBB, the same links for any number of threads; it takes time by
//            the squares of the numbers of triangles at the vertices
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace frustum::stock {

struct TriangleLinks {
  static constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::array<std::uint32_t, 3>> triangles{};
  std::vector<std::uint32_t> across{};   // by half-edge
  std::vector<std::uint32_t> leaving{};  // by vertex: a half-edge from it; kGone: none

  [[nodiscard]] static std::uint32_t next(std::uint32_t half) {
    return half % 3 == 2 ? half - 2 : half + 1;
  }
  [[nodiscard]] static std::uint32_t before(std::uint32_t half) {
    return half % 3 == 0 ? half + 2 : half - 1;
  }
  [[nodiscard]] std::uint32_t from(std::uint32_t half) const {
    return triangles[half / 3][half % 3];
  }
  [[nodiscard]] std::uint32_t to(std::uint32_t half) const { return from(next(half)); }
  // The half-edge from the same vertex that follows counter-clockwise.
  [[nodiscard]] std::uint32_t turned(std::uint32_t half) const { return across[before(half)]; }
  [[nodiscard]] bool is_gone(std::uint32_t triangle) const {
    return triangles[triangle][0] == kGone;
  }
  template <typename Visit>
  void for_each_leaving(std::uint32_t vertex, const Visit& visit) const {
    const std::uint32_t first = leaving[vertex];
    if (first == kGone) return;
    std::uint32_t half = first;
    do {
      visit(half);
      half = turned(half);
    } while (half != first);
  }
  [[nodiscard]] std::size_t valence(std::uint32_t vertex) const {
    std::size_t count = 0;
    for_each_leaving(vertex, [&](std::uint32_t) { ++count; });
    return count;
  }

  [[nodiscard]] bool has_three(std::uint32_t vertex) const {
    const std::uint32_t first = leaving[vertex];
    return turned(turned(turned(first))) == first;
  }

  // The surface stays a closed 2-manifold.
  [[nodiscard]] bool may_collapse(std::uint32_t half) const;
  // Precondition: may_collapse().
  void collapse(std::uint32_t half);
  // The other diagonal of the two triangles at an edge; likewise.
  [[nodiscard]] bool may_flip(std::uint32_t half) const;
  void flip(std::uint32_t half);
};

[[nodiscard]] std::optional<TriangleLinks> linked(
    std::vector<std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count);

}  // namespace frustum::stock
