#include "calibration/identify/observations.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "core/counted.hpp"

namespace frustum::calibration {
namespace {

Diagnostics wrong_sizes(const Observations& o) {
  const auto rows = static_cast<Eigen::Index>(o.rows.size());
  const auto unknowns = static_cast<Eigen::Index>(o.unknowns.size());
  if (rows == 0)
    return {error("nothing-to-identify"_id, "no measured characteristic",
                  "give at least one measurement")};
  if (unknowns == 0)
    return {
        error("nothing-to-identify"_id, "nothing to identify", "name at least one machine error")};
  if (o.gain.rows() != rows || o.gain.cols() != unknowns) {
    return {error("wrong-size"_id,
                  fmt::format("the sensitivity matrix is {} x {} for {} characteristics and {} "
                              "unknowns",
                              o.gain.rows(), o.gain.cols(), rows, unknowns))};
  }
  if (o.values.size() != rows) {
    return {
        error("wrong-size"_id,
              fmt::format("{} for {}", counted(static_cast<std::size_t>(o.values.size()), "value"),
                          counted(static_cast<std::size_t>(rows), "characteristic")))};
  }
  if (o.covariance.rows() != rows || o.covariance.cols() != rows) {
    return {error("covariance"_id, fmt::format("the covariance is {} x {} for {} characteristics",
                                               o.covariance.rows(), o.covariance.cols(), rows))};
  }
  return {};
}

void check_rows(const Observations& o, Diagnostics& found) {
  std::set<std::string> names;
  for (Eigen::Index i = 0; i < o.gain.rows(); ++i) {
    const std::string& name = o.rows[static_cast<std::size_t>(i)].name;
    if (!names.insert(name).second) {
      found.push_back(error("given-twice"_id, "characteristic " + name + " is given twice",
                            "pool repeated measurements first"));
    }
    if (!std::isfinite(o.values[i])) {
      found.push_back(error("not-a-number"_id, "the value of " + name + " is not a finite number"));
    }
    if (!o.gain.row(i).allFinite()) {
      found.push_back(
          error("not-a-number"_id, "a sensitivity of " + name + " is not a finite number"));
    }
    const double variance = o.covariance(i, i);
    if (!std::isfinite(variance) || variance <= 0.0) {
      found.push_back(
          error("uncertainty-not-positive"_id,
                fmt::format("the variance of {} is {}; it has to be positive", name, variance),
                "state the accuracy of the measuring machine"));
    }
  }
}

void check_unknowns(const Observations& o, Diagnostics& found) {
  std::set<std::string> names;
  for (const Unknown& unknown : o.unknowns) {
    if (!names.insert(unknown.name).second) {
      found.push_back(error("given-twice"_id, "unknown " + unknown.name + " is given twice"));
    }
    if (unknown.fixed && !std::isfinite(*unknown.fixed)) {
      found.push_back(error("not-a-number"_id,
                            "the fixed value of " + unknown.name + " is not a finite number"));
    }
    if (!unknown.prior) continue;
    const Prior& prior = *unknown.prior;
    if (!std::isfinite(prior.value) || !std::isfinite(prior.standard_deviation) ||
        prior.standard_deviation < 0.0) {
      found.push_back(error("uncertainty-not-positive"_id,
                            fmt::format("{} is known as {} with standard deviation {}",
                                        unknown.name, prior.value, prior.standard_deviation),
                            "both have to be finite, the standard deviation not negative"));
    }
  }
}

void check_symmetry(const Observations& o, Diagnostics& found) {
  for (Eigen::Index i = 0; i < o.covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double scale = std::sqrt(o.covariance(i, i) * o.covariance(j, j));
      const double difference = std::abs(o.covariance(i, j) - o.covariance(j, i)) / scale;
      // Sums of squares in another order agree to 1e-13; 1e-9 forgives files with ten digits.
      if (difference <= 1e-9) continue;
      found.push_back(error(
          "covariance"_id, fmt::format("the covariance of {} and {} is not symmetric or not finite",
                                       o.rows[static_cast<std::size_t>(i)].name,
                                       o.rows[static_cast<std::size_t>(j)].name)));
      return;
    }
  }
}

}  // namespace

bool Unknown::is_fixed() const {
  return fixed.has_value() || (prior.has_value() && prior->standard_deviation == 0.0);
}

double Unknown::fixed_value() const {
  if (fixed) return *fixed;
  return prior ? prior->value : 0.0;
}

Observations Observations::selected(std::span<const Eigen::Index> picked) const {
  const std::vector<Eigen::Index> indices(picked.begin(), picked.end());
  Observations part;
  part.unknowns = unknowns;
  for (const Eigen::Index i : picked) part.rows.push_back(rows[static_cast<std::size_t>(i)]);
  part.gain = gain(indices, Eigen::all);
  part.values = values(indices);
  part.covariance = covariance(indices, indices);
  return part;
}

double expected_size(const Unknown& unknown) {
  if (unknown.prior && unknown.prior->standard_deviation > 0.0) {
    return unknown.prior->standard_deviation;
  }
  return unknown.angular ? kExpectedAngle : kExpectedLength;
}

Diagnostics check(const Observations& observations) {
  Diagnostics found = wrong_sizes(observations);
  if (!found.empty()) return found;
  check_rows(observations, found);
  check_unknowns(observations, found);
  if (found.empty()) check_symmetry(observations, found);
  return found;
}

}  // namespace frustum::calibration
