#include "calibration/identify/refinement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/counted.hpp"

namespace frustum::calibration {
namespace {

Eigen::VectorXd start_of(const Observations& observations) {
  Eigen::VectorXd start =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.unknowns.size()));
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    const Unknown& unknown = observations.unknowns[static_cast<std::size_t>(j)];
    if (unknown.is_fixed()) {
      start[j] = unknown.fixed_value();
    } else if (unknown.prior) {
      start[j] = unknown.prior->value;
    }
  }
  return start;
}

Diagnostics wrong_prediction(const Prediction& prediction, const Observations& observations) {
  const auto rows = static_cast<Eigen::Index>(observations.rows.size());
  const auto unknowns = static_cast<Eigen::Index>(observations.unknowns.size());
  if (prediction.values.size() != rows || prediction.gain.rows() != rows ||
      prediction.gain.cols() != unknowns) {
    return {error("wrong-size"_id,
                  fmt::format("the model answers {} values and {} x {} sensitivities for {} "
                              "characteristics and {} unknowns",
                              prediction.values.size(), prediction.gain.rows(),
                              prediction.gain.cols(), rows, unknowns))};
  }
  if (!prediction.values.allFinite() || !prediction.gain.allFinite()) {
    return {error("not-a-number"_id, "the model answers a number that is not finite",
                  "the estimate may have left what the machine can do; start from known values")};
  }
  return {};
}

struct Change {
  double size = 0.0;  // in standard uncertainties
  std::string name{};
};

Change largest_change(const Identification& identification, const Eigen::VectorXd& before) {
  Change largest;
  for (std::size_t j = 0; j < identification.estimates.size(); ++j) {
    const Estimate& estimate = identification.estimates[j];
    if (estimate.fixed || !estimate.value) continue;
    const double change = std::abs(*estimate.value - before[static_cast<Eigen::Index>(j)]) /
                          *estimate.standard_uncertainty;
    if (change >= largest.size) largest = {change, estimate.name};
  }
  // What only combinations identify has to settle too.
  for (const EstimatedCombination& estimated : identification.combinations) {
    double old = 0.0;
    for (const Term& term : estimated.combination.terms)
      old += term.coefficient * before[term.unknown];
    const double change = std::abs(estimated.value - old) / estimated.standard_uncertainty;
    if (change >= largest.size) largest = {change, estimated.combination.text};
  }
  return largest;
}

}  // namespace

Result<Refinement> refine(Observations observations, const Model& model,
                          const RefineOptions& options) {
  if (options.most_rounds < 1 || !(options.settled > 0.0)) {
    return error("out-of-range"_id, "a refinement needs at least one round and a positive limit");
  }
  const Eigen::VectorXd measured = observations.values;
  if (measured.size() != static_cast<Eigen::Index>(observations.rows.size())) {
    return error(
        "wrong-size"_id,
        fmt::format("{} for {}", counted(static_cast<std::size_t>(measured.size()), "value"),
                    counted(observations.rows.size(), "characteristic")));
  }
  Eigen::VectorXd x = start_of(observations);
  Refinement result;
  Change change;
  for (int round = 0; round < options.most_rounds; ++round) {
    auto prediction = model(x);
    if (!prediction) return std::move(prediction).error();
    Diagnostics wrong = wrong_prediction(*prediction, observations);
    if (!wrong.empty()) return wrong;
    observations.gain = prediction->gain;
    observations.values = measured - prediction->values + prediction->gain * x;
    auto identification = identify(observations, options.identify);
    if (!identification) return std::move(identification).error();
    change = largest_change(*identification, x);
    result.changes.push_back(change.size);
    x = identification->working_point;
    if (change.size < options.settled) {
      // The rows of the linearised problem are shifted; show the measurements themselves.
      for (std::size_t i = 0; i < observations.rows.size(); ++i) {
        Residual& residual = identification->residuals[i];
        residual.measured = measured[static_cast<Eigen::Index>(i)];
        residual.predicted = residual.measured - residual.residual;
      }
      result.identification = *std::move(identification);
      return result;
    }
  }
  return error(
      "not-converged"_id,
      fmt::format("the estimate did not settle in {} rounds: {} still moved by {:.3g} of its "
                  "standard uncertainty",
                  options.most_rounds, change.name, change.size),
      "the model may be far from linear at such errors, or its numbers noisier than the "
      "measurements");
}

}  // namespace frustum::calibration
