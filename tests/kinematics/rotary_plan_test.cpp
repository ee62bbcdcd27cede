#include "kinematics/model/rotary_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/random.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

constexpr double kPlanDeg = kRadPerDeg;

// The inclined cone: half apex angle a, inclination b, radius r, phi from `from` to `to`, in
// degrees.
std::vector<ToolPose> cone(double a, double b, double from, double to, int steps = 720) {
  const Mat3 inclined = rotation_y(b * kPlanDeg);
  std::vector<ToolPose> path;
  for (int i = 0; i <= steps; ++i) {
    const double phi = (from + (to - from) * i / steps) * kPlanDeg, r = 40.0;
    path.push_back(
        {inclined * Vec3(r * std::cos(phi), r * std::sin(phi), 0.0) + Vec3(-65, 0, 150),
         inclined * Vec3(-std::sin(a * kPlanDeg) * std::cos(phi),
                         -std::sin(a * kPlanDeg) * std::sin(phi), std::cos(a * kPlanDeg))});
  }
  return path;
}

// `turns` turns about the vertical with the tool tilted.
std::vector<ToolPose> winding(double tilt, double turns, int steps) {
  std::vector<ToolPose> path;
  for (int i = 0; i <= steps; ++i) {
    const double phi = 2.0 * std::numbers::pi * turns * i / steps;
    path.push_back({Vec3(20.0 * std::cos(phi), 20.0 * std::sin(phi), 0.05 * i),
                    rotation_z(phi) * rotation_y(tilt * kPlanDeg) * Vec3::UnitZ()});
  }
  return path;
}

double range_of(const std::vector<PlannedPose>& plan, AxisLetter axis) {
  const auto [lo, hi] = std::minmax_element(
      plan.begin(), plan.end(),
      [axis](const PlannedPose& p, const PlannedPose& q) { return p.axes[axis] < q.axes[axis]; });
  return (hi->axes[axis] - lo->axes[axis]) / kPlanDeg;
}

struct Seen {
  double largest_step = 0.0;  // deg, of any rotary axis, unwindings apart
  double worst_tip = 0.0, worst_axis = 0.0;
  int unwindings = 0;
};

Seen follow_poses(const Machine& machine, const std::vector<ToolPose>& path,
                  const std::vector<PlannedPose>& plan, double length) {
  Seen seen;
  const auto compare = [&](const AxisPositions& q, const ToolPose& wanted) {
    const ToolPose is = tool_pose(nominal_pose(machine, q, length));
    seen.worst_tip = std::max(seen.worst_tip, (is.tip - wanted.tip).norm());
    seen.worst_axis = std::max(seen.worst_axis, angle_between(is.axis, wanted.axis));
    EXPECT_TRUE(within_travel(machine, q));
  };
  for (std::size_t i = 0; i < plan.size(); ++i) {
    compare(plan[i].axes, path[i]);
    if (i == 0) continue;
    if (plan[i].unwind) {
      compare(plan[i].resume, path[i - 1]);
      ++seen.unwindings;
    }
    const AxisPositions& before = plan[i].unwind ? plan[i].resume : plan[i - 1].axes;
    for (const AxisLetter letter : {AxisLetter::A, AxisLetter::B, AxisLetter::C}) {
      seen.largest_step =
          std::max(seen.largest_step, std::abs(plan[i].axes[letter] - before[letter]) / kPlanDeg);
    }
  }
  return seen;
}

TEST(RotaryPlanReference, TurnsBAndCOnTheConeAsTheThesisTables31And33Say) {
  const Machine machine = shipped("iwf-bc");
  // alpha > beta: C turns once, B by 2 beta.
  const auto wide = plan_axes(machine, cone(45, 30, 0, 360), 150.0, {});
  ASSERT_TRUE(wide) << to_string(wide.error().front());
  EXPECT_NEAR(range_of(*wide, AxisLetter::C), 360.0, 1e-9);
  EXPECT_NEAR(range_of(*wide, AxisLetter::B), 60.0, 1e-9);
  // alpha < beta: C swings by 2 atan(tan a / (sin b sqrt(1 - (tan a / tan b)^2))), B by 2 alpha.
  const auto narrow = plan_axes(machine, cone(30, 45, 0, 360, 36000), 150.0, {});
  ASSERT_TRUE(narrow) << to_string(narrow.error().front());
  const double slope = std::tan(30 * kPlanDeg) / std::tan(45 * kPlanDeg);
  EXPECT_NEAR(range_of(*narrow, AxisLetter::C),
              2.0 / kPlanDeg *
                  std::atan(std::tan(30 * kPlanDeg) /
                            (std::sin(45 * kPlanDeg) * std::sqrt(1 - slope * slope))),
              1e-4);
  EXPECT_NEAR(range_of(*narrow, AxisLetter::B), 60.0, 1e-9);
}

TEST(RotaryPlanReference, PassesThePoleOfTheConeWithAlphaEqualBetaByTheSignOfB) {
  const Machine machine = shipped("iwf-bc");
  const auto path = cone(30, 30, 180, 540);
  const auto plan = plan_axes(machine, path, 150.0, {});
  ASSERT_TRUE(plan) << to_string(plan.error().front());
  EXPECT_TRUE((*plan)[360].singular);
  EXPECT_NEAR(range_of(*plan, AxisLetter::C), 180.0, 1e-9);
  EXPECT_NEAR(range_of(*plan, AxisLetter::B), 4.0 * 30.0, 1e-9);
  EXPECT_NEAR(std::abs((*plan)[0].axes[AxisLetter::B] + (*plan)[720].axes[AxisLetter::B]), 0.0,
              1e-9);
  const Seen seen = follow_poses(machine, path, *plan, 150.0);
  EXPECT_LT(seen.largest_step, 1.0);
  EXPECT_LT(seen.worst_tip, 1e-9);
  EXPECT_LT(seen.worst_axis, 1e-7);
  // Begun at the pole: B stays on one side, C turns by 180 deg again.
  const auto begun = plan_axes(machine, cone(30, 30, 0, 360), 150.0, {});
  ASSERT_TRUE(begun);
  EXPECT_NEAR(range_of(*begun, AxisLetter::C), 180.0, 0.6);  // the free ends are held
  EXPECT_NEAR(range_of(*begun, AxisLetter::B), 2.0 * 30.0, 1e-9);
  EXPECT_LT(follow_poses(machine, cone(30, 30, 0, 360), *begun, 150.0).largest_step, 1.0);
}

TEST(RotaryPlanLaws, PassesAThousandthOfADegreeBesideThePoleWithoutAJump) {
  for (const char* name : {"iwf-bc", "zx-yac", "dvf5000", "swivel-head-table"}) {
    const Machine machine = shipped(name);
    auto path = cone(30.0, 30.001, 175, 545, 740);
    for (ToolPose& pose : path) pose.tip = 0.2 * pose.tip + Vec3(0, 0, 50);
    PlanOptions tolerant;
    tolerant.pole_tolerance = 0.005 * kPlanDeg;
    const auto plan = plan_axes(machine, path, 100.0, tolerant);
    ASSERT_TRUE(plan) << name << ' ' << to_string(plan.error().front());
    const Seen seen = follow_poses(machine, path, *plan, 100.0);
    EXPECT_LT(seen.largest_step, 1.1) << name;
    EXPECT_LT(seen.worst_tip, 1e-9) << name;
    EXPECT_LT(seen.worst_axis, tolerant.pole_tolerance) << name;
    // Held to the exact orientation the table must turn by 90 deg and back, or on, in the poses
    // there.
    const auto exact = plan_axes(machine, path, 100.0, {});
    ASSERT_TRUE(exact);
    const Seen held = follow_poses(machine, path, *exact, 100.0);
    EXPECT_LT(held.largest_step, 91.0) << name;
    EXPECT_LT(held.worst_axis, 1e-12 + 3e-8) << name;
  }
}

TEST(RotaryPlanLaws, TurnsEvenlyWhereTheTiltAxisCannotChangeItsSign) {
  // A tilts to one side only: through the pole C has to turn by 180 deg, spread over the poses
  // there.
  const auto machine = machine_from_text(R"(
name = "one-sided"
structure = "t-Z-X-b-Y-A-C-w"
[axis.X]
travel = [-400, 400]
[axis.Y]
travel = [-400, 400]
[axis.Z]
travel = [-400, 400]
[axis.A]
travel = [-5, 110]
[axis.C]
endless = true
)");
  ASSERT_TRUE(machine);
  std::vector<ToolPose> path;
  for (int i = -20; i <= 20; ++i) {
    const double tilt = std::abs(i) <= 9 ? 0.0 : (std::abs(i) - 9) * (i < 0 ? -1.0 : 1.0);
    path.push_back({Vec3(i, 0, 0), rotation_x(tilt * kPlanDeg) * Vec3::UnitZ()});
  }
  const auto plan = plan_axes(*machine, path, 50.0, {});
  ASSERT_TRUE(plan) << to_string(plan.error().front());
  const Seen seen = follow_poses(*machine, path, *plan, 50.0);
  EXPECT_NEAR(seen.largest_step, 9.0, 1e-6);  // 180 deg in twenty steps
  EXPECT_LT(seen.worst_tip, 1e-9);
  // Through the air it turns at once.
  PlanOptions lifted;
  lifted.through_air = {20};
  const auto free = plan_axes(*machine, path, 50.0, lifted);
  ASSERT_TRUE(free);
  EXPECT_NEAR(follow_poses(*machine, path, *free, 50.0).largest_step, 180.0, 1e-6);
  EXPECT_DOUBLE_EQ((*free)[19].axes[AxisLetter::C], (*free)[0].axes[AxisLetter::C]);
  EXPECT_DOUBLE_EQ((*free)[20].axes[AxisLetter::C], (*free)[40].axes[AxisLetter::C]);
}

TEST(RotaryPlan, UnwindsAsSeldomAsTravelAllows) {
  const Machine machine = shipped("double-pivot-head");  // C -400 .. 400 deg
  const auto unwindings = [&](double turns) {
    const auto path = winding(30.0, turns, static_cast<int>(turns * 180));
    const auto plan = plan_axes(machine, path, 100.0, {});
    EXPECT_TRUE(plan);
    const Seen seen = follow_poses(machine, path, *plan, 100.0);
    EXPECT_LT(seen.largest_step, 2.01);
    EXPECT_LT(seen.worst_tip, 1e-9);
    return seen.unwindings;
  };
  EXPECT_EQ(unwindings(2.0), 0);
  EXPECT_EQ(unwindings(3.0), 1);  // 1080 deg of path, 800 deg of travel
  EXPECT_EQ(unwindings(6.0), 2);
  const Machine endless = shipped("iwf-bc");
  const auto path = winding(30.0, 6.0, 1000);
  const auto plan = plan_axes(endless, path, 100.0, {});
  ASSERT_TRUE(plan);
  EXPECT_EQ(follow_poses(endless, path, *plan, 100.0).unwindings, 0);
  EXPECT_NEAR(range_of(*plan, AxisLetter::C), 6.0 * 360.0, 1e-6);
}

TEST(RotaryPlan, BeginsNearThePreferredSolution) {
  const Machine machine = shipped("iwf-bc");
  const auto path = cone(30, 10, 0, 360);
  for (const double tilt : {-25.0, 25.0}) {
    PlanOptions options;
    options.preferred = AxisPositions{};
    (*options.preferred)[AxisLetter::B] = tilt * kPlanDeg;
    (*options.preferred)[AxisLetter::C] = 90.0 * kPlanDeg;
    const auto plan = plan_axes(machine, path, 150.0, options);
    ASSERT_TRUE(plan);
    EXPECT_GT((*plan)[0].axes[AxisLetter::B] * tilt, 0.0);
  }
}

// Half-way between two axis positions the tool axis is no farther from the path's middle than the
// ends are.
bool stays_near(const Machine& machine, const AxisPositions& a, const AxisPositions& b) {
  AxisPositions middle;
  for (const AxisLetter letter : kAxisLetters) middle[letter] = 0.5 * (a[letter] + b[letter]);
  const auto axis = [&](const AxisPositions& q) {
    return tool_pose(nominal_pose(machine, q, 0.0)).axis;
  };
  const Vec3 wanted = (axis(a) + axis(b)).normalized();
  return angle_between(axis(middle), wanted) <= angle_between(axis(a), wanted) + 1e-7;
}

// Every way through the solutions, tried one by one.
double least_travel(const Machine& machine, const std::vector<std::vector<InverseSolution>>& layers,
                    double largest_step) {
  double least = std::numeric_limits<double>::infinity();
  const std::function<void(std::size_t, const AxisPositions&, double)> go =
      [&](std::size_t i, const AxisPositions& from, double travel) {
        if (travel >= least) return;
        if (i == layers.size()) {
          least = travel;
          return;
        }
        for (const InverseSolution& s : layers[i]) {
          const double b = std::abs(s.axes[AxisLetter::B] - from[AxisLetter::B]);
          const double c = std::abs(s.axes[AxisLetter::C] - from[AxisLetter::C]);
          if (!s.within_travel) continue;
          if (i > 0 && (std::max(b, c) > largest_step || !stays_near(machine, from, s.axes)))
            continue;
          go(i + 1, s.axes, travel + b + c);
        }
      };
  go(0, {}, 0.0);
  return least;
}

TEST(RotaryPlanOracle, FindsTheLeastTravelOfAllWaysThroughTheSolutions) {
  const Machine machine = shipped("double-pivot-head");
  PlanOptions options;
  options.singular_weight = 1.0;
  int compared = 0;
  for (std::uint32_t draw = 0; draw < 60; ++draw) {
    const RandomKey key{.seed = 31, .draw = draw};
    std::vector<ToolPose> path;
    std::vector<std::vector<InverseSolution>> layers;
    double azimuth = 0.0;
    for (std::uint64_t i = 0; i < 6; ++i) {
      azimuth += 240.0 * (uniform(key, 2 * i) - 0.3);
      const double tilt = 5.0 + 80.0 * uniform(key, 2 * i + 1);
      path.push_back(
          {Vec3(10.0 * static_cast<double>(i), 0, 0),
           rotation_z(azimuth * kPlanDeg) * rotation_y(tilt * kPlanDeg) * Vec3::UnitZ()});
      layers.push_back(all_solutions(machine, path.back(), 100.0).value());
    }
    const auto plan = plan_axes(machine, path, 100.0, options);
    ASSERT_TRUE(plan) << to_string(plan.error().front());
    const double least = least_travel(machine, layers, options.largest_step);
    if (follow_poses(machine, path, *plan, 100.0).unwindings > 0) {
      EXPECT_TRUE(std::isinf(least)) << draw;
      continue;
    }
    double travel = 0.0;
    AxisPositions from;
    for (const PlannedPose& pose : *plan) {
      travel += std::abs(pose.axes[AxisLetter::B] - from[AxisLetter::B]) +
                std::abs(pose.axes[AxisLetter::C] - from[AxisLetter::C]);
      from = pose.axes;
    }
    EXPECT_NEAR(travel, least, 1e-5) << draw;
    ++compared;
  }
  EXPECT_GT(compared, 40);
}

TEST(RotaryPlan, NamesThePoseAndTheAxisThatIsInTheWay) {
  const Machine machine = shipped("iwf-bc");
  auto path = winding(30.0, 0.2, 20);
  path[7].axis = rotation_y(115.0 * kPlanDeg) * Vec3::UnitZ();
  const auto tilted = plan_axes(machine, path, 100.0, {});
  ASSERT_FALSE(tilted);
  EXPECT_NE(tilted.error().front().message.find("pose 7: beyond travel: B = -115"),
            std::string::npos)
      << to_string(tilted.error().front());
  path[7] = {Vec3(0, 0, 900), Vec3::UnitZ()};
  const auto high = plan_axes(machine, path, 100.0, {});
  ASSERT_FALSE(high);
  EXPECT_NE(high.error().front().message.find("pose 7: beyond travel at the pole: Z = "),
            std::string::npos)
      << to_string(high.error().front());
}

TEST(RotaryPlan, TakesMachinesWithOneRotaryAxisOrNone) {
  const Machine plain = shipped("three-axis");
  const std::vector<ToolPose> straight{{Vec3(0, 0, 0), Vec3::UnitZ()},
                                       {Vec3(9, 0, 0), Vec3::UnitZ()}};
  const auto plan = plan_axes(plain, straight, 0.0, {});
  ASSERT_TRUE(plan) << to_string(plan.error().front());
  EXPECT_EQ(follow_poses(plain, straight, *plan, 0.0).worst_tip, 0.0);
  EXPECT_TRUE(plan_axes(plain, {}, 0.0, {}).value().empty());
}

}  // namespace
}  // namespace frustum::kinematics
