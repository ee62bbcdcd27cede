#include "calibration/identify/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace frustum::calibration {
namespace {

// Curved on purpose: the first round is off by many standard uncertainties.
Result<Prediction> curved(const Eigen::VectorXd& x) {
  Prediction p;
  p.values.resize(4);
  p.values << x[0] + 20.0 * x[0] * x[0], 2.0 * x[0] - x[1] + 30.0 * x[0] * x[1],
      x[1] + 10.0 * x[1] * x[1] + x[2], std::sin(x[0] + x[1]);
  p.gain.resize(4, 3);
  p.gain << 1.0 + 40.0 * x[0], 0.0, 0.0, 2.0 + 30.0 * x[1], -1.0 + 30.0 * x[0], 0.0, 0.0,
      1.0 + 20.0 * x[1], 1.0, std::cos(x[0] + x[1]), std::cos(x[0] + x[1]), 0.0;
  return p;
}

Observations measured(const Eigen::VectorXd& x) {
  Observations o;
  o.unknowns = {{"p", false, {}, {}}, {"q", false, {}, {}}, {"r", false, {}, 0.004}};
  o.rows = {{"a", "A", false}, {"b", "A", false}, {"c", "A", false}, {"d", "A", false}};
  o.values = curved(x)->values;
  o.covariance = 1e-10 * Eigen::MatrixXd::Identity(4, 4);
  return o;
}

TEST(Refinement, RerunsTheModelUntilTheEstimateRests) {
  const Eigen::Vector3d truth(0.008, -0.011, 0.004);
  const auto result = refine(measured(truth), curved);
  ASSERT_TRUE(result) << result.error().front().message;
  EXPECT_NEAR(*result->identification.estimates[0].value, truth[0], 1e-8);
  EXPECT_NEAR(*result->identification.estimates[1].value, truth[1], 1e-8);
  EXPECT_EQ(*result->identification.estimates[2].value, truth[2]);
  EXPECT_GT(result->changes.front(), 100.0);
  EXPECT_GT(result->changes.size(), 2U);
  EXPECT_LT(result->changes.back(), 1e-3);
  EXPECT_LT(result->identification.agreement.chi_square, 1e-6);
  // Residual lines show the measurements themselves.
  EXPECT_EQ(result->identification.residuals[0].measured, measured(truth).values[0]);
}

TEST(Refinement, NeedsTwoRoundsOfALinearModel) {
  const auto linear = [](const Eigen::VectorXd& x) -> Result<Prediction> {
    const Eigen::MatrixXd gain = curved(Eigen::Vector3d::Zero())->gain;
    return Prediction{gain * x, gain};
  };
  Observations o = measured(Eigen::Vector3d::Zero());
  o.values << 0.01, 0.02, 0.03, 0.01;
  const auto result = refine(o, linear);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->changes.size(), 2U);
  o.gain = curved(Eigen::Vector3d::Zero())->gain;
  const auto direct = identify(o);
  EXPECT_NEAR(*direct->estimates[1].value, *result->identification.estimates[1].value, 1e-12);
  EXPECT_NEAR(direct->agreement.chi_square, result->identification.agreement.chi_square, 1e-3);
}

TEST(Refinement, SaysWhichUnknownDidNotSettle) {
  int round = 0;
  const auto restless = [&](const Eigen::VectorXd& x) -> Result<Prediction> {
    Prediction p = *curved(x);
    p.values[0] += (++round % 2 == 0 ? 1e-4 : -1e-4);
    return p;
  };
  const auto result = refine(measured(Eigen::Vector3d(0.001, 0.001, 0.004)), restless);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().front().message.find("the estimate did not settle in 12 rounds: p "), 0U)
      << result.error().front().message;
}

TEST(Refinement, PassesOnWhatTheModelRefuses) {
  const Observations o = measured(Eigen::Vector3d::Zero());
  const auto refusing = [](const Eigen::VectorXd&) -> Result<Prediction> {
    return error("the tool does not reach");
  };
  EXPECT_EQ(refine(o, refusing).error().front().message, "the tool does not reach");
  const auto empty = [](const Eigen::VectorXd&) -> Result<Prediction> { return Prediction{}; };
  EXPECT_FALSE(refine(o, empty));
  const auto infinite = [](const Eigen::VectorXd& x) -> Result<Prediction> {
    Prediction p = *curved(x);
    p.values[2] = std::numeric_limits<double>::infinity();
    return p;
  };
  EXPECT_FALSE(refine(o, infinite));
  Observations empty_values = o;
  empty_values.values.resize(0);
  EXPECT_FALSE(refine(empty_values, curved));
}

TEST(Refinement, LeavesUnknownsAloneThatNothingTells) {
  Observations o = measured(Eigen::Vector3d(0.001, -0.002, 0.004));
  o.unknowns.push_back({"nobody knows", true, {}, {}});
  const auto model = [](const Eigen::VectorXd& x) -> Result<Prediction> {
    Prediction p = *curved(x.head(3));
    p.gain.conservativeResize(4, 4);
    p.gain.col(3).setZero();
    return p;
  };
  const auto result = refine(o, model);
  ASSERT_TRUE(result) << result.error().front().message;
  EXPECT_NEAR(*result->identification.estimates[1].value, -0.002, 1e-8);
  EXPECT_FALSE(result->identification.estimates[3].value);
  EXPECT_EQ(result->identification.working_point[3], 0.0);
}

}  // namespace
}  // namespace frustum::calibration
