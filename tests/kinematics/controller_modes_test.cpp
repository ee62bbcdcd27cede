// What a controller can be commanded about how to move: frames, rotary paths, feeds, times and
// streams.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "kinematics/controller/controller.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/executing.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using namespace parser;  // NOLINT: the motions are the language of these tests
using enum AxisLetter;
using Motions = std::vector<Motion>;

constexpr double kDeg = kRadPerDeg;

AxisTarget target(std::initializer_list<std::pair<AxisLetter, double>> words) {
  AxisTarget t;
  for (const auto& [axis, value] : words) t[axis] = is_rotary(axis) ? value * kDeg : value;
  return t;
}

void add(Motions& motions, std::uint32_t line, Command command) {
  Motion& motion = motions.emplace_back();
  motion.place.line = line;
  motion.place.column = 1;
  motion.command = std::move(command);
}

// Numbers the motions as lines.
Motions lines(std::initializer_list<Command> commands) {
  Motions motions;
  for (const Command& c : commands) {
    add(motions, static_cast<std::uint32_t>(motions.size() + 1), c);
  }
  return motions;
}

constexpr CompensationChange kTcp{LengthCompensation::tool_centre_point, false, 1};
constexpr CompensationChange kLength{LengthCompensation::length, false, 1};

Setup setup() {
  Setup s;
  s.work_offsets = {{1, Vec3(10, 20, 30)}};
  s.tools = {{1, {.length = 100.0, .flute_length = 20.0}}};
  return s;
}

Result<Execution> run(const Machine& machine, const Motions& motions,
                      const TravelOptions& options = {}, const GeometricErrors& errors = {}) {
  return execute(machine, errors, setup(), motions, options);
}

Feed feed(double value, FeedMode mode = FeedMode::per_minute) { return {value, mode}; }

double block_time(const Execution& e, std::uint32_t line) {
  for (const PathBlock& b : e.path.blocks) {
    if (b.source_line == line) return b.duration;
  }
  return -1.0;
}

const TravelOptions kNoLimits{.time_law = {.limits = false}};

TEST(ControllerFeed, CountsTheTipUnderTcpAndDegreesWhereTheTipStands) {
  const auto e = run(
      shipped("iwf-bc"),
      lines({ToolChange{1}, kTcp, Traverse{target({{X, 0}, {Y, 0}, {Z, 80}})},
             LinearFeed{.end = target({{X, 30}, {Y, 40}, {B, -20}, {C, 50}}), .feed = feed(600)},
             LinearFeed{.end = target({{B, -50}, {C, 90}}), .feed = feed(500)},
             LinearFeed{.end = target({{X, 0}, {Y, 0}}), .feed = feed(4, FeedMode::inverse_time)},
             SpindleChange{SpindleDirection::clockwise, 1000},
             LinearFeed{.end = target({{X, 30}}), .feed = feed(0.1, FeedMode::per_revolution)}}),
      kNoLimits);
  ASSERT_TRUE(e) << to_string(e.error().front());
  EXPECT_NEAR(block_time(*e, 4), 50.0 / 600.0 * 60.0, 1e-9);
  EXPECT_NEAR(block_time(*e, 5), 50.0 / 500.0 * 60.0, 1e-9);  // 30 and 40 deg together
  EXPECT_NEAR(block_time(*e, 6), 15.0, 1e-9);
  EXPECT_NEAR(block_time(*e, 8), 30.0 / 100.0 * 60.0, 1e-9);
  EXPECT_NEAR(e->path.times.back(), e->cycle_time, 1e-12);
  ASSERT_EQ(e->path.times.size(), e->path.poses.size());
  EXPECT_TRUE(std::is_sorted(e->path.times.begin(), e->path.times.end()));
}

TEST(ControllerFeed, CountsTheLinearAxesWithoutTcpAndDwellsTakeTime) {
  const auto e =
      run(shipped("iwf-bc"),
          lines({ToolChange{1}, kLength, Traverse{target({{X, 0}, {Y, 0}, {Z, 80}})},
                 LinearFeed{.end = target({{X, 30}, {Y, 40}, {C, 50}}), .feed = feed(600)},
                 Dwell{2.5}}),
          kNoLimits);
  ASSERT_TRUE(e) << to_string(e.error().front());
  EXPECT_NEAR(block_time(*e, 4), 5.0, 1e-9);
  EXPECT_NEAR(e->cycle_time, block_time(*e, 3) + 5.0 + 2.5, 1e-9);
}

TEST(ControllerFeed, AProbeGoesToItsEndAndSaysThatItMeetsNothing) {
  const auto e = run(shipped("iwf-bc"),
                     lines({ToolChange{1}, kLength, Traverse{target({{X, 0}, {Y, 0}, {Z, 80}})},
                            Probe{.end = target({{Z, 70}}), .feed = feed(600)}}),
                     kNoLimits);
  ASSERT_TRUE(e) << to_string(e.error().front());
  EXPECT_NEAR(block_time(*e, 4), 1.0, 1e-9);
  ASSERT_EQ(e->warnings.size(), 1U);
  EXPECT_EQ(e->warnings.front().line, 4);
  EXPECT_NE(e->warnings.front().message.find("meets nothing"), std::string::npos);
}

TEST(ControllerFeed, RefusesAFeedPerRevolutionWhileTheSpindleStands) {
  const auto e = run(
      shipped("three-axis"),
      lines({ToolChange{1}, kLength,
             LinearFeed{.end = target({{Z, 200}}), .feed = feed(0.1, FeedMode::per_revolution)}}));
  ASSERT_FALSE(e);
  EXPECT_EQ(e.error().front().message, "feed per revolution while the spindle is at rest");
  EXPECT_EQ(e.error().front().line, 3);
}

// G44 subtracts the setup's length: twice its 100 mm below G43.
TEST(ControllerFrames, TakeALengthAwayThatIsNegative) {
  for (const char* name : {"three-axis", "iwf-bc"}) {
    const CompensationChange negative{
        .mode = LengthCompensation::length, .offset_number = 1, .negative = true};
    const auto e = run(shipped(name),
                       lines({kLength, Traverse{target({{X, 1}, {Y, 2}, {Z, 3}})}, negative,
                              Traverse{target({{Z, 3}})}, Traverse{target({{Z, 203}})}}),
                       kNoLimits);
    ASSERT_TRUE(e) << to_string(e.error().front());
    EXPECT_NEAR(e->axes.at(2).axes[Z], e->axes.at(1).axes[Z] - 200.0, 1e-9);
    EXPECT_NEAR(e->axes.at(3).axes[Z], e->axes.at(1).axes[Z], 1e-9);
  }
}

// The axes are where the program says, as its control counts: origin, word and length.
TEST(ControllerFrames, FollowAWorkOffsetThatTheProgramPlaces) {
  for (const char* name : {"three-axis", "iwf-bc"}) {
    const auto e = run(shipped(name),
                       lines({WorkOffsetSetting{2, {7.0, 8.0, 9.0}}, WorkOffsetChange{2},
                              CompensationChange{LengthCompensation::length, false, 5, 40.0},
                              Traverse{target({{X, 1}, {Y, 2}, {Z, 3}})},
                              WorkOffsetSetting{2, {17.0, std::nullopt, std::nullopt}},
                              Traverse{target({{X, 1}})}}),
                       kNoLimits);
    ASSERT_TRUE(e) << to_string(e.error().front());
    const AxisPositions& first = e->axes.at(1).axes;
    EXPECT_NEAR(first[X], 8.0, 1e-9);
    EXPECT_NEAR(first[Y], 10.0, 1e-9);
    EXPECT_NEAR(first[Z], 52.0, 1e-9);
    const AxisPositions& second = e->axes.at(2).axes;
    EXPECT_NEAR(second[X], 18.0, 1e-9);
    EXPECT_NEAR(second[Y], 10.0, 1e-9);
  }
}

TEST(ControllerFrames, KeepTheAxesOfTheSetupThatTheProgramLeavesOut) {
  const auto e = run(shipped("three-axis"),
                     lines({Traverse{target({{X, 0}, {Y, 0}, {Z, 0}})},
                            WorkOffsetSetting{1, {std::nullopt, std::nullopt, 55.0}},
                            Traverse{target({{X, 0}, {Y, 0}, {Z, 0}})}}),
                     kNoLimits);
  ASSERT_TRUE(e) << to_string(e.error().front());
  EXPECT_NEAR(e->axes.at(2).axes[X], e->axes.at(1).axes[X], 1e-9);
  EXPECT_NEAR(e->axes.at(2).axes[Z], 55.0, 1e-9);
}

TEST(ControllerFrames, RefuseWhatNothingPlaces) {
  const auto half =
      run(shipped("three-axis"), lines({WorkOffsetSetting{3, {1.0, std::nullopt, 2.0}}}));
  ASSERT_FALSE(half);
  EXPECT_EQ(half.error().front().message,
            "the program places G56 along some axes, and nothing gives the others");
  const auto point = run(shipped("three-axis"), lines({HomeReturn{.point = 2}}));
  ASSERT_FALSE(point);
  EXPECT_EQ(point.error().front().message, "G30: the machine has no reference point 2");
  const auto beyond = run(shipped("three-axis"), lines({WorkOffsetChange{8}}));
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().front().message, "work offset G59.2 is not defined");
}

TEST(ControllerFrames, FollowATiltedPlaneWithAndWithoutTcp) {
  const Pose plane{rotation_z(25 * kDeg) * rotation_y(-30 * kDeg), Vec3(3, -4, 5)};
  for (const char* name : {"iwf-bc", "swivel-head-table", "double-pivot-head"}) {
    for (const CompensationChange& compensation : {kTcp, kLength}) {
      const Machine machine = shipped(name);
      ArcFeed arc{
          .end = target({{X, 0}, {Y, 12}, {Z, 8}}), .center = Vec3(0, 0, 8), .feed = feed(600)};
      const auto e = run(
          machine,
          lines({ToolChange{1}, compensation, TiltedPlaneChange{plane}, AlignToPlane{},
                 Traverse{target({{X, 0}, {Y, 0}, {Z, 20}})},
                 LinearFeed{.end = target({{X, 12}, {Y, 0}, {Z, 8}}), .feed = feed(600)}, arc}));
      ASSERT_TRUE(e) << name << to_string(e.error().front());
      const Pose table_from_plane = Pose::translated(Vec3(10, 20, 30)) * plane;
      for (const PathSegment& s : e->path.segments) {
        const PathBlock& block = e->path.blocks[s.block];
        if (block.source_line < 6) continue;
        const ToolPose& to = e->path.to(s);
        EXPECT_LT((to.axis - table_from_plane.direction(Vec3::UnitZ())).norm(), 1e-11) << name;
        const Vec3 in_plane = table_from_plane.inverse().point(to.tip);
        if (block.source_line == 7) {
          EXPECT_NEAR(in_plane.z(), 8.0, 1e-9);
          EXPECT_NEAR(std::hypot(in_plane.x(), in_plane.y()), 12.0, 1e-9);
        }
      }
      EXPECT_LT((e->path.poses.back().tip - table_from_plane.point(Vec3(0, 12, 8))).norm(), 1e-9);
      EXPECT_NEAR(e->path.blocks.back().feed_duration, 6.0 * std::numbers::pi / 600 * 60, 1e-9);
    }
  }
  const auto none = run(shipped("iwf-bc"), lines({AlignToPlane{}}));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().front().message,
            "the tool is to be set perpendicular to a tilted plane, but none is active");
}

TEST(ControllerRotary, TurnsTheShortestWayWhenTold) {
  const auto turn = [](RotaryPath path) {
    const auto e =
        run(shipped("iwf-bc"), lines({ToolChange{1}, RotaryPathChange{path},
                                      Traverse{target({{C, 350}})}, Traverse{target({{C, 5}})}}));
    return e ? std::abs(e->axes[2].axes[C] - e->axes[1].axes[C]) / kDeg : -1.0;
  };
  EXPECT_NEAR(turn(RotaryPath::shortest), 15.0, 1e-9);
  EXPECT_NEAR(turn(RotaryPath::as_programmed), 345.0, 1e-9);
  EXPECT_NEAR(turn(RotaryPath::positive), 15.0, 1e-9);
  EXPECT_NEAR(turn(RotaryPath::negative), 345.0, 1e-9);
}

TEST(ControllerRotary, TurnsInOneDirectionAndNotAtAllWhenItIsThere) {
  const auto turn = [](RotaryPath path, double from, double to) {
    const auto e = run(shipped("iwf-bc"), lines({ToolChange{1}, Traverse{target({{C, from}})},
                                                 RotaryPathChange{path, {false, false, true}},
                                                 Traverse{target({{C, to}})}}));
    return e ? (e->axes[2].axes[C] - e->axes[1].axes[C]) / kDeg : 1e9;
  };
  EXPECT_NEAR(turn(RotaryPath::positive, 30, 10), 340.0, 1e-9);
  EXPECT_NEAR(turn(RotaryPath::negative, 30, 10), -20.0, 1e-9);
  EXPECT_NEAR(turn(RotaryPath::positive, 30, 750), 0.0, 1e-6);
  EXPECT_NEAR(turn(RotaryPath::positive, 30.0000001, 30), 0.0, 1e-6);
  EXPECT_NEAR(turn(RotaryPath::negative, 29.9999999, 30), 0.0, 1e-6);
  EXPECT_NEAR(turn(RotaryPath::negative, 30, 31), -359.0, 1e-9);
  // The other axes keep theirs.
  const auto e =
      run(shipped("iwf-bc"),
          lines({ToolChange{1}, RotaryPathChange{RotaryPath::positive, {true, true, false}},
                 Traverse{target({{C, 350}})}, Traverse{target({{C, 5}})}}));
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->axes[2].axes[C] / kDeg, 5.0, 1e-9);
}

TEST(ControllerRotary, KeepsTheToolAxisOnTheGreatCircleWhenTold) {
  const auto from = UnitVec3::of(Vec3(0.3, 0.1, 1.0)), to = UnitVec3::of(Vec3(-0.2, 0.4, 1.0));
  const auto e =
      run(shipped("iwf-bc"),
          lines({ToolChange{1}, kTcp, OrientationPathChange{parser::OrientationPath::great_circle},
                 Traverse{target({{X, 0}, {Y, 0}, {Z, 80}}), *from},
                 LinearFeed{target({{X, 20}}), *to, Coordinates::program, feed(600)}}));
  ASSERT_TRUE(e) << to_string(e.error().front());
  const Vec3 normal = from->vec().cross(to->vec()).normalized();
  double worst = 0.0;
  for (const PathSegment& s : e->path.segments) {
    if (e->path.blocks[s.block].source_line == 5)
      worst = std::max(worst, std::abs(e->path.to(s).axis.dot(normal)));
  }
  EXPECT_LT(worst, 1e-11);
  EXPECT_LT((e->path.poses.back().axis - to->vec()).norm(), 1e-11);
}

// The tool axis from one side of the pole to the other, `beside` it by an angle.
Result<Execution> pole_passage(const Machine& machine, double beside,
                               parser::OrientationPath path) {
  const auto lean = [&](double along) {
    return *UnitVec3::of(Vec3(std::sin(along), std::sin(beside), 1.0));
  };
  Motions motions = lines({ToolChange{1}, kTcp, OrientationPathChange{path},
                           Traverse{target({{X, -20}, {Y, 0}, {Z, 80}}), lean(-0.2)}});
  // Vector blocks as a programming system writes them, one of them from before the pole to behind
  // it.
  for (int i = 1; i <= 20; ++i) {
    add(motions, static_cast<std::uint32_t>(100 + i),
        LinearFeed{target({{X, -20 + 2.0 * i}}), lean(-0.2 + 0.02 * i), Coordinates::program,
                   feed(1500)});
  }
  return run(machine, motions);
}

TEST(ControllerPole, PassesThroughAndBesideThePoleWithinTheLimitsOfTheAxes) {
  for (const char* name : {"iwf-bc", "zx-yac", "double-pivot-head"}) {
    const Machine machine = shipped(name);
    for (const double beside : {0.0, 0.001 * kDeg, 0.05 * kDeg}) {
      for (const auto path :
           {parser::OrientationPath::great_circle, parser::OrientationPath::rotary_axes}) {
        const auto e = pole_passage(machine, beside, path);
        ASSERT_TRUE(e) << name << " " << beside << to_string(e.error().front());
        const ToolPath& p = e->path;
        for (std::size_t i = 1; i < p.poses.size(); ++i) {
          const double dt = p.times[i] - p.times[i - 1];
          for (const Joint& joint : machine.joints()) {
            const double dq = p.axes[i].q[joint.letter] - p.axes[i - 1].q[joint.letter];
            // 1e-5: the time law sees a polyline of the motion; 1e-9: rounding of the inverse.
            EXPECT_LE(std::abs(dq), joint.dynamics.velocity * dt * (1.0 + 1e-5) + 1e-9)
                << name << " " << beside / kDeg << " " << to_char(joint.letter);
          }
        }
        double off = 0.0;
        for (const PathSegment& s : p.segments) {
          if (p.blocks[s.block].source_line < 100) continue;
          const Vec3 tip = p.to(s).tip - Vec3(10, 20, 30);
          off = std::max(off, std::hypot(tip.y(), tip.z() - 80.0));
        }
        EXPECT_LT(off, 1e-8) << name << " " << beside / kDeg;
      }
    }
  }
}

Motions wandering(int blocks) {
  Motions motions = lines({ToolChange{1}, kTcp, Traverse{target({{X, 0}, {Y, 0}, {Z, 80}})}});
  for (int i = 0; i < blocks; ++i) {
    const double t = 0.01 * i;
    add(motions, static_cast<std::uint32_t>(10 + i),
        LinearFeed{.end = target({{X, 40 * std::sin(t)},
                                  {Y, 30 * std::cos(1.3 * t)},
                                  {B, -20 + 5 * std::sin(2 * t)},
                                  {C, 30 * std::sin(0.7 * t)}}),
                   .feed = feed(4000)});
    if (i % 700 == 699) add(motions, 1, Dwell{0.5});
  }
  return motions;
}

TEST(ControllerLaws, GivesASinkTheSamePathInParts) {
  const Machine machine = shipped("iwf-bc");
  const Motions motions = wandering(9000);
  const auto whole = run(machine, motions);
  ASSERT_TRUE(whole);
  std::size_t at = 0, blocks = 0, parts = 0;
  TravelOptions options;
  options.sink = [&](const ToolPath& part) {
    ++parts;
    ASSERT_LE(at + part.poses.size(), whole->path.poses.size());
    for (std::size_t i = 0; i < part.poses.size(); ++i) {
      ASSERT_EQ(part.poses[i].tip, whole->path.poses[at + i].tip);
      ASSERT_EQ(part.times[i], whole->path.times[at + i]);
    }
    at += part.poses.size() - 1;
    blocks += part.blocks.size();
  };
  const auto streamed = run(machine, motions, options);
  ASSERT_TRUE(streamed);
  EXPECT_GT(parts, 1u);
  EXPECT_EQ(at + 1, whole->path.poses.size());
  EXPECT_EQ(blocks, whole->path.blocks.size());
  EXPECT_EQ(streamed->cycle_time, whole->cycle_time);
  EXPECT_TRUE(streamed->path.poses.empty());
}

TEST(ControllerErrors, PutBothSidesOfAReversalIntoThePath) {
  const Machine machine = shipped("iwf-bc");
  GeometricErrors errors;
  errors[X].component[0] = ErrorFunction(std::vector<ErrorTerm>{ReversalTerm{0.005}});
  ArcFeed circle{.end = target({{X, 20}, {Y, 0}}), .feed = feed(600)};
  const auto e =
      run(machine,
          lines({ToolChange{1}, kLength, Traverse{target({{X, 20}, {Y, 0}, {Z, 80}})}, circle}), {},
          errors);
  ASSERT_TRUE(e) << to_string(e.error().front());
  // X turns at 0 and 180 deg; each turn is a step of the full jump at one place.
  int steps = 0;
  for (const PathSegment& s : e->path.segments) {
    if (e->path.blocks[s.block].source_line != 4) continue;
    const Vec3 d = e->path.to(s).tip - e->path.from(s).tip;
    if (std::abs(d.y()) < 1e-6 && std::abs(d.x()) > 5e-3) {
      ++steps;
      EXPECT_NEAR(std::abs(d.x()), 0.010, 1e-6);
    }
  }
  EXPECT_GE(steps, 1);
  EXPECT_LE(steps, 2);
}

TEST(ControllerServoLag, ShrinksACircleByTheGains) {
  const Machine machine = shipped("iwf-bc");
  const double gain = machine.joint(X)->dynamics.servo_gain;
  ArcFeed circle{.end = target({{X, 20}, {Y, 0}}), .turns = 3, .feed = feed(6000)};
  TravelOptions options;
  options.servo_lag = true;
  const auto e =
      run(machine,
          lines({ToolChange{1}, kLength, Traverse{target({{X, 20}, {Y, 0}, {Z, 80}})}, circle}),
          options);
  ASSERT_TRUE(e) << to_string(e.error().front());
  double least = 1e9, most = 0.0;
  const double middle = 0.5 * (e->path.times.back() + e->path.times.front());
  for (std::size_t i = 0; i < e->path.poses.size(); ++i) {
    if (std::abs(e->path.times[i] - middle) > 0.8) continue;
    const Vec3 from_centre = e->path.poses[i].tip - Vec3(10, 20, 110);
    least = std::min(least, from_centre.head<2>().norm());
    most = std::max(most, from_centre.head<2>().norm());
  }
  const double w = 100.0 / 20.0;
  EXPECT_NEAR(least, 20.0 / std::hypot(1.0, w / gain), 1e-3);
  EXPECT_NEAR(most, 20.0 / std::hypot(1.0, w / gain), 1e-3);
  // In position at the end.
  EXPECT_LT((e->path.poses.back().tip - Vec3(30, 20, 110)).norm(), 1e-9);
}

}  // namespace
}  // namespace frustum::kinematics
