#include "calibration/identify/observability.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "calibration/identify/identification.hpp"
#include "calibration/identify/sparse_basis.hpp"
#include "core/random.hpp"
#include "tests/calibration/step_patterns.hpp"

namespace frustum::calibration {
namespace {

Observability of(const std::vector<std::string>& patterns) {
  const auto result = observability(planned(patterns));
  EXPECT_TRUE(result);
  return *result;
}

std::vector<std::string> texts(const Observability& o) {
  std::vector<std::string> all;
  for (const NullDirection& direction : o.null_space) all.push_back(direction.text);
  return all;
}

TEST(Observability, SaysInWordsWhat1aAnd1bDoNotTell) {
  const Observability result = of({"1-a", "1-b"});
  EXPECT_EQ(result.rank, 4);
  EXPECT_EQ(result.unknowns, 9);
  EXPECT_EQ(
      texts(result),
      (std::vector<std::string>{
          "g_AY cannot be identified: no measurement shows it",
          "dx_AY cannot be identified: no measurement shows it",
          "dz_AY cannot be identified: no measurement shows it",
          "b_AY and b_CA cannot be separated: b_AY - b_CA cannot be identified; b_AY + b_CA can",
          "dy_AY and dy_CA cannot be separated: dy_AY - dy_CA cannot be identified; "
          "dy_AY + dy_CA can"}));
}

TEST(Observability, GivesNoNumberToUnknownsInTheNullSpace) {
  const std::vector<std::string> patterns{"1-a", "1-b"};
  const auto result = identify(planned(patterns));
  ASSERT_TRUE(result);
  for (const Estimate& estimate : result->estimates) {
    const bool identified = estimate.fixed || estimate.name == "a_AY" || estimate.name == "d_r";
    EXPECT_EQ(estimate.value.has_value(), identified) << estimate.name;
    EXPECT_EQ(estimate.standard_uncertainty.has_value(), identified) << estimate.name;
    EXPECT_EQ(estimate.upper.has_value(), identified) << estimate.name;
  }
  ASSERT_EQ(result->combinations.size(), 2U);
  EXPECT_EQ(result->combinations[0].combination.text, "b_AY + b_CA");
  EXPECT_EQ(result->combinations[1].combination.text, "dy_AY + dy_CA");
  EXPECT_GT(result->combinations[0].standard_uncertainty, 0.0);
  EXPECT_TRUE(result->covariance.allFinite());
}

TEST(Observability, EstimatesTheSumThatItCannotSplit) {
  const std::vector<std::string> patterns{"1-a", "1-b"};
  Observations observations = planned(patterns);
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(12);
  errors << 5e-6, 30e-6, -12e-6, 7e-6, 1e-3, 4e-3, 9e-3, 2e-3, 0, 0, 0, 3e-3;
  observations.values = observations.gain * errors;
  const auto result = identify(observations);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->combinations[0].value, 18e-6, 1e-14);
  EXPECT_NEAR(result->combinations[1].value, 13e-3, 1e-11);
  EXPECT_NEAR(*result->estimates[0].value, 5e-6, 1e-14);
  // The point explains the measurements although its split means nothing.
  EXPECT_LT((observations.gain * result->working_point - observations.values).norm(), 1e-12);
}

TEST(Observability, GivesTheArmWhereLengthsAndAnglesMix) {
  Observations o;
  o.unknowns = {{"dz_AY", false, {}, {}}, {"beta_AY", true, {}, {}}};
  o.rows = {{"4.dL", "4", false}};
  o.gain.resize(1, 2);
  o.gain << -2.0, 194.3;
  o.values = Eigen::VectorXd::Constant(1, 1e-3);
  o.covariance = Eigen::MatrixXd::Constant(1, 1, 1e-8);
  const auto result = observability(o);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->null_space.size(), 1U);
  EXPECT_EQ(result->null_space[0].text,
            "dz_AY and beta_AY cannot be separated: no measurement shows it when they change "
            "together, dz_AY by +0.09715 um, beta_AY by +1 urad; dz_AY - 97.15 mm * beta_AY can");
}

// Sensitivities from central differences carry 1e-6 of noise; ten times that does not change a
// word.
TEST(Observability, SaysTheSameOfSensitivitiesWithNumericalNoise) {
  const std::vector<std::string> patterns{"1-a", "1-b"};
  const Observations exact = planned(patterns);
  const auto expected = observability(exact);
  for (std::uint32_t draw = 0; draw < 50; ++draw) {
    Observations noisy = exact;
    const RandomKey key{31, draw, RandomPurpose::test_data};
    std::uint64_t index = 0;
    for (Eigen::Index i = 0; i < noisy.gain.rows(); ++i) {
      const bool angular = noisy.rows[static_cast<std::size_t>(i)].angular;
      for (Eigen::Index j = 0; j < noisy.gain.cols(); ++j) {
        // Gains of one kind are 2 where lever arms do not come in, and those are 200 mm.
        const bool by_angle = noisy.unknowns[static_cast<std::size_t>(j)].angular;
        double size = 2.0;
        if (!angular && by_angle) size = 200.0;
        if (angular && !by_angle) size = 2.0 / 200.0;
        noisy.gain(i, j) += 1e-5 * size * normal(key, index++);
      }
    }
    const auto result = observability(noisy);
    ASSERT_TRUE(result);
    EXPECT_EQ(texts(*result), texts(*expected));
    EXPECT_EQ(result->identified, expected->identified);
  }
}

TEST(Observability, TellsTheSquarenessOfYAndTheTiltAxisOnlyAsTheirDifference) {
  const std::vector<std::string> patterns{"1-a", "2-a", "3", "4"};
  Observations o = planned(patterns);
  for (Unknown& unknown : o.unknowns) {
    if (unknown.name == "g_YX") unknown.fixed.reset();
  }
  const auto result = observability(o);
  ASSERT_TRUE(result);
  EXPECT_EQ(texts(*result),
            (std::vector<std::string>{"g_AY and g_YX cannot be separated: g_AY + "
                                      "g_YX cannot be identified; g_AY - g_YX can"}));
  // Known to 5 urad it is no obstacle.
  for (Unknown& unknown : o.unknowns) {
    if (unknown.name == "g_YX") unknown.prior = Prior{0.0, 5e-6};
  }
  EXPECT_TRUE(observability(o)->complete());
}

// Every direction is invisible and every estimable combination blind to all directions.
TEST(ObservabilityLaws, DirectionsAreUnseenAndCombinationsAreOrthogonalToThem) {
  const std::vector<std::string> all = all_patterns();
  for (unsigned set = 1; set < (1U << all.size()); set += 7) {
    std::vector<std::string> patterns;
    for (std::size_t p = 0; p < all.size(); ++p) {
      if ((set >> p & 1U) != 0) patterns.push_back(all[p]);
    }
    const Observations o = planned(patterns);
    const auto result = observability(o);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->null_space.size(), static_cast<std::size_t>(result->unknowns - result->rank));
    const Eigen::VectorXd sd = o.covariance.diagonal().cwiseSqrt();
    for (const NullDirection& direction : result->null_space) {
      Eigen::VectorXd change = Eigen::VectorXd::Zero(12);
      double size = 0.0;
      for (const Term& term : direction.terms) {
        change[term.unknown] = term.coefficient;
        const Unknown& unknown = o.unknowns[static_cast<std::size_t>(term.unknown)];
        size = std::max(size, std::abs(term.coefficient) / expected_size(unknown));
      }
      // Moved by its expected size: far below the noise.
      const Eigen::VectorXd seen = (o.gain * change).cwiseQuotient(sd) / size;
      EXPECT_LT(seen.cwiseAbs().maxCoeff(), 0.1) << direction.text;
      for (const Combination& combination : result->estimable) {
        double product = 0.0;
        double scale = 0.0;
        for (const Term& term : combination.terms) {
          product += term.coefficient * change[term.unknown];
          scale = std::max(scale, std::abs(term.coefficient * change[term.unknown]));
        }
        EXPECT_LE(std::abs(product), 1e-2 * scale) << direction.text << "; " << combination.text;
      }
    }
  }
}

TEST(ObservabilityLaws, TellsLessTheCoarserTheMeasurement) {
  const Observations fine = planned(all_patterns());
  int before = 9;
  for (double coarser = 1.0; coarser < 1e12; coarser *= 3.0) {
    Observations o = fine;
    o.covariance *= coarser;
    o.values.setConstant(1e-6);
    const auto result = identify(o);
    ASSERT_TRUE(result);
    EXPECT_LE(result->observability.rank, before);
    before = result->observability.rank;
    for (const Estimate& estimate : result->estimates) {
      EXPECT_TRUE(std::isfinite(estimate.value.value_or(0.0)));
    }
    EXPECT_EQ(result->observability.null_space.size(), static_cast<std::size_t>(9 - before));
  }
  EXPECT_EQ(before, 0);
}

Candidate candidate(const std::string& pattern) {
  const std::vector<std::string> one{pattern};
  const Observations o = planned(one);
  return {pattern, o.rows, o.gain, o.covariance};
}

TEST(Separation, NamesThePatternThatRemovesTheNullSpace) {
  const std::vector<std::string> have{"1-a", "2-a"};
  const std::vector<Candidate> candidates{candidate("5-a"), candidate("3"), candidate("4")};
  const auto result = separating(planned(have), candidates);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->rank_before, 5);
  EXPECT_EQ(result->unknowns, 9);
  ASSERT_EQ(result->by_rank.size(), 3U);
  EXPECT_EQ(result->by_rank[0].candidate, 2U);
  EXPECT_EQ(result->by_rank[0].rank, 9);
  EXPECT_EQ(result->smallest, (std::vector<std::size_t>{2}));
}

TEST(Separation, NeedsTwoPatternsWhereNoneIsEnough) {
  const std::vector<std::string> have{"1-a", "1-b"};
  const std::vector<Candidate> candidates{candidate("5-a"), candidate("2-a"), candidate("4"),
                                          candidate("2-b")};
  const auto result = separating(planned(have), candidates);
  ASSERT_TRUE(result);
  ASSERT_TRUE(result->smallest);
  EXPECT_EQ(result->smallest->size(), 2U);
  EXPECT_TRUE(std::count(result->smallest->begin(), result->smallest->end(), 2U));
  const auto none = separating(planned(have), std::span(candidates).first(1));
  EXPECT_FALSE(none->smallest);
  const std::vector<std::string> enough{"1-a", "2-a", "3", "4"};
  EXPECT_EQ(separating(planned(enough), candidates)->smallest, std::vector<std::size_t>{});
  const std::vector<Candidate> many(kMostCandidates + 1, candidates[0]);
  EXPECT_FALSE(separating(planned(have), many));
}

TEST(SparseBasis, FindsTheSparsestVectorsOfAMixedBasis) {
  Eigen::MatrixXd sparse(6, 3);
  sparse << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, -1, 0;
  Eigen::Matrix3d mix;
  mix << 1, 2, 3, -1, 1, 0.5, 2, 0.25, -1;
  const Eigen::MatrixXd mixed = sparse * mix;
  const Eigen::MatrixXd q =
      Eigen::HouseholderQR<Eigen::MatrixXd>(mixed).householderQ() * Eigen::MatrixXd::Identity(6, 3);
  const Eigen::MatrixXd found = sparse_basis(q, 1e-9);
  ASSERT_EQ(found.cols(), 3);
  EXPECT_NEAR(found(3, 0), 1.0, 1e-12);                 // one entry
  EXPECT_NEAR(found(0, 1) / found(1, 1), -1.0, 1e-12);  // two
  EXPECT_NEAR(found(4, 2) / found(2, 2), 2.0, 1e-12);   // three
  EXPECT_EQ((found.array() != 0.0).count(), 6);
}

TEST(SparseBasis, SpansTheSubspaceWhereNothingIsSparse) {
  const Eigen::MatrixXd q =
      Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd::Random(12, 4)).householderQ() *
      Eigen::MatrixXd::Identity(12, 4);
  const Eigen::MatrixXd found = sparse_basis(q, 1e-9);
  ASSERT_EQ(found.cols(), 4);
  EXPECT_LT((found - q * (q.transpose() * found)).norm(), 1e-9);
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(found).rank(), 4);
}

}  // namespace
}  // namespace frustum::calibration
