// The triangles around a vertex, as a collapse of one of its edges needs them.
//
// Units    : mm
// Errors   : look() is false for more than kMostSpokes
// Accuracy : departure() is no less than the distance of any point of the fan before to the fan
//            after, and the other way round, within rounding
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pose.hpp"
#include "stock/mesh/triangle_links.hpp"

namespace frustum::stock {

// A vertex with what is around it, counter-clockwise.
struct VertexFan {
  static constexpr std::size_t kMostSpokes = 40;  // longer fans take longer and are ugly

  std::uint32_t vertex = 0;
  std::size_t size = 0;
  std::array<std::uint32_t, kMostSpokes> half{};   // to spoke i
  std::array<std::uint32_t, kMostSpokes> spoke{};  // triangle i is between spokes i and i + 1
  std::array<Vec3, kMostSpokes> normal{};          // of triangle i, twice its area
  // Seen along the mean normal, from the vertex: across in x and y, the height in z.
  Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), up = Vec3::UnitZ();
  std::array<Vec3, kMostSpokes> seen{};
  bool is_graph = false;  // no triangle stands on its edge or is turned over, seen so

  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == size ? 0 : i + 1; }
  [[nodiscard]] std::size_t before(std::size_t i) const { return (i == 0 ? size : i) - 1; }

  // False if there are too many spokes.
  [[nodiscard]] bool look(std::span<const Vec3> vertices, const TriangleLinks& links,
                          std::uint32_t centre);
  // When the vertex goes to the end of spoke `target`: seen from above, both fans are functions
  // over one polygon; the most that they differ by in height, or infinity where one is none.
  [[nodiscard]] double departure(std::size_t target) const;
  // Then, the triangle that is over `at`, counted from the one after the target; it is looked for
  // from where triangle `from` was.
  [[nodiscard]] std::uint32_t sector(std::size_t target, const Vec3& at, std::size_t from) const;
};

}  // namespace frustum::stock
