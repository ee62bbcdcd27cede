#include "calibration/design/design.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "calibration/identify/identification.hpp"
#include "tests/calibration/step_patterns.hpp"

namespace frustum::calibration {
namespace {

std::vector<DesignBlock> blocks_of(const Observations& o) {
  std::vector<DesignBlock> blocks;
  for (const std::string& name : all_patterns()) {
    DesignBlock block{name, {}};
    for (std::size_t i = 0; i < o.rows.size(); ++i) {
      if (o.rows[i].group == name) block.rows.push_back(static_cast<Eigen::Index>(i));
    }
    blocks.push_back(block);
  }
  return blocks;
}

std::string names(const std::vector<std::size_t>& set) {
  std::string text;
  for (const std::size_t b : set) text += (text.empty() ? "" : " ") + all_patterns()[b];
  return text;
}

// One reading of all patterns that share their noise as one CMM's scale error would.
Observations correlated() {
  Observations o = planned(all_patterns());
  const Eigen::VectorXd sd = o.covariance.diagonal().cwiseSqrt();
  const auto n = static_cast<Eigen::Index>(o.rows.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i != j) o.covariance(i, j) = 0.3 * sd[i] * sd[j];
    }
  }
  return o;
}

TEST(StepDesignReference, FindsWhichSetsIdentifyEverything) {
  const Observations o = planned(all_patterns());
  const std::vector<DesignBlock> blocks = blocks_of(o);
  const auto result = design(o, blocks);
  ASSERT_TRUE(result) << result.error().front().message;
  ASSERT_EQ(result->best_of_size.size(), 11U);
  // The paper calls {1-a, 2-a, 3, 4} the minimum; the height difference of pattern 4 identifies
  // dy_AY too, so that three with pattern 4 are enough. Counted independently as well.
  const std::vector<std::size_t> counts(result->identifying_sets.begin(),
                                        result->identifying_sets.begin() + 5);
  EXPECT_EQ(counts, (std::vector<std::size_t>{0, 0, 10, 67, 217}));
  EXPECT_EQ(result->best_of_size[1].rank, 8);
  EXPECT_EQ(names(result->best_of_size[2].blocks), "1-b 2-a 4");
  EXPECT_NEAR(*result->best_of_size[2].log_det, 70.58353778328436, 1e-4);
  EXPECT_EQ(names(result->best_of_size[3].blocks), "1-b 2-a 3 4");
  EXPECT_EQ(names(result->best_of_size[4].blocks), "1-b 2-a 3 4 5-b");
  EXPECT_EQ(names(result->smallest->blocks), "1-b 2-a 4");
  ASSERT_EQ(result->smallest_identifying.size(), 10U);
  for (const auto& set : result->smallest_identifying) {
    EXPECT_TRUE(std::count(set.begin(), set.end(), 5U)) << names(set);
  }
}

TEST(StepDesignReference, FindsThePublishedSetsAmongThose) {
  const Observations o = planned(all_patterns());
  const std::vector<DesignBlock> blocks = blocks_of(o);
  DesignOptions case_1;
  case_1.required = {0, 2, 4, 5};
  const auto result = design(o, blocks, case_1);
  ASSERT_TRUE(result);
  EXPECT_EQ(names(result->smallest->blocks), "1-a 2-a 3 4");
  EXPECT_EQ(result->identifying_sets.front(), 1U);
  const nlohmann::json& sd = step_data()["identifiability"]["Case 1 {1-a,2-a,3,4}"]["sd"];
  for (std::size_t j = 0; j < o.unknowns.size(); ++j) {
    if (o.unknowns[j].is_fixed()) continue;
    EXPECT_NEAR(*result->smallest->standard_deviations[j] * (o.unknowns[j].angular ? 1e6 : 1e3),
                sd[o.unknowns[j].name].get<double>(), 1e-6);
  }
  // Without pattern 4 no three are enough.
  std::vector<DesignBlock> others = blocks;
  others.erase(others.begin() + 5);
  const auto without = design(o, others);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->identifying_sets[2], 0U);
  EXPECT_EQ(without->smallest->blocks.size(), 4U);
}

// The optimum by plain evaluation of each set.
TEST(StepDesign, AgreesWithEvaluationOfEverySetForAllCriteria) {
  for (const Observations& o : {planned(all_patterns()), correlated()}) {
    const std::vector<DesignBlock> all = blocks_of(o);
    const std::vector<DesignBlock> blocks{all[0], all[2], all[4], all[5], all[10]};
    for (const DesignCriterion criterion :
         {DesignCriterion::d_optimal, DesignCriterion::a_optimal, DesignCriterion::worst_unknown}) {
      DesignOptions options;
      options.criterion = criterion;
      const auto result = design(o, blocks, options);
      ASSERT_TRUE(result);
      std::map<std::size_t, std::pair<double, std::vector<std::size_t>>> best;
      for (unsigned set = 1; set < 32; ++set) {
        std::vector<Eigen::Index> rows;
        std::vector<std::size_t> members;
        for (std::size_t b = 0; b < 5; ++b) {
          if ((set >> b & 1U) == 0) continue;
          members.push_back(b);
          rows.insert(rows.end(), blocks[b].rows.begin(), blocks[b].rows.end());
        }
        const auto fit = identify(o.selected(rows));
        ASSERT_TRUE(fit);
        if (!fit->observability.complete()) continue;
        double value = 0.0;
        if (criterion == DesignCriterion::d_optimal) {
          for (const double s : fit->observability.singular_values) value -= 2.0 * std::log(s);
        }
        for (std::size_t j = 0; j < o.unknowns.size(); ++j) {
          if (o.unknowns[j].is_fixed()) continue;
          const double ratio =
              *fit->estimates[j].standard_uncertainty / expected_size(o.unknowns[j]);
          if (criterion == DesignCriterion::a_optimal) value += ratio * ratio;
          if (criterion == DesignCriterion::worst_unknown) value = std::max(value, ratio);
        }
        const auto hit = best.find(members.size());
        if (hit == best.end() || value < hit->second.first) best[members.size()] = {value, members};
      }
      for (const auto& [size, expected] : best) {
        const DesignChoice& choice = result->best_of_size[size - 1];
        EXPECT_TRUE(choice.identifies_all);
        EXPECT_NEAR(choice.criterion, expected.first, 1e-7 * std::abs(expected.first));
        EXPECT_EQ(choice.blocks, expected.second);
      }
    }
  }
}

TEST(StepDesign, TakesElevenPatternsThatAllShareNoise) {
  const Observations o = correlated();
  const auto result = design(o, blocks_of(o));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->best_of_size.size(), 11U);
  EXPECT_EQ(result->identifying_sets[2], 10U);
}

TEST(StepDesign, KeepsLimitsExclusionsAndPriors) {
  Observations o = planned(all_patterns());
  const std::vector<DesignBlock> blocks = blocks_of(o);
  DesignOptions options;
  options.exclusive = {{4, 5}};  // 3 and 4 are cut from the same material
  options.limits.assign(o.unknowns.size(), std::nullopt);
  options.limits[1] = 1.2e-6;  // beta_AY
  const auto result = design(o, blocks, options);
  ASSERT_TRUE(result);
  ASSERT_TRUE(result->smallest);
  EXPECT_LE(*result->smallest->standard_deviations[1], 1.2e-6);
  EXPECT_GT(result->smallest->blocks.size(), 3U);
  for (const DesignChoice& choice : result->best_of_size) {
    EXPECT_FALSE(std::count(choice.blocks.begin(), choice.blocks.end(), 4U) &&
                 std::count(choice.blocks.begin(), choice.blocks.end(), 5U));
  }
  EXPECT_EQ(result->best_of_size.size(), 10U);  // never all eleven
  options.limits[1] = 1e-12;
  EXPECT_FALSE(design(o, blocks, options)->smallest);
  // beta_CA known from elsewhere: two patterns may be enough.
  for (Unknown& unknown : o.unknowns) {
    if (unknown.name == "b_CA") unknown.prior = Prior{0.0, 2e-6};
    if (unknown.name == "dx_AY") unknown.fixed = 0.0;
  }
  EXPECT_LE(design(o, blocks)->smallest->blocks.size(), 2U);
}

// What a set of blocks tells, by an identification of its own: rank, and log det where complete.
struct Told {
  bool is_complete = false;
  double log_det = 0.0;
};
Told told_by(const Observations& o, std::span<const DesignBlock> blocks, unsigned set) {
  std::vector<Eigen::Index> rows;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if ((set >> b & 1U) == 0) continue;
    rows.insert(rows.end(), blocks[b].rows.begin(), blocks[b].rows.end());
  }
  const auto fit = identify(o.selected(rows));
  Told told;
  if (!fit) return told;
  told.is_complete = fit->observability.complete();
  for (const double s : fit->observability.singular_values) told.log_det += 2.0 * std::log(s);
  return told;
}

TEST(StepDesign, TheChoiceUnderABudgetIsThatOfSearchingEverySet) {
  for (const Observations& o : {planned(all_patterns()), correlated()}) {
    const std::vector<DesignBlock> all = blocks_of(o);
    const std::vector<DesignBlock> blocks{all[0], all[1], all[2], all[4], all[5], all[10]};
    const std::vector<double> costs{1.5, 0.9, 1.1, 2.0, 0.4, 0.8};
    std::size_t complete = 0;
    for (const double budget : {0.3, 1.0, 2.0, 2.4, 3.5, 4.4, 6.0, 10.0}) {
      DesignOptions options;
      options.costs = costs;
      options.budget = budget;
      const auto result = design(o, blocks, options);
      ASSERT_TRUE(result);
      std::optional<std::pair<double, unsigned>> best;
      for (unsigned set = 1; set < 64; ++set) {
        double cost = 0.0;
        for (std::size_t b = 0; b < 6; ++b) cost += (set >> b & 1U) != 0 ? costs[b] : 0.0;
        if (cost > budget) continue;
        const Told told = told_by(o, blocks, set);
        if (told.is_complete && (!best || told.log_det > best->first)) best = {told.log_det, set};
      }
      if (!best) {
        EXPECT_TRUE(!result->within_budget || !result->within_budget->identifies_all) << budget;
        continue;
      }
      ++complete;
      ASSERT_TRUE(result->within_budget) << budget;
      unsigned chosen = 0;
      double cost = 0.0;
      for (const std::size_t b : result->within_budget->blocks) {
        chosen |= 1U << b;
        cost += costs[b];
      }
      EXPECT_EQ(chosen, best->second) << budget;
      EXPECT_NEAR(*result->within_budget->log_det, best->first, 1e-7 * std::abs(best->first));
      EXPECT_NEAR(result->within_budget->cost, cost, 1e-12);
      EXPECT_LE(cost, budget);
    }
    EXPECT_GE(complete, 3U);
    EXPECT_LT(complete, 8U);
  }
  Observations o = planned(all_patterns());
  DesignOptions options;
  options.costs = {1.0, -1.0};
  EXPECT_FALSE(design(o, blocks_of(o), options));
}

TEST(StepDesign, BitsAreOfTheUnknownsOfInterest) {
  Observations o;
  o.unknowns = {{"p", false, {}, {}}, {"q", false, Prior{0.0, 0.015}, {}}};
  o.rows = {{"sum", "A", false}, {"p", "B", false}};
  o.gain = Eigen::MatrixXd::Ones(2, 2);
  o.gain(1, 1) = 0.0;
  o.covariance = Eigen::MatrixXd::Identity(2, 2) * 1e-6;
  const std::vector<DesignBlock> blocks{{"A", {0}}, {"B", {1}}};
  const double a = 15.0 * 15.0;  // what is expected over the noise, squared
  auto result = design(o, blocks);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->alone[0].bits, 0.5 * std::log2(1.0 + 2.0 * a), 1e-9);
  EXPECT_NEAR(result->alone[1].bits, 0.5 * std::log2(1.0 + a), 1e-9);
  // Of p alone the sum gives half a bit, whatever its noise; none where q may be anything.
  DesignOptions options;
  options.no_interest = {1};
  result = design(o, blocks, options);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->alone[0].bits, 0.5 * std::log2((1.0 + 2.0 * a) / (1.0 + a)), 1e-9);
  EXPECT_NEAR(result->alone[1].bits, 0.5 * std::log2(1.0 + a), 1e-9);
  o.unknowns[1].prior.reset();
  result = design(o, blocks, options);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->alone[0].bits, 0.0, 1e-9);
  EXPECT_NEAR(result->alone[1].bits, 0.5 * std::log2(1.0 + a), 1e-9);
}

TEST(StepDesign, CountsSharedReferencesOnce) {
  // Two blocks with the same noise and gain: the second adds nothing.
  Observations o;
  o.unknowns = {{"p", false, {}, {}}};
  o.rows = {{"a", "A", false}, {"b", "B", false}, {"c", "C", false}};
  o.gain = Eigen::MatrixXd::Ones(3, 1);
  o.covariance = Eigen::MatrixXd::Identity(3, 3) * 1e-6;
  o.covariance(0, 1) = o.covariance(1, 0) = 1e-6;
  o.covariance(2, 2) = 4e-6;
  const std::vector<DesignBlock> blocks{{"A", {0}}, {"B", {1}}, {"C", {2}}};
  const auto result = design(o, blocks);
  ASSERT_TRUE(result) << result.error().front().message;
  EXPECT_EQ(result->best_of_size[0].blocks, (std::vector<std::size_t>{0}));  // tie: the first
  EXPECT_EQ(result->best_of_size[1].blocks, (std::vector<std::size_t>{0, 2}));
  EXPECT_NEAR(*result->best_of_size[2].standard_deviations[0],
              *result->best_of_size[1].standard_deviations[0], 1e-12);
}

TEST(StepDesign, RefusesBlocksThatMakeNoSense) {
  const Observations o = planned(all_patterns());
  const std::vector<DesignBlock> blocks = blocks_of(o);
  EXPECT_FALSE(design(o, {}));
  const std::vector<DesignBlock> many(kMostBlocks + 1, blocks[0]);
  EXPECT_FALSE(design(o, many));
  const std::vector<DesignBlock> twice{blocks[0], blocks[0]};
  EXPECT_FALSE(design(o, twice));
  const std::vector<DesignBlock> outside{{"x", {500}}};
  EXPECT_FALSE(design(o, outside));
  DesignOptions options;
  options.required = {11};
  EXPECT_FALSE(design(o, blocks, options));
  options = {};
  options.limits = {1.0};
  EXPECT_FALSE(design(o, blocks, options));
}

}  // namespace
}  // namespace frustum::calibration
