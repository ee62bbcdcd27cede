// Places about a pole, and arcs that lead on from the move before: LP, CP, CTP and CT of Klartext.
#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/running/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr double kSamePlace = 1e-6;       // mm
constexpr double kNearlyStraight = 1e-9;  // sine of the angle between heading and chord

}  // namespace

// PR and PA; what is not given stays as it is about the pole.
BlockExecutor::Outcome BlockExecutor::set_target_about_pole(const BlockWords& words) {
  const char first = words.first_of(LetterSet("pq"));
  if (first == 0) return Done{};
  for (const char letter : {'X', 'Y'}) {
    if (!words.has(letter)) continue;
    return fail(words[letter].column,
                fmt::format("{} beside a polar position", words.text_of(letter)),
                "give the place in the plane by PR and PA, or by X and Y");
  }
  if (!state_.pole) return fail(words[first].column, "there is no pole", "give it by CC before");
  const Vec3 pole = *state_.pole;
  const auto relative = [&](char letter) {
    return !words.has(letter) || words[letter].measure == Measure::incremental;
  };
  double radius = 0.0;
  double angle = 0.0;
  if (relative(kPolarRadius) || relative(kPolarAngle)) {
    for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
      if (position_[axis]) continue;
      return fail(words[first].column,
                  fmt::format("the polar position goes on from one that is not known: {}",
                              position_.why_unknown(axis)),
                  "give both PR and PA");
    }
    const double x = *position_[AxisLetter::X] - pole[0];
    const double y = *position_[AxisLetter::Y] - pole[1];
    if (x == 0.0 && y == 0.0 && relative(kPolarAngle)) {
      return fail(words[first].column, "a polar position without angle, from the pole",
                  "give PA in degrees");
    }
    radius = std::hypot(x, y);
    angle = std::atan2(y, x);
  }
  const auto apply = [&](char letter, double& value, double scale) {
    if (!words.has(letter)) return;
    value = (relative(letter) ? value : 0.0) + words[letter].value * scale;
  };
  apply(kPolarRadius, radius, unit_scale());
  apply(kPolarAngle, angle, kRadPerDeg);
  position_.set(AxisLetter::X, pole[0] + radius * std::cos(angle));
  position_.set(AxisLetter::Y, pole[1] + radius * std::sin(angle));
  return Done{};
}

// IPA has the sign of DR.
BlockExecutor::Outcome BlockExecutor::check_turned_angle(const BlockWords& words,
                                                         const ArcWords& arc) const {
  const GivenWord& angle = words[kPolarAngle];
  if (angle.value != 0.0 && (angle.value < 0.0) == arc.clockwise) return Done{};
  return fail(angle.column,
              fmt::format("{} does not turn as {} says", words.text_of(kPolarAngle),
                          arc.clockwise ? "DR-" : "DR+"),
              "give IPA and DR the same sign");
}

// The arc that leaves its start in the direction of the last move.
BlockExecutor::Outcome BlockExecutor::lead_on(const Movement& movement, ArcWords& arc) const {
  const PlaneAxes axes = axes_of(arc.plane);
  const auto in_plane = [&](const Vec3& v) { return Vec3(v[axes.u], v[axes.v], 0.0); };
  const auto& heading = state_.heading;
  if (!heading || in_plane(heading->at - arc.start).norm() > kSamePlace) {
    return fail(movement.column, "the arc leads on from no move",
                "move along a contour in the plane before it, by L, C, CR or CT");
  }
  const Vec3 along = in_plane(heading->along).normalized();
  const Vec3 left(-along[1], along[0], 0.0);
  const Vec3 chord = in_plane(arc.end - arc.start);
  const double aside = chord.dot(left);
  if (!(std::abs(aside) > kNearlyStraight * chord.norm())) {
    return fail(movement.column, "the end of the arc lies straight ahead or behind",
                "write an L block, or give another end");
  }
  const double radius = chord.squaredNorm() / (2.0 * aside);
  arc.clockwise = aside < 0.0;
  arc.centre_is_absolute = true;
  arc.centre = {};
  arc.centre.at(static_cast<std::size_t>(axes.u)) = arc.start[axes.u] + radius * left[0];
  arc.centre.at(static_cast<std::size_t>(axes.v)) = arc.start[axes.v] + radius * left[1];
  return Done{};
}

// A move that stays where it was in the plane has no direction; the one before it counts.
void BlockExecutor::keep_heading(const AxisTarget& before) {
  if (!rules_.arcs_turn_about_pole) return;
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
    if (before[axis] && position_[axis]) continue;
    state_.heading.reset();
    return;
  }
  const auto point = [](const AxisTarget& target) {
    return Vec3(*target[AxisLetter::X], *target[AxisLetter::Y], 0.0);
  };
  const Vec3 at = point(position_.target());
  const Vec3 along = at - point(before);
  if (along.norm() > kSamePlace) state_.heading = Heading{at, along};
}

}  // namespace frustum::parser
