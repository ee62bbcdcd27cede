#include "kinematics/errors/error_gain.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

double draw(std::uint64_t index, double size) {
  return size * (2.0 * uniform({.seed = 77}, index) - 1.0);
}

AxisPositions position_of_draw(std::uint64_t k) {
  AxisPositions q;
  for (std::size_t i = 0; i < 6; ++i) {
    q[kAxisLetters[i]] = draw(6 * k + i, i < 3 ? 200.0 : 1.5);
  }
  return q;
}

// Every error name the machine accepts, aliases too, as text with a small amount.
std::vector<std::string> every_error_text(const Machine& machine) {
  std::vector<std::string> texts;
  const auto add = [&](const std::string& name, ErrorDirection direction) {
    texts.push_back(name + (is_rotation(direction) ? "=10 urad" : "=1 um"));
  };
  for (const ErrorName& e : machine.error_names()) add(e.text(), e.direction);
  for (const auto& [name, alias] : machine.aliases()) add(name, alias.error.direction);
  texts.push_back("EXX=linear 3um over -100mm..100mm + 1um");
  return texts;
}

GeometricErrors errors_of(const Machine& machine, const std::string& text, bool negative) {
  ErrorEntry entry = *parse_error(text);
  if (negative) {
    for (ErrorShape& shape : entry.terms) shape.amount.value *= -1.0;
  }
  auto resolved = resolve(machine, std::vector{entry});
  EXPECT_TRUE(resolved) << text << ": " << to_string(resolved.error().front());
  return resolved ? *resolved : GeometricErrors{};
}

// Rotation vector of a nearly unit rotation.
Vec3 small_turn(const Mat3& r) {
  return 0.5 * Vec3(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
}

class ErrorGainOfMachine : public ::testing::TestWithParam<const char*> {};

TEST_P(ErrorGainOfMachine, AgreesWithCentralDifferencesOfTheExactChainForEveryError) {
  const Machine machine = shipped(GetParam());
  constexpr double kToolLength = 150.0;
  for (const std::string& text : every_error_text(machine)) {
    const GeometricErrors plus = errors_of(machine, text, false);
    const GeometricErrors minus = errors_of(machine, text, true);
    for (std::uint64_t k = 0; k < 20; ++k) {
      const AxisPositions q = position_of_draw(k);
      const Pose up = actual_pose(machine, plus, q, kToolLength);
      const Pose down = actual_pose(machine, minus, q, kToolLength);
      const Vec3 tip = 0.5 * (up.translation - down.translation);
      const Vec3 turn = small_turn(up.rotation * down.rotation.transpose()) / 2.0;
      const PoseDisplacement found = first_order_displacement(machine, plus, q, kToolLength);
      // 10 urad: the third-order rest is 1e-10 of levers below a metre; rounding of metres 1e-12.
      EXPECT_LT((found.tip - tip).norm(), 1e-11) << text;
      EXPECT_LT((found.turn - turn).norm(), 1e-14) << text;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, ErrorGainOfMachine,
                         ::testing::Values("zx-yac", "iwf-bc", "dvf5000", "double-pivot-head",
                                           "swivel-head-table", "three-axis"),
                         [](const auto& machine) {
                           std::string name = machine.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(ErrorGain, IsLinearInTheErrors) {
  const Machine machine = shipped("zx-yac");
  const AxisPositions q = position_of_draw(3);
  const auto of = [&](std::vector<std::string> texts) {
    std::vector<ErrorEntry> entries;
    for (const std::string& text : texts) entries.push_back(*parse_error(text));
    return first_order_displacement(machine, *resolve(machine, entries), q, 100.0);
  };
  const PoseDisplacement both = of({"beta_CA=20urad", "EZ0A=3um"});
  const PoseDisplacement one = of({"beta_CA=10urad"}), other = of({"EZ0A=1um"});
  EXPECT_LT((both.tip - 2.0 * one.tip - 3.0 * other.tip).norm(), 1e-15);
  EXPECT_LT((both.turn - 2.0 * one.turn - 3.0 * other.turn).norm(), 1e-18);
}

}  // namespace
}  // namespace frustum::kinematics
