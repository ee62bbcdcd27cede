#include "calibration/identify/findings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "calibration/identify/sparse_basis.hpp"
#include "core/units.hpp"

namespace frustum::calibration {
namespace {

// Rows whose noise cancels, by name.
std::string names_of(const Eigen::VectorXd& combination, const Observations& observations) {
  std::string names;
  for (Eigen::Index i = 0; i < combination.size(); ++i) {
    if (combination[i] == 0.0) continue;
    if (!names.empty()) names += ", ";
    names += observations.rows[static_cast<std::size_t>(i)].name;
  }
  return names;
}

void contradictions(const Observations& observations, const WeightedSystem& system,
                    const Identification& result, Diagnostics& found) {
  // 1e-3: shares of a row that nobody would read.
  const Eigen::MatrixXd combinations = sparse_basis(system.without_noise, 1e-3);
  const Eigen::VectorXd sd = system.covariance.diagonal().cwiseSqrt();
  for (Eigen::Index k = 0; k < combinations.cols(); ++k) {
    const Eigen::VectorXd share = combinations.col(k).cwiseQuotient(sd);
    double left = 0.0;
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      left += share[i] * result.residuals[static_cast<std::size_t>(i)].residual;
    }
    const std::string names = names_of(combinations.col(k), observations);
    if (std::abs(left) > kContradiction) {
      found.push_back(warning(
          "observations-contradict"_id,
          fmt::format("{} contradict each other by {:.2g} standard deviations: by their covariance "
                      "they share all their noise",
                      names, std::abs(left)),
          "check that they were evaluated from the same points"));
    }
    const Eigen::VectorXd effect =
        (share.transpose() * system.gain * system.size.asDiagonal()).transpose();
    if (effect.cwiseAbs().maxCoeff() > kFaintest) {
      found.push_back(warning(
          "observations-contradict"_id,
          fmt::format("what {} say together would be free of noise by their covariance although it "
                      "depends on the errors; it was left out",
                      names),
          "state the covariance of the measuring machine"));
    }
  }
}

void verdict(const Agreement& agreement, Diagnostics& found) {
  if (!agreement.rejected) return;
  found.push_back(warning(
      "model-misfit"_id,
      fmt::format(
          "the model does not explain the measurements: chi2 = {:.4g} with {} degrees of "
          "freedom (probability {:.2g}). The stated uncertainties hold for a model that does; "
          "the Birge factor, by which they would have to grow, is {:.3g}. It is not applied",
          agreement.chi_square, agreement.degrees_of_freedom, *agreement.probability,
          *agreement.birge),
      "look at the largest residuals; a floor covers what the machine does outside the model"));
}

void outliers(const Identification& result, Diagnostics& found) {
  if (!result.suspect) return;
  const Residual& residual = result.residuals[*result.suspect];
  const double unit = residual.angular ? kUradPerRad : kUmPerMm;
  std::string message = fmt::format(
      "{} disagrees most with all others: residual {:+.3g} {}, w = {:+.3g}", residual.name,
      residual.residual * unit, residual.angular ? "urad" : "um", *residual.w);
  if (result.agreement.rejected)
    message += "; where the model fails as a whole this may be the model";
  found.push_back(warning("outlying-value"_id, std::move(message),
                          "measure it again, or leave it out and compare"));
}

}  // namespace

Diagnostics findings(const Observations& observations, const WeightedSystem& system,
                     const Identification& identification) {
  Diagnostics found;
  for (const NullDirection& direction : identification.observability.null_space) {
    found.push_back(warning("not-identifiable"_id, direction.text));
  }
  contradictions(observations, system, identification, found);
  verdict(identification.agreement, found);
  outliers(identification, found);
  return found;
}

}  // namespace frustum::calibration
