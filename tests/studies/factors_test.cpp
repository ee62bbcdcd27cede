#include "studies/laws/factors.hpp"

#include <cmath>

#include "core/random.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "studies/laws/correlation.hpp"
#include "studies/laws/error_pattern.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

using kinematics::ErrorEntry;

std::vector<ErrorEntry> entries_of(const std::vector<std::string>& texts,
                                   const kinematics::DrawnQuantities& drawn = {}) {
  std::vector<ErrorEntry> entries;
  for (const std::string& text : texts) {
    auto entry = kinematics::parse_error(text, drawn);
    EXPECT_TRUE(entry) << text;
    entries.push_back(*std::move(entry));
  }
  return entries;
}

const kinematics::Machine& machine() {
  static const kinematics::Machine kMachine = machine_named("iwf-bc");
  return kMachine;
}

TEST(FactorsReference, StreamsAndDrawsAreThoseOfTheIndependentComputation) {
  for (const auto& [place, number] : expected()["stream_numbers"].items()) {
    EXPECT_EQ(std::to_string(kinematics::stream_of(place)), number.get<std::string>());
  }
  const FactorSet& set = RingPopulation::of("proposed/cone", 'A').set;
  std::vector<double> values(set.variables().size());
  std::size_t compared = 0;
  for (std::uint32_t d = 0; d < 3; ++d) {
    set.draw(1, d, values);
    for (const DrawnAmount& amount : set.amounts()) {
      const std::string place = amount.name.substr(amount.name.find('/') + 1);
      const nlohmann::json& row = expected()["draws_seed_1"][place];
      if (amount.name.starts_with("phases/")) {
        EXPECT_NEAR(amount(values) * kDegPerRad, row["phase_deg"][d].get<double>(), 1e-9 * 0.5);
      } else {
        const double unit = amount.unit == UnitKind::angle ? 1e6 : 1e3;
        // The numbers have twelve digits.
        EXPECT_NEAR(amount(values) * unit, row["amount"][d].get<double>(), 1e-10) << place;
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3U * set.variables().size());
}

TEST(Factors, DrawWhatFrustumRunDraws) {
  const auto entries = errors_of_file("bossoni-cone-limits");
  const FactorSet& set = RingPopulation::of("proposed/cone", 'A').set;
  std::vector<double> values(set.variables().size());
  for (const std::uint32_t d : {0U, 7U, 100000U}) {
    set.draw(5, d, values);
    const auto fixed = set.entries_at(values);
    const auto drawn = kinematics::draw(entries, 5, d);
    ASSERT_EQ(fixed.size(), drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(fixed[i].written, drawn[i].written);
  }
}

// Shared quantities, cosines, polynomials, fixed terms, tolerances: the columns by their weights
// are the errors of the entries.
TEST(Factors, ColumnsByTheirWeightsAreTheErrorsOfTheDraw) {
  kinematics::DrawnQuantities drawn;
  drawn["a1"] = *kinematics::parse_distribution("normal 0um sd 2um");
  drawn["zeta"] = *kinematics::parse_distribution("uniform 0deg..360deg");
  const auto entries = entries_of(
      {"EXC=harmonic 1 a1 phase zeta over 0deg..360deg + 2um", "EYC=harmonic 2 3um phase -zeta",
       "EZC=a1*cos(zeta)", "EXX=polynomial 1um uniform -2um..2um triangular -1um..1um",
       "EYX=cyclic nominal 2um tolerance 1um period 30mm phase normal 10deg sd 20deg",
       "EZX=reversal uniform 0um..4um settle 0.1mm", "EX0C=nominal 3um tolerance 2um as normal-2sd",
       "EB0C=10urad"},
      drawn);
  const auto set = FactorSet::make(machine(), entries,
                                   {.read_as = kinematics::ToleranceReading::normal_3sd_cut});
  ASSERT_TRUE(set) << to_string(set.error().front());
  EXPECT_TRUE(set->has_fixed_errors());
  EXPECT_EQ(set->variables().size(), 2U + 2U + 2U + 1U + 1U);
  // a1 and zeta join three terms.
  ASSERT_EQ(set->factors().size(), 5U);
  EXPECT_EQ(set->factors()[0].entries, (std::vector<std::string>{"EXC", "EYC", "EZC"}));
  std::vector<double> values(set->variables().size()), weights(set->columns().size());
  for (std::uint32_t d = 0; d < 20; ++d) {
    set->draw(2, d, values);
    set->weights(values, weights);
    const auto exact = set->errors_at(machine(), values);
    ASSERT_TRUE(exact);
    kinematics::GeometricErrors sum = set->fixed();
    for (std::size_t j = 0; j < weights.size(); ++j) {
      sum = sum.plus(set->columns()[j].unit, weights[j]);
    }
    kinematics::AxisState at;
    for (const auto letter : kinematics::kAxisLetters) {
      at.q[letter] = 0.3 * d - 1.0;
      at.heading[letter] = d % 2 == 0 ? 1.0 : -1.0;
    }
    for (const auto letter : {kinematics::AxisLetter::X, kinematics::AxisLetter::C}) {
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(sum[letter].component[i](letter, at), (*exact)[letter].component[i](letter, at),
                    1e-16);
        EXPECT_NEAR(sum[letter].location[i], (*exact)[letter].location[i], 1e-18);
      }
      EXPECT_EQ(sum[letter].lost_motion, (*exact)[letter].lost_motion);
    }
  }
}

TEST(Factors, MomentsOfWeightsAreThoseOfManyDraws) {
  kinematics::DrawnQuantities drawn;
  drawn["zeta"] = *kinematics::parse_distribution("uniform 0deg..150deg");
  const auto entries = entries_of({"EXC=harmonic 1 uniform -1um..3um phase zeta",
                                   "EYC=harmonic 1 normal 1um sd 2um limit 3um phase zeta+90deg",
                                   "EXX=linear triangular -2um..4um"},
                                  drawn);
  const auto set = FactorSet::make(machine(), entries);
  ASSERT_TRUE(set);
  const WeightMoments moments = set->weight_moments();
  const auto n = static_cast<Eigen::Index>(set->columns().size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n), w(n);
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(n, n);
  std::vector<double> values(set->variables().size());
  constexpr std::uint32_t kDraws = 100000;
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    set->draw(1, d, values);
    set->weights(values, {w.data(), set->columns().size()});
    mean += 1e3 * w / kDraws;
    square += 1e6 * w * w.transpose() / kDraws;
  }
  // Standard errors are 0.005 um and 0.01 um^2.
  EXPECT_LT((1e3 * moments.mean - mean).cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((1e6 * moments.covariance - (square - mean * mean.transpose())).cwiseAbs().maxCoeff(),
            0.07);
}

TEST(Factors, ScaleNamesTermsByPatternKindAndOrderAndTheLastHolds) {
  const auto entries =
      entries_of({"EXX=linear uniform -1um..1um + reversal uniform 0um..4um",
                  "EYX=harmonic 1 uniform -3um..3um + harmonic 2 uniform -2um..2um",
                  "EYY=harmonic 2 uniform -2um..2um"});
  const auto set = FactorSet::make(
      machine(), entries,
      {.scale = {
           {"*", 3.0}, {"E?X:harmonic 2", 0.5}, {"E*:reversal", 0.25}, {"EYY:harmonic", 2.0}}});
  ASSERT_TRUE(set) << to_string(set.error().front());
  std::vector<double> factors;
  for (const DrawnAmount& amount : set->amounts()) factors.push_back(amount.value);
  EXPECT_EQ(factors, (std::vector<double>{3.0, 0.25, 3.0, 0.5, 2.0}));
  EXPECT_EQ(FactorSet::make(machine(), entries, {.scale = {{"EZ?", 0.5}}}).error().front().id,
            "scale-pattern"_id);
  EXPECT_FALSE(ErrorPattern::parse("EXX:harmonc 2"));
  EXPECT_FALSE(ErrorPattern::parse("EXX:linear 2"));
}

TEST(FactorsReference, CorrelatedMembersHaveTheCorrelationOfTheCopula) {
  const auto entries = entries_of({"EX0C=uniform -10um..10um", "EY0C=uniform 0um..4um",
                                   "EZ0Z=normal 1um sd 3um", "EB0C=uniform -5urad..5urad"});
  for (const nlohmann::json& row : expected()["copula"]["rows"]) {
    const double rho = row["rho"];
    Eigen::MatrixXd r(2, 2);
    r << 1.0, rho, rho, 1.0;
    const auto set = FactorSet::make(machine(), entries, {.correlated = {{{"EX0C", "EY0C"}, r}}});
    ASSERT_TRUE(set) << to_string(set.error().front());
    EXPECT_EQ(set->factors().size(), 3U);
    const Eigen::MatrixXd c = set->weight_moments().covariance;
    const double uniform = row["uniform"];
    EXPECT_NEAR(c(0, 1) / std::sqrt(c(0, 0) * c(1, 1)), uniform, 1e-6);
    std::vector<double> x, y, values(set->variables().size());
    for (std::uint32_t d = 0; d < 20000; ++d) {
      set->draw(1, d, values);
      x.push_back(values[0]);
      y.push_back(values[1]);
      ASSERT_LE(std::abs(values[0]), 10e-3);
    }
    // Four standard errors and a little for margins that are no normals.
    EXPECT_NEAR(pearson(x, y), uniform,
                4.5 * (1.0 - uniform * uniform) / std::sqrt(20000.0) + 1e-3);
  }
}

TEST(Factors, TheFirstMemberOfACorrelatedGroupIsDrawnFromItsOwnStream) {
  const auto entries =
      entries_of({"EZ0Z=normal 1um sd 3um", "EX0C=uniform -10um..10um", "EY0C=uniform 0um..4um"});
  Eigen::MatrixXd r(2, 2);
  r << 1.0, 0.6, 0.6, 1.0;
  const auto set = FactorSet::make(machine(), entries, {.correlated = {{{"EX0C", "EY0C"}, r}}});
  ASSERT_TRUE(set);
  std::vector<double> values(3);
  set->draw(1, 5, values);
  const RandomKey key{1, 5, RandomPurpose::error_amount};
  const double u = uniform(key, kinematics::stream_of("EX0C/0/amount/0"));
  const double v = uniform(key, kinematics::stream_of("EY0C/0/amount/0"));
  EXPECT_NEAR(values[1], -10e-3 + 20e-3 * u, 1e-15);
  const double y = 0.6 * normal_quantile(u) + 0.8 * normal_quantile(v);
  EXPECT_NEAR(values[2], 4e-3 * normal_probability(y), 1e-15);
}

TEST(Factors, WrongGroupsAndNothingDrawnAreRefused) {
  const auto entries = entries_of({"EX0C=uniform -1um..1um", "EY0C=uniform -1um..1um",
                                   "EZ0Z=uniform -1um..1um", "EXX=linear uniform -1um..1um"});
  const auto refused = [&](std::vector<std::string> names, const Eigen::MatrixXd& r) {
    const auto set = FactorSet::make(machine(), entries, {.correlated = {{std::move(names), r}}});
    EXPECT_FALSE(set);
    return set ? DiagnosticId{} : set.error().front().id;
  };
  Eigen::MatrixXd r(2, 2);
  r << 1.0, 0.6, 0.6, 1.0;
  EXPECT_EQ(refused({"EX0C", "EX0C"}, r), "correlated-twice"_id);
  EXPECT_EQ(refused({"EX0C", "EXX"}, r), "correlated-name"_id);
  EXPECT_EQ(refused({"EX0C", "EY0C", "EZ0Z"}, r), "correlation-matrix"_id);
  r(0, 1) = 0.5;
  EXPECT_EQ(refused({"EX0C", "EY0C"}, r), "correlation-matrix"_id);
  r << 1.0, 1.5, 1.5, 1.0;
  const auto indefinite =
      FactorSet::make(machine(), entries, {.correlated = {{{"EX0C", "EY0C"}, r}}});
  ASSERT_FALSE(indefinite);
  EXPECT_NE(to_string(indefinite.error().front()).find("smallest eigenvalue is -0.5"),
            std::string::npos);
  const auto fixed = entries_of({"EX0C=3um"});
  ASSERT_FALSE(FactorSet::make(machine(), fixed));
  EXPECT_EQ(FactorSet::make(machine(), fixed).error().front().id, "nothing-drawn"_id);
  EXPECT_FALSE(FactorSet::make(machine(), entries_of({"EX0A=uniform -1um..1um"})));
}

TEST(Factors, APeakThatIsDrawnIsNotLinear) {
  const auto set = FactorSet::make(
      machine(), entries_of({"EZC=tent 8um at uniform 80deg..100deg", "EX0C=uniform -1um..1um"}));
  ASSERT_TRUE(set) << to_string(set.error().front());
  ASSERT_EQ(set->nonlinear().size(), 1U);
  EXPECT_EQ(set->columns().size(), 1U);
}

}  // namespace
}  // namespace frustum::studies
