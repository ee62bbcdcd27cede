#include "metrology/probing/stylus_collision.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "metrology/fit/element.hpp"

namespace frustum::metrology {
namespace {

constexpr int kLines = 12;

// Whether a surface crosses a cylinder of that radius from `tip` to the head.
bool is_crossed(const SurfaceProbeRef& part, const Stylus& stylus, const Vec3& tip, double radius) {
  const auto [u, v] = tangents(stylus.direction);
  const Vec3 whole = stylus.length * stylus.direction.vec();
  for (int i = 0; i < kLines; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kLines;
    const Vec3 low = tip + radius * (std::cos(angle) * u + std::sin(angle) * v);
    if (part.touch(low + whole, -stylus.direction, stylus.length) ||
        part.touch(low, stylus.direction, stylus.length)) {
      return true;
    }
  }
  return false;
}

std::string_view words(StylusFault fault) {
  switch (fault) {
    case StylusFault::shank_at_contact:
      return "the stylus shank meets the part when the ball touches";
    case StylusFault::shank_before:
      return "the stylus shank meets the part before the approach";
    case StylusFault::ball_on_the_way:
      return "the ball meets the part on its way along the stylus to the approach";
    case StylusFault::none:
      break;
  }
  return "";
}

}  // namespace

StylusFault stylus_fault(const SurfaceProbeRef& part, const Stylus& stylus,
                         const BallApproach& approach, const Vec3& contact) {
  const double shank = 0.5 * stylus.diameter;
  const Vec3 start =
      approach.target + (approach.ball_radius + approach.clearance) * approach.outward.vec();
  if (is_crossed(part, stylus, contact, shank)) return StylusFault::shank_at_contact;
  if (is_crossed(part, stylus, start, shank)) return StylusFault::shank_before;
  if (is_crossed(part, stylus, start, approach.ball_radius)) return StylusFault::ball_on_the_way;
  return StylusFault::none;
}

void StylusFaults::note(StylusFault fault, std::size_t point) {
  if (fault == StylusFault::none) return;
  if (count_++ > 0) return;
  first_ = point;
  kind_ = fault;
}

std::optional<Diagnostic> StylusFaults::warning_for(std::string_view feature,
                                                    std::size_t points) const {
  if (count_ == 0) return std::nullopt;
  return warning(
      "stylus-collision"_id,
      fmt::format("feature '{}', point {}: {}; {} of {} points are not reached freely", feature,
                  first_ + 1, words(kind_), count_, points),
      "state a longer, thinner or differently directed cmm.stylus, or leave these points "
      "out");
}

}  // namespace frustum::metrology
