// A flat polygon cut into triangles.
//
// Model    : ears are cut off one after the other; a hole is joined to the outline by a bridge
// Units    : mm; only x and y count
// Shape    : outline counter-clockwise seen from above, without crossings; n^2 for n corners
// Errors   : none; of an outline that crosses itself fewer triangles come back than corners less 2
// Accuracy : the triangles have the polygon's corners
// Source   : Meisters 1975, Am. Math. Monthly 82(6)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace frustum::programs {

using Triangle = std::array<std::uint32_t, 3>;

// Above 0 for a counter-clockwise outline.
[[nodiscard]] double area_of(std::span<const Vec3> outline);

// Numbers of corners, counter-clockwise.
[[nodiscard]] std::vector<Triangle> triangles_of(std::span<const Vec3> outline);

// Between a convex outline and a hole in it, both counter-clockwise: numbers of corners of the
// outline, then of the hole.
[[nodiscard]] std::vector<Triangle> triangles_around(std::span<const Vec3> outline,
                                                     std::span<const Vec3> hole);

}  // namespace frustum::programs
