// Spikes after reversals in a circular test, on traces that are made of closed forms.
#include "instruments/reversal_spikes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace frustum::instruments {
namespace {

constexpr double kLength = 150.0;

// First axis: a spike of 3 um over 0.5 mm and a backlash of 2 um; second: 1 um over 2 mm; both with
// squareness and a centre that is off. By hand: an axis that turns back at the positive end of its
// way moves down from there, and lags outwards.
std::vector<CircleTrace> spiked(double first, double second, double noise) {
  std::vector<CircleTrace> traces;
  for (const Sense sense : kSenses) {
    const double w = sense == Sense::ccw ? 1.0 : -1.0;
    CircleTrace trace{.sense = sense};
    for (int i = 0; i < 3600; ++i) {
      const double phi = (i + 0.5) * 2.0 * std::numbers::pi / 3600.0;
      const double c = std::cos(phi), s = std::sin(phi);
      const bool x_falls = w * s > 0.0, y_rises = w * c > 0.0;
      const double x_travel = kLength * (x_falls ? 1.0 - c : 1.0 + c);
      const double y_travel = kLength * (y_rises ? 1.0 + s : 1.0 - s);
      const double x_lag = (x_falls ? 1.0 : -1.0) * (first * std::exp(-x_travel / 0.5) + 1e-3);
      const double y_lag = (y_rises ? -1.0 : 1.0) * second * std::exp(-y_travel / 2.0);
      trace.angle.push_back(phi);
      trace.deviation.push_back(
          x_lag * c + y_lag * s - 0.5 * 30e-6 * kLength * std::sin(2.0 * phi) + 0.004 * c +
          noise * normal({.seed = 9, .draw = w > 0.0 ? 1U : 2U}, static_cast<std::uint64_t>(i)));
    }
    traces.push_back(std::move(trace));
  }
  return traces;
}

TEST(ReversalSpikes, AreFoundWithTheirHeightAndWay) {
  const auto found = reversal_spikes(spiked(3e-3, 1e-3, 0.0), kLength);
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->axes[0].seen && found->axes[1].seen);
  EXPECT_NEAR(found->axes[0].height, 3e-3, 1e-6);
  EXPECT_NEAR(found->axes[0].distance, 0.5, 1e-3);
  EXPECT_NEAR(found->axes[1].height, 1e-3, 1e-6);
  EXPECT_NEAR(found->axes[1].distance, 2.0, 4e-3);
  // The backlash is that without the spike, which else makes it larger.
  EXPECT_NEAR(found->signature[static_cast<std::size_t>(SignatureTerm::backlash_1)], 2e-3, 1e-6);
  EXPECT_NEAR(found->signature[static_cast<std::size_t>(SignatureTerm::square)], 30e-6, 1e-9);
  EXPECT_NEAR(found->signature[static_cast<std::size_t>(SignatureTerm::cx)], 4e-3, 1e-7);
  const auto plain = signature(spiked(3e-3, 1e-3, 0.0), kLength);
  EXPECT_GT(std::abs((*plain)[SignatureTerm::backlash_1] - 2e-3), 1e-4);
}

TEST(ReversalSpikes, AreFoundInNoiseAndNotWhereNoneAre) {
  const auto found = reversal_spikes(spiked(3e-3, 0.0, 3e-4), kLength);
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->axes[0].seen);
  EXPECT_NEAR(found->axes[0].height, 3e-3, 5.0 * found->axes[0].sd);
  EXPECT_NEAR(found->axes[0].distance, 0.5, 0.1);
  EXPECT_FALSE(found->axes[1].seen);
  const auto none = reversal_spikes(spiked(0.0, 0.0, 3e-4), kLength);
  ASSERT_TRUE(none.has_value());
  EXPECT_FALSE(none->axes[0].seen || none->axes[1].seen);
}

// An error of the position of an axis is near its ends whichever way it comes.
TEST(ReversalSpikes, ACyclicErrorIsNone) {
  auto traces = spiked(0.0, 0.0, 1e-4);
  for (CircleTrace& trace : traces) {
    for (std::size_t i = 0; i < trace.angle.size(); ++i) {
      const double c = std::cos(trace.angle[i]);
      trace.deviation[i] += 2e-3 * std::sin(2.0 * std::numbers::pi * kLength * c / 5.0 + 0.5) * c;
    }
  }
  const auto found = reversal_spikes(traces, kLength);
  ASSERT_TRUE(found.has_value());
  EXPECT_FALSE(found->axes[0].seen) << found->axes[0].height << " sd " << found->axes[0].sd;
  EXPECT_FALSE(found->axes[1].seen) << found->axes[1].height << " sd " << found->axes[1].sd;
}

}  // namespace
}  // namespace frustum::instruments
