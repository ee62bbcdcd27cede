#include "kinematics/model/inverse.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

AxisPositions random_position(const Machine& machine, std::uint32_t draw) {
  AxisPositions q;
  std::uint64_t index = 0;
  for (const Joint& joint : machine.joints()) {
    const double u = uniform({.seed = 7, .draw = draw}, index++);
    q[joint.letter] = joint.travel.lo + u * joint.travel.width();
  }
  return q;
}

class EveryMachine : public testing::TestWithParam<const char*> {};

TEST_P(EveryMachine, ReturnsToTheSamePoseAfterInverseAndForwardKinematics) {
  const Machine machine = shipped(GetParam());
  double worst_tip = 0.0, worst_axis = 0.0;
  for (std::uint32_t draw = 0; draw < 10000; ++draw) {
    const AxisPositions q = random_position(machine, draw);
    const double length = 200.0 * uniform({.seed = 8, .draw = draw}, 0);
    const ToolPose pose = tool_pose(nominal_pose(machine, q, length));
    const auto solutions = inverse(machine, pose, length, q);
    ASSERT_TRUE(solutions) << to_string(solutions.error().front());
    ASSERT_TRUE(solutions->front().within_travel);
    for (const InverseSolution& solution : *solutions) {
      const ToolPose back = tool_pose(nominal_pose(machine, solution.axes, length));
      worst_tip = std::max(worst_tip, (back.tip - pose.tip).norm());
      worst_axis = std::max(worst_axis, (back.axis - pose.axis).norm());
    }
  }
  EXPECT_LT(worst_tip, 1e-9);
  EXPECT_LT(worst_axis, 1e-12);
  RecordProperty("worst_tip_mm", std::to_string(worst_tip * 1e12) + "e-12");
  RecordProperty("worst_axis_rad", std::to_string(worst_axis * 1e15) + "e-15");
}

TEST_P(EveryMachine, KeepsThePreviousSolutionAlongASmoothMotion) {
  const Machine machine = shipped(GetParam());
  const AxisPositions start = random_position(machine, 1), end = random_position(machine, 2);
  AxisPositions q = start;
  for (int i = 0; i <= 2000; ++i) {
    AxisPositions wanted;
    for (const AxisLetter letter : kAxisLetters) {
      wanted[letter] = start[letter] + i / 2000.0 * (end[letter] - start[letter]);
    }
    const auto solutions =
        inverse(machine, tool_pose(nominal_pose(machine, wanted, 100.0)), 100.0, q);
    ASSERT_TRUE(solutions);
    q = solutions->front().axes;
    for (const AxisLetter letter : kAxisLetters) ASSERT_NEAR(q[letter], wanted[letter], 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryMachine,
                         testing::Values("zx-yac", "iwf-bc", "dvf5000", "double-pivot-head",
                                         "swivel-head-table", "three-axis"));

// --- machines that nobody built ------------------------------------------------------------------

class Draw {
 public:
  explicit Draw(std::uint32_t draw) : draw_(draw) {}
  double between(double lo, double hi) {
    return lo + (hi - lo) * uniform({.seed = 21, .draw = draw_}, index_++);
  }
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(between(0.0, 1.0) * static_cast<double>(n));
  }
  Vec3 direction() {
    const double z = between(-1.0, 1.0), turn = between(0.0, 2.0 * std::numbers::pi);
    return {std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z};
  }

 private:
  std::uint32_t draw_;
  std::uint64_t index_ = 0;
};

std::string listed(const Vec3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

// Along an axis of the machine, nutating at 45 deg between two of them, or any.
Vec3 rotary_direction(Draw& draw) {
  const std::size_t kind = draw.below(3), i = draw.below(3);
  const double side = draw.below(2) == 0 ? 1.0 : -1.0;
  if (kind == 0) return side * Vec3::Unit(static_cast<Eigen::Index>(i));
  if (kind == 2) return draw.direction();
  Vec3 nutating = side * Vec3::Unit(static_cast<Eigen::Index>(i));
  nutating[static_cast<Eigen::Index>((i + 1 + draw.below(2)) % 3)] = 1.0;
  return nutating.normalized();
}

// Any order, any side, any offsets; X Y Z somewhat skew.
std::string random_machine_text(Draw& draw) {
  const char rotary[] = {'A', 'B', 'C'};
  const std::size_t left_out = draw.below(3);
  std::string letters = "XYZ";
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != left_out) letters += rotary[i];
  }
  for (std::size_t i = letters.size() - 1; i > 0; --i) {
    std::swap(letters[i], letters[draw.below(i + 1)]);
  }
  const std::size_t bed = draw.below(letters.size() + 1);
  std::string code = "t-(S)";
  for (std::size_t i = 0; i <= letters.size(); ++i) {
    if (i == bed) code += "-b";
    if (i < letters.size()) code += std::string("-") + letters[i];
  }
  std::string text = fmt::format("name = \"drawn\"\nstructure = \"{}-w\"\n", code);
  const auto offset = [&]() -> Vec3 { return 300.0 * draw.direction(); };
  text += fmt::format("[spindle]\noffset = {}\n[table]\noffset = {}\n", listed(offset()),
                      listed(offset()));
  Vec3 other = Vec3::Zero();
  for (const char letter : letters) {
    const bool turns = letter < 'X';
    Vec3 direction = turns ? rotary_direction(draw)
                           : (Vec3::Unit(letter - 'X') + 0.3 * draw.direction()).normalized();
    while (turns && !other.isZero() && direction.cross(other).norm() < 0.1)
      direction = rotary_direction(draw);
    if (turns) other = direction;
    const bool endless = turns && draw.below(2) == 0;
    text += fmt::format("[axis.{}]\ndirection = {}\noffset = {}\n{}\n", letter, listed(direction),
                        listed(offset()),
                        endless ? "endless = true"
                        : turns ? "travel = [-400, 250]"
                                : "travel = [-5000, 5000]");
  }
  return text;
}

bool same_turn(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)) < 1e-6;
}

TEST(InverseLaws, ClosesOnThirtyRandomStructuresAndFindsThePositionItCameFrom) {
  double worst_tip = 0.0, worst_axis = 0.0;
  for (std::uint32_t number = 0; number < 30; ++number) {
    Draw draw(number);
    const std::string text = random_machine_text(draw);
    const auto machine = machine_from_text(text);
    ASSERT_TRUE(machine) << to_string(machine.error().front()) << '\n' << text;
    for (std::uint32_t i = 0; i < 200; ++i) {
      const AxisPositions q = random_position(*machine, i);
      const double length = draw.between(0.0, 300.0);
      const ToolPose pose = tool_pose(nominal_pose(*machine, q, length));
      const auto solutions = all_solutions(*machine, pose, length);
      ASSERT_TRUE(solutions) << to_string(solutions.error().front()) << '\n' << text;
      bool found = false;
      for (const InverseSolution& s : *solutions) {
        found = found || s.singular;
        // Linear axes on top of rotary ones may stand nearly in one plane: then they run off to
        // far.
        if (!s.within_travel) continue;
        const ToolPose back = tool_pose(nominal_pose(*machine, s.axes, length));
        worst_tip = std::max(worst_tip, (back.tip - pose.tip).norm());
        worst_axis = std::max(worst_axis, (back.axis - pose.axis).norm());
        ASSERT_LT(worst_tip, 1e-9) << text;
        ASSERT_LT(worst_axis, 1e-12) << text;
        bool same = true;
        for (const AxisLetter letter : {AxisLetter::A, AxisLetter::B, AxisLetter::C}) {
          const Joint* joint = machine->joint(letter);
          if (joint == nullptr) continue;
          same = same && (joint->endless ? same_turn(s.axes[letter], q[letter])
                                         : std::abs(s.axes[letter] - q[letter]) < 1e-6);
        }
        found = found || same;
      }
      ASSERT_TRUE(found) << "pose " << i << '\n' << text;
    }
  }
  RecordProperty("worst_tip_mm", fmt::format("{:.2e}", worst_tip));
  RecordProperty("worst_axis_rad", fmt::format("{:.2e}", worst_axis));
}

TEST(InverseLaws, SaysHowFarADirectionIsOutOfTheReachOfANutatingHead) {
  // B nutates at 30 deg to the spindle: the tool axis reaches 60 deg from the table's normal, no
  // more.
  const auto machine = machine_from_text(R"(
name = "nutating"
structure = "t-B-Z-Y-X-b-C-w"
[axis.B]
direction = [0, 0.5, 0.8660254037844387]
endless = true
[axis.C]
endless = true
[axis.X]
travel = [-900, 900]
[axis.Y]
travel = [-900, 900]
[axis.Z]
travel = [-900, 900]
)");
  ASSERT_TRUE(machine);
  const auto reached = [&](double tilt) {
    const Vec3 u = rotation_z(0.4) * rotation_x(tilt * kRadPerDeg) * Vec3::UnitZ();
    return inverse(*machine, {Vec3::Zero(), u}, 100.0, {});
  };
  EXPECT_TRUE(reached(59.999));
  const auto beyond = reached(62.5);
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().front().message.find("2.500000 deg from the nearest"), std::string::npos)
      << to_string(beyond.error().front());
}

TEST(Inverse, ListsEveryFullTurnWithinTravel) {
  const Machine machine = shipped("double-pivot-head");  // C -400 .. 400 deg, B -110 .. 110 deg
  const Vec3 axis = rotation_z(20.0 * kRadPerDeg) * rotation_y(50.0 * kRadPerDeg) * Vec3::UnitZ();
  const auto solutions = all_solutions(machine, {Vec3(10, 20, 30), axis}, 200.0);
  ASSERT_TRUE(solutions);
  std::vector<std::pair<double, double>> degrees;
  for (const InverseSolution& s : *solutions) {
    EXPECT_TRUE(s.within_travel);
    degrees.emplace_back(std::round(s.axes[AxisLetter::B] * kDegPerRad * 1e6) / 1e6,
                         std::round(s.axes[AxisLetter::C] * kDegPerRad * 1e6) / 1e6);
  }
  const std::vector<std::pair<double, double>> expected{
      {50, 20}, {-50, -160}, {-50, 200}, {50, -340}, {50, 380}};
  EXPECT_EQ(degrees, expected);
}

TEST(Inverse, ReportsTheSingularDirectionAndKeepsTheFreeAxis) {
  const Machine machine = shipped("iwf-bc");
  AxisPositions previous;
  previous[AxisLetter::C] = 1.25;
  const auto solutions = inverse(machine, {Vec3(10, 20, 30), Vec3::UnitZ()}, 0.0, previous);
  ASSERT_TRUE(solutions);
  EXPECT_TRUE(solutions->front().singular);
  EXPECT_DOUBLE_EQ(solutions->front().axes[AxisLetter::C], 1.25);
}

TEST(Inverse, IsExactBesideThePole) {
  const Machine machine = shipped("iwf-bc");
  for (const double tilt : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const Vec3 axis = rotation_z(0.7) * rotation_y(tilt) * Vec3::UnitZ();
    const auto solutions = inverse(machine, {Vec3(10, 20, 30), axis}, 50.0, {});
    ASSERT_TRUE(solutions);
    for (const InverseSolution& s : *solutions) {
      EXPECT_LT((tool_pose(nominal_pose(machine, s.axes, 50.0)).axis - axis).norm(), 1e-12) << tilt;
    }
  }
}

TEST(Inverse, SaysByHowMuchADirectionIsOutOfReach) {
  const Machine machine = shipped("three-axis");
  const auto tilted = inverse(machine, {Vec3::Zero(), rotation_x(0.1) * Vec3::UnitZ()}, 0.0, {});
  ASSERT_FALSE(tilted);
  EXPECT_NE(tilted.error().front().message.find("5.729578 deg off the spindle"), std::string::npos);
}

TEST(Inverse, PrefersTheSolutionWithinTravel) {
  const Machine machine = shipped("iwf-bc");
  // 100 deg of tilt: B = -100 and B = +100 are both in reach; 115 deg is not.
  const auto out =
      inverse(machine, {Vec3(0, 0, 100), rotation_y(115.0 * kRadPerDeg) * Vec3::UnitZ()}, 0.0, {});
  ASSERT_TRUE(out);
  EXPECT_FALSE(out->front().within_travel);
  EXPECT_FALSE(travel_violations(machine, out->front().axes).empty());
}

}  // namespace
}  // namespace frustum::kinematics
