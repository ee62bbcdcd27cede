#include "dynamics/path_deviation.hpp"

#include <numbers>

#include "dynamics/harmonic_circle.hpp"
#include "tests/dynamics/machines.hpp"
#include "tests/kinematics/executing.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::dynamics {
namespace {

using kinematics::AxisLetter;
using kinematics::ToolPath;

constexpr double kRadius = 50.0;
constexpr double kFeed = 10000.0;

// Circles about the crossing of B and C, 150 mm above it.
std::vector<parser::Motion> circles(int turns) {
  std::vector<parser::Motion> motions;
  const auto add = [&](parser::Command command) {
    parser::Motion& motion = motions.emplace_back();
    motion.place.line = static_cast<std::uint32_t>(motions.size());
    motion.place.column = 1;
    motion.command = std::move(command);
  };
  add(parser::ToolChange{1});
  add(parser::CompensationChange{parser::LengthCompensation::length, false, 1});
  parser::Traverse start;
  start.end[AxisLetter::X] = kRadius;
  start.end[AxisLetter::Y] = 0.0;
  start.end[AxisLetter::Z] = 0.0;
  add(start);
  parser::ArcFeed arc;
  arc.end[AxisLetter::X] = kRadius;
  arc.end[AxisLetter::Y] = 0.0;
  arc.turns = turns;
  arc.feed = {.value = kFeed};
  add(arc);
  add(parser::Dwell{0.3});
  return motions;
}

kinematics::Setup circle_setup() {
  kinematics::Setup setup;
  setup.work_offsets = {{1, Vec3(0, 0, 150)}};
  setup.tools = {{1, {.length = 150.0, .flute_length = 20.0}}};
  return setup;
}

struct BothPaths {
  ToolPath commanded{}, deviating{};
};
BothPaths travel_circles(const DynamicModel& model, int turns, const PathDynamics& options,
                         bool limits) {
  const auto machine = kinematics::shipped("iwf-bc");
  const kinematics::GeometricErrors errors;
  const auto setup = circle_setup();
  const auto motions = circles(turns);
  auto done = kinematics::execute(
      machine, errors, setup, motions,
      {.time_law = {.limits = limits, .jerk = limits}, .time_step = options.time_step});
  EXPECT_TRUE(done);
  return {done->path, with_dynamics(model, setup, done->path, options)};
}

bool same(const ToolPath& a, const ToolPath& b) {
  return std::ranges::equal(
             a.poses, b.poses,
             [](const auto& p, const auto& q) { return p.tip == q.tip && p.axis == q.axis; }) &&
         a.times == b.times && a.segments.size() == b.segments.size();
}

TEST(PathDeviation, OffLeavesThePathAsItIs) {
  const DynamicModel model = model_named("iwf-bc");
  const auto paths = travel_circles(model, 1, {.method = PathMethod::off}, true);
  EXPECT_TRUE(same(paths.commanded, paths.deviating));
}

TEST(PathDeviation, EvenTimesAddPosesOfTheSamePath) {
  const auto machine = kinematics::shipped("iwf-bc");
  const kinematics::GeometricErrors errors;
  const auto motions = circles(1);
  const auto plain = kinematics::execute(machine, errors, circle_setup(), motions, {});
  const auto even =
      kinematics::execute(machine, errors, circle_setup(), motions, {.time_step = 5e-4});
  ASSERT_TRUE(plain && even);
  EXPECT_EQ(plain->cycle_time, even->cycle_time);
  // Every pose of the one is in the other, at its time.
  std::size_t i = 0;
  for (std::size_t k = 0; k < plain->path.poses.size(); ++k) {
    while (i < even->path.poses.size() && (even->path.times[i] != plain->path.times[k] ||
                                           even->path.poses[i].tip != plain->path.poses[k].tip)) {
      ++i;
    }
    ASSERT_LT(i, even->path.poses.size()) << k;
  }
  for (std::size_t k = 1; k < even->path.times.size(); ++k) {
    EXPECT_GE(even->path.times[k], even->path.times[k - 1]);
    EXPECT_LE(even->path.times[k] - even->path.times[k - 1], 5e-4 + 1e-12);
  }
}

struct Circularity {
  double mean_radial = 0.0, roundness = 0.0;  // um
};
// Of the poses of one turn, about the least-squares circle (to first order).
Circularity circularity_of(const ToolPath& path, double from, double to) {
  std::vector<Eigen::Vector3d> rows;
  std::vector<double> off;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    if (path.times[i] < from || path.times[i] >= to) continue;
    const Eigen::Vector2d p = (path.poses[i].tip - Vec3(0, 0, 150)).head<2>();
    rows.emplace_back(1.0, p.x() / p.norm(), p.y() / p.norm());
    off.push_back(p.norm() - kRadius);
  }
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    normal += rows[i] * rows[i].transpose();
    right += off[i] * rows[i];
  }
  const Vec3 circle = normal.inverse() * right;
  double low = 1e300, high = -1e300, sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double rest = off[i] - rows[i].dot(circle);
    low = std::min(low, rest);
    high = std::max(high, rest);
    sum += off[i];
  }
  return {1e3 * sum / static_cast<double>(off.size()), 1e3 * (high - low)};
}

TEST(PathDeviationReference, AProgramOfCirclesIsTheHarmonicSteadyState) {
  const json& wanted = expected()["circle_spring_drives"];
  const DynamicModel model = model_named("iwf-bc");
  for (const PathMethod method : {PathMethod::quasi_static, PathMethod::linear}) {
    const auto paths = travel_circles(model, 3, {.method = method}, false);
    const double turn = 2.0 * std::numbers::pi * kRadius / kFeed * 60.0;
    double start = 0.0;
    for (const kinematics::PathSegment& s : paths.commanded.segments) {
      if (paths.commanded.blocks[s.block].kind == kinematics::PathKind::feed) {
        start = paths.commanded.times[s.first_pose];
        break;
      }
    }
    const auto found = circularity_of(paths.deviating, start + turn, start + 2.0 * turn);
    std::cout << "mean radial " << found.mean_radial << " um, roundness " << found.roundness
              << " um\n";
    EXPECT_NEAR(found.mean_radial, wanted["mean_radial_um"].get<double>(), 0.05);
    EXPECT_NEAR(found.roundness, wanted["roundness_lsq_um"].get<double>(), 0.05);
  }
}

TEST(PathDeviationReference, ControlledDrivesMakeTheCircleOfTheirClosedLoop) {
  for (const char* kind : {"no feed-forward", "velocity", "velocity and acceleration"}) {
    const json& c = expected()["cascade"][kind];
    DynamicModel model = model_named("iwf-bc", true);
    for (AxisModel& axis : model.axes) {
      axis.control->feed_forward_velocity = c["feed_forward"][0];
      axis.control->feed_forward_acceleration = c["feed_forward"][1];
    }
    const auto paths = travel_circles(model, 3, {.method = PathMethod::linear}, false);
    // Before the path stops, which samples of the velocity see a step ahead.
    const double end = paths.commanded.times.back() - 0.3 - 0.1;
    const double turn = 2.0 * std::numbers::pi * kRadius / kFeed * 60.0;
    const auto found = circularity_of(paths.deviating, end - turn, end);
    std::cout << kind << ": mean radial " << found.mean_radial << " um, roundness "
              << found.roundness << " um\n";
    EXPECT_NEAR(found.mean_radial, c["circle"]["mean_radial_um"].get<double>(), 0.05) << kind;
    EXPECT_NEAR(found.roundness, c["circle"]["roundness_lsq_um"].get<double>(), 0.05) << kind;
  }
}

Vec3 tip_at(const ToolPath& path, double time) {
  const auto after = std::ranges::upper_bound(path.times, time);
  const auto i = static_cast<std::size_t>(after - path.times.begin());
  if (i == 0 || i == path.times.size()) return path.poses[std::min(i, path.times.size() - 1)].tip;
  const double share = (time - path.times[i - 1]) / (path.times[i] - path.times[i - 1]);
  return path.poses[i - 1].tip + share * (path.poses[i].tip - path.poses[i - 1].tip);
}

// F = -Kp Kv p - Kp v about axes that lag by Kv is F = Kp (Kv (q - y) - y') about the command.
TEST(PathDeviationLaws, LagBeforeSpringsIsTheCascadeThatTheyStandFor) {
  const auto machine = kinematics::shipped("iwf-bc");
  DynamicModel springs = model_named("iwf-bc");
  DynamicModel cascade = springs;
  for (std::size_t k = 0; k < springs.axes.size(); ++k) {
    const double gain = machine.joint(springs.axes[k].joint.letter)->dynamics.servo_gain;
    SpringDamper& spring = springs.axes[k].drive.spring;
    spring.damping = spring.stiffness / gain;
    cascade.axes[k].control = Control{.position_gain = gain, .velocity_gain = spring.damping};
  }
  const kinematics::GeometricErrors errors;
  const auto motions = circles(2);
  const auto run = [&](const DynamicModel& model, bool lag) {
    const auto done =
        kinematics::execute(machine, errors, circle_setup(), motions,
                            {.time_law = {.jerk = true}, .servo_lag = lag, .time_step = 5e-4});
    EXPECT_TRUE(done);
    return with_dynamics(model, circle_setup(), done->path, {.method = PathMethod::linear});
  };
  const ToolPath lagging = run(springs, true), controlled = run(cascade, false);
  const auto commanded = kinematics::execute(machine, errors, circle_setup(), motions,
                                             {.time_law = {.jerk = true}, .time_step = 5e-4});
  ASSERT_TRUE(commanded);
  double most = 0.0, late = 0.0;
  for (std::size_t i = 0; i < controlled.poses.size(); ++i) {
    // The last block ends when the lag has run out, which the other path does not wait for.
    if (controlled.times[i] > controlled.times.back() - 0.7) break;
    const Vec3 tip = tip_at(lagging, controlled.times[i]);
    most = std::max(most, (tip - controlled.poses[i].tip).norm());
    late = std::max(late, (tip - tip_at(commanded->path, controlled.times[i])).norm());
  }
  std::cout << "lag before springs against the cascade: " << 1e3 * most << " um\n";
  EXPECT_LT(most, 1e-4);
  EXPECT_GT(late, 3.0);  // v / Kv is 3.3 mm
}

TEST(PathDeviation, TheToolStaysUntilTheVibrationIsGone) {
  const DynamicModel model = model_named("iwf-bc");
  const auto paths = travel_circles(model, 1, {.method = PathMethod::linear}, true);
  const double last = (paths.deviating.poses.back().tip - paths.commanded.poses.back().tip).norm();
  EXPECT_LT(last, 2e-5);
  EXPECT_GE(paths.deviating.times.back(), paths.commanded.times.back());
  double most = 0.0;
  for (std::size_t i = 0; i < paths.commanded.poses.size(); ++i) {
    most = std::max(most, (paths.deviating.poses[i].tip - paths.commanded.poses[i].tip).norm());
  }
  EXPECT_GT(most, 5e-3);
  EXPECT_LT(most, 0.5);
}

}  // namespace
}  // namespace frustum::dynamics
