#include "instruments/turn_harmonics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"

namespace frustum::instruments {

Result<TurnHarmonics> turn_harmonics(const PolarSamples& samples) {
  constexpr Eigen::Index kTerms = 5;
  const auto count = static_cast<Eigen::Index>(samples.angle.size());
  if (count < kTerms) {
    return error("too-few-samples"_id,
                 fmt::format("two harmonics need five samples, given are {}", count));
  }
  Eigen::MatrixXd rows(count, kTerms);
  Eigen::VectorXd readings(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t = samples.angle[static_cast<std::size_t>(i)];
    rows.row(i) << 1.0, std::cos(t), std::sin(t), std::cos(2.0 * t), std::sin(2.0 * t);
    readings[i] = samples.deviation[static_cast<std::size_t>(i)];
  }
  if (column_rank(rows, kTerms * std::numeric_limits<double>::epsilon()) < kTerms) {
    return error("arc-too-short"_id, "the angles do not separate two harmonics",
                 "give more angles, over a longer arc");
  }
  const Eigen::VectorXd x = least_squares_solution(rows, readings);
  TurnHarmonics found;
  for (Eigen::Index k = 0; k < kTerms; ++k) found.value[static_cast<std::size_t>(k)] = x[k];
  found.residual_rms = (readings - rows * x).norm() / std::sqrt(static_cast<double>(count));
  const auto circle = least_squares_circle(samples);
  if (!circle) return circle.error();
  found.form = range_about(samples, *circle).width();
  return found;
}

}  // namespace frustum::instruments
