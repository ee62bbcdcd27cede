#include "parser/arc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parser/language/expression.hpp"

namespace frustum::parser {
namespace {

// Shorter than any controller's increment: an arc that ends so near its start is a full circle.
constexpr double kFullCircleGap = 1e-6;  // mm
// A difference of just the tolerance is allowed, whatever its last digits.
constexpr double kRounding = 1e-9;  // mm

const char* word_of(bool clockwise) { return clockwise ? "G2" : "G3"; }

// A length for a message: the digits that matter and no more.
std::string mm(double length) { return fmt::format("{:.6g} mm", length); }

Result<Arc> arc_by_radius(const ArcWords& words) {
  const PlaneAxes axes = axes_of(words.plane);
  const double radius = *words.radius;
  if (radius == 0.0) {
    return error("arc-radius-zero"_id, fmt::format("{} is zero", words.radius_word),
                 fmt::format("give the radius, or the centre by {}", centre_words(words.plane)));
  }
  const double du = words.end[axes.u] - words.start[axes.u];
  const double dv = words.end[axes.v] - words.start[axes.v];
  const double chord = std::hypot(du, dv);
  if (chord < kFullCircleGap) {
    return error("arc-full-by-radius"_id,
                 fmt::format("an arc with {} ends at its start, which leaves its centre open",
                             words.radius_word),
                 fmt::format("give the centre of a full circle by {}", centre_words(words.plane)));
  }
  const double half = chord / 2.0;
  if (half - std::abs(radius) > words.tolerance.reach.value_or(words.tolerance.at(half))) {
    return error("arc-radius"_id,
                 fmt::format("{} {} is too small: the end is {} from the start", words.radius_word,
                             mm(std::abs(radius)), mm(chord)),
                 fmt::format("{0} must be at least {1}; correct {0} or the end", words.radius_word,
                             mm(half)));
  }
  // From the middle of the chord to the centre; left of the chord for a short counterclockwise arc.
  const double height = std::sqrt(std::max(radius * radius - half * half, 0.0));
  const double side = words.clockwise == (radius > 0.0) ? -1.0 : 1.0;
  Arc arc{words.start, words.end};
  arc.centre[axes.u] = words.start[axes.u] + du / 2.0 - side * height * dv / chord;
  arc.centre[axes.v] = words.start[axes.v] + dv / 2.0 + side * height * du / chord;
  return arc;
}

Result<Arc> arc_by_centre(const ArcWords& words) {
  const PlaneAxes axes = axes_of(words.plane);
  Arc arc{words.start, words.end};
  for (const int axis : {axes.u, axes.v}) {
    const auto& word = words.centre.at(static_cast<std::size_t>(axis));
    if (words.centre_is_absolute && !word) {
      return error("arc-centre-missing"_id,
                   fmt::format("{} has half a centre", word_of(words.clockwise)),
                   fmt::format("after G90.1 give both {}", centre_words(words.plane)));
    }
    arc.centre[axis] = words.centre_is_absolute ? *word : words.start[axis] + word.value_or(0.0);
  }
  const auto distance = [&](const Vec3& point) {
    return std::hypot(point[axes.u] - arc.centre[axes.u], point[axes.v] - arc.centre[axes.v]);
  };
  const double at_start = distance(words.start);
  const double at_end = distance(words.end);
  if (at_start <= words.tolerance.least_radius) {
    return error("arc-centre-is-start"_id, "the centre of the arc is its start",
                 fmt::format("{} lead from the start to the centre", centre_words(words.plane)));
  }
  const double difference = std::abs(at_start - at_end);
  const ArcTolerance& allowed = words.tolerance;
  if (difference > allowed.at(std::max(at_start, at_end)) + kRounding) {
    return error("arc-radius"_id,
                 fmt::format("the start of the arc is {} from the centre, its end {}: {} apart",
                             mm(at_start), mm(at_end), mm(difference)),
                 fmt::format("allowed are {:.3g} mm, or {:g} % of the radius up to {:.3g} mm; "
                             "correct {} or the end",
                             allowed.absolute, 100.0 * allowed.relative, allowed.largest,
                             centre_words(words.plane)));
  }
  const double gap =
      std::hypot(words.end[axes.u] - words.start[axes.u], words.end[axes.v] - words.start[axes.v]);
  if (gap < kFullCircleGap) {
    arc.end[axes.u] = words.start[axes.u];
    arc.end[axes.v] = words.start[axes.v];
  }
  return arc;
}

}  // namespace

double ArcTolerance::at(double radius) const {
  return std::max(absolute, std::min(relative * radius, largest));
}

const char* centre_words(Plane plane) {
  constexpr std::array kWords{"I and J", "I and K", "J and K"};
  return kWords.at(static_cast<std::size_t>(plane));
}

Result<Arc> arc_of(const ArcWords& words) {
  const bool has_centre = std::any_of(words.centre.begin(), words.centre.end(),
                                      [](const auto& word) { return word.has_value(); });
  if (has_centre && words.radius) {
    return error(
        "arc-centre-twice"_id,
        fmt::format("{} has both {} and a centre", word_of(words.clockwise), words.radius_word),
        fmt::format("give {}, or {}", words.radius_word, centre_words(words.plane)));
  }
  if (words.radius) return arc_by_radius(words);
  if (has_centre) return arc_by_centre(words);
  return error("arc-centre-missing"_id,
               fmt::format("{} without a centre", word_of(words.clockwise)),
               fmt::format("give {}, or {}", centre_words(words.plane), words.radius_word));
}

}  // namespace frustum::parser
