// One machine, every instrument: nine bars, an R-test, a touch probe, step patterns and cone bars
// identify the same errors within their uncertainty, and together they know them better.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "calibration/identify/distributions.hpp"
#include "calibration/identify/joint_observations.hpp"
#include "calibration/identify/measured_tests.hpp"
#include "core/random.hpp"
#include "instruments/chase_test.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/instrument.hpp"
#include "instruments/readings.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/sample_angles.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "programs/step/step_pattern.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/law_count.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

using kinematics::AxisLetter;
using kinematics::GeometricErrors;
using kinematics::Machine;

constexpr int kMeasuredMachines = 10;
constexpr int kFewMeasuredMachines = 2;  // of `make test`
constexpr double kNoise = 0.3e-3;        // mm, of bars and R-test
constexpr double kTouchNoise = 0.175e-3;
constexpr std::uint64_t kInstrumentSeed = 20;

constexpr std::array kErrorNames{"alpha_AY", "beta_AY",  "gamma_AY", "beta_CA",
                                 "dx_AY",    "dy_AY",    "dz_AY",    "dy_CA",
                                 "gamma_YX", "alpha_ZY", "beta_ZX",  "tool_radius_error"};
constexpr std::size_t kMachineErrors = 11;

bool is_angular(std::size_t k) { return k < 4 || (k >= 8 && k < kMachineErrors); }

// What is wrong with machine `number`, and how its instruments are mounted.
class WrongMachine {
 public:
  WrongMachine(const Machine& machine, int number) : number_(number), truth_(12) {
    for (std::size_t k = 0; k < kErrorNames.size(); ++k) {
      const double size = is_angular(k) ? 30e-6 : 10e-3;
      truth_[static_cast<Eigen::Index>(k)] = size * draw();
      if (k < kMachineErrors) {
        const auto unit = trials::Parameter::named(machine, kErrorNames.at(k));
        errors_ = errors_.plus(*unit->unit, truth_[static_cast<Eigen::Index>(k)]);
      }
    }
    bar_ball_ = vector(20e-3);
    nest_ = vector(20e-3);
    probe_ = vector(5e-3);
  }
  double draw() {
    return normal({.seed = kInstrumentSeed, .draw = static_cast<std::uint32_t>(number_)}, next_++);
  }
  Vec3 vector(double size) { return size * Vec3(draw(), draw(), draw()); }

  [[nodiscard]] const GeometricErrors& errors() const { return errors_; }
  [[nodiscard]] const Eigen::VectorXd& truth() const { return truth_; }
  [[nodiscard]] const Vec3& bar_ball() const { return bar_ball_; }
  [[nodiscard]] const Vec3& nest() const { return nest_; }
  [[nodiscard]] const Vec3& probe() const { return probe_; }
  [[nodiscard]] instruments::Instrument instrument(double noise) {
    return {.noise = noise, .seed = 1000 + static_cast<std::uint64_t>(number_)};
  }
  // Each test its own noise.
  [[nodiscard]] std::uint32_t next_trace() { return traces_++; }

 private:
  int number_;
  std::uint64_t next_ = 0;
  std::uint32_t traces_ = 0;
  Eigen::VectorXd truth_;
  GeometricErrors errors_{};
  Vec3 bar_ball_, nest_, probe_;
};

std::vector<double> bar_of(const Machine& machine, WrongMachine& wrong,
                           const instruments::MotionTest& test,
                           const instruments::SetupErrors& mounted) {
  const kinematics::ForwardChain actual(machine, wrong.errors(), test.tool_length);
  return shown(wrong.instrument(kNoise), bar_readings(actual, test, mounted), wrong.next_trace());
}

MeasuredMotion turned_bar(const Machine& machine, WrongMachine& wrong, const std::string& name,
                          const instruments::MotionTest& test) {
  const instruments::SetupErrors mounted{wrong.bar_ball(), wrong.vector(30e-3),
                                         2e-3 * wrong.draw()};
  const TestHead head{.name = name, .ball = "bar ball", .noise = kNoise};
  auto measured = measured_turn(
      machine, head, {{instruments::Sense::ccw, test, bar_of(machine, wrong, test, mounted)}});
  EXPECT_TRUE(measured) << name;
  return *std::move(measured);
}

std::vector<MeasuredMotion> nine_bars(const Machine& machine, WrongMachine& wrong) {
  std::vector<MeasuredMotion> tests;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (const instruments::Plane plane : instruments::kPlanes) {
    const instruments::SetupErrors mounted{wrong.bar_ball(), wrong.vector(30e-3),
                                           2e-3 * wrong.draw()};
    BarRuns runs;
    for (const instruments::Sense sense : instruments::kSenses) {
      const auto test =
          instruments::circle_test(machine, {.plane = plane,
                                             .sense = sense,
                                             .centre = {0, 0, 150},
                                             .angles = instruments::midpoints(0.0, kTurn, 360)});
      EXPECT_TRUE(test);
      runs.push_back({sense, *test, bar_of(machine, wrong, *test, mounted)});
    }
    const TestHead head{.name = std::string(name_of(plane)), .ball = "bar ball", .noise = kNoise};
    tests.push_back(*measured_circle(machine, head, runs));
  }
  for (const AxisLetter axis : {AxisLetter::C, AxisLetter::A}) {
    const double reach = axis == AxisLetter::C ? kTurn / 2 : kTurn / 4;
    for (const instruments::BarDirection direction : instruments::kBarDirections) {
      const auto test = instruments::rotary_test(
          machine, {.axis = axis,
                    .direction = direction,
                    .table_ball = {60, 80, 40},
                    .length = 100.0,
                    .angles = instruments::midpoints(-reach + 0.05, reach - 0.05, 360)});
      EXPECT_TRUE(test) << to_string(test.error().front());
      tests.push_back(turned_bar(machine, wrong,
                                 fmt::format("{} {}", to_char(axis), name_of(direction)), *test));
    }
  }
  return tests;
}

std::vector<MeasuredMotion> cone_bars(const Machine& machine, WrongMachine& wrong) {
  std::vector<MeasuredMotion> tests;
  for (const auto sense : {instruments::ConeSense::normal, instruments::ConeSense::radial}) {
    const auto test = instruments::cone_test(
        machine, {.cone_angle = std::numbers::pi / 6,
                  .inclination = std::numbers::pi / 9,
                  .radius = 60.0,
                  .centre = {0, 0, 100},
                  .sense = sense,
                  .angles = instruments::midpoints(0.0, 2.0 * std::numbers::pi, 360)});
    EXPECT_TRUE(test) << to_string(test.error().front());
    tests.push_back(turned_bar(machine, wrong, "cone " + std::string(name_of(sense)), *test));
  }
  return tests;
}

std::vector<MeasuredMotion> r_test(const Machine& machine, WrongMachine& wrong) {
  instruments::ChaseTest chase{.table_ball = {80, 30, 60}};
  for (const double a : {-80.0, -60.0, -40.0, -20.0, 0.0, 20.0, 40.0}) {
    for (int c = 0; c < 12; ++c) {
      kinematics::AxisPositions q;
      q[AxisLetter::A] = a * kRadPerDeg;
      q[AxisLetter::C] = (30.0 * c - 165.0) * kRadPerDeg;
      chase.rotary.push_back(q);
    }
  }
  const auto test = instruments::chase_test(machine, chase);
  EXPECT_TRUE(test) << to_string(test.error().front());
  const kinematics::ForwardChain actual(machine, wrong.errors(), 0.0);
  const auto readings =
      shown(wrong.instrument(kNoise),
            displacements(actual, test->poses, {wrong.nest(), wrong.vector(30e-3), 0.0}),
            wrong.next_trace());
  return {
      *measured_chase(machine, {.name = "R", .ball = "nest", .noise = kNoise}, *test, readings)};
}

std::vector<MeasuredMotion> touches(const Machine& machine, WrongMachine& wrong) {
  const auto plan = instruments::touch_plan(machine);
  EXPECT_TRUE(plan);
  const instruments::TouchProbe probe;
  const auto poses = touch_poses(machine, wrong.errors(), *plan, probe);
  const auto exact = touch_readings(
      machine, wrong.errors(), *plan, *poses, probe,
      {.ball = wrong.probe(), .shift = wrong.vector(50e-3), .tilt = wrong.vector(100e-6)});
  EXPECT_TRUE(exact);
  const auto readings = shown(wrong.instrument(kTouchNoise), *exact, wrong.next_trace());
  return {*measured_touches(machine, {.name = "touch", .ball = "probe", .noise = kTouchNoise},
                            *plan, probe, readings)};
}

std::vector<Unknown> machine_unknowns() {
  std::vector<Unknown> unknowns;
  for (std::size_t k = 0; k < kErrorNames.size(); ++k) {
    unknowns.push_back({.name = kErrorNames.at(k), .angular = is_angular(k)});
  }
  return unknowns;
}

std::vector<Cause> causes_on_machine(const Machine& machine) {
  std::vector<Cause> causes;
  for (const char* name : kErrorNames) {
    causes.push_back({*trials::Parameter::named(machine, name), std::nullopt});
  }
  return causes;
}

// All step patterns, cut and measured, linear about the machine that cut them.
PieceObservations steps(const Machine& machine, WrongMachine& wrong, int number) {
  metrology::CmmModel cmm;
  cmm.e0_mm = 0.5e-3;
  cmm.length_per_error = 600.0;
  cmm.seed = kInstrumentSeed;
  std::vector<MeasuredPiece> pieces;
  for (const auto& [workpiece, patterns] :
       {std::pair<int, std::vector<std::string>>{1, {}}, {2, {}}, {2, {"4"}}}) {
    programs::StepTest test;
    test.workpiece = *programs::step_workpiece(workpiece);
    test.patterns = patterns;
    programs::TestPiece piece = programs::step_pattern(test, machine)->piece;
    programs::TestPiece cut = piece;
    for (auto& [tool, spec] : cut.tools) spec.radius_error.value = wrong.truth()[11];
    trials::TrialOptions options;
    options.find_collisions = false;
    cmm.draw = static_cast<std::uint32_t>(3 * number) + static_cast<std::uint32_t>(pieces.size());
    const auto trial = trials::run_trial(machine, wrong.errors(), cut, cmm, options);
    EXPECT_TRUE(trial);
    MeasuredPart part;
    for (const auto& c : trial->measurement.characteristics) {
      part.emplace(c.name, MeasuredValue{metrology::internal_value(c), {}});
    }
    MeasuredPiece measured;
    measured.name = fmt::format("workpiece {}", pieces.size() + 1);
    measured.piece = std::move(piece);
    measured.parts = {std::move(part)};
    measured.cmm = cmm;
    pieces.push_back(std::move(measured));
  }
  auto found = observations_of(machine, pieces, machine_unknowns(), causes_on_machine(machine));
  EXPECT_TRUE(found);
  const Eigen::VectorXd& x0 = wrong.truth();
  const Prediction at = *found->model(x0);
  found->model = [x0 = Eigen::VectorXd(x0), at](const Eigen::VectorXd& x) -> Result<Prediction> {
    return Prediction{at.values + at.gain * (x - x0), at.gain};
  };
  return *std::move(found);
}

struct Measured {
  std::string name{};
  std::vector<MeasuredMotion> motions{};
  std::optional<PieceObservations> pieces{};
};

Identification identified(const Machine& machine, const std::vector<const Measured*>& together) {
  std::vector<MeasuredMotion> motions;
  PieceObservations pieces;
  for (const Measured* each : together) {
    motions.insert(motions.end(), each->motions.begin(), each->motions.end());
    if (each->pieces) pieces = *each->pieces;
  }
  std::vector<Unknown> unknowns = machine_unknowns();
  const auto balls = ball_unknowns(motions);
  unknowns.insert(unknowns.end(), balls.begin(), balls.end());
  MotionObservations of_motions;
  if (!motions.empty()) {
    auto found = observations_of(machine, motions, unknowns, causes_on_machine(machine));
    EXPECT_TRUE(found) << to_string(found.error().front());
    of_motions = *std::move(found);
  }
  const auto joint = joint_observations(std::move(pieces), std::move(of_motions));
  auto refined = refine(joint.observations, joint.model);
  EXPECT_TRUE(refined) << to_string(refined.error().front());
  return refined->identification;
}

TEST(EveryInstrumentLaws, PairsAgreeAndTogetherTheyKnowMore) {
  const Machine machine = kinematics::shipped("zx-yac");
  double difference = 0.0, chi_square = 0.0;
  int freedom = 0, own_freedom = 0, covered = 0, intervals = 0;
  const int machines = proof::law_count(kMeasuredMachines, kFewMeasuredMachines);
  for (int number = 0; number < machines; ++number) {
    WrongMachine wrong(machine, number);
    std::vector<Measured> all{{"nine bars", nine_bars(machine, wrong), {}},
                              {"R-test", r_test(machine, wrong), {}},
                              {"touch probe", touches(machine, wrong), {}},
                              {"cone bars", cone_bars(machine, wrong), {}}};
    all.push_back({"step patterns", {}, steps(machine, wrong, number)});
    std::vector<Identification> alone;
    std::vector<const Measured*> every;
    for (const Measured& each : all) {
      every.push_back(&each);
      alone.push_back(identified(machine, {&each}));
      const Agreement& agreement = alone.back().agreement;
      EXPECT_FALSE(agreement.degrees_of_freedom > 0 && *agreement.probability < 1e-5)
          << each.name << " on machine " << number << ": " << agreement.chi_square << " with "
          << agreement.degrees_of_freedom;
      chi_square += agreement.chi_square;
      own_freedom += agreement.degrees_of_freedom;
    }
    // What two know of the same errors differs by no more than both uncertainties leave: their
    // joint chi-square exceeds those of each by one for each thing that both know.
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        const Identification both = identified(machine, {&all[a], &all[b]});
        const int common = both.agreement.degrees_of_freedom -
                           alone[a].agreement.degrees_of_freedom -
                           alone[b].agreement.degrees_of_freedom;
        const double more = both.agreement.chi_square - alone[a].agreement.chi_square -
                            alone[b].agreement.chi_square;
        EXPECT_GT(common, 0) << all[a].name << " and " << all[b].name;
        if (common <= 0) continue;
        EXPECT_GT(chi_square_tail(more, common), 1e-5)
            << all[a].name << " and " << all[b].name << " on machine " << number << ": " << more
            << " with " << common;
        difference += more;
        freedom += common;
      }
    }
    const Identification joint = identified(machine, every);
    for (std::size_t k = 0; k < kErrorNames.size(); ++k) {
      const Estimate& best = joint.estimates[k];
      ASSERT_TRUE(best.value) << best.name;
      for (std::size_t i = 0; i < alone.size(); ++i) {
        const Estimate& own = alone[i].estimates[k];
        if (!own.value) continue;
        EXPECT_LE(*best.standard_uncertainty, *own.standard_uncertainty * (1.0 + 1e-9))
            << best.name << ", " << all[i].name;
      }
      ++intervals;
      const double truth = wrong.truth()[static_cast<Eigen::Index>(k)];
      if (truth >= *best.lower && truth <= *best.upper) ++covered;
    }
  }
  RecordProperty("difference", fmt::format("{:.1f} with {}", difference, freedom));
  RecordProperty("alone", fmt::format("{:.1f} with {}", chi_square, own_freedom));
  RecordProperty("covered", fmt::format("{} of {}", covered, intervals));
  // Within four standard deviations of chi-square; pairs of a machine share their noise, so that
  // their sum scatters by twice as much.
  EXPECT_LT(std::abs(chi_square - own_freedom), 4.0 * std::sqrt(2.0 * own_freedom));
  EXPECT_LT(std::abs(difference - freedom), 8.0 * std::sqrt(2.0 * freedom));
  EXPECT_GE(covered, 0.95 * intervals - 4.0 * std::sqrt(0.0475 * intervals));
}

}  // namespace
}  // namespace frustum::calibration
