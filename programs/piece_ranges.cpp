#include "programs/piece_ranges.hpp"

#include <fmt/format.h>

namespace frustum::programs {

Diagnostic refused_number(DiagnosticId id, const char* key, std::string what, std::string hint) {
  Diagnostic failure = error(id, std::move(what), std::move(hint));
  failure.key = key;
  return failure;
}

std::optional<Diagnostic> out_of_range(std::span<const PieceRange> ranges, const Vec3& center) {
  for (const PieceRange& r : ranges) {
    if (r.value >= r.lowest && r.value <= r.highest) continue;
    return refused_number(
        "out-of-range"_id, r.key, fmt::format("{:g} {}", r.value, r.unit),
        fmt::format("it must be between {:g} and {:g} {}", r.lowest, r.highest, r.unit));
  }
  constexpr double kReach = 5e4;  // mm, beyond any machine's travel
  if (!(center.allFinite() && center.norm() < kReach)) {
    return refused_number("out-of-range"_id, "center", "the centre is out of any machine's reach",
                          "x,y,z in mm");
  }
  return std::nullopt;
}

}  // namespace frustum::programs
