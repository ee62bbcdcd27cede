#include "instruments/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisPositions;

constexpr double kStep = 1.0 * kRadPerDeg;  // between the places of an arc that are looked at

std::optional<Diagnostic> beyond(const kinematics::Machine& machine, const AxisPositions& q,
                                 const std::string& place) {
  if (within_travel(machine, q)) return std::nullopt;
  return error("axis-overtravel"_id,
               fmt::format("the test cannot be run: {}: {}", place,
                           fmt::join(kinematics::travel_violations(machine, q), "; ")),
               "use a shorter bar, another place of the table ball or fewer angles");
}

}  // namespace

std::optional<Diagnostic> out_of_reach(const kinematics::Machine& machine, const MotionTest& test,
                                       const std::string& what) {
  const auto place = [&](double parameter) {
    return fmt::format("at {} = {:.6g} deg", what, parameter * kDegPerRad);
  };
  for (const TestPose& pose : test.poses) {
    if (auto problem = beyond(machine, pose.at.q, place(pose.parameter))) return problem;
  }
  if (!test.motion.axes) return std::nullopt;
  // Between the samples, which may be few.
  const auto [least, most] = std::ranges::minmax_element(test.poses, {}, &TestPose::parameter);
  if (least == test.poses.end()) return std::nullopt;
  const double from = least->parameter, to = most->parameter;
  for (int i = 1; from + i * kStep < to; ++i) {
    const double parameter = from + i * kStep;
    if (auto problem = beyond(machine, test.motion.axes(parameter), place(parameter))) {
      return problem;
    }
  }
  return std::nullopt;
}

}  // namespace frustum::instruments
