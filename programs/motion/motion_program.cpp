#include "programs/motion/motion_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "programs/motion/motion_blocks.hpp"

namespace frustum::programs {
namespace {

using instruments::MotionTest;
using kinematics::AxisPositions;
using kinematics::Machine;

constexpr double kFeedIn = 1.5;  // mm: by what the bar is too long where it is approached

std::optional<Diagnostic> unreachable(const Machine& machine, const AxisPositions& q,
                                      const char* what) {
  if (within_travel(machine, q)) return std::nullopt;
  return error("axis-overtravel"_id,
               fmt::format("{} cannot be reached: {}", what,
                           fmt::join(kinematics::travel_violations(machine, q), "; ")),
               "choose other angles, or another place of the table ball");
}

// Longer by the feed-in, at the same rotary positions.
AxisPositions fed_out(const Machine& machine, const MotionTest& test, const AxisPositions& q) {
  const Vec3 tip = nominal_pose(machine, q, test.tool_length).translation;
  const Vec3 outward = (tip - test.table_ball).normalized();
  return place_tip(machine, tip + kFeedIn * outward, test.tool_length, q);
}

struct PassNames {
  const char* up;
  const char* down;
};

// Both passes, with `run(blocks, from, to)` between feed-in and feed-out.
template <typename Run>
std::optional<Diagnostic> add_passes(MotionBlocks& blocks, const Machine& machine,
                                     const MotionTest& test, const MotionProgramOptions& options,
                                     const PassNames& names, const Run& run) {
  const BarPass pass = pass_of(machine, test);
  const AxisPositions begin = test.motion.axes(pass.from), end = test.motion.axes(pass.to);
  const AxisPositions before = fed_out(machine, test, begin), after = fed_out(machine, test, end);
  if (auto problem = unreachable(machine, before, "the place where the bar is mounted")) {
    return problem;
  }
  if (auto problem = unreachable(machine, after, "the place where the bar is fed out")) {
    return problem;
  }
  blocks.begin(before);
  blocks.approach(before);
  blocks.stop("MOUNT THE BAR");
  blocks.comment(names.up);
  blocks.feed(begin);
  run(blocks, pass.from, pass.to);
  blocks.feed(after);
  blocks.dwell(options.dwell);
  blocks.comment(names.down);
  blocks.feed(end);
  run(blocks, pass.to, pass.from);
  blocks.feed(before);
  blocks.stop("TAKE THE BAR OFF");
  return std::nullopt;
}

void describe(MotionBlocks& blocks, const MotionTest& test) {
  blocks.comment(fmt::format("BAR {:g} MM, TABLE BALL AT X{:g} Y{:g} Z{:g} OF THE TABLE", test.bar,
                             test.table_ball.x(), test.table_ball.y(), test.table_ball.z()));
  blocks.comment(fmt::format("T1 IS THE SPINDLE BALL, LENGTH {:g} MM", test.tool_length));
}

}  // namespace

BarPass pass_of(const Machine& machine, const MotionTest& test) {
  const auto [least, most] =
      std::ranges::minmax_element(test.poses, {}, &instruments::TestPose::parameter);
  // From one whole degree to another, as an operator reads them.
  BarPass pass{std::floor(std::min(test.motion.from, test.motion.to) * kDegPerRad) * kRadPerDeg,
               std::ceil(std::max(test.motion.from, test.motion.to) * kDegPerRad) * kRadPerDeg};
  // Where the travels end the capture begins at once.
  if (!within_travel(machine, test.motion.axes(pass.from))) pass.from = least->parameter;
  if (!within_travel(machine, test.motion.axes(pass.to))) pass.to = most->parameter;
  return pass;
}

Vec3 circle_origin(const Machine& machine, const instruments::CircleTest& circle) {
  const AxisPositions centre = place_tip(machine, circle.centre, circle.tool_length, circle.held);
  const AxisPositions upright =
      kinematics::with_linear_positions({}, kinematics::linear_positions(centre));
  return nominal_pose(machine, upright, circle.tool_length).translation;
}

Result<TestPiece> circle_program(const Machine& machine, const instruments::CircleTest& given,
                                 const MotionProgramOptions& given_options) {
  instruments::CircleTest circle = given;
  circle.feed.reset();  // where the axes are commanded to be
  circle.sense = instruments::Sense::ccw;
  const auto test = circle_test(machine, circle);
  if (!test) return test.error();
  MotionProgramOptions options = given_options;
  // The circle is one of axis positions, wherever the rotary axes are.
  options.form = MotionForm::axes;
  const AxisPositions centre = place_tip(machine, circle.centre, circle.tool_length, circle.held);
  const std::string title =
      fmt::format("BALL BAR {} CIRCLE {:g} MM", name_of(circle.plane), circle.length);
  MotionBlocks blocks(machine, "5001", title, circle_origin(machine, circle), circle.tool_length,
                      options);
  describe(blocks, *test);
  const bool arcs =
      options.dialect != parser::Dialect::heidenhain || circle.plane == instruments::Plane::XY;
  const auto run = [&](MotionBlocks& out, double from, double to) {
    if (arcs) {
      out.arc(test->motion.axes(to), centre, circle.plane, to - from);
    } else {
      out.along(test->motion.axes, from, to);
    }
  };
  if (auto problem = add_passes(blocks, machine, *test, options, {"CCW", "CW"}, run)) {
    return *std::move(problem);
  }
  return blocks.end("circle", title);
}

Result<TestPiece> bar_program(const Machine& machine, const std::string& name,
                              const std::string& title, const MotionTest& test,
                              const MotionProgramOptions& options) {
  MotionBlocks blocks(machine, name == "cone" ? "5003" : "5002", title, test.table_ball,
                      test.tool_length, options);
  describe(blocks, test);
  const auto run = [&](MotionBlocks& out, double from, double to) {
    out.along(test.motion.axes, from, to);
  };
  if (auto problem = add_passes(blocks, machine, test, options, {"UP", "DOWN"}, run)) {
    return *std::move(problem);
  }
  return blocks.end(name, title);
}

Result<TestPiece> chase_program(const Machine& machine, const MotionTest& test,
                                const MotionProgramOptions& options) {
  const std::string title = "R-TEST";
  MotionBlocks blocks(machine, "5004", title, test.table_ball, test.tool_length, options);
  blocks.comment(fmt::format("TABLE BALL AT X{:g} Y{:g} Z{:g} OF THE TABLE", test.table_ball.x(),
                             test.table_ball.y(), test.table_ball.z()));
  blocks.comment(fmt::format("T1 IS THE NEST, LENGTH {:g} MM", test.tool_length));
  const AxisPositions& first = test.poses.front().at.q;
  // From above along the tool, where a nest has its opening.
  constexpr double kAbove = 50.0;  // mm
  const Vec3 tool_axis = nominal_pose(machine, first, test.tool_length).rotation.col(2);
  const AxisPositions above =
      place_tip(machine, test.table_ball + kAbove * tool_axis, test.tool_length, first);
  if (auto problem = unreachable(machine, above, "the place above the table ball")) {
    return *std::move(problem);
  }
  blocks.begin(above);
  blocks.approach(above);
  blocks.stop("OPEN THE NEST");
  const AxisPositions* before = &above;
  for (const instruments::TestPose& pose : test.poses) {
    const AxisPositions from = *before, to = pose.at.q;
    // The tip stays at the ball while the rotary axes go on evenly.
    const auto motion = [&](double u) {
      const AxisPositions q = kinematics::part_way(from, to, u);
      return before == &above ? q : place_tip(machine, test.table_ball, test.tool_length, q);
    };
    blocks.along(motion, 0.0, 1.0);
    blocks.dwell(options.dwell);
    before = &pose.at.q;
  }
  return blocks.end("chase", title);
}

}  // namespace frustum::programs
