// A value that is the size of something: a form is the peak to valley of deviations, a
// concentricity the length of an offset. Noise makes such a value larger, never smaller than zero;
// what it is the size of tells by how much.
//
// Model  : size(parts), where measuring errors move the parts in proportion; size(c parts) = c
//          size(parts) for c >= 0
// Units  : mm
// Errors : none
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"

namespace frustum::metrology {

enum class NonNegativeKind {
  none,                  // the value has either sign, or its parts are not known
  peak_to_valley,        // one part a place; where there are rows of places, of the worst row
  twice_largest,         // three parts a place, a vector: twice the longest
  twice_largest_height,  // one part a place, of either sign: twice the largest amount
  length                 // of the vector of all parts; no places
};

// How a size comes of its parts.
struct SizeRule {
  NonNegativeKind kind = NonNegativeKind::none;
  std::vector<std::size_t> rows{};  // of a peak to valley: places in each row; empty: all in one

  // 0 of no parts.
  [[nodiscard]] double operator()(std::span<const double> parts) const;
};

struct NonNegative {
  SizeRule rule{};
  std::vector<double> parts{};  // mm
  // mm, where on a surface they stand: near ones are alike. Empty where parts are few or those of
  // an element, which are taken as measured.
  std::vector<Vec3> places{};
  // Of each place, the variance that its own points give it in any direction, in those of a point:
  // 1 of a measured point, less of the centre of a section. Empty: parts of an element, which move
  // with it alone.
  std::vector<double> own{};

  [[nodiscard]] bool is_known() const { return rule.kind != NonNegativeKind::none; }
};

[[nodiscard]] double size_of(const NonNegative& measurand);

// Heights of places along a direction, counted from their mean.
[[nodiscard]] NonNegative heights_along(const Vec3& direction, std::vector<Vec3> places);
// The vector itself.
[[nodiscard]] NonNegative length_of(const Vec3& vector);

}  // namespace frustum::metrology
