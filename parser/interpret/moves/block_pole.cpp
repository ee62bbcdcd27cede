// Poles, places about them, and arcs that lead on from the move before: CC, LP, CP, CTP and CT of
// Klartext; G110 to G112, AP=, RP= and CT of Sinumerik.
#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr double kSamePlace = 1e-6;       // mm
constexpr double kNearlyStraight = 1e-9;  // sine of the angle between heading and chord

}  // namespace

BlockExecutor::Outcome BlockExecutor::set_pole(const BlockWords& words) {
  Vec3 here = Vec3::Zero();
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    here[static_cast<Eigen::Index>(axis)] = position_[axis].value_or(0.0);
  }
  Vec3 pole = state_.pole ? state_.pole->at : here;
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
    const char letter = to_char(axis);
    const bool relative = words.has(letter) && words[letter].measure == Measure::incremental;
    const bool as_before = !words.has(letter) && !state_.pole;
    if ((relative || as_before) && !position_[axis]) {
      return fail(words[CodeGroup::non_modal].column, position_.unknown_id(axis),
                  fmt::format("the pole needs a position, but {}", position_.why_unknown(axis)),
                  fmt::format("give {} of the pole without I", letter));
    }
    if (!words.has(letter)) continue;
    pole[static_cast<Eigen::Index>(axis)] =
        words[letter].value * unit_scale() + (relative ? *position_[axis] : 0.0);
  }
  // CC alone is where the tool stands.
  if ((words.given() & LetterSet("XY")).empty()) pole = here;
  state_.pole = Pole{.at = pole};
  return Done{};
}

// G110, G111, G112: along the plane's axes, or by radius and angle.
BlockExecutor::Outcome BlockExecutor::set_pole_in_plane(const BlockWords& words, NonModal from) {
  const GivenCode& code = words[CodeGroup::non_modal];
  const PlaneAxes axes = axes_of(state_.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const std::string letters = fmt::format("{} and {}", to_char(u), to_char(v));
  const char normal = to_char(static_cast<AxisLetter>(axes.w));
  if (words.has(normal)) {
    return fail(words[normal].column, "pole-plane"_id,
                fmt::format("{} of a pole", words.text_of(normal)),
                fmt::format("a pole lies in the plane: give {}", letters));
  }
  for (const char letter : {to_char(u), to_char(v), kPolarRadius, kPolarAngle}) {
    if (!words.has(letter) || words[letter].measure == Measure::modal) continue;
    return fail(
        words[letter].column, "pole-measure"_id,
        fmt::format("{} has a measure of its own", words.name_of(letter)),
        "G110 counts from where the tool is, G111 from the origin, G112 from the last pole");
  }
  const bool polar = words.has(kPolarRadius) && words.has(kPolarAngle);
  const bool either = words.has(kPolarRadius) || words.has(kPolarAngle);
  const bool axis_words = words.has(to_char(u)) || words.has(to_char(v));
  const bool both = words.has(to_char(u)) && words.has(to_char(v));
  const bool whole_place = from == NonModal::pole_from_origin ? both : axis_words;
  if (polar == whole_place || (either && !polar) || (axis_words && polar)) {
    return fail(code.column, "pole-place-missing"_id,
                fmt::format("{} without a place", code.code->name()),
                fmt::format("give {}, or RP= and AP=", letters));
  }
  Vec3 pole = Vec3::Zero();
  if (from == NonModal::pole_from_here) {
    for (const AxisLetter axis : {u, v}) {
      if (!position_[axis]) {
        return fail(code.column, position_.unknown_id(axis),
                    fmt::format("the pole needs a position, but {}", position_.why_unknown(axis)),
                    "give the pole by G111");
      }
      pole[static_cast<Eigen::Index>(axis)] = *position_[axis];
    }
  } else if (from == NonModal::pole_from_pole) {
    const auto last = pole_for(code.column);
    if (!last) return last.error();
    pole = last->at;
  }
  if (polar) {
    const double radius = words[kPolarRadius].value * unit_scale();
    const double angle = words[kPolarAngle].value * kRadPerDeg;
    pole[axes.u] += radius * std::cos(angle);
    pole[axes.v] += radius * std::sin(angle);
  } else {
    pole[axes.u] += scaled(u, words[to_char(u)].value);
    pole[axes.v] += scaled(v, words[to_char(v)].value);
  }
  state_.pole = Pole{.at = pole, .plane = state_.plane};
  state_.pole_lost = false;
  return Done{};
}

// The frame of its coordinates is another one now.
void BlockExecutor::lose_pole() {
  state_.pole_lost = state_.pole_lost || (state_.pole && state_.pole->given);
  state_.pole.reset();
}

Result<Pole> BlockExecutor::pole_for(std::uint32_t column) const {
  if (state_.pole && state_.pole->plane == state_.plane) return *state_.pole;
  const std::string give = fmt::format("give it by {} before", rules_.polar.pole);
  if (state_.pole && state_.pole->given) {
    return fail(column, "pole-plane"_id, "the pole is one of another plane", give);
  }
  if (rules_.polar.origin_is_pole && !state_.pole_lost) {
    return Pole{.plane = state_.plane, .given = false};
  }
  return fail(column, "pole-missing"_id, "there is no pole", give);
}

// What is left out or steps goes on from the tool's place; that has to be where it was written
// last.
BlockExecutor::Outcome BlockExecutor::check_place_about_pole(const BlockWords& words,
                                                             const Pole& pole, double radius,
                                                             double angle) const {
  if (!rules_.polar.words_stay) return Done{};
  const auto goes_on = [&](char letter) {
    return !words.has(letter) || words[letter].measure == Measure::incremental ||
           (words[letter].measure == Measure::modal &&
            state_.distance == DistanceMode::incremental);
  };
  const std::uint32_t column = words[words.first_of(LetterSet("pq"))].column;
  const std::string both = fmt::format("give both {} and {}, or give them by AC()",
                                       rules_.polar.radius, rules_.polar.angle);
  const auto left = [&](std::string_view name) {
    return fail(column, "polar-chain"_id,
                fmt::format("{} goes on from the last one, but the tool has left that", name),
                both);
  };
  if (goes_on(kPolarRadius)) {
    if (!pole.radius && words.has(kPolarRadius)) {
      return fail(column, "polar-chain"_id,
                  fmt::format("{} is a step, but there is none before it about this pole",
                              words.text_of(kPolarRadius)),
                  both);
    }
    if (pole.radius && std::abs(*pole.radius - radius) > kSamePlace)
      return left(rules_.polar.radius);
  }
  if (goes_on(kPolarAngle)) {
    if (!pole.angle) {
      return fail(column, "polar-chain"_id,
                  fmt::format("{} goes on from the last one, but there is none about this pole",
                              rules_.polar.angle),
                  both);
    }
    const double apart = 2.0 * radius * std::abs(std::sin((*pole.angle - angle) / 2.0));
    if (apart > kSamePlace) return left(rules_.polar.angle);
  }
  return Done{};
}

// PR and PA, RP= and AP=; what is not given stays as it is about the pole.
BlockExecutor::Outcome BlockExecutor::set_target_about_pole(const BlockWords& words) {
  const char first = words.first_of(LetterSet("pq"));
  if (first == 0) return Done{};
  const PolarRules& names = rules_.polar;
  const PlaneAxes axes = axes_of(state_.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  for (const char letter : {to_char(u), to_char(v)}) {
    if (!words.has(letter)) continue;
    return fail(words[letter].column, "polar-with-axis"_id,
                fmt::format("{} beside a polar position", words.text_of(letter)),
                fmt::format("give the place in the plane by {} and {}, or by {} and {}",
                            names.radius, names.angle, to_char(u), to_char(v)));
  }
  auto pole = pole_for(words[first].column);
  if (!pole) return pole.error();
  const auto relative = [&](char letter) {
    const Measure measure = words[letter].measure;
    return !words.has(letter) || measure == Measure::incremental ||
           (measure == Measure::modal && state_.distance == DistanceMode::incremental);
  };
  const bool open = names.words_stay && words.has(kPolarRadius) &&
                    words[kPolarRadius].measure == Measure::modal &&
                    state_.distance == DistanceMode::incremental;
  if (open) {
    return fail(words[kPolarRadius].column, "polar-measure"_id,
                words.text_of(kPolarRadius) + " in G91", "say how it counts: RP=AC() or RP=IC()");
  }
  double radius = 0.0;
  double angle = 0.0;
  if (relative(kPolarRadius) || relative(kPolarAngle)) {
    for (const AxisLetter axis : {u, v}) {
      if (position_[axis]) continue;
      return fail(words[first].column, position_.unknown_id(axis),
                  fmt::format("the polar position goes on from one that is not known: {}",
                              position_.why_unknown(axis)),
                  fmt::format("give both {} and {}", names.radius, names.angle));
    }
    const double from_u = *position_[u] - pole->at[axes.u];
    const double from_v = *position_[v] - pole->at[axes.v];
    if (from_u == 0.0 && from_v == 0.0 && relative(kPolarAngle) && !pole->angle) {
      return fail(words[first].column, "polar-angle-missing"_id,
                  "a polar position without angle, from the pole",
                  fmt::format("give {} in degrees", names.angle));
    }
    radius = std::hypot(from_u, from_v);
    angle = std::atan2(from_v, from_u);
    if (auto done = check_place_about_pole(words, *pole, radius, angle); !done) return done;
    if (names.words_stay) {
      radius = pole->radius.value_or(radius);
      angle = pole->angle.value_or(angle);
    }
  }
  const auto apply = [&](char letter, double& value, double scale) {
    if (!words.has(letter)) return;
    value = (relative(letter) ? value : 0.0) + words[letter].value * scale;
  };
  apply(kPolarRadius, radius, unit_scale());
  apply(kPolarAngle, angle, kRadPerDeg);
  if (names.words_stay && radius < 0.0) {
    return fail(
        words[first].column, "value-negative"_id,
        fmt::format("the polar radius is {:g} mm", radius),
        fmt::format("{} is not negative; turn {} by 180 degrees", names.radius, names.angle));
  }
  position_.set(u, pole->at[axes.u] + radius * std::cos(angle));
  position_.set(v, pole->at[axes.v] + radius * std::sin(angle));
  if (!names.words_stay) return Done{};
  pole->radius = radius;
  pole->angle = angle;
  state_.pole = *pole;
  return Done{};
}

// G2 and G3 with a polar end.
BlockExecutor::Outcome BlockExecutor::turn_about_pole(const BlockWords& words,
                                                      const Movement& movement,
                                                      ArcWords& arc) const {
  if (const char shape = words.first_of(LetterSet("IJKR")); shape != 0) {
    return fail(words[shape].column, "polar-with-axis"_id,
                fmt::format("{} beside a polar position", words.text_of(shape)),
                fmt::format("an arc with {} and {} turns about the pole", rules_.polar.radius,
                            rules_.polar.angle));
  }
  const auto pole = pole_for(movement.column);
  if (!pole) return pole.error();
  const PlaneAxes axes = axes_of(arc.plane);
  arc.centre_is_absolute = true;
  arc.centre = {};
  for (const int axis : {axes.u, axes.v}) {
    arc.centre.at(static_cast<std::size_t>(axis)) = pole->at[axis];
  }
  return Done{};
}

// IPA has the sign of DR.
BlockExecutor::Outcome BlockExecutor::check_turned_angle(const BlockWords& words,
                                                         const ArcWords& arc) const {
  const GivenWord& angle = words[kPolarAngle];
  if (angle.value != 0.0 && (angle.value < 0.0) == arc.clockwise) return Done{};
  return fail(angle.column, "arc-direction"_id,
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
    return fail(movement.column, "arc-tangent-missing"_id, "the arc leads on from no move",
                "move along a contour in the plane before it");
  }
  const Vec3 along = in_plane(heading->along).normalized();
  const Vec3 left(-along[1], along[0], 0.0);
  const Vec3 chord = in_plane(arc.end - arc.start);
  const double aside = chord.dot(left);
  if (!(std::abs(aside) > kNearlyStraight * chord.norm())) {
    return fail(movement.column, "arc-straight"_id,
                "the end of the arc lies straight ahead or behind",
                "write a straight move, or give another end");
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
  if (!rules_.arcs_lead_on) return;
  const PlaneAxes axes = axes_of(state_.plane);
  Vec3 at = Vec3::Zero();
  Vec3 along = Vec3::Zero();
  for (const int slot : {axes.u, axes.v}) {
    const auto axis = static_cast<AxisLetter>(slot);
    if (!before[axis] || !position_[axis]) {
      state_.heading.reset();
      return;
    }
    at[slot] = *position_[axis];
    along[slot] = at[slot] - *before[axis];
  }
  if (along.norm() > kSamePlace) state_.heading = Heading{at, along};
}

}  // namespace frustum::parser
