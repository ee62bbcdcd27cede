// The centre of a G2 or G3 arc from its centre words or its radius.
//
// Model    : in the plane's axes (u, v) and its normal w, a right-handed triple: XY has (X, Y, Z),
//            ZX has (Z, X, Y), YZ has (Y, Z, X); counterclockwise is seen from +w
// Units    : mm
// Shape    : centre words or a radius, not both; a radius below zero is the arc longer than half a
//            turn
// Errors   : no centre, both, radius zero or too small, end at the start with a radius, radii that
//            disagree by more than the tolerance
// Accuracy : 1e-12 relative
// Source   : RS-274/NGC, sections 3.5.3.1 and 3.5.3.2
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// Indices (0 X, 1 Y, 2 Z) of the plane's first and second axis and its normal.
struct PlaneAxes {
  int u;
  int v;
  int w;
};
[[nodiscard]] constexpr PlaneAxes axes_of(Plane plane) {
  constexpr std::array kAxes{PlaneAxes{0, 1, 2}, PlaneAxes{2, 0, 1}, PlaneAxes{1, 2, 0}};
  return kAxes[static_cast<std::size_t>(plane)];
}
// "I and J": the words that give the centre in the plane.
[[nodiscard]] const char* centre_words(Plane plane);

// How far the words of an arc may disagree: what a post-processor's rounding leaves on a large
// radius.
struct ArcTolerance {
  // Of the radii at start and end: always, and in proportion to the radius up to the largest.
  double absolute = 0.01;  // mm
  double relative = 0.001;
  double largest = 0.5;  // mm
  // By how much R may be below half the chord; absent: as the radii.
  std::optional<double> reach{};  // mm
  double least_radius = 0.0;      // mm: a smaller radius is none

  [[nodiscard]] double at(double radius) const;
};

struct ArcWords {
  Plane plane = Plane::xy;
  bool clockwise = false;
  Vec3 start = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  std::array<std::optional<double>, 3> centre{};  // I J K; those of the plane count
  bool centre_is_absolute = false;                // G90.1
  std::optional<double> radius{};
  ArcTolerance tolerance{};
  std::string_view radius_word = "R";  // as the program writes it, for messages
};

struct Arc {
  Vec3 centre = Vec3::Zero();  // at the height of the start along the normal
  // Where the arc ends: the programmed end, or exactly the start when it is less than 1e-6 mm from
  // it.
  Vec3 end = Vec3::Zero();
};

// The diagnostic has no place; the caller knows which word to point at.
[[nodiscard]] Result<Arc> arc_of(const ArcWords& words);

}  // namespace frustum::parser
