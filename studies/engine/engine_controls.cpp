#include "studies/engine/engine_controls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustum::studies {
namespace {

constexpr double kEngineBound = 0.05;      // um: what auto allows at most
constexpr double kShareOfHalfWidth = 0.1;  // of the smallest interval asked for
constexpr double kSafety = 1.5;            // on the largest difference of the controls

struct Differences {
  double square = 0.0;
  double largest = 0.0;
};

Differences differences(std::span<const double> full, std::span<const double> linear) {
  assert(full.size() == linear.size());
  Differences d;
  for (std::size_t i = 0; i < full.size(); ++i) {
    const double difference = full[i] - linear[i];
    d.square += difference * difference;
    d.largest = std::max(d.largest, std::abs(difference));
  }
  return d;
}

}  // namespace

EngineControls engine_controls(std::span<const ControlValues> characteristics, double rounding) {
  EngineControls controls;
  double square = 0.0, doubled = 0.0;
  for (const ControlValues& c : characteristics) {
    controls.draws = static_cast<std::uint32_t>(c.full.size());
    const Differences once = differences(c.full, c.linear);
    square += once.square;
    doubled += differences(c.full_doubled, c.linear_doubled).square;
    controls.largest_difference = std::max(controls.largest_difference, once.largest);
  }
  controls.growth = square > 0.0 ? std::sqrt(doubled / square) : 0.0;
  controls.is_rounding = controls.largest_difference <= rounding;
  if (controls.is_rounding || std::abs(controls.growth - kGrowthOfSecondOrder) <= kGrowthLimit)
    return controls;
  controls.refusal = fmt::format(
      "the difference between the linear model and whole trials grows {:.2f} fold when all errors "
      "double, not 4 +- {:g} fold: it is not of second order",
      controls.growth, kGrowthLimit);
  return controls;
}

double linear_bound(const EngineControls& controls, double largest_of_controls,
                    double largest_of_draws) {
  if (!(largest_of_controls > 0.0)) return kSafety * controls.largest_difference;
  const double ratio = std::max(1.0, largest_of_draws / largest_of_controls);
  return kSafety * controls.largest_difference * ratio * ratio;
}

EngineChoice automatic_engine(const EngineFacts& facts) {
  const auto full = [](std::string reason) {
    return EngineChoice{EngineKind::full, std::move(reason)};
  };
  if (!facts.nonlinear.empty()) return full(facts.nonlinear.front());
  if (facts.has_even_part)
    return full("a face is cut by a leaning end of the cutter: its dish is not linear");
  if (facts.jumps) return full("a contact jumps from one pass of the cutter to another");
  if (!facts.controls.refusal.empty()) return full(facts.controls.refusal);
  const double allowed = std::min(
      kEngineBound,
      kShareOfHalfWidth * facts.smallest_half_width.value_or(kEngineBound / kShareOfHalfWidth));
  if (facts.bound <= allowed) return {};
  return full(fmt::format("the bound of the linear model is {:.3g} um, above {:.3g} um",
                          facts.bound, allowed));
}

}  // namespace frustum::studies
