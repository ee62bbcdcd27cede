#include <numbers>

#include "dynamics/jerk_move.hpp"
#include "dynamics/path_response.hpp"
#include "dynamics/time_step.hpp"
#include "kinematics/model/inverse.hpp"
#include "tests/dynamics/machines.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::dynamics {
namespace {

TEST(JerkMoveReference, HasTheMovesOfTwoAxes) {
  const DynamicModel model = model_named("iwf-bc");
  for (const json& wanted : expected()["jerk_move"]) {
    const auto axis = *kinematics::axis_named(wanted["axis"].get<std::string>());
    const JerkMove move = jerk_move(model, positions_of(wanted["axes"]), wanted["tool_length_mm"],
                                    *model.axis(axis), {0.1, 0.5, 4.0, 100.0});
    json breakpoints = json::array(), rows = json::array();
    for (const Breakpoint& b : move.breakpoints) breakpoints.push_back({b.time, b.acceleration});
    for (const auto& row : move.rows) {
      const Vec3 d = row.tip * kUm;
      rows.push_back({row.time, d.x(), d.y(), d.z()});
    }
    expect_near(breakpoints, wanted["breakpoints_s_m_s2"], 1e-12, "breakpoints");
    expect_near(rows, wanted["rows"], 1e-9, "rows");
    expect_near(as_json(Vec3(move.largest * kUm)), wanted["largest_um"], 1e-6, "largest");
    expect_near(as_json(Vec3(move.largest_after * kUm)), wanted["largest_after_the_move_um"], 1e-6,
                "largest after the move");
  }
}

TEST(JerkMove, KeepsItsLimitsAndArrives) {
  for (const double distance : {1e-6, 1e-3, 0.02, 0.1, -1.0}) {
    for (const double jerk : {10.0, 1e3, 1e6}) {
      const MoveLimits limits{distance, 0.5, 4.0, jerk};
      const auto profile = jerk_profile(limits);
      double way = 0.0, speed = 0.0;
      for (std::size_t i = 1; i < profile.size(); ++i) {
        const double t = profile[i].time - profile[i - 1].time;
        const double a = profile[i - 1].acceleration, b = profile[i].acceleration;
        EXPECT_LE(std::abs(b - a), jerk * t * (1 + 1e-9));
        EXPECT_LE(std::abs(b), 4.0 * (1 + 1e-12));
        way += speed * t + t * t * (2.0 * a + b) / 6.0;
        speed += 0.5 * t * (a + b);
        EXPECT_LE(std::abs(speed), 0.5 * (1 + 1e-9));
      }
      EXPECT_NEAR(way, distance, 1e-12);
      EXPECT_NEAR(speed, 0.0, 1e-12);
    }
  }
}

// The quintic move of all five axes that numbers of full rotations exist for.
MotionSample quintic_sample(double time) {
  constexpr double kTime = 0.6;
  const double s = std::min(time / kTime, 1.0), a = s < 1.0 ? 1.0 : 0.0;
  const double way = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  const double speed = a * 30.0 * s * s * (1.0 - s) * (1.0 - s) / kTime;
  const double faster = a * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (kTime * kTime);
  MotionSample sample;
  const auto move = [&](kinematics::AxisLetter axis, double from, double by) {
    sample.position[axis] = from + way * by;
    sample.velocity[axis] = speed * by;
    sample.acceleration[axis] = faster * by;
  };
  move(kinematics::AxisLetter::X, -50.0, 150.0);
  move(kinematics::AxisLetter::Y, -40.0, 80.0);
  move(kinematics::AxisLetter::Z, 350.0, -100.0);
  move(kinematics::AxisLetter::B, 0.0, -60.0 * kRadPerDeg);
  move(kinematics::AxisLetter::C, 0.0, 120.0 * kRadPerDeg);
  return sample;
}

TEST(PathResponseReference, FollowsFullRotationsOfAllFiveAxes) {
  const DynamicModel model = model_named("iwf-bc");
  constexpr double kStep = 5e-4;
  std::vector<MotionSample> samples;
  for (int i = 0; i <= 1400; ++i) samples.push_back(quintic_sample(i * kStep));
  const auto linear = linear_deviations(model, samples, kStep, 150.0);
  const auto quasi = quasi_static_deviations(model, samples, 150.0);
  double off_full = 0.0, off_linear = 0.0, off_quasi = 0.0;
  for (const json& row : expected()["nonlinear"]["rows"]) {
    const auto i = static_cast<std::size_t>(std::lround(row[0].get<double>() / kStep));
    const auto off = [&](const Vec3& found, const json& wanted) {
      return (found * kUm -
              Vec3(wanted[0].get<double>(), wanted[1].get<double>(), wanted[2].get<double>()))
          .cwiseAbs()
          .maxCoeff();
    };
    off_full = std::max(off_full, off(linear[i].tip, row[1]));
    off_linear = std::max(off_linear, off(linear[i].tip, row[2]));
    off_quasi = std::max(off_quasi, off(quasi[i].tip, row[3]));
  }
  EXPECT_LT(off_full, 0.05) << "um against full rotations";
  EXPECT_LT(off_linear, 0.05) << "um against matrices that are renewed each time step";
  EXPECT_LT(off_quasi, 1e-7) << "um";
  std::cout << "linear against full rotations " << off_full << " um, against the linear rows "
            << off_linear << " um, quasi-static " << off_quasi << " um\n";
}

TEST(PathResponseReference, FollowsMoreCloselyTheMoreOftenItRenews) {
  const DynamicModel model = model_named("iwf-bc");
  constexpr double kStep = 5e-4;
  std::vector<MotionSample> samples;
  for (int i = 0; i <= 600; ++i) samples.push_back(quintic_sample(i * kStep));
  const auto often = linear_deviations(model, samples, kStep, 150.0, {0.1, 0.1 * kRadPerDeg});
  double before = 1.0;
  for (const double distance : {8.0, 2.0, 0.5}) {
    const auto found =
        linear_deviations(model, samples, kStep, 150.0, {distance, distance * kRadPerDeg});
    double off = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      off = std::max(off, (found[i].tip - often[i].tip).norm());
    }
    EXPECT_LT(off, before);
    before = off;
  }
}

// In a frozen position the path of samples is the jerk move.
TEST(PathResponseLaws, AShortMoveIsTheMoveInFrozenMatrices) {
  const DynamicModel model = model_named("iwf-bc");
  kinematics::AxisPositions q;
  q[kinematics::AxisLetter::Z] = 300.0;
  const auto axis = *model.axis(kinematics::AxisLetter::X);
  const JerkMove move = jerk_move(model, q, 150.0, axis, {1e-4, 0.5, 4.0, 100.0});
  constexpr double kStep = 1e-4;
  std::vector<MotionSample> samples;
  for (int i = 0; i <= 1000; ++i) {
    MotionSample sample{.position = q};
    const double t = i * kStep;
    for (std::size_t b = 1; b < move.breakpoints.size(); ++b) {
      const Breakpoint &from = move.breakpoints[b - 1], &to = move.breakpoints[b];
      if (t < from.time || t > to.time) continue;
      sample.acceleration[kinematics::AxisLetter::X] =
          1e3 *
          std::lerp(from.acceleration, to.acceleration, (t - from.time) / (to.time - from.time));
    }
    samples.push_back(sample);
  }
  const auto found = linear_deviations(model, samples, kStep, 150.0);
  for (std::size_t r = 0; r < 10; ++r) {
    EXPECT_LT((found[r * 100].tip - move.rows[r].tip).norm(), 2e-4 * move.peak.norm());
  }
}

TEST(TimeStepLaws, SeriesAndMatricesMakeTheSameStep) {
  for (const bool control : {false, true}) {
    const ServoSystem system = servo_system(model_named("iwf-bc", control), {}, 150.0);
    const StateSpace space = state_space(system);
    const Eigen::Index n = space.matrix.rows();
    const Eigen::VectorXd state = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
    const Eigen::VectorXd before = Eigen::VectorXd::LinSpaced(n, 300.0, -500.0);
    const Eigen::VectorXd after = Eigen::VectorXd::LinSpaced(n, 900.0, 100.0);
    for (const double seconds : {1e-5, 5e-4, 2e-3}) {
      const Eigen::VectorXd one = TimeStep(space.matrix, seconds)(state, before, after);
      const Eigen::VectorXd other =
          SeriesStep(space.matrix, system.coordinates(), seconds)(state, before, after);
      // Differences of matrices near one lose digits where the step is short.
      EXPECT_LT((one - other).norm(), 1e-9 * one.norm()) << seconds;
    }
  }
}

TEST(PathResponse, RatesOfAParabolaAreExact) {
  std::vector<kinematics::AxisPositions> positions(100);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    positions[i][kinematics::AxisLetter::X] = 5.0 + 20.0 * t + 300.0 * t * t;
  }
  const auto samples = with_rates(positions, 1e-3);
  EXPECT_NEAR(samples[50].velocity[kinematics::AxisLetter::X], 20.0 + 600.0 * 0.05, 1e-9);
  EXPECT_NEAR(samples[50].acceleration[kinematics::AxisLetter::X], 600.0, 1e-6);
  EXPECT_EQ(samples[50].acceleration[kinematics::AxisLetter::C], 0.0);
}

// The cone of the ETH thesis: half apex angle 45 deg, inclined by 30 deg, radius 40 mm.
struct ConePath {
  const kinematics::Machine machine = kinematics::shipped("iwf-bc");
  const Mat3 tilt = rotation_y(30.0 * kRadPerDeg);

  [[nodiscard]] Vec3 normal(double phi) const {
    return tilt * Vec3(std::cos(phi), std::sin(phi), 1.0).normalized();
  }
  // The solution with B below zero, C counted on with phi.
  [[nodiscard]] kinematics::AxisPositions axes(double phi) const {
    const Vec3 tip =
        Vec3(-65.0, 0.0, 150.0) + tilt * Vec3(std::cos(phi), std::sin(phi), 0.0) * 40.0;
    const auto axis = UnitVec3::of(tilt * Vec3(-std::cos(phi), -std::sin(phi), 1.0));
    const auto all = kinematics::all_solutions(machine, {tip, *axis}, 150.0);
    for (const auto& solution : *all) {
      if (solution.axes[kinematics::AxisLetter::B] > 0.0) continue;
      auto q = solution.axes;
      double& c = q[kinematics::AxisLetter::C];
      c += 2.0 * std::numbers::pi * std::round((phi - c) / (2.0 * std::numbers::pi));
      return q;
    }
    return {};
  }
  // Rates at an even angular speed, by differences that are exact to the eighth order.
  [[nodiscard]] MotionSample sample(double phi, double omega) const {
    constexpr double kStep = 0.02;
    constexpr double kFirst[] = {0.0, 4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
    constexpr double kSecond[] = {-205.0 / 72.0, 8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0};
    MotionSample sample{.position = axes(phi)};
    for (int k = -4; k <= 4; ++k) {
      const auto q = axes(phi + k * kStep);
      const double first = (k < 0 ? -1.0 : 1.0) * kFirst[std::abs(k)] * omega / kStep;
      const double second = kSecond[std::abs(k)] * omega * omega / (kStep * kStep);
      for (const auto letter : kinematics::kAxisLetters) {
        sample.velocity[letter] += first * q[letter];
        sample.acceleration[letter] += second * q[letter];
      }
    }
    return sample;
  }
};

// Peak to valley without mean, first cosine and sine, of values at even angles from 0 on.
double form_of(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const auto phi = [&](std::size_t i) {
    return 2.0 * std::numbers::pi * static_cast<double>(i) / count;
  };
  double mean = 0.0, cosine = 0.0, sine = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean += values[i] / count;
    cosine += 2.0 * values[i] * std::cos(phi(i)) / count;
    sine += 2.0 * values[i] * std::sin(phi(i)) / count;
  }
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double rest = values[i] - mean - cosine * std::cos(phi(i)) - sine * std::sin(phi(i));
    low = std::min(low, rest);
    high = std::max(high, rest);
  }
  return high - low;
}

TEST(ConePathReference, HasTheFormOfFourFeedsWhichGrowsWithTheirSquare) {
  const DynamicModel model = model_named("iwf-bc");
  const ConePath cone;
  double per_square = 0.0;
  for (const json& wanted : expected()["cone"]) {
    const double feed = wanted["feed_mm_min"];
    const double omega = feed / 60.0 / 40.0;
    for (const json& sample : wanted["samples"]) {
      MotionSample given{.position = positions_of(sample["axes"])};
      for (const auto& [letter, rates] : sample["rates_si"].items()) {
        const auto axis = *kinematics::axis_named(letter);
        given.velocity[axis] = rates[0].get<double>() * (is_rotary(axis) ? 1.0 : 1e3);
        given.acceleration[axis] = rates[1].get<double>() * (is_rotary(axis) ? 1.0 : 1e3);
      }
      const Vec3 tip = quasi_static_deviations(model, std::vector{given}, 150.0)[0].tip * kUm;
      expect_near(as_json(tip), sample["tip_in_table_um"], kShare, "tip");
      const double phi = sample["phi_deg"].get<double>() * kRadPerDeg;
      EXPECT_NEAR(tip.dot(cone.normal(phi)), sample["along_normal_um"].get<double>(), 1e-7);
    }
    std::vector<double> along;
    constexpr int kPoints = 360;  // as the numbers have
    for (int i = 0; i < kPoints; ++i) {
      const double phi = 2.0 * std::numbers::pi * i / kPoints;
      const auto d = quasi_static_deviations(model, std::vector{cone.sample(phi, omega)}, 150.0);
      along.push_back(d[0].tip.dot(cone.normal(phi)) * kUm);
    }
    const double form = form_of(along);
    EXPECT_NEAR(form / wanted["form_error_um"].get<double>(), 1.0, 1e-4);
    if (per_square == 0.0) per_square = form / (feed * feed);
    EXPECT_NEAR(form / (feed * feed) / per_square, 1.0, 1e-6);
    std::cout << "form at " << feed << " mm/min: " << form << " um\n";
  }
}

}  // namespace
}  // namespace frustum::dynamics
