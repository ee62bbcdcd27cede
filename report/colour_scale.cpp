#include "report/colour_scale.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/quantile.hpp"
#include "report/number_text.hpp"

namespace frustum::report {

Colour deviation_colour(double deviation, double span) {
  constexpr auto kLast = static_cast<double>(kDeviationStops.size() - 1);
  if (!std::isfinite(deviation)) return kNoNominalColour;
  const double place = (std::clamp(deviation / span, -1.0, 1.0) + 1.0) / 2.0 * kLast;
  const auto below = static_cast<std::size_t>(std::min(std::floor(place), kLast - 1.0));
  const double t = place - static_cast<double>(below);
  Colour colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    colour[k] = (1.0 - t) * kDeviationStops[below][k] + t * kDeviationStops[below + 1][k];
  }
  return colour;
}

Colour deviation_colour(const std::optional<float>& deviation, double span) {
  return deviation ? deviation_colour(static_cast<double>(*deviation), span) : kNoNominalColour;
}

double natural_span(const SurfacePicture& picture) {
  constexpr double kShareInside = 0.995;
  constexpr double kSmallest = 1e-6;  // mm: 1 nm, what the cut is exact to
  std::vector<double> sizes;
  for (const std::optional<float>& deviation : picture.deviation) {
    if (deviation && std::isfinite(*deviation))
      sizes.push_back(std::abs(static_cast<double>(*deviation)));
  }
  if (sizes.empty()) return 1e-3;
  const double size = nearest_rank(sizes, kShareInside);
  return round_up_125(std::max(size, kSmallest));
}

}  // namespace frustum::report
