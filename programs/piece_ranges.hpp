// The numbers of a test piece, held against what a machine could do before anything is generated.
//
// Units  : as the unit of each range says; the centre mm
// Errors : the first number outside its range, not finite or not, with its key
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/diagnostic.hpp"
#include "core/pose.hpp"

namespace frustum::programs {

struct PieceRange {
  const char* key;
  double value, lowest, highest;
  const char* unit;
};

[[nodiscard]] Diagnostic refused_number(DiagnosticId id, const char* key, std::string what,
                                        std::string hint);
[[nodiscard]] std::optional<Diagnostic> out_of_range(std::span<const PieceRange> ranges,
                                                     const Vec3& center);

}  // namespace frustum::programs
