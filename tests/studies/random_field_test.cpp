#include "studies/laws/random_field.hpp"

#include <cmath>

#include "core/constants.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

using kinematics::FieldKernel;

TEST(RandomFieldReference, SpectraAreThoseOfTheIndependentComputation) {
  for (const FieldKernel kernel : {FieldKernel::gaussian, FieldKernel::matern32}) {
    const nlohmann::json& field = expected()["fields"][std::string(name_of(kernel))];
    const auto spectrum = field_spectrum(kernel, field["span"], field["correlation_length"]);
    ASSERT_TRUE(spectrum);
    EXPECT_NEAR(spectrum->period, field["period"].get<double>(), 1e-9);
    ASSERT_EQ(spectrum->variances.size(), field["harmonics"].get<std::size_t>() + 1);
    for (std::size_t k = 0; k < spectrum->variances.size(); ++k) {
      EXPECT_NEAR(spectrum->variances[k], field["variances"][k].get<double>(), 1e-9);
    }
    for (std::size_t i = 0; i < field["lags"].size(); ++i) {
      const double lag = field["lags"][i];
      double covariance = 0.0;
      for (std::size_t k = 0; k < spectrum->variances.size(); ++k) {
        covariance += spectrum->variances[k] *
                      std::cos(kTurn * static_cast<double>(k) * lag / spectrum->period);
      }
      EXPECT_NEAR(covariance, field["covariance"][i].get<double>(), 1e-9);
      const double kernel_there = kernel_value(kernel, lag, field["correlation_length"]);
      EXPECT_NEAR(kernel_there, field["kernel"][i].get<double>(), 1e-9);
      EXPECT_NEAR(covariance, kernel_there, 1.2e-3);
    }
  }
}

// Drawn fields: the covariance of their values at two places is that of the kernel, and the
// standard deviation the one written.
TEST(RandomField, DrawsHaveTheCovarianceOfTheKernel) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  const auto entry =
      kinematics::parse_error("EYX=field 3um correlation 40mm kernel matern32 over 0mm..200mm");
  ASSERT_TRUE(entry);
  const auto set = FactorSet::make(machine, {&*entry, 1});
  ASSERT_TRUE(set) << to_string(set.error().front());
  EXPECT_EQ(set->factors().size(), 1U);
  EXPECT_EQ(set->columns().size(), 2 * 37 + 1U);
  constexpr std::uint32_t kDraws = 1000;
  std::vector<double> values(set->variables().size());
  double square = 0.0, near = 0.0;
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    set->draw(1, d, values);
    const auto errors = set->errors_at(machine, values);
    ASSERT_TRUE(errors);
    const auto at = [&](double x) {
      kinematics::AxisPositions q;
      q[kinematics::AxisLetter::X] = x;
      return 1e3 * (*errors)[kinematics::AxisLetter::X].component[1](kinematics::AxisLetter::X, q);
    };
    square += at(60.0) * at(60.0) / kDraws;
    near += at(60.0) * at(80.0) / kDraws;
  }
  // Four standard errors: sqrt(2 / n) and sqrt((1 + rho^2) / n) of the variance.
  EXPECT_NEAR(square, 9.0, 9.0 * 4.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(near, 9.0 * 0.7849, 9.0 * 4.0 * std::sqrt(1.62 / kDraws));
  const double variance = set->weight_moments().covariance.diagonal().sum();
  double sum = 9e-6;  // cos^2 + sin^2 of each harmonic is one: twice the variance of all but k = 0
  sum = 2.0 * sum - set->weight_moments().covariance(0, 0);
  EXPECT_NEAR(variance, sum, 1e-12 * sum);
}

TEST(RandomField, IsRefusedWhereItIsTooRough) {
  EXPECT_FALSE(field_spectrum(FieldKernel::matern32, 2000.0, 0.5));
}

}  // namespace
}  // namespace frustum::studies
