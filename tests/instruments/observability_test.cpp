// Ranks and what is told of sets of tests, against what was computed apart.
#include "instruments/observability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <numbers>

#include "instruments/chase_test.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/sample_angles.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;
using kinematics::MachineError;
using kinematics::shipped;
using Set = std::vector<ReadingGains>;

constexpr double kFullTurn = 2.0 * std::numbers::pi;

// The tests of one machine as gains of its location errors.
class Tests {
 public:
  explicit Tests(const std::string& name, int samples = 36)
      : machine_(shipped(name)), errors_(location_unknowns(machine_)), samples_(samples) {}

  [[nodiscard]] Set planes() const {
    Set set;
    for (const Plane plane : kPlanes) {
      set.push_back(
          bar_gains(machine_, errors_,
                    *circle_test(machine_, {.plane = plane,
                                            .centre = {0.0, 0.0, 150.0},
                                            .angles = from_step(0.0, kFullTurn / samples_),
                                            .tool_length = tool_length()})));
    }
    return set;
  }
  // Three bars, or one.
  [[nodiscard]] Set bars(AxisLetter axis, BarHold hold, const Vec3& ball, double held_deg = 0.0,
                         std::optional<BarDirection> only = {}) const {
    Set set;
    for (const BarDirection direction : kBarDirections) {
      if (only && *only != direction) continue;
      RotaryTest test{.axis = axis,
                      .direction = direction,
                      .hold = hold,
                      .table_ball = ball,
                      .tool_length = tool_length()};
      test.angles = axis == AxisLetter::C
                        ? from_step(0.0, kFullTurn / samples_)
                        : from_step(-0.5 * std::numbers::pi, std::numbers::pi / (samples_ - 1));
      if (axis == AxisLetter::C) test.held[tilt()] = held_deg * kRadPerDeg;
      set.push_back(bar_gains(machine_, errors_, *rotary_test(machine_, test)));
    }
    return set;
  }
  [[nodiscard]] Set r_test(int balls) const {
    const std::vector<Vec3> places{{100.0, 0.0, 100.0}, {-60.0, 80.0, 160.0}, {40.0, -90.0, 60.0}};
    Set set;
    for (int b = 0; b < balls; ++b) {
      ChaseTest chase{.table_ball = places[static_cast<std::size_t>(b)],
                      .tool_length = tool_length()};
      for (int t = -3; t <= 3; ++t) {
        for (int c = 0; c < 12; ++c) {
          AxisPositions q;
          q[tilt()] = 30.0 * t * kRadPerDeg;
          q[AxisLetter::C] = 30.0 * c * kRadPerDeg;
          chase.rotary.push_back(q);
        }
      }
      set.push_back(displacement_gains(machine_, errors_, *chase_test(machine_, chase)));
    }
    return set;
  }
  [[nodiscard]] Set cone(ConeSense sense) const {
    return {bar_gains(machine_, errors_,
                      *cone_test(machine_, {.cone_angle = 45.0 * kRadPerDeg,
                                            .inclination = 30.0 * kRadPerDeg,
                                            .radius = 40.0,
                                            .centre = {-65.0, 0.0, 150.0},
                                            .sense = sense,
                                            .angles = midpoints(0.0, kFullTurn, 72)}))};
  }

  void expect(const Set& set, const std::string& name) const {
    const json& all = motion_numbers()["observability"]["machines"][machine_.name()];
    for (const SpindleBall ball : {SpindleBall::unknown, SpindleBall::known}) {
      const std::string key = name + (ball == SpindleBall::known ? " (spindle ball known)" : "");
      if (!all.contains(key)) continue;
      const Told told = told_by(errors_, set, ball);
      EXPECT_EQ(told.unknowns, all[key]["of"].get<int>()) << machine_.name() << ": " << key;
      EXPECT_EQ(told.rank(), all[key]["rank"].get<int>()) << machine_.name() << ": " << key;
      EXPECT_THAT(told.told,
                  testing::ElementsAreArray(all[key]["told"].get<std::vector<std::string>>()))
          << machine_.name() << ": " << key;
      ++held_;
    }
  }
  [[nodiscard]] int held() const { return held_; }
  [[nodiscard]] std::size_t listed() const {
    return motion_numbers()["observability"]["machines"][machine_.name()].size();
  }
  [[nodiscard]] const Machine& machine() const { return machine_; }
  [[nodiscard]] const std::vector<MachineError>& errors() const { return errors_; }
  [[nodiscard]] AxisLetter tilt() const {
    return machine_.joint(AxisLetter::A) != nullptr ? AxisLetter::A : AxisLetter::B;
  }

 private:
  [[nodiscard]] double tool_length() const { return tool_length_of(machine_); }
  [[nodiscard]] std::vector<double> from_step(double from, double step) const {
    std::vector<double> angles;
    for (int i = 0; i < samples_; ++i) angles.push_back(from + i * step);
    return angles;
  }

  Machine machine_;
  std::vector<MachineError> errors_;
  int samples_;
  mutable int held_ = 0;
};

Set joined(std::initializer_list<Set> sets) {
  Set all;
  for (const Set& set : sets) all.insert(all.end(), set.begin(), set.end());
  return all;
}

const Vec3 kBall(100.0, 0.0, 100.0);

TEST(ObservabilityReference, TablesWithTwoRotaryAxes) {
  for (const char* name : {"zx-yac", "iwf-bc"}) {
    const Tests t(name);
    const Vec3 tilt_ball = t.tilt() == AxisLetter::A ? Vec3(0.0, 100.0, 100.0) : kBall;
    const Set planes = t.planes(), c = t.bars(AxisLetter::C, BarHold::rotor, kBall),
              tilt = t.bars(t.tilt(), BarHold::rotor, tilt_ball);
    t.expect(planes, "planes");
    t.expect(c, "C");
    t.expect(tilt, "tilt");
    t.expect(joined({c, tilt}), "C+tilt");
    t.expect(joined({c, tilt,
                     t.bars(AxisLetter::C, BarHold::rotor, {100.0, 0.0, 200.0}, 0.0,
                            BarDirection::radial)}),
             "C+tilt+second height");
    t.expect(joined({c, t.bars(AxisLetter::C, BarHold::rotor, kBall, -90.0)}),
             "C at tilt 0 and -90");
    t.expect(joined({planes, c, tilt}), "planes+C+tilt");
    t.expect(t.r_test(1), "R-test one ball");
    t.expect(t.r_test(2), "R-test two balls");
    t.expect(t.r_test(3), "R-test three balls");
    if (t.tilt() == AxisLetter::B) {
      const Set normal = t.cone(ConeSense::normal), radial = t.cone(ConeSense::radial);
      t.expect(normal, "cone-normal");
      t.expect(radial, "cone-radial");
      t.expect(joined({planes, c, tilt, normal, radial}), "planes+C+tilt+cone");
    }
    EXPECT_EQ(static_cast<std::size_t>(t.held()), t.listed()) << name;
  }
}

TEST(ObservabilityReference, SwivelHeadAndTable) {
  const Tests t("swivel-head-table");
  const Vec3 ball(0.0, 0.0, 100.0);
  const Set planes = t.planes(), c = t.bars(AxisLetter::C, BarHold::rotor, kBall),
            rotor = t.bars(AxisLetter::B, BarHold::rotor, ball),
            bed = t.bars(AxisLetter::B, BarHold::bed, ball);
  t.expect(planes, "planes");
  t.expect(c, "C");
  t.expect(rotor, "head rotor");
  t.expect(bed, "head bed");
  t.expect(joined({c, rotor}), "C+head rotor");
  t.expect(joined({c, bed}), "C+head bed");
  t.expect(joined({planes, c, rotor, bed}), "planes+C+head rotor+bed");
  t.expect(t.r_test(1), "R-test one ball");
  t.expect(t.r_test(2), "R-test two balls");
  t.expect(t.r_test(3), "R-test three balls");
  EXPECT_EQ(static_cast<std::size_t>(t.held()), t.listed());
}

TEST(ObservabilityReference, DoublePivotHead) {
  const Tests t("double-pivot-head");
  const Vec3 ball(0.0, 0.0, 100.0);
  const Set planes = t.planes(),
            b = joined({t.bars(AxisLetter::B, BarHold::rotor, ball),
                        t.bars(AxisLetter::B, BarHold::bed, ball)}),
            at_0 = t.bars(AxisLetter::C, BarHold::bed, ball),
            at_60 = joined({t.bars(AxisLetter::C, BarHold::rotor, ball, 60.0),
                            t.bars(AxisLetter::C, BarHold::bed, ball, 60.0)});
  t.expect(planes, "planes");
  t.expect(b, "B");
  t.expect(at_0, "C at B=0");
  t.expect(at_60, "C at B=60");
  t.expect(joined({b, at_60}), "B+C at 60");
  t.expect(joined({planes, b, at_0, at_60}), "planes+B+C at 0,60");
  t.expect(t.r_test(1), "R-test one ball");
  t.expect(t.r_test(2), "R-test two balls");
  t.expect(t.r_test(3), "R-test three balls");
  EXPECT_EQ(static_cast<std::size_t>(t.held()), t.listed());
}

// Standard deviations of an estimate from nine bars with noise of 0.3 um, spindle ball known.
TEST(ObservabilityReference, NoiseOfTheIdentifiedErrors) {
  const json& numbers = motion_numbers()["identification_noise"];
  for (const char* name : {"zx-yac", "iwf-bc"}) {
    const Tests turn(name, 360), tilted(name, 181);
    const Set set =
        joined({turn.planes(), turn.bars(AxisLetter::C, BarHold::rotor, kBall),
                tilted.bars(turn.tilt(), BarHold::rotor,
                            turn.tilt() == AxisLetter::A ? Vec3(0.0, 100.0, 100.0) : kBall)});
    const Eigen::MatrixXd rows = without_setup(set, SpindleBall::known);
    const json& sds = numbers[name];
    std::vector<Eigen::Index> columns;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < turn.errors().size(); ++k) {
      if (!sds.contains(turn.errors()[k].name)) continue;
      columns.push_back(static_cast<Eigen::Index>(k));
      names.push_back(turn.errors()[k].name);
    }
    ASSERT_EQ(names.size(), sds.size());
    const Eigen::MatrixXd chosen = rows(Eigen::all, columns);
    const Eigen::MatrixXd normal = chosen.transpose() * chosen;
    const Eigen::MatrixXd covariance =
        normal.ldlt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool angle = names[k][1] >= 'A' && names[k][1] <= 'C';
      const auto at = static_cast<Eigen::Index>(k);
      const double sd = 0.3 * std::sqrt(covariance(at, at)) * (angle ? 1e3 : 1.0);
      EXPECT_NEAR(sd, sds[names[k]].get<double>(), 6e-6) << name << names[k];
    }
  }
}

// What six bars identify where squareness is taken for zero: the ball-bar column of the paper's
// Table 8 from its machining estimates (um, urad in; mm, deg out).
TEST(ObservabilityReference, NeglectedSquarenessMakesTheBallBarColumn) {
  const json& table = motion_numbers()["table_8"];
  const Tests turn("zx-yac", 72), tilted("zx-yac", 73);  // 5 deg, 2.5 deg
  const Set six = joined({turn.bars(AxisLetter::C, BarHold::rotor, kBall),
                          tilted.bars(AxisLetter::A, BarHold::rotor, {0.0, 100.0, 100.0})});
  const Eigen::MatrixXd rows = without_setup(six, SpindleBall::unknown);
  Eigen::VectorXd machine = Eigen::VectorXd::Zero(rows.cols());
  std::vector<Eigen::Index> sought;
  const auto column = [&](const std::string& name) {
    const auto at = std::ranges::find(turn.errors(), name, &MachineError::name);
    return static_cast<Eigen::Index>(at - turn.errors().begin());
  };
  for (const auto& [name, value] : table["published_deg_mm"]["machining"].items()) {
    machine[column(name)] = value.get<double>() * (name[1] == 'Y' ? 1.0 : kRadPerDeg);
    sought.push_back(column(name));
  }
  const json& squareness = table["published_deg_mm"]["squareness"];
  machine[column("EC0Y")] = -squareness["gamma_YX"].get<double>() * kRadPerDeg;
  machine[column("EA0Z")] = squareness["alpha_ZY"].get<double>() * kRadPerDeg;
  machine[column("EB0Z")] = squareness["beta_ZX"].get<double>() * kRadPerDeg;
  const Eigen::MatrixXd chosen = rows(Eigen::all, sought);
  const Eigen::VectorXd found =
      (chosen.transpose() * chosen).ldlt().solve(chosen.transpose() * (rows * machine));
  const json& predicted = table["predicted"]["ISO line tilt; A -90..90; six tests"];
  for (std::size_t k = 0; k < sought.size(); ++k) {
    const std::string& name = turn.errors()[static_cast<std::size_t>(sought[k])].name;
    const double value = found[static_cast<Eigen::Index>(k)] * (name[1] == 'Y' ? 1.0 : kDegPerRad);
    EXPECT_NEAR(value, predicted[name].get<double>(), name[1] == 'Y' ? 5.1e-6 : 5.1e-5) << name;
  }
}

TEST(Observability, AMachineWithoutRotaryAxesHasThreeSquarenesses) {
  const Machine machine = shipped("three-axis");
  const auto errors = location_unknowns(machine);
  ASSERT_EQ(errors.size(), 3U);
  const auto test =
      circle_test(machine, {.centre = {0.0, 0.0, 150.0}, .angles = midpoints(0.0, kFullTurn, 36)});
  ASSERT_TRUE(test);
  const std::vector<ReadingGains> gains{bar_gains(machine, errors, *test)};
  const Told told = told_by(errors, gains, SpindleBall::unknown);
  EXPECT_THAT(told.told, testing::ElementsAre("EC0Y"));
  EXPECT_THAT(told.not_told, testing::ElementsAre("EA0Z", "EB0Z"));
  EXPECT_EQ(told_by(errors, {}, SpindleBall::known).rank(), 0);
}

}  // namespace
}  // namespace frustum::instruments
