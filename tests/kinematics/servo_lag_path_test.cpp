// Where the axes are that follow their commands late: in position at every rest, in whole and in
// parts.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/kinematics/executing.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

// NC lines of a program that moves X at 100 mm/s, by lines of their own.
class Lines {
 public:
  Lines& operator<<(parser::Command command) {
    parser::Motion& motion = motions_.emplace_back();
    motion.place.line = static_cast<std::uint32_t>(motions_.size());
    motion.place.column = 1;
    motion.command = std::move(command);
    return *this;
  }
  Lines& feed_to(double x) {
    parser::LinearFeed move;
    move.end[AxisLetter::X] = x;
    move.feed = {.value = 6000.0};
    return *this << move;
  }
  Lines& begin(int tool) {
    *this << parser::ToolChange{tool}
          << parser::CompensationChange{parser::LengthCompensation::length, false, tool};
    parser::Traverse move;
    move.end[AxisLetter::X] = 0.0;
    move.end[AxisLetter::Y] = 0.0;
    move.end[AxisLetter::Z] = 50.0;
    return *this << move;
  }
  [[nodiscard]] const std::vector<parser::Motion>& motions() const { return motions_; }

 private:
  std::vector<parser::Motion> motions_{};
};

Result<Execution> run_late(const Lines& program, TravelOptions options) {
  Setup setup;
  setup.work_offsets = {{1, Vec3(10, 20, 30)}};
  setup.tools = {{1, {.length = 100.0, .flute_length = 20.0}},
                 {2, {.length = 80.0, .flute_length = 20.0}}};
  options.servo_lag = true;
  return execute(shipped("iwf-bc"), {}, setup, program.motions(), options);
}

// Where the tip is at the end of a line.
Vec3 end_of(const ToolPath& path, std::uint32_t line) {
  Vec3 tip = Vec3::Zero();
  for (const PathSegment& segment : path.segments) {
    if (path.blocks[segment.block].source_line == line) tip = path.to(segment).tip;
  }
  return tip;
}

// 100 mm/s and a gain of 50/s are 2 mm of lag when the command ends.
TEST(ServoLagPath, Fault2_26_IsInPositionAtDwellsToolChangesAndTheEndWithoutATimeLaw) {
  for (const bool limits : {true, false}) {
    Lines program;
    program.begin(1).feed_to(40.0) << parser::Dwell{0.01};  // lines 4, 5
    program.feed_to(80.0).begin(2).feed_to(60.0);           // lines 6, 7 to 9, 10
    TravelOptions options;
    options.time_law.limits = limits;
    const auto e = run_late(program, options);
    ASSERT_TRUE(e) << to_string(e.error().front());
    EXPECT_LT((end_of(e->path, 4) - Vec3(50, 20, 80)).norm(), 1e-9) << limits;
    EXPECT_LT((end_of(e->path, 6) - Vec3(90, 20, 80)).norm(), 1e-9) << limits;
    EXPECT_LT((end_of(e->path, 10) - Vec3(70, 20, 80)).norm(), 1e-9) << limits;
    EXPECT_DOUBLE_EQ(e->path.times.back(), e->cycle_time);
  }
}

TEST(ServoLagPath, Fault2_27_GivesASinkThePosesInWhichTheAxesSettle) {
  Lines program;
  program.begin(1);
  for (int k = 1; k <= 120; ++k) program.feed_to(k % 2 == 0 ? 0.0 : 20.0) << parser::Dwell{0.1};
  const auto whole = run_late(program, {});
  ASSERT_TRUE(whole) << to_string(whole.error().front());
  std::vector<ToolPose> poses;
  std::vector<double> times;
  std::size_t parts = 0, blocks = 0, segments = 0;
  TravelOptions options;
  options.sink = [&](const ToolPath& part) {
    // Its first pose is the last of the part before.
    const std::size_t first = parts++ == 0 ? 0 : 1;
    poses.insert(poses.end(), part.poses.begin() + static_cast<std::ptrdiff_t>(first),
                 part.poses.end());
    times.insert(times.end(), part.times.begin() + static_cast<std::ptrdiff_t>(first),
                 part.times.end());
    blocks += part.blocks.size();
    segments += part.segments.size();
    for (const PathSegment& segment : part.segments) ASSERT_LT(segment.block, part.blocks.size());
  };
  const auto streamed = run_late(program, options);
  ASSERT_TRUE(streamed);
  EXPECT_GT(parts, 2U);
  EXPECT_EQ(blocks, whole->path.blocks.size());
  EXPECT_EQ(segments, whole->path.segments.size());
  ASSERT_EQ(times, whole->path.times);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    ASSERT_EQ(poses[k].tip, whole->path.poses[k].tip);
  }
}

}  // namespace
}  // namespace frustum::kinematics
