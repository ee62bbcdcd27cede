#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrology/characteristic/gaussian_filter.hpp"
#include "metrology/characteristic/harmonics.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct Profile {
  std::vector<double> place{};
  std::vector<double> value{};
};
template <typename Value>
Profile sampled(int count, double step, Value value) {
  Profile p;
  for (int i = 0; i < count; ++i) {
    p.place.push_back(i * step);
    p.value.push_back(value(p.place.back()));
  }
  return p;
}

double amplitude(const Profile& p, const std::vector<double>& value, int order) {
  double c = 0.0;
  double s = 0.0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    c += value[i] * std::cos(order * p.place[i]);
    s += value[i] * std::sin(order * p.place[i]);
  }
  return 2.0 * std::hypot(c, s) / static_cast<double>(value.size());
}

TEST(GaussianFilter, LeavesHalfOfAnUndulationAtTheCutOff) {
  for (const int upr : {15, 50, 150}) {
    const Profile p = sampled(16 * upr, kTurn / (16 * upr),
                              [&](double a) { return 0.003 * std::cos(upr * a + 0.4); });
    const auto smooth = closed_waviness(p.place, p.value, upr);
    ASSERT_TRUE(smooth);
    EXPECT_NEAR(amplitude(p, *smooth, upr) / 0.003, 0.5, 1e-12) << upr;
  }
}

TEST(GaussianFilter, TransmitsByTheSquareOfTheFrequency) {
  const Profile empty = sampled(1440, kTurn / 1440, [](double) { return 0.0; });
  for (const int order : {1, 5, 10, 25, 60, 100, 150}) {
    Profile p = empty;
    for (std::size_t i = 0; i < p.place.size(); ++i) p.value[i] = std::sin(order * p.place[i]);
    const auto smooth = closed_waviness(p.place, p.value, 50.0);
    ASSERT_TRUE(smooth);
    const double share = order / 50.0;
    EXPECT_NEAR(amplitude(p, *smooth, order), std::exp2(-share * share), 1e-12) << order;
  }
}

TEST(GaussianFilter, KeepsConstantsWhateverTheSteps) {
  synthetic::Draws draws(51);
  Profile p;
  for (int i = 0; i < 500; ++i) {
    p.place.push_back(draws.between(-1.0, 8.0));  // any turn, any order
    p.value.push_back(0.007);
  }
  const auto smooth = closed_waviness(p.place, p.value, 5.0);
  ASSERT_TRUE(smooth);
  for (const double v : *smooth) EXPECT_NEAR(v, 0.007, 1e-16);
}

TEST(GaussianFilter, FollowsOpenProfilesToTheirEnds) {
  // A slope is no undulation: it stays, at the ends too.
  const Profile line = sampled(200, 0.05, [](double x) { return 0.01 + 0.002 * x; });
  const auto same = open_waviness(line.place, line.value, 0.8);
  ASSERT_TRUE(same);
  for (std::size_t i = 0; i < same->size(); ++i) {
    EXPECT_NEAR((*same)[i], line.value[i], 1e-15) << i;
  }
  // In the middle an undulation at the cut-off keeps half.
  const Profile wave =
      sampled(400, 0.05, [](double x) { return 0.001 * std::cos(kTurn * (x - 10.0) / 0.8); });
  const auto half = open_waviness(wave.place, wave.value, 0.8);
  ASSERT_TRUE(half);
  EXPECT_NEAR((*half)[200] / 0.001, 0.5, 1e-12);
}

TEST(GaussianFilter, LeavesABand) {
  const Profile p = sampled(1440, kTurn / 1440, [](double a) {
    return std::cos(2.0 * a) + std::cos(15.0 * a) + std::cos(200.0 * a);
  });
  const auto kept = closed_band({50.0, 5.0, 0.0, 0.0}, p.place, p.value);
  ASSERT_TRUE(kept);
  const auto through = [](double order, double cutoff) {
    return std::exp2(-order * order / (cutoff * cutoff));
  };
  for (const double order : {2.0, 15.0, 200.0}) {
    EXPECT_NEAR(amplitude(p, *kept, static_cast<int>(order)),
                through(order, 50.0) * (1.0 - through(order, 5.0)), 1e-12)
        << order;
  }
}

TEST(GaussianFilter, AsksForEnoughPointsAWave) {
  const Profile p = sampled(36, kTurn / 36, [](double a) { return a; });
  EXPECT_TRUE(closed_waviness(p.place, p.value, 5.0));
  EXPECT_EQ(closed_waviness(p.place, p.value, 15.0).error().front().message,
            "the closed profile has 2.4 points a wave of the filter's cut-off, it needs 7");
  // Half a turn is not closed.
  const Profile arc = sampled(180, kTurn / 360, [](double) { return 0.0; });
  EXPECT_FALSE(closed_waviness(arc.place, arc.value, 5.0));
  EXPECT_FALSE(open_waviness(arc.place, arc.value, 0.05));
  EXPECT_FALSE(open_waviness(std::vector<double>{1.0}, std::vector<double>{1.0}, 0.05));
}

// As the definition says: all samples for each.
double summed_around(const Profile& p, double at, double cutoff, double turn) {
  double w = 0.0, wx = 0.0, wxx = 0.0, wy = 0.0, wxy = 0.0;
  const std::size_t n = p.place.size();
  for (int lap = turn > 0.0 ? -3 : 0; lap <= (turn > 0.0 ? 3 : 0); ++lap) {
    for (std::size_t j = 0; j < n; ++j) {
      const double before = j > 0        ? p.place[j] - p.place[j - 1]
                            : turn > 0.0 ? p.place[0] + turn - p.place[n - 1]
                                         : 0.0;
      const double after = j + 1 < n    ? p.place[j + 1] - p.place[j]
                           : turn > 0.0 ? p.place[0] + turn - p.place[n - 1]
                                        : 0.0;
      const double x = p.place[j] + lap * turn - at;
      const double u = x / cutoff;
      const double g = 0.5 * (before + after) *
                       std::exp(-std::numbers::pi * std::numbers::pi / std::numbers::ln2 * u * u);
      w += g;
      wx += g * x;
      wxx += g * x * x;
      wy += g * p.value[j];
      wxy += g * x * p.value[j];
    }
  }
  return turn > 0.0 ? wy / w : (wxx * wy - wx * wxy) / (w * wxx - wx * wx);
}

TEST(GaussianFilter, Fault2_59_ManyPointsAreAsExactAsFew) {
  synthetic::Draws draws(53);
  Profile p;
  for (int i = 0; i < 3000; ++i) {
    p.place.push_back(kTurn * (i + draws.between(-0.4, 0.4) + 0.5) / 3000);
    p.value.push_back(draws.between(-1.0, 1.0) + std::sin(3.0 * p.place.back()));
  }
  for (const double upr : {1.0, 2.5, 5.0, 9.0}) {
    const auto closed = closed_waviness(p.place, p.value, upr);
    const auto open = open_waviness(p.place, p.value, kTurn / upr);
    ASSERT_TRUE(closed && open);
    for (std::size_t i = 0; i < p.place.size(); i += 97) {
      EXPECT_NEAR((*closed)[i], summed_around(p, p.place[i], kTurn / upr, kTurn), 1e-14) << upr;
      EXPECT_NEAR((*open)[i], summed_around(p, p.place[i], kTurn / upr, 0.0), 1e-13) << upr;
    }
  }
}

TEST(GaussianFilter, Fault2_59_AMillionPointsTakeSeconds) {
  // Each against each within reach would be 2e11 weights, an hour.
  constexpr int kCount = 1000000;
  const Profile p = sampled(kCount, kTurn / kCount,
                            [](double a) { return std::cos(15.0 * a) + std::cos(400.0 * a); });
  const auto smooth = closed_waviness(p.place, p.value, 15.0);
  ASSERT_TRUE(smooth);
  for (std::size_t i = 0; i < p.place.size(); i += 9973) {
    EXPECT_NEAR((*smooth)[i], 0.5 * std::cos(15.0 * p.place[i]), 1e-12);
  }
}

TEST(GaussianFilter, Fault2_60_SaysWhereAGapIs) {
  Profile p = sampled(360, kTurn / 360, [](double a) { return std::cos(a); });
  p.place.erase(p.place.begin() + 101, p.place.begin() + 131);
  p.value.erase(p.value.begin() + 101, p.value.begin() + 131);
  EXPECT_TRUE(closed_waviness(p.place, p.value, 1.0));  // 51 deg would do
  const auto refused = closed_waviness(p.place, p.value, 15.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().message,
            "the closed profile has a gap of 31 deg after 100 deg: a point every 3.43 "
            "deg is needed for 7 a wave of the filter's cut-off");
  // The gap across the zero direction, and a second one.
  p.place.erase(p.place.begin(), p.place.begin() + 50);
  p.value.erase(p.value.begin(), p.value.begin() + 50);
  const auto twice = closed_waviness(p.place, p.value, 15.0);
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().front().message.find("2 gaps, the largest of 51 deg after 359 deg"),
            std::string::npos)
      << twice.error().front().message;
}

TEST(Harmonics, FindsAmplitudesAndPhasesAtUnevenAngles) {
  synthetic::Draws draws(52);
  std::vector<double> angle;
  std::vector<double> deviation;
  for (int i = 0; i < 300; ++i) {
    angle.push_back(draws.between(0.0, kTurn));
    deviation.push_back(0.5 + 0.003 * std::cos(3.0 * angle.back() - 1.0) +
                        0.002 * std::cos(7.0 * angle.back() + 2.0));
  }
  const auto found = harmonics(angle, deviation, 10);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 10U);
  for (const Harmonic& h : *found) {
    const double expected = h.order == 3 ? 0.003 : h.order == 7 ? 0.002 : 0.0;
    EXPECT_NEAR(h.amplitude, expected, 1e-14) << h.order;
  }
  EXPECT_NEAR((*found)[2].phase, 1.0, 1e-11);
  EXPECT_NEAR((*found)[6].phase, -2.0, 1e-11);
}

TEST(Harmonics, RefusesWhatThePointsDoNotTell) {
  std::vector<double> angle;
  for (int i = 0; i < 100; ++i) angle.push_back(0.001 * i);
  EXPECT_FALSE(harmonics(angle, angle, 10));
  EXPECT_EQ(harmonics(angle, angle, 50).error().front().message,
            "50 undulations per revolution need 101 points, given are 100");
}

}  // namespace
}  // namespace frustum::metrology
