// Positioning and straightness against values that were computed apart.
#include "instruments/positioning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "instruments/approach.hpp"
#include "instruments/line_straightness.hpp"
#include "instruments/line_test.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

Deviations rows_of(const json& rows) { return rows.get<Deviations>(); }

void expect_positioning(const Positioning& p, const json& numbers, double within) {
  const auto near = [&](const char* name, double value) {
    EXPECT_NEAR(value, numbers[name].get<double>(), within) << name;
  };
  const auto all = [&](const char* name, const std::vector<double>& values) {
    ASSERT_EQ(values.size(), numbers[name].size()) << name;
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], numbers[name][i].get<double>(), within) << name << i;
    }
  };
  all("x_up", p.up.mean);
  all("x_down", p.down.mean);
  all("s_up", p.up.sd);
  all("s_down", p.down.sd);
  all("B_i", p.reversal);
  all("R_i", p.repeatability_at);
  near("B", p.largest_reversal);
  near("B_mean", p.mean_reversal);
  near("R_up", p.up.repeatability);
  near("R_down", p.down.repeatability);
  near("R", p.repeatability);
  near("E_up", p.up.systematic);
  near("E_down", p.down.systematic);
  near("E", p.systematic);
  near("M", p.mean_range);
  near("A_up", p.up.accuracy);
  near("A_down", p.down.accuracy);
  near("A", p.accuracy);
}

TEST(PositioningReference, TwoPublicReports) {
  for (std::size_t i : {0U, 1U}) {
    const json& numbers = motion_numbers()["iso230_2"][i];
    const auto p =
        positioning(rows_of(numbers["deviations_up_um"]), rows_of(numbers["deviations_down_um"]));
    ASSERT_TRUE(p);
    expect_positioning(*p, numbers["computed_um"], 5.1e-7);
  }
}

TEST(PositioningReference, ASimulatedLaser) {
  const json& numbers = motion_numbers()["iso230_2"][2];
  const auto machine = kinematics::shipped("zx-yac");  // X on the tool side
  const auto errors = errors_of(
      machine,
      {"EXX=cyclic 4um period 250mm phase -90deg + linear 6um over -180mm..180mm + reversal "
       "3um"});
  Deviations up, down;
  for (const RunDirection direction : {RunDirection::up, RunDirection::down}) {
    auto line = axis_line(machine, {.targets = numbers["positions_mm"].get<std::vector<double>>()},
                          direction);
    ASSERT_TRUE(line);
    line->poses = with_approach(line->poses, line->start, errors);
    auto readings = line_readings(kinematics::ForwardChain(machine, errors, 0.0), *line, {});
    if (direction == RunDirection::down) std::ranges::reverse(readings);
    for (const double reading : readings) {
      (direction == RunDirection::up ? up : down)
          .push_back({reading * kUmPerMm, reading * kUmPerMm});
    }
  }
  const auto p = positioning(up, down);
  ASSERT_TRUE(p);
  expect_positioning(*p, numbers["computed_um"], 5.1e-7);
}

TEST(Positioning, RefusesWhatCannotBeEvaluated) {
  const auto id = [](const Deviations& up, const Deviations& down) {
    const auto p = positioning(up, down);
    return p ? std::string("accepted") : std::string(p.error().front().id.text());
  };
  EXPECT_EQ(id({{1.0, 2.0}}, {{1.0, 2.0}}), "too-few-targets");
  EXPECT_EQ(id({{1.0, 2.0}, {1.0, 2.0}}, {{1.0, 2.0}}), "too-few-targets");
  EXPECT_EQ(id({{1.0}, {1.0}}, {{1.0}, {1.0}}), "too-few-runs");
  EXPECT_EQ(id({{1.0, 2.0}, {1.0}}, {{1.0, 2.0}, {1.0, 3.0}}), "too-few-runs");
}

TEST(LineStraightness, OfAParabola) {
  std::vector<double> x, y;
  for (int i = 0; i <= 100; ++i) {
    x.push_back(10.0 + i);
    const double t = (i - 50) / 50.0;
    y.push_back(3.0 + 0.7 * t + 5.0 * t * t);
  }
  const auto s = straightness_of(x, y);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->least_squares, 5.0, 1e-12);
  EXPECT_NEAR(s->end_points, 5.0, 1e-12);
  EXPECT_NEAR(s->minimum_zone, 5.0, 1e-12);
}

TEST(LineStraightnessLaws, TheMinimumZoneIsTheNarrowest) {
  const RandomKey key{.seed = 77};
  for (std::uint64_t n = 0; n < 30; ++n) {
    std::vector<double> x, y;
    for (std::uint64_t i = 0; i < 25; ++i) {
      x.push_back(static_cast<double>(i) * 7.0);
      y.push_back(normal(key, 100 * n + i));
    }
    const auto s = straightness_of(x, y);
    ASSERT_TRUE(s);
    // The narrowest band has an edge through two of the points.
    double narrowest = 1e9;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = i + 1; j < x.size(); ++j) {
        const double slope = (y[j] - y[i]) / (x[j] - x[i]);
        double least = 1e9, most = -1e9;
        for (std::size_t k = 0; k < x.size(); ++k) {
          least = std::min(least, y[k] - slope * x[k]);
          most = std::max(most, y[k] - slope * x[k]);
        }
        narrowest = std::min(narrowest, most - least);
      }
    }
    EXPECT_NEAR(s->minimum_zone, narrowest, 1e-12);
    EXPECT_LE(s->minimum_zone, s->least_squares + 1e-12);
    EXPECT_LE(s->minimum_zone, s->end_points + 1e-12);
  }
}

}  // namespace
}  // namespace frustum::instruments
