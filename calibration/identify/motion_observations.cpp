#include "calibration/identify/motion_observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/linear_algebra.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

// Below this part of the largest, what a mounting does to a row is rounding.
constexpr double kNothing = 1e-9;

Eigen::Index count_of(std::size_t n) { return static_cast<Eigen::Index>(n); }

// Combinations of rows that the mounting of a test cannot make: each is one row of factor
// 1, `named`, and shares of rows that the mounting takes.
struct Kept {
  Eigen::MatrixXd factors{};
  std::vector<Eigen::Index> named{};
};

Kept without_mounting(const MeasuredMotion& motion) {
  Eigen::MatrixXd m = motion.rows * motion.of_mounting;
  const Eigen::Index rows = m.rows();
  // In the size of what each unknown does to the readings, so that rounding stays rounding, also
  // where an unknown does nothing; levers are at most a thousand times as large as shifts.
  const double readings = std::sqrt(static_cast<double>(motion.of_mounting.rows()));
  const double largest_size =
      m.cols() > 0 ? motion.of_mounting.colwise().norm().maxCoeff() / readings : 0.0;
  for (Eigen::Index k = 0; k < m.cols(); ++k) {
    const double size = motion.of_mounting.col(k).norm() / readings;
    if (largest_size > 0.0) m.col(k) /= std::max(size, 1e-3 * largest_size);
  }
  Kept kept{.factors = Eigen::MatrixXd::Identity(rows, rows)};
  for (Eigen::Index i = 0; i < rows; ++i) kept.named.push_back(i);
  for (Eigen::Index k = 0; k < m.cols(); ++k) {
    double largest = 0.0;
    for (const Eigen::Index i : kept.named) largest = std::max(largest, std::abs(m(i, k)));
    if (largest < kNothing) continue;
    // The first row with a good share of the column is taken; harmonics of low order come first.
    const auto taken = std::ranges::find_if(
        kept.named, [&](Eigen::Index i) { return std::abs(m(i, k)) > 0.3 * largest; });
    const Eigen::Index pivot = *taken;
    kept.named.erase(taken);
    for (const Eigen::Index i : kept.named) {
      if (m(i, k) == 0.0) continue;
      const double factor = m(i, k) / m(pivot, k);
      m.row(i) -= factor * m.row(pivot);
      kept.factors.row(i) -= factor * kept.factors.row(pivot);
    }
  }
  kept.factors = Eigen::MatrixXd(kept.factors(kept.named, Eigen::all));
  return kept;
}

// One test, ready to be asked.
struct Condensed {
  MeasuredMotion motion{};
  Eigen::Index ball = -1;       // column of its ds among the unknowns
  Eigen::MatrixXd estimator{};  // of the mounting, by readings; none: no columns
  Eigen::VectorXd mounting{};   // of a perfect machine: where the search for others begins
  Eigen::MatrixXd rows{};       // without the mounting: rows x readings
  std::vector<Row> names{};
};

constexpr double kSeen = 1e-12;  // of the largest: a millionth of its effect

// Directions of the mounting that change no reading to first order, as columns.
Eigen::MatrixXd unseen_directions(const Eigen::MatrixXd& of_mounting) {
  const SymmetricEigen normal = symmetric_eigen(of_mounting.transpose() * of_mounting);
  const double least = kSeen * normal.values.cwiseAbs().maxCoeff();
  Eigen::Index unseen = 0;
  while (unseen < normal.values.size() && !(normal.values[unseen] > least)) ++unseen;
  return normal.vectors.leftCols(unseen);
}

// What readings say of the mounting, to first order: the shortest answer of least squares.
Eigen::MatrixXd mounting_estimator(const Eigen::MatrixXd& of_mounting) {
  const Eigen::MatrixXd transposed = of_mounting.transpose();
  const SymmetricEigen normal = symmetric_eigen(transposed * of_mounting);
  const double least = kSeen * normal.values.cwiseAbs().maxCoeff();
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(normal.values.size());
  for (Eigen::Index k = 0; k < inverse.size(); ++k) {
    if (normal.values[k] > least) inverse[k] = 1.0 / normal.values[k];
  }
  return normal.vectors * inverse.asDiagonal() * normal.vectors.transpose() * transposed;
}

Eigen::VectorXd refined_mounting(const MeasuredMotion& motion, const Eigen::MatrixXd& estimator,
                                 const GeometricErrors& errors, const Vec3& ds, int rounds,
                                 Eigen::VectorXd s) {
  for (int i = 0; i < rounds; ++i) {
    s += estimator * (motion.measured - motion.readings(errors, ds, s));
  }
  return s;
}

Result<Condensed> condensed(const MeasuredMotion& motion) {
  if (motion.measured.size() == 0 || motion.rows.rows() == 0) {
    return error("nothing-measured"_id, fmt::format("test '{}' has no readings", motion.name));
  }
  if (!(motion.noise > 0.0)) {
    return error(
        "no-uncertainty"_id,
        fmt::format("test '{}' has readings without noise, which would outweigh all others",
                    motion.name),
        "state noise = \"0.3um\", the standard deviation of a reading");
  }
  Condensed test{.motion = motion, .mounting = mounting_with(motion, motion.base, Vec3::Zero())};
  if (test.mounting.size() > 0) test.estimator = mounting_estimator(motion.of_mounting);
  const Kept kept = without_mounting(motion);
  if (kept.named.empty()) {
    return error("nothing-measured"_id,
                 fmt::format("test '{}': its mounting can make all that it reads", motion.name),
                 "measure at more poses");
  }
  test.rows = kept.factors * motion.rows;
  for (const Eigen::Index i : kept.named) {
    test.names.push_back(motion.names[static_cast<std::size_t>(i)]);
  }
  return test;
}

Eigen::MatrixXd gain_of(const Machine& machine, const Condensed& test,
                        const std::vector<Cause>& causes, Eigen::Index unknowns) {
  const auto readings = count_of(test.motion.at.size());
  Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(readings, unknowns);
  for (Eigen::Index i = 0; i < readings; ++i) {
    const auto& at = test.motion.at[static_cast<std::size_t>(i)];
    const Vec3& along = test.motion.along[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < causes.size(); ++k) {
      const auto& unit = causes[k].parameter.unit;
      if (!unit) continue;
      gain(i, count_of(k)) =
          along.dot(first_order_displacement(machine, *unit, at, test.motion.tool_length).tip);
    }
    if (test.ball >= 0) {
      gain.row(i).segment<3>(test.ball) =
          along.transpose() * nominal_pose(machine, at.q, test.motion.tool_length).rotation;
    }
  }
  return test.rows * gain;
}

GeometricErrors errors_with(const GeometricErrors& base, const std::vector<Cause>& causes,
                            const Eigen::VectorXd& x) {
  GeometricErrors errors = base;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    if (causes[k].parameter.unit) {
      errors = errors.plus(*causes[k].parameter.unit, x[count_of(k)]);
    }
  }
  return errors;
}

// Column of the ball of a test among the unknowns; -1: it has none.
Eigen::Index ball_column(const MeasuredMotion& motion, const std::vector<Unknown>& unknowns,
                         std::size_t after) {
  if (motion.ball.empty()) return -1;
  for (std::size_t k = after; k < unknowns.size(); ++k) {
    if (unknowns[k].name == motion.ball + " X") return count_of(k);
  }
  return -1;
}

Vec3 ball_at_column(Eigen::Index column, const Eigen::VectorXd& x) {
  return column < 0 ? Vec3(Vec3::Zero()) : Vec3(x.segment<3>(column));
}

Eigen::VectorXd values_of(const Condensed& test, const std::vector<Cause>& causes,
                          const Eigen::VectorXd& x) {
  const GeometricErrors errors = errors_with(test.motion.base, causes, x);
  const Vec3 ds = ball_at_column(test.ball, x);
  if (test.mounting.size() == 0) return test.rows * test.motion.readings(errors, ds, test.mounting);
  // Errors of micrometres move the mounting by as much: one round leaves what is of third order.
  constexpr int kRounds = 2;
  const Eigen::VectorXd s =
      refined_mounting(test.motion, test.estimator, errors, ds, kRounds, test.mounting);
  return test.rows * test.motion.readings(errors, ds, s);
}

}  // namespace

Eigen::VectorXd mounting_with(const MeasuredMotion& motion, const GeometricErrors& errors,
                              const Vec3& ds, int rounds) {
  Eigen::VectorXd s = Eigen::VectorXd::Zero(motion.of_mounting.cols());
  if (s.size() == 0) return s;
  return refined_mounting(motion, mounting_estimator(motion.of_mounting), errors, ds, rounds,
                          std::move(s));
}

std::vector<Unknown> ball_unknowns(const std::vector<MeasuredMotion>& motions) {
  std::vector<Unknown> unknowns;
  std::vector<std::string> known;
  for (const MeasuredMotion& motion : motions) {
    if (motion.ball.empty() || std::ranges::find(known, motion.ball) != known.end()) continue;
    known.push_back(motion.ball);
    std::optional<Prior> prior;
    for (const MeasuredMotion& each : motions) {
      if (each.ball == motion.ball && each.ball_known_to && !prior) {
        prior = Prior{0.0, *each.ball_known_to};
      }
    }
    for (const char* axis : {"X", "Y", "Z"}) {
      unknowns.push_back({.name = fmt::format("{} {}", motion.ball, axis), .prior = prior});
    }
  }
  return unknowns;
}

Result<Eigen::MatrixXd> unseen_mounting_covariance(const std::vector<MeasuredMotion>& motions,
                                                   const std::vector<Unknown>& unknowns,
                                                   const std::vector<Cause>& causes,
                                                   const Eigen::VectorXd& values, double size) {
  Eigen::MatrixXd covariance;
  for (const MeasuredMotion& motion : motions) {
    const auto test = condensed(motion);
    if (!test) return test.error();
    const Eigen::Index before = covariance.rows(), own = test->rows.rows();
    covariance.conservativeResize(before + own, before + own);
    covariance.rightCols(own).setZero();
    covariance.bottomRows(own).setZero();
    if (test->mounting.size() == 0) continue;
    const GeometricErrors errors = errors_with(motion.base, causes, values);
    const Vec3 ds = ball_at_column(ball_column(motion, unknowns, causes.size()), values);
    const Eigen::VectorXd s = mounting_with(motion, errors, ds);
    const Eigen::MatrixXd unseen = unseen_directions(motion.of_mounting);
    for (Eigen::Index k = 0; k < unseen.cols(); ++k) {
      const Eigen::VectorXd step = size * unseen.col(k);
      const Eigen::VectorXd shown =
          0.5 * test->rows *
          (motion.readings(errors, ds, s + step) - motion.readings(errors, ds, s - step));
      covariance.bottomRightCorner(own, own) += shown * shown.transpose();
    }
  }
  return covariance;
}

std::vector<FoundMounting> found_mountings(const std::vector<MeasuredMotion>& motions,
                                           const std::vector<Unknown>& unknowns,
                                           const std::vector<Cause>& causes,
                                           const Eigen::VectorXd& values) {
  std::vector<FoundMounting> found;
  for (const MeasuredMotion& motion : motions) {
    const Vec3 ds = ball_at_column(ball_column(motion, unknowns, causes.size()), values);
    found.push_back({motion.name, motion.mounting,
                     mounting_with(motion, errors_with(motion.base, causes, values), ds)});
  }
  return found;
}

Result<MotionObservations> observations_of(const Machine& machine,
                                           const std::vector<MeasuredMotion>& motions,
                                           std::vector<Unknown> unknowns,
                                           const std::vector<Cause>& causes) {
  const auto columns = count_of(unknowns.size());
  auto tests = std::make_shared<std::vector<Condensed>>();
  Eigen::Index rows = 0;
  for (const MeasuredMotion& motion : motions) {
    auto test = condensed(motion);
    if (!test) return test.error();
    test->ball = ball_column(motion, unknowns, causes.size());
    rows += test->rows.rows();
    tests->push_back(*std::move(test));
  }
  // The gains hardly change with errors of micrometres: those at zero serve every round.
  Eigen::MatrixXd gain(rows, columns);
  MotionObservations found;
  Observations& o = found.observations;
  o.unknowns = std::move(unknowns);
  o.values.resize(rows);
  o.covariance = Eigen::MatrixXd::Zero(rows, rows);
  found.without_unknowns.resize(rows);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(columns);
  Eigen::Index row = 0;
  for (const Condensed& test : *tests) {
    const Eigen::Index own = test.rows.rows();
    o.rows.insert(o.rows.end(), test.names.begin(), test.names.end());
    gain.middleRows(row, own) = gain_of(machine, test, causes, columns);
    o.values.segment(row, own) = test.rows * test.motion.measured;
    found.without_unknowns.segment(row, own) = values_of(test, causes, zero);
    o.covariance.block(row, row, own, own) =
        test.motion.noise * test.motion.noise * test.rows * test.rows.transpose();
    row += own;
  }
  o.gain = gain;
  found.model = [tests, causes, gain](const Eigen::VectorXd& x) -> Result<Prediction> {
    Prediction prediction{Eigen::VectorXd(gain.rows()), gain};
    Eigen::Index at = 0;
    for (const Condensed& test : *tests) {
      prediction.values.segment(at, test.rows.rows()) = values_of(test, causes, x);
      at += test.rows.rows();
    }
    return prediction;
  };
  return found;
}

double effective_noise(const Eigen::VectorXd& residuals, int parameters) {
  const Eigen::Index n = residuals.size();
  const double squares = residuals.squaredNorm();
  if (n <= parameters || squares == 0.0) return 0.0;
  double sum = 1.0;
  for (Eigen::Index lag = 1; lag < n / 2; ++lag) {
    const double correlation = residuals.head(n - lag).dot(residuals.tail(n - lag)) / squares;
    if (correlation <= 0.0) break;
    sum += 2.0 * correlation;
  }
  return std::sqrt(sum * squares / static_cast<double>(n - parameters));
}

}  // namespace frustum::calibration
