#include "instruments/cone_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/constants.hpp"
#include "instruments/reach.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;
using kinematics::ToolPose;

constexpr double kOvershootOfCone = 2.0 * kRadPerDeg;

// The rotary axes change by at most a few degrees between neighbours, but beside a pole.
constexpr double kNodeStep = 0.5 * kRadPerDeg;

class ConePath {
 public:
  ConePath(const Machine& machine, const ConeTest& cone)
      : machine_(machine), cone_(cone), tilt_(rotation_y(cone.inclination)) {}

  [[nodiscard]] ToolPose pose_at(double phi) const {
    const double s = std::sin(cone_.cone_angle), c = std::cos(cone_.cone_angle);
    const Vec3 outward(std::cos(phi), std::sin(phi), 0.0);
    return {cone_.centre + tilt_ * (cone_.radius * outward),
            tilt_ * Vec3(-s * outward.x(), -s * outward.y(), c)};
  }

  // Follows the rotary axes from phi = 180 deg to `from` and to `to`.
  std::optional<Diagnostics> follow(double from, double to) {
    from_ = from;
    nodes_.resize(static_cast<std::size_t>(std::ceil((to - from) / kNodeStep)) + 1);
    const double middle = std::clamp(std::numbers::pi, from, to);
    const auto first = static_cast<std::size_t>(std::round((middle - from) / kNodeStep));
    const auto begin = inverse(machine_, pose_at(node(first)), cone_.tool_length, preferred());
    if (!begin) return begin.error();
    nodes_[first] = (*begin)[0].axes;
    for (std::size_t i = first; i-- > 0;) {
      if (auto problem = step(i, nodes_[i + 1])) return problem;
    }
    for (std::size_t i = first + 1; i < nodes_.size(); ++i) {
      if (auto problem = step(i, nodes_[i - 1])) return problem;
    }
    return std::nullopt;
  }

  // Within from .. to, after follow().
  [[nodiscard]] AxisPositions axes_at(double phi) const {
    const double place =
        std::clamp((phi - from_) / kNodeStep, 0.0, static_cast<double>(nodes_.size() - 1));
    const AxisPositions& previous = nodes_[static_cast<std::size_t>(std::round(place))];
    const auto found = inverse(machine_, pose_at(phi), cone_.tool_length, previous);
    return found ? nearest(*found, previous) : previous;
  }

 private:
  [[nodiscard]] double node(std::size_t i) const {
    return from_ + static_cast<double>(i) * kNodeStep;
  }
  // The tilt axis below zero, C at half a turn.
  [[nodiscard]] AxisPositions preferred() const {
    AxisPositions q;
    for (const kinematics::Joint& joint : machine_.joints()) {
      if (!joint.rotary()) continue;
      q[joint.letter] = joint.letter == AxisLetter::C ? std::numbers::pi
                                                      : -(cone_.cone_angle + cone_.inclination);
    }
    return q;
  }
  // Of the solutions, within travel or not, the one that goes on smoothly.
  static AxisPositions nearest(const kinematics::InverseSolutions& found,
                               const AxisPositions& previous) {
    const auto distance = [&](const AxisPositions& q) {
      double sum = 0.0;
      for (const AxisLetter letter : kinematics::kRotaryAxes) {
        sum += std::abs(q[letter] - previous[letter]);
      }
      return sum;
    };
    AxisPositions best = found[0].axes;
    for (std::size_t i = 1; i < found.size(); ++i) {
      if (distance(found[i].axes) < distance(best)) best = found[i].axes;
    }
    return best;
  }
  std::optional<Diagnostics> step(std::size_t i, const AxisPositions& previous) {
    const auto found = inverse(machine_, pose_at(node(i)), cone_.tool_length, previous);
    if (!found) return found.error();
    nodes_[i] = nearest(*found, previous);
    return std::nullopt;
  }

  const Machine& machine_;
  ConeTest cone_;
  Mat3 tilt_;
  double from_ = 0.0;
  std::vector<AxisPositions> nodes_{};
};

std::optional<Diagnostic> impossible_cone(const ConeTest& cone) {
  constexpr double kRight = 0.5 * std::numbers::pi;
  if (!(cone.cone_angle > 0.0 && cone.cone_angle < kRight)) {
    return error("out-of-range"_id,
                 fmt::format("cone angle {:g} deg: expected half the apex angle, above 0 and below "
                             "90 deg",
                             cone.cone_angle * kDegPerRad));
  }
  if (!(std::abs(cone.inclination) < kRight)) {
    return error("out-of-range"_id, fmt::format("inclination {:g} deg: expected -90 to 90 deg",
                                                cone.inclination * kDegPerRad));
  }
  if (!(cone.radius > 0.0)) {
    return error("out-of-range"_id,
                 fmt::format("radius {:g} mm: expected a length above 0", cone.radius));
  }
  if (cone.angles.empty()) {
    return error("no-samples"_id, "the test has no angles to be sampled at");
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(ConeSense sense) {
  return sense == ConeSense::normal ? "normal" : "radial";
}

Result<MotionTest> cone_test(const Machine& machine, const ConeTest& cone) {
  if (const auto problem = impossible_cone(cone)) return *problem;
  const auto [least, most] = std::ranges::minmax(cone.angles);
  auto path = std::make_shared<ConePath>(machine, cone);
  if (auto problems = path->follow(least - kOvershootOfCone, most + kOvershootOfCone)) {
    return *std::move(problems);
  }
  const bool normal = cone.sense == ConeSense::normal;
  const double below = normal ? cone.radius * std::tan(cone.cone_angle) : 0.0;
  MotionTest test{
      .table_ball = cone.centre - below * (rotation_y(cone.inclination) * Vec3::UnitZ()),
      .bar = normal ? cone.radius / std::cos(cone.cone_angle) : cone.radius,
      .tool_length = cone.tool_length};
  test.poses.reserve(cone.angles.size());
  for (const double phi : cone.angles) {
    test.poses.push_back({phi, path->axes_at(phi), path->pose_at(phi).tip});
  }
  test.motion = {[path](double phi) { return path->axes_at(phi); }, least - kOvershootOfCone,
                 most + kOvershootOfCone};
  if (auto problem = out_of_reach(machine, test, "phi")) return *std::move(problem);
  return test;
}

}  // namespace frustum::instruments
