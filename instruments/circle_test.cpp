#include "instruments/circle_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "instruments/reach.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

// One axis on a circle: radius and phase behind its command.
struct AxisSwing {
  AxisLetter letter = AxisLetter::X;
  double amplitude = 0.0;
  double lag = 0.0;  // rad
};

AxisSwing swing_of(const Machine& machine, AxisLetter letter, const CircleTest& circle) {
  const double gain = machine.joint(letter)->dynamics.servo_gain;
  if (!circle.feed || gain == 0.0) return {letter, circle.length, 0.0};
  const double behind = *circle.feed / (circle.length * gain);
  return {letter, circle.length / std::hypot(1.0, behind), std::atan(behind)};
}

// Before and after the samples: so that all axes have turned back once, and their play is taken up.
constexpr double kOvershootOfCircle = std::numbers::pi;

std::optional<Diagnostic> impossible(const Machine& machine, const CircleTest& circle) {
  for (const AxisLetter letter : axes_of(circle.plane)) {
    if (machine.joint(letter) != nullptr) continue;
    return error("unknown-axis"_id,
                 fmt::format("machine {} has no axis {} for a circle in {}", machine.name(),
                             to_char(letter), name_of(circle.plane)));
  }
  if (!(circle.length > 0.0)) {
    return error("out-of-range"_id,
                 fmt::format("the bar is {:g} mm long: expected a length above 0", circle.length));
  }
  if (circle.angles.empty()) {
    return error("no-samples"_id, "the circle has no angles to be sampled at");
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(Plane plane) {
  constexpr std::array<std::string_view, 3> kNames{"XY", "YZ", "ZX"};
  return kNames[static_cast<std::size_t>(plane)];
}

std::optional<Plane> plane_named(std::string_view text) {
  const auto found = std::ranges::find(kPlanes, text, [](Plane p) { return name_of(p); });
  return found == kPlanes.end() ? std::nullopt : std::optional(*found);
}

std::array<AxisLetter, 2> axes_of(Plane plane) {
  using enum AxisLetter;
  constexpr std::array<std::array<AxisLetter, 2>, 3> kAxes{{{X, Y}, {Y, Z}, {Z, X}}};
  return kAxes[static_cast<std::size_t>(plane)];
}

std::string_view name_of(Sense sense) { return sense == Sense::ccw ? "ccw" : "cw"; }

Result<MotionTest> circle_test(const Machine& machine, const CircleTest& circle) {
  if (const auto problem = impossible(machine, circle)) return *problem;
  const auto [first, second] = axes_of(circle.plane);
  const AxisPositions centre = place_tip(machine, circle.centre, circle.tool_length, circle.held);
  const Mat3 directions = linear_axis_directions(machine, centre);
  const Vec3 e1 = directions.col(static_cast<Eigen::Index>(first));
  const Vec3 e2 = directions.col(static_cast<Eigen::Index>(second));
  const AxisSwing swing1 = swing_of(machine, first, circle);
  const AxisSwing swing2 = swing_of(machine, second, circle);
  const double w = sign_of(circle.sense);
  const auto axes_at = [centre, swing1, swing2, w](double phi) {
    AxisPositions q = centre;
    q[swing1.letter] += swing1.amplitude * std::cos(phi - w * swing1.lag);
    q[swing2.letter] += swing2.amplitude * std::sin(phi - w * swing2.lag);
    return q;
  };
  MotionTest test{
      .table_ball = circle.centre, .bar = circle.length, .tool_length = circle.tool_length};
  take_poses(test, circle.angles, [&](double phi) -> TestPose {
    return {phi, axes_at(phi),
            circle.centre + circle.length * (std::cos(phi) * e1 + std::sin(phi) * e2)};
  });
  const auto [least, most] = std::ranges::minmax(circle.angles);
  // An upright arc, one with a gap of more than two steps, is none of a turn so that the bar stays
  // above the table.
  constexpr double kOvershootOfArc = 2.0 * kRadPerDeg;
  const double gap = 2.0 * std::numbers::pi - (most - least);
  const auto steps = static_cast<double>(circle.angles.size()) - 1.0;
  const bool arc = circle.plane != Plane::XY && steps > 0.0 && gap > 2.0 * (most - least) / steps;
  const double over = arc ? kOvershootOfArc : kOvershootOfCircle;
  test.motion = w > 0.0 ? TestMotion{axes_at, least - over, most + over}
                        : TestMotion{axes_at, most + over, least - over};
  if (auto problem = out_of_reach(machine, test, "phi")) return *std::move(problem);
  return test;
}

}  // namespace frustum::instruments
