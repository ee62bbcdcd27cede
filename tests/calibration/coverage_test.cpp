// Stated intervals hold what they state: ten random machines, 200 noise draws each, on the linear
// model of all eleven patterns.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <string>

#include "calibration/identify/identification.hpp"
#include "core/random.hpp"
#include "tests/calibration/step_patterns.hpp"

namespace frustum::calibration {
namespace {

constexpr std::uint64_t kSeed = 20240607;
constexpr std::uint32_t kMachines = 10;
constexpr std::uint32_t kRepetitions = 200;
constexpr double kSquareness = 50e-6;      // rad, spread over machines
constexpr double kSquarenessKnown = 5e-6;  // rad

bool squareness(const Unknown& unknown) {
  return unknown.name == "g_YX" || unknown.name == "a_ZY" || unknown.name == "b_ZX";
}

// Location errors 30 urad and 15 um, squareness 50 urad, tool radius 10 um.
Eigen::VectorXd machine(const Observations& o, std::uint32_t number) {
  const RandomKey key{kSeed, number, RandomPurpose::test_data};
  Eigen::VectorXd errors(static_cast<Eigen::Index>(o.unknowns.size()));
  for (Eigen::Index j = 0; j < errors.size(); ++j) {
    const Unknown& unknown = o.unknowns[static_cast<std::size_t>(j)];
    double size = unknown.angular ? 30e-6 : 15e-3;
    if (squareness(unknown)) size = kSquareness;
    if (unknown.name == "d_r") size = 10e-3;
    errors[j] = size * normal(key, static_cast<std::uint64_t>(j));
  }
  return errors;
}

// Noise of the rows, correlated by `shared` as one measuring machine's scale would.
Observations with_shared_noise(double shared) {
  Observations o = planned(all_patterns());
  const Eigen::VectorXd sd = o.covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd variances = o.covariance.diagonal();
  o.covariance = shared * sd * sd.transpose();
  o.covariance.diagonal() = variances;
  for (Unknown& unknown : o.unknowns) unknown.fixed.reset();
  return o;
}

struct Tally {
  Eigen::VectorXd inside, bias;
  int rejected = 0;
};

Tally repeat(Observations o) {
  const auto count = static_cast<Eigen::Index>(o.unknowns.size());
  const auto rows = static_cast<Eigen::Index>(o.rows.size());
  Tally tally{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
  const Eigen::LLT<Eigen::MatrixXd> root(o.covariance);
  for (std::uint32_t number = 0; number < kMachines; ++number) {
    const Eigen::VectorXd truth = machine(o, number);
    for (std::uint32_t draw = 0; draw < kRepetitions; ++draw) {
      const RandomKey key{kSeed + 1, number * kRepetitions + draw, RandomPurpose::test_data};
      Eigen::VectorXd noise(rows);
      for (Eigen::Index i = 0; i < rows; ++i) noise[i] = normal(key, static_cast<std::uint64_t>(i));
      o.values = o.gain * truth + root.matrixL() * noise;
      for (Eigen::Index j = 0; j < count; ++j) {
        Unknown& unknown = o.unknowns[static_cast<std::size_t>(j)];
        if (!squareness(unknown)) continue;
        const double off = kSquarenessKnown * normal(key, static_cast<std::uint64_t>(rows + j));
        unknown.prior = Prior{truth[j] + off, kSquarenessKnown};
      }
      const auto result = identify(o);
      if (!result) {
        ADD_FAILURE() << result.error().front().message;
        return tally;
      }
      for (Eigen::Index j = 0; j < count; ++j) {
        const Estimate& e = result->estimates[static_cast<std::size_t>(j)];
        if (*e.lower <= truth[j] && truth[j] <= *e.upper) tally.inside[j] += 1.0;
        tally.bias[j] += (*e.value - truth[j]) / *e.standard_uncertainty;
      }
      tally.rejected += result->agreement.rejected ? 1 : 0;
    }
  }
  constexpr double kDraws = kMachines * kRepetitions;
  tally.inside /= kDraws;
  tally.bias /= kDraws;
  return tally;
}

void expect_calibrated(double shared) {
  const Observations o = with_shared_noise(shared);
  const Tally tally = repeat(o);
  // Of 2000 draws the share inside scatters by 0.005 and the mean by 0.022 standard deviations: the
  // limits asked for (0.90 to 0.985, 0.1) lie 7 and 4.5 of those away; held are 0.02 and 0.1.
  for (Eigen::Index j = 0; j < tally.inside.size(); ++j) {
    const std::string& name = o.unknowns[static_cast<std::size_t>(j)].name;
    EXPECT_NEAR(tally.inside[j], 0.95, 0.02) << name;
    EXPECT_LT(std::abs(tally.bias[j]), 0.1) << name;
  }
  // One right model in a hundred is rejected: 20 of 2000, give or take 4.5.
  EXPECT_GT(tally.rejected, 3);
  EXPECT_LT(tally.rejected, 40);
  testing::Test::RecordProperty("lowest", std::to_string(tally.inside.minCoeff()));
  testing::Test::RecordProperty("highest", std::to_string(tally.inside.maxCoeff()));
  testing::Test::RecordProperty("bias", std::to_string(tally.bias.cwiseAbs().maxCoeff()));
  testing::Test::RecordProperty("rejected", tally.rejected);
}

TEST(CoverageLaws, IntervalsHoldAtTheirRateWithIndependentNoise) { expect_calibrated(0.0); }
TEST(CoverageLaws, IntervalsHoldAtTheirRateWithSharedNoise) { expect_calibrated(0.5); }

}  // namespace
}  // namespace frustum::calibration
