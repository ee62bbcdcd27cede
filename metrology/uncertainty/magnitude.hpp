// A value that is the size of something: a form is the peak to valley of deviations, a concentricity
// the length of an offset. Noise makes such a value larger, never smaller than zero; what it is the
// size of tells by how much.
//
// Model  : size(parts), where measuring errors move the parts in proportion; size(c parts) = c size(parts)
//          for c >= 0
// Units  : mm
// Errors : none
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"

namespace frustum::metrology {

enum class MagnitudeKind {
  none,            // the value is no magnitude, or nobody told its parts
  peak_to_valley,  // one part a place
  twice_largest,   // three parts a place, a vector: twice the longest
  length           // of the vector of all parts; no places
};

struct Magnitude {
  MagnitudeKind kind = MagnitudeKind::none;
  std::vector<double> parts{};  // mm
  std::vector<Vec3> places{};   // mm, where on the part they stand
};

[[nodiscard]] double size_of(MagnitudeKind kind, std::span<const double> parts);

}  // namespace frustum::metrology
