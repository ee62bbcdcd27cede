#include "calibration/identify/measured_tests.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/linear_algebra.hpp"
#include "instruments/readings.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::calibration {
namespace {

using instruments::MotionTest;
using instruments::TestPose;
using kinematics::GeometricErrors;
using kinematics::Machine;

using SharedMachine = std::shared_ptr<const Machine>;

Eigen::VectorXd vector_of(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Rows that give the first `wanted` coefficients of a least-squares fit of the columns.
Result<Eigen::MatrixXd> coefficients_of(const Eigen::MatrixXd& columns, Eigen::Index wanted,
                                        const std::string& name) {
  // Below it a coefficient would be a million times as uncertain as a reading.
  constexpr double kSeparates = 1e-6;
  if (columns.rows() < columns.cols() || column_rank(columns, kSeparates) < columns.cols()) {
    return error("arc-too-short"_id,
                 fmt::format("test '{}': its angles do not separate two harmonics", name),
                 "give more angles, over a longer arc");
  }
  const SymmetricFactors normal(columns.transpose() * columns);
  return Eigen::MatrixXd(normal.solve(Eigen::MatrixXd(columns.transpose())).topRows(wanted));
}

// The noise that is stated, or that the residuals show.
void settle_noise(MeasuredMotion& motion, const TestHead& head, const Eigen::MatrixXd& columns) {
  motion.noise = head.noise;
  if (head.noise > 0.0) return;
  const SymmetricFactors normal(columns.transpose() * columns);
  const Eigen::VectorXd fitted =
      columns * normal.solve(Eigen::VectorXd(columns.transpose() * motion.measured));
  motion.noise = effective_noise(motion.measured - fitted, static_cast<int>(columns.cols()));
}

std::vector<Unknown> table_ball_unknowns() {
  return {{.name = "table ball X"}, {.name = "table ball Y"}, {.name = "table ball Z"}};
}

constexpr Eigen::Index kHarmonics = 5;

Eigen::RowVectorXd harmonics_at(double t) {
  Eigen::RowVectorXd row(kHarmonics);
  row << 1.0, std::cos(t), std::sin(t), std::cos(2.0 * t), std::sin(2.0 * t);
  return row;
}

// `columns`: harmonics, then what is fitted beside.
Result<MeasuredMotion> measured_bar(const Machine& machine, const TestHead& head,
                                    const BarRuns& runs, const Eigen::MatrixXd& columns) {
  MeasuredMotion motion{.name = head.name, .ball = head.ball, .tool_length = head.tool_length};
  std::vector<double> measured;
  std::vector<MotionTest> tests;
  for (const BarRun& run : runs) {
    measured.insert(measured.end(), run.readings.begin(), run.readings.end());
    tests.push_back(run.test);
    for (const TestPose& pose : run.test.poses) {
      motion.at.push_back(pose.at);
      motion.along.push_back((pose.spindle_ball - run.test.table_ball).normalized());
    }
  }
  motion.measured = vector_of(measured);
  motion.of_mounting.resize(motion.measured.size(), 4);
  motion.mounting = table_ball_unknowns();
  motion.mounting.push_back({.name = "length"});
  for (Eigen::Index i = 0; i < motion.measured.size(); ++i) {
    motion.of_mounting.row(i) << -motion.along[static_cast<std::size_t>(i)].transpose(), -1.0;
  }
  const auto rows = coefficients_of(columns, kHarmonics, head.name);
  if (!rows) return rows.error();
  motion.rows = *rows;
  settle_noise(motion, head, columns);
  for (const char* name : {"mean", "cos", "sin", "cos2", "sin2"}) {
    motion.names.push_back({fmt::format("{}.{}", head.name, name), head.name, false});
  }
  motion.readings = [on = std::make_shared<const Machine>(machine), tests = std::move(tests),
                     length = head.tool_length](const GeometricErrors& errors, const Vec3& ds,
                                                const Eigen::VectorXd& mounting) {
    const kinematics::ForwardChain actual(*on, errors, length);
    std::vector<double> all;
    for (const MotionTest& test : tests) {
      const auto seen =
          instruments::bar_readings(actual, test, {ds, Vec3(mounting.head<3>()), mounting[3]});
      all.insert(all.end(), seen.begin(), seen.end());
    }
    return vector_of(all);
  };
  return motion;
}

// First-order rows of all readings: where a test has no redundancy of its own, its noise is stated.
Result<MeasuredMotion> measured_turn_of(const Machine& machine, const TestHead& head,
                                        const BarRuns& runs, bool circle) {
  Eigen::Index count = 0;
  for (const BarRun& run : runs) count += static_cast<Eigen::Index>(run.readings.size());
  // Backlash of both axes; servo mismatch where both senses were run.
  const Eigen::Index beside = !circle ? 0 : runs.size() > 1 ? 3 : 2;
  Eigen::MatrixXd columns(count, kHarmonics + beside);
  Eigen::Index i = 0;
  for (const BarRun& run : runs) {
    const double w = sign_of(run.sense);
    for (const TestPose& pose : run.test.poses) {
      const double t = pose.parameter, c = std::cos(t), s = std::sin(t);
      columns.row(i).head(kHarmonics) = harmonics_at(t);
      if (beside > 0) {
        columns(i, kHarmonics) = -w * std::copysign(1.0, s) * c;
        columns(i, kHarmonics + 1) = w * std::copysign(1.0, c) * s;
      }
      if (beside > 2) columns(i, kHarmonics + 2) = w * std::sin(2.0 * t);
      ++i;
    }
  }
  return measured_bar(machine, head, runs, columns);
}

Result<MeasuredMotion> without_noise(const std::string& name) {
  return error("no-uncertainty"_id, fmt::format("test '{}' does not state its noise", name),
               "noise = \"0.3um\" in its table, the standard deviation of a reading");
}

}  // namespace

Result<MeasuredMotion> measured_circle(const Machine& machine, const TestHead& head,
                                       const BarRuns& runs) {
  return measured_turn_of(machine, head, runs, true);
}

Result<MeasuredMotion> measured_turn(const Machine& machine, const TestHead& head,
                                     const BarRuns& runs) {
  return measured_turn_of(machine, head, runs, false);
}

Result<MeasuredMotion> measured_chase(const Machine& machine, const TestHead& head,
                                      const MotionTest& test, std::span<const Vec3> readings) {
  if (!(head.noise > 0.0)) return without_noise(head.name);
  MeasuredMotion motion{
      .name = head.name, .ball = head.ball, .tool_length = head.tool_length, .noise = head.noise};
  const auto count = static_cast<Eigen::Index>(3 * readings.size());
  motion.measured.resize(count);
  motion.of_mounting.resize(count, 3);
  motion.mounting = table_ball_unknowns();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      motion.at.push_back(test.poses[i].at);
      motion.along.push_back(Vec3::Unit(k));
      motion.names.push_back(
          {fmt::format("{} {}.{}", head.name, i + 1, "xyz"[k]), head.name, false});
    }
    const auto row = static_cast<Eigen::Index>(3 * i);
    motion.measured.segment<3>(row) = readings[i];
    motion.of_mounting.middleRows<3>(row) = -Mat3::Identity();
  }
  motion.rows = Eigen::MatrixXd::Identity(count, count);
  motion.readings = [on = std::make_shared<const Machine>(machine), test,
                     length = head.tool_length](const GeometricErrors& errors, const Vec3& ds,
                                                const Eigen::VectorXd& mounting) {
    const kinematics::ForwardChain actual(*on, errors, length);
    Eigen::VectorXd all(static_cast<Eigen::Index>(3 * test.poses.size()));
    Eigen::Index row = 0;
    for (const Vec3& d :
         instruments::displacements(actual, test.poses, {ds, Vec3(mounting), 0.0})) {
      all.segment<3>(row) = d;
      row += 3;
    }
    return all;
  };
  return motion;
}

Result<MeasuredMotion> measured_diagonals(const Machine& machine, const TestHead& head,
                                          std::span<const std::string> names,
                                          std::span<const instruments::LineTest> lines,
                                          const std::vector<std::vector<double>>& readings) {
  if (!(head.noise > 0.0)) return without_noise(head.name);
  MeasuredMotion motion{
      .name = head.name, .ball = head.ball, .tool_length = head.tool_length, .noise = head.noise};
  std::vector<double> measured, lengths;
  std::vector<std::size_t> line_of;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    for (std::size_t i = 0; i < lines[k].poses.size(); ++i) {
      motion.at.push_back(lines[k].poses[i].at);
      motion.along.push_back(lines[k].direction);
      measured.push_back(readings[k][i]);
      lengths.push_back(lines[k].poses[i].parameter);
      line_of.push_back(k);
    }
    motion.names.push_back({fmt::format("{}.{}", head.name, names[k]), head.name, false});
  }
  motion.measured = vector_of(measured);
  const Eigen::Index count = motion.measured.size();
  const auto diagonals = static_cast<Eigen::Index>(lines.size());
  // Slopes over the whole length, then zeros.
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(count, 2 * diagonals);
  motion.of_mounting = Eigen::MatrixXd::Zero(count, diagonals + 1);
  for (const std::string& name : names) motion.mounting.push_back({.name = "zero of " + name});
  // A ratio, which is shown as um per m.
  motion.mounting.push_back({.name = "scale", .angular = true});
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<Eigen::Index>(line_of[static_cast<std::size_t>(i)]);
    const double length = lengths[static_cast<std::size_t>(i)];
    columns(i, k) = length / lines[static_cast<std::size_t>(k)].poses.back().parameter;
    columns(i, diagonals + k) = 1.0;
    motion.of_mounting(i, k) = 1.0;
    motion.of_mounting(i, diagonals) = length;
  }
  const auto rows = coefficients_of(columns, diagonals, head.name);
  if (!rows) return rows.error();
  motion.rows = *rows;
  motion.readings = [on = std::make_shared<const Machine>(machine),
                     all_lines = std::vector(lines.begin(), lines.end()),
                     of_mounting = motion.of_mounting,
                     length = head.tool_length](const GeometricErrors& errors, const Vec3& ds,
                                                const Eigen::VectorXd& mounting) {
    const kinematics::ForwardChain actual(*on, errors, length);
    std::vector<double> all;
    for (const auto& line : all_lines) {
      const auto seen = instruments::line_readings(actual, line, {.ball = ds});
      all.insert(all.end(), seen.begin(), seen.end());
    }
    return Eigen::VectorXd(vector_of(all) + of_mounting * mounting);
  };
  return motion;
}

Result<MeasuredMotion> measured_touches(const Machine& machine, const TestHead& head,
                                        const instruments::TouchPlan& plan,
                                        const instruments::TouchProbe& probe,
                                        std::span<const double> readings) {
  if (!(head.noise > 0.0)) return without_noise(head.name);
  auto poses = touch_poses(machine, {}, plan, probe);
  if (!poses) return poses.error();
  MeasuredMotion motion{
      .name = head.name, .ball = head.ball, .tool_length = probe.tool_length, .noise = head.noise};
  const auto count = static_cast<Eigen::Index>(readings.size());
  motion.measured = vector_of(readings);
  motion.of_mounting.resize(count, 6);
  for (const char* name : {"X", "Y", "Z"}) {
    motion.mounting.push_back({.name = fmt::format("artefact {}", name)});
  }
  for (const char* name : {"A", "B", "C"}) {
    motion.mounting.push_back({.name = fmt::format("artefact {}", name), .angular = true});
  }
  const auto turns = static_cast<Eigen::Index>(plan.turns.size());
  const Eigen::Index places = static_cast<Eigen::Index>(plan.tilts.size()) * turns;
  // Where the table is meant to be, its six errors shift the surfaces along their normals.
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(count, 6 * places);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& touch = plan.touches[static_cast<std::size_t>(i)];
    const instruments::TouchPoint& point = instruments::touch_points().at(touch.point);
    motion.at.push_back((*poses)[static_cast<std::size_t>(i)].at);
    motion.along.emplace_back(-point.normal);
    Eigen::Matrix<double, 1, 6> by_table;
    by_table << point.normal.transpose(), point.place.cross(point.normal).transpose();
    motion.of_mounting.row(i) = by_table;
    const Eigen::Index place =
        static_cast<Eigen::Index>(touch.tilt) * turns + static_cast<Eigen::Index>(touch.turn);
    columns.row(i).segment<6>(6 * place) = by_table;
  }
  const auto rows = coefficients_of(columns, columns.cols(), head.name);
  if (!rows) return rows.error();
  motion.rows = *rows;
  for (const auto& tilt : plan.tilts) {
    for (const auto& turn : plan.turns) {
      for (const char component : {'x', 'y', 'z', 'a', 'b', 'c'}) {
        motion.names.push_back({fmt::format("{} A{:g} C{:g}.{}", head.name, tilt.axis * kDegPerRad,
                                            turn.axis * kDegPerRad, component),
                                head.name, component < 'x'});
      }
    }
  }
  motion.readings = [on = std::make_shared<const Machine>(machine), plan, probe,
                     poses = *std::move(poses)](const GeometricErrors& errors, const Vec3& ds,
                                                const Eigen::VectorXd& mounting) {
    const auto seen =
        touch_readings(*on, errors, plan, poses, probe,
                       {.ball = ds, .shift = mounting.head<3>(), .tilt = mounting.tail<3>()});
    if (seen) return vector_of(*seen);
    // Errors beyond what a probe reaches, which the refinement reports.
    return Eigen::VectorXd(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(poses.size()),
                                                     std::numeric_limits<double>::quiet_NaN()));
  };
  return motion;
}

}  // namespace frustum::calibration
