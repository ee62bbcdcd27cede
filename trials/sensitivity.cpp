#include "trials/sensitivity.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <vector>

#include "metrology/characteristic/characteristic.hpp"
#include "metrology/cmm.hpp"
#include "trials/surface_gain.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;
using programs::TestPiece;

double step_of(const Parameter& parameter, const DifferenceSteps& steps) {
  return parameter.angular ? steps.angle : steps.length;
}

TrialOptions quiet(TrialOptions options) {
  options.find_collisions = false;
  options.measure = true;
  options.on_stage = {};
  return options;
}

// Characteristics of the measured part when every point moves along its normal.
class MovedPoints {
 public:
  MovedPoints(const TestPiece& piece, const metrology::Measurement& measurement)
      : piece_(piece), measurement_(measurement) {}

  [[nodiscard]] Result<Eigen::VectorXd> characteristics(const Eigen::VectorXd& moves) const {
    std::vector<metrology::FeaturePoints> features;
    Eigen::Index row = 0;
    for (const auto& feature : measurement_.features) {
      metrology::FeaturePoints points{feature.name, {}, {}};
      for (const metrology::MeasuredPoint& p : feature.points) {
        const Vec3 moved = p.point + moves[row++] * p.normal;
        points.points.push_back(measurement_.workpiece_from_datum.point(moved));
        points.sections.push_back(p.section);
      }
      features.push_back(std::move(points));
    }
    const auto evaluated = metrology::evaluate(piece_.plan, features);
    if (!evaluated) return evaluated.error();
    return values_of(*evaluated);
  }

 private:
  const TestPiece& piece_;
  const metrology::Measurement& measurement_;
};

Sensitivity empty_for(metrology::Measurement measurement, std::span<const Parameter> parameters) {
  Sensitivity s;
  const auto rows = static_cast<Eigen::Index>(measurement.characteristics.size());
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  s.measurement = std::move(measurement);
  s.parameters.assign(parameters.begin(), parameters.end());
  s.odd = s.even = Eigen::MatrixXd::Zero(rows, columns);
  return s;
}

void set_column(Sensitivity& s, Eigen::Index column, double step, const Eigen::VectorXd& plus,
                const Eigen::VectorXd& minus, const Eigen::VectorXd& centre) {
  s.odd.col(column) = (plus - minus) / (2.0 * step);
  s.even.col(column) = (plus + minus - 2.0 * centre) / (2.0 * step);
}

// The machine or the tools with one parameter raised by `amount`.
Result<Trial> varied_trial(const Machine& machine, const GeometricErrors& errors,
                           const TestPiece& piece, const CommandedPiece& commanded,
                           const Parameter& parameter, double amount, const TrialOptions& options) {
  if (parameter.unit) {
    return clean_trial(machine, errors.plus(*parameter.unit, amount), piece, commanded, options);
  }
  TestPiece varied = piece;
  for (auto& [number, tool] : varied.tools) tool.radius_error.value += amount;
  return clean_trial(machine, errors, varied, commanded, options);
}

}  // namespace

Eigen::VectorXd values_of(const metrology::Measurement& measurement) {
  const auto& characteristics = measurement.characteristics;
  Eigen::VectorXd values(static_cast<Eigen::Index>(characteristics.size()));
  for (std::size_t i = 0; i < characteristics.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = metrology::internal_value(characteristics[i]);
  }
  return values;
}

Result<Sensitivity> sensitivity(const Machine& machine, const GeometricErrors& errors,
                                const TestPiece& piece, std::span<const Parameter> parameters,
                                const TrialOptions& options) {
  const auto commanded = command_piece(machine, piece);
  if (!commanded) return commanded.error();
  return sensitivity(machine, errors, piece, *commanded, parameters, options);
}

Result<Sensitivity> sensitivity(const Machine& machine, const GeometricErrors& errors,
                                const TestPiece& piece, const CommandedPiece& commanded,
                                std::span<const Parameter> parameters,
                                const TrialOptions& options) {
  const auto trial = clean_trial(machine, errors, piece, commanded, options);
  if (!trial) return trial.error();
  const auto gains = surface_gains(machine, piece, *trial, parameters);
  if (!gains) return gains.error();
  return sensitivity_of_moves(piece, trial->measurement, *gains, parameters);
}

Result<Sensitivity> sensitivity_of_moves(const TestPiece& piece,
                                         const metrology::Measurement& measurement,
                                         const SurfaceGains& gains,
                                         std::span<const Parameter> parameters,
                                         const DifferenceSteps& steps) {
  const MovedPoints points(piece, measurement);
  const auto centre = points.characteristics(Eigen::VectorXd::Zero(gains.odd.rows()));
  if (!centre) return centre.error();
  Sensitivity s = empty_for(measurement, parameters);
  // What went wrong, by columns: the first one counts, whichever thread finds it.
  std::vector<Diagnostics> problems(parameters.size());
  tbb::parallel_for(std::size_t{0}, parameters.size(), [&](std::size_t column) {
    const auto k = static_cast<Eigen::Index>(column);
    // What moves no point changes no characteristic.
    if (gains.odd.col(k).isZero(0.0) && gains.even.col(k).isZero(0.0)) return;
    const double step = step_of(parameters[column], steps);
    const Eigen::VectorXd odd = step * gains.odd.col(k), even = step * gains.even.col(k);
    const auto plus = points.characteristics(even + odd);
    const auto minus = points.characteristics(even - odd);
    if (plus && minus) {
      set_column(s, k, step, *plus, *minus, *centre);
    } else {
      problems[column] = plus ? minus.error() : plus.error();
    }
  });
  for (Diagnostics& problem : problems) {
    if (!problem.empty()) return std::move(problem);
  }
  return s;
}

Result<Trial> clean_trial(const Machine& machine, const GeometricErrors& errors,
                          const TestPiece& piece, const CommandedPiece& commanded,
                          const TrialOptions& options) {
  auto trial = run_trial(machine, errors, piece, commanded, {}, quiet(options));
  if (!trial || trial->wrong_cuts.empty()) return trial;
  Diagnostics wrong = std::move(trial->wrong_cuts);
  for (Diagnostic& d : wrong) d.severity = Severity::error;
  return wrong;
}

Result<Sensitivity> sensitivity_by_differences(const Machine& machine,
                                               const GeometricErrors& errors,
                                               const TestPiece& piece,
                                               std::span<const Parameter> parameters,
                                               const DifferenceSteps& steps,
                                               const TrialOptions& options) {
  const auto commanded = command_piece(machine, piece);
  if (!commanded) return commanded.error();
  const auto trial = clean_trial(machine, errors, piece, *commanded, options);
  if (!trial) return trial.error();
  const Eigen::VectorXd centre = values_of(trial->measurement);
  Sensitivity s = empty_for(trial->measurement, parameters);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double step = step_of(parameters[k], steps);
    const auto plus =
        varied_trial(machine, errors, piece, *commanded, parameters[k], step, options);
    if (!plus) return plus.error();
    const auto minus =
        varied_trial(machine, errors, piece, *commanded, parameters[k], -step, options);
    if (!minus) return minus.error();
    set_column(s, static_cast<Eigen::Index>(k), step, values_of(plus->measurement),
               values_of(minus->measurement), centre);
  }
  return s;
}

}  // namespace frustum::trials
