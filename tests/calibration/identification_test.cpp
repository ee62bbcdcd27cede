#include "calibration/identify/identification.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "calibration/identify/distributions.hpp"

namespace frustum::calibration {
namespace {

// Four lengths, two unknowns, correlated noise.
Observations small() {
  Observations o;
  o.unknowns = {{"p", false, {}, {}}, {"q", true, {}, {}}};
  o.rows = {{"a", "A", false}, {"b", "A", false}, {"c", "B", false}, {"d", "B", true}};
  o.gain.resize(4, 2);
  o.gain << 1.0, 100.0, 2.0, -50.0, 1.0, 0.0, 0.0, 1.0;
  o.values.resize(4);
  o.values << 0.013, 0.0081, 0.0102, 31e-6;
  o.covariance.resize(4, 4);
  o.covariance << 1e-6, 4e-7, 0, 0, 4e-7, 2e-6, 1e-7, 0, 0, 1e-7, 1e-6, 1e-9, 0, 0, 1e-9, 4e-12;
  return o;
}

std::string messages(const Diagnostics& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics) all += d.message + "\n";
  return all;
}

TEST(Identification, IsTheTextbookSolutionOfCorrelatedLeastSquares) {
  const Observations o = small();
  const auto result = identify(o);
  ASSERT_TRUE(result) << messages(result.error());
  const Eigen::MatrixXd weight = o.covariance.inverse();
  const Eigen::MatrixXd covariance = (o.gain.transpose() * weight * o.gain).inverse();
  const Eigen::VectorXd x = covariance * o.gain.transpose() * weight * o.values;
  const Eigen::VectorXd e = o.values - o.gain * x;
  EXPECT_NEAR(*result->estimates[0].value, x[0], 1e-12);
  EXPECT_NEAR(*result->estimates[1].value, x[1], 1e-14);
  EXPECT_LT((result->covariance - covariance).norm(), 1e-12 * covariance.norm());
  EXPECT_NEAR(result->agreement.chi_square, e.dot(weight * e), 1e-9);
  EXPECT_EQ(result->agreement.degrees_of_freedom, 2);
  const Eigen::MatrixXd left = o.covariance - o.gain * covariance * o.gain.transpose();
  const Eigen::MatrixXd test = weight * left * weight;
  const Eigen::VectorXd weighted = weight * e;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Residual& residual = result->residuals[static_cast<std::size_t>(i)];
    EXPECT_NEAR(residual.residual, e[i], 1e-12);
    EXPECT_NEAR(*residual.normalised, e[i] / std::sqrt(left(i, i)), 1e-7);
    EXPECT_NEAR(*residual.w, weighted[i] / std::sqrt(test(i, i)), 1e-7);
    EXPECT_NEAR(residual.predicted, o.gain.row(i).dot(x), 1e-12);
  }
}

TEST(Identification, GivesNormalIntervalsForAKnownCovarianceAndStudentsOtherwise) {
  const auto known = identify(small());
  const auto scattered = identify(small(), {{}, 0.95, 4.0});
  const Estimate& a = known->estimates[0];
  const Estimate& b = scattered->estimates[0];
  EXPECT_NEAR((*a.upper - *a.value) / *a.standard_uncertainty, 1.959963985, 1e-8);
  EXPECT_NEAR((*b.value - *b.lower) / *b.standard_uncertainty, 2.776445105, 1e-8);
}

TEST(Identification, KnowsItsProbabilities) {
  EXPECT_NEAR(chi_square_tail(40.113272, 27), 0.05, 1e-7);  // printed in every table
  EXPECT_NEAR(chi_square_tail(2.0, 2), std::exp(-1.0), 1e-14);
}

TEST(Identification, UsesAPriorAsAMeasurementMore) {
  Observations with_row = small();
  with_row.rows.push_back({"e", "C", true});
  with_row.gain.conservativeResize(5, 2);
  with_row.gain.row(4) << 0.0, 1.0;
  with_row.values.conservativeResize(5);
  with_row.values[4] = 29e-6;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(5, 5);
  covariance.topLeftCorner(4, 4) = with_row.covariance;
  covariance(4, 4) = 9e-12;
  with_row.covariance = covariance;
  Observations with_prior = small();
  with_prior.unknowns[1].prior = Prior{29e-6, 3e-6};
  const auto a = identify(with_row);
  const auto b = identify(with_prior);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(*a->estimates[0].value, *b->estimates[0].value, 1e-12);
  EXPECT_NEAR(*a->estimates[1].standard_uncertainty, *b->estimates[1].standard_uncertainty, 1e-15);
  EXPECT_NEAR(a->agreement.chi_square, b->agreement.chi_square, 1e-9);
  EXPECT_EQ(a->agreement.degrees_of_freedom, b->agreement.degrees_of_freedom);
  EXPECT_EQ(b->residuals[4].name, "prior q");
  EXPECT_NEAR(*a->residuals[4].normalised, *b->residuals[4].normalised, 1e-7);
}

TEST(Identification, TakesExactlyKnownErrorsOffTheRightHandSide) {
  Observations fixed = small();
  fixed.unknowns[1].fixed = 30e-6;
  Observations certain = small();
  certain.unknowns[1].prior = Prior{30e-6, 0.0};
  Observations less = small();
  less.values -= 30e-6 * less.gain.col(1);
  less.gain = Eigen::MatrixXd(less.gain.col(0));
  less.unknowns.pop_back();
  const auto a = identify(fixed);
  const auto b = identify(certain);
  const auto c = identify(less);
  ASSERT_TRUE(a && b && c);
  EXPECT_NEAR(*a->estimates[0].value, *c->estimates[0].value, 1e-13);
  EXPECT_EQ(*a->estimates[0].value, *b->estimates[0].value);
  EXPECT_EQ(*a->estimates[0].standard_uncertainty, *c->estimates[0].standard_uncertainty);
  EXPECT_EQ(a->agreement.degrees_of_freedom, 3);
  EXPECT_EQ(b->agreement.degrees_of_freedom, 3);
  EXPECT_EQ(*a->estimates[1].standard_uncertainty, 0.0);
  EXPECT_EQ(a->residuals.size(), 4U);
}

// The same characteristic under two names, as when two patterns share their reference steps.
Observations doubled(double difference) {
  Observations o = small();
  o.rows.push_back({"a again", "B", false});
  o.gain.conservativeResize(5, 2);
  o.gain.row(4) = o.gain.row(0);
  o.values.conservativeResize(5);
  o.values[4] = o.values[0] + difference;
  Eigen::MatrixXd covariance(5, 5);
  covariance.topLeftCorner(4, 4) = o.covariance;
  covariance.col(4).head(4) = o.covariance.col(0);
  covariance.row(4).head(4) = o.covariance.row(0);
  covariance(4, 4) = o.covariance(0, 0);
  o.covariance = covariance;
  return o;
}

TEST(Identification, CountsSharedSurfacesOnce) {
  const auto once = identify(small());
  const auto twice = identify(doubled(0.0));
  ASSERT_TRUE(twice) << messages(twice.error());
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(*twice->estimates[j].value, *once->estimates[j].value, 1e-11);
    EXPECT_NEAR(*twice->estimates[j].standard_uncertainty, *once->estimates[j].standard_uncertainty,
                1e-9 * *once->estimates[j].standard_uncertainty);
  }
  EXPECT_EQ(twice->agreement.degrees_of_freedom, once->agreement.degrees_of_freedom);
  EXPECT_NEAR(twice->agreement.chi_square, once->agreement.chi_square, 1e-8);
  EXPECT_EQ(messages(twice->diagnostics).find("contradict"), std::string::npos);
  // Neither does a floor make two measurements of one.
  const IdentifyOptions floor{{2e-3, 3e-6}, 0.95, {}};
  EXPECT_NEAR(*identify(doubled(0.0), floor)->estimates[0].standard_uncertainty,
              *identify(small(), floor)->estimates[0].standard_uncertainty, 1e-12);
}

TEST(Identification, ReportsSharedSurfacesThatContradictEachOther) {
  const auto result = identify(doubled(0.0005));  // half a standard deviation
  ASSERT_TRUE(result);
  const std::string all = messages(result->diagnostics);
  EXPECT_NE(all.find("a, a again contradict each other by 0.5 standard deviations"),
            std::string::npos)
      << all;
}

TEST(Identification, LeavesOutWhatWouldBeFreeOfNoiseAndSaysSo) {
  Observations o = doubled(0.0);
  o.gain(4, 0) = 3.0;  // no noise between a and a again, but another gain
  const auto result = identify(o);
  ASSERT_TRUE(result);
  const std::string all = messages(result->diagnostics);
  EXPECT_NE(all.find("would be free of noise"), std::string::npos) << all;
}

TEST(Identification, PointsAtTheOneWrongMeasurement) {
  Observations o;
  o.unknowns = {{"p", false, {}, {}}, {"q", false, {}, {}}};
  o.gain.resize(12, 2);
  for (int i = 0; i < 12; ++i) {
    o.rows.push_back({"row" + std::to_string(i), "A", false});
    o.gain.row(i) << 1.0, 0.1 * i;
  }
  o.values = o.gain * Eigen::Vector2d(0.01, 0.02);
  o.covariance = 1e-6 * Eigen::MatrixXd::Identity(12, 12);
  const auto good = identify(o);
  EXPECT_FALSE(good->suspect);
  EXPECT_TRUE(good->diagnostics.empty()) << messages(good->diagnostics);
  o.values[7] += 6e-3;
  const auto bad = identify(o);
  ASSERT_TRUE(bad->suspect);
  EXPECT_EQ(*bad->suspect, 7U);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(bad->residuals[i].outlier, i == 7) << i;
  EXPECT_TRUE(bad->agreement.rejected);
  // A diagonal covariance: both tests are one.
  EXPECT_NEAR(*bad->residuals[7].w, *bad->residuals[7].normalised, 1e-9);
}

TEST(Identification, HasNoVerdictWithoutRedundancy) {
  Observations o = small();
  o = o.selected(std::vector<Eigen::Index>{0, 2});
  const auto result = identify(o);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->agreement.degrees_of_freedom, 0);
  EXPECT_FALSE(result->agreement.probability);
  EXPECT_FALSE(result->agreement.birge);
  EXPECT_FALSE(result->residuals[0].normalised);
  EXPECT_FALSE(result->agreement.rejected);
}

void expect_refused(const Observations& o, const char* text, const IdentifyOptions& options = {}) {
  const auto result = identify(o, options);
  ASSERT_FALSE(result) << text;
  EXPECT_NE(messages(result.error()).find(text), std::string::npos) << messages(result.error());
}

TEST(Identification, RefusesWhatIsNoObservation) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused({}, "no measured characteristic");
  Observations o = small();
  o.values[2] = nan;
  expect_refused(o, "the value of c is not a finite number");
  o = small();
  o.gain(1, 1) = nan;
  expect_refused(o, "a sensitivity of b is not a finite number");
  o = small();
  o.covariance(3, 3) = 0.0;
  expect_refused(o, "the variance of d is 0; it has to be positive");
  o = small();
  o.covariance(0, 1) = 5e-7;
  expect_refused(o, "the covariance of b and a is not symmetric");
  o = small();
  o.covariance(0, 1) = o.covariance(1, 0) = 3e-6;
  expect_refused(o, "the covariance has a negative eigenvalue");
  o = small();
  o.covariance(0, 1) = o.covariance(1, 0) = nan;
  expect_refused(o, "not symmetric or not finite");
  o = small();
  o.rows[1].name = "a";
  expect_refused(o, "characteristic a is given twice");
  o = small();
  o.unknowns[1].name = "p";
  expect_refused(o, "unknown p is given twice");
  o = small();
  o.unknowns[0].prior = Prior{0.0, -1.0};
  expect_refused(o, "p is known as 0 with standard deviation -1");
  o = small();
  o.unknowns[0].fixed = o.unknowns[1].fixed = 0.0;
  expect_refused(o, "nothing is left to identify");
  o = small();
  o.values.resize(3);
  expect_refused(o, "3 values for 4 characteristics");
  o = small();
  o.values *= 1e200;
  expect_refused(o, "leave the range of numbers");
  expect_refused(small(), "the floor of the uncertainties", {{-1.0, 0.0}, 0.95, {}});
  expect_refused(small(), "confidence", {{}, 1.0, {}});
  expect_refused(small(), "degrees of freedom", {{}, 0.95, 0.0});
}

}  // namespace
}  // namespace frustum::calibration
