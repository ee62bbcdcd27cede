#include "instruments/line_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "instruments/readings.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::AxisRange;
using kinematics::Machine;

Vec3 tip_at(const Machine& machine, const AxisPositions& q, double tool_length) {
  return nominal_pose(machine, q, tool_length).translation;
}

std::optional<Diagnostic> no_linear_axis(const Machine& machine, AxisLetter letter) {
  const kinematics::Joint* joint = machine.joint(letter);
  if (joint != nullptr && !joint->rotary()) return std::nullopt;
  return error("unknown-axis"_id,
               fmt::format("{} is no linear axis of machine {}", to_char(letter), machine.name()));
}

std::optional<Diagnostic> beyond_travel(const Machine& machine, const AxisPositions& q,
                                        const std::string& what) {
  if (within_travel(machine, q)) return std::nullopt;
  return error("axis-overtravel"_id, fmt::format("{} cannot be reached: {}", what,
                                                 fmt::join(travel_violations(machine, q), "; ")));
}

Result<LineTest> diagonal(const Machine& machine, const Diagonals& d, const std::string& signs) {
  LineTest line;
  const auto place = [&](double share) {
    AxisPositions q = d.held;
    std::size_t i = 0;
    for (const auto& [letter, range] : d.box) {
      q[letter] =
          signs[i] == '+' ? range.lo + share * range.width() : range.hi - share * range.width();
      ++i;
    }
    return q;
  };
  const Vec3 first = tip_at(machine, place(0.0), d.tool_length);
  const Vec3 whole = tip_at(machine, place(1.0), d.tool_length) - first;
  line.direction = whole.normalized();
  line.start = place(-0.01);
  for (int k = 0; k < d.points; ++k) {
    const AxisPositions q = place(static_cast<double>(k) / (d.points - 1));
    if (auto problem =
            beyond_travel(machine, q, fmt::format("point {} of diagonal {}", k + 1, signs))) {
      return *std::move(problem);
    }
    const Vec3 tip = tip_at(machine, q, d.tool_length);
    line.poses.push_back({(tip - first).norm(), q, tip});
  }
  return line;
}

}  // namespace

Result<LineTest> axis_line(const Machine& machine, const AxisLine& line, RunDirection direction) {
  if (const auto problem = no_linear_axis(machine, line.axis)) return *problem;
  if (line.targets.size() < 2) {
    return error("too-few-targets"_id,
                 fmt::format("a line needs two targets, given are {}", line.targets.size()));
  }
  for (std::size_t i = 1; i < line.targets.size(); ++i) {
    if (line.targets[i] > line.targets[i - 1]) continue;
    return error("targets-not-increasing"_id,
                 fmt::format("target {:g} mm follows {:g} mm: targets must increase",
                             line.targets[i], line.targets[i - 1]));
  }
  const auto place = [&](double position) {
    AxisPositions q = line.held;
    q[line.axis] = position;
    return q;
  };
  LineTest test;
  const double first = line.targets.front(), last = line.targets.back();
  test.direction = (tip_at(machine, place(last), line.tool_length) -
                    tip_at(machine, place(first), line.tool_length))
                       .normalized();
  const bool up = direction == RunDirection::up;
  test.start = place(up ? first - line.overrun : last + line.overrun);
  for (const double target : line.targets) {
    const AxisPositions q = place(target);
    if (auto problem = beyond_travel(machine, q, fmt::format("target {:g} mm", target))) {
      return *std::move(problem);
    }
    test.poses.push_back({target, q, tip_at(machine, q, line.tool_length)});
  }
  if (!up) std::ranges::reverse(test.poses);
  return test;
}

Result<std::map<std::string, LineTest>> diagonal_lines(const Machine& machine,
                                                       const Diagonals& diagonals) {
  if (diagonals.box.size() < 2 || diagonals.box.size() > 3) {
    return error("box-axes"_id,
                 fmt::format("a box has two or three axes, given are {}", diagonals.box.size()),
                 "for example \"X=-200:200,Y=-150:150,Z=0:300\"");
  }
  if (diagonals.points < 2) {
    return error("too-few-targets"_id,
                 fmt::format("a diagonal needs two points, given are {}", diagonals.points));
  }
  for (const auto& [letter, range] : diagonals.box) {
    if (const auto problem = no_linear_axis(machine, letter)) return *problem;
    if (range.width() > 0.0) continue;
    return error("box-empty"_id, fmt::format("the box has no width in {}: {:g} .. {:g} mm",
                                             to_char(letter), range.lo, range.hi));
  }
  const std::vector<std::string> signs = diagonals.box.size() == 2
                                             ? std::vector<std::string>{"++", "+-"}
                                             : std::vector<std::string>{"+++", "++-", "+-+", "-++"};
  std::map<std::string, LineTest> lines;
  for (const std::string& each : signs) {
    auto line = diagonal(machine, diagonals, each);
    if (!line) return line.error();
    lines.emplace(each, *std::move(line));
  }
  return lines;
}

std::vector<double> line_readings(const kinematics::ForwardChain& actual, const LineTest& line,
                                  const SetupErrors& setup) {
  std::vector<double> readings;
  readings.reserve(line.poses.size());
  for (const Vec3& d : displacements(actual, line.poses, setup)) {
    readings.push_back(d.dot(line.direction));
  }
  return readings;
}

std::vector<double> from_first(std::vector<double> readings) {
  const double first = readings.empty() ? 0.0 : readings.front();
  for (double& each : readings) each -= first;
  return readings;
}

}  // namespace frustum::instruments
