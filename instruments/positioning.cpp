#include "instruments/positioning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/counted.hpp"

namespace frustum::instruments {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values, double mean) {
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double range_of(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return most - least;
}

// The band of mean +- 2 s.
struct Band {
  double low = 0.0, high = 0.0;
  [[nodiscard]] double width() const { return high - low; }
};
Band band_of(const DirectionValues& v) {
  Band band{v.mean[0] - 2.0 * v.sd[0], v.mean[0] + 2.0 * v.sd[0]};
  for (std::size_t i = 1; i < v.mean.size(); ++i) {
    band.low = std::min(band.low, v.mean[i] - 2.0 * v.sd[i]);
    band.high = std::max(band.high, v.mean[i] + 2.0 * v.sd[i]);
  }
  return band;
}

DirectionValues direction_values(const Deviations& deviations) {
  DirectionValues v;
  for (const std::vector<double>& runs : deviations) {
    v.mean.push_back(mean_of(runs));
    v.sd.push_back(sd_of(runs, v.mean.back()));
  }
  v.repeatability = 4.0 * *std::ranges::max_element(v.sd);
  v.systematic = range_of(v.mean);
  v.accuracy = band_of(v).width();
  return v;
}

std::optional<Diagnostic> misshapen(const Deviations& up, const Deviations& down) {
  if (up.size() < 2 || up.size() != down.size()) {
    return error("too-few-targets"_id,
                 fmt::format("{} up and {} down: expected the same two or more",
                             counted(up.size(), "target"), down.size()));
  }
  const std::size_t runs = up.front().size();
  for (const Deviations* side : {&up, &down}) {
    for (const std::vector<double>& row : *side) {
      if (row.size() == runs && runs >= 2) continue;
      return error("too-few-runs"_id,
                   fmt::format("a target has {}, another {}: expected the same two or more",
                               counted(row.size(), "run"), runs),
                   "ISO 230-2 asks for five runs in each direction");
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Positioning> positioning(const Deviations& up, const Deviations& down) {
  if (const auto problem = misshapen(up, down)) return *problem;
  Positioning p{.up = direction_values(up), .down = direction_values(down)};
  std::vector<double> means, of_both;
  for (std::size_t i = 0; i < up.size(); ++i) {
    const double b = p.up.mean[i] - p.down.mean[i];
    p.reversal.push_back(b);
    p.largest_reversal = std::max(p.largest_reversal, std::abs(b));
    p.repeatability_at.push_back(std::max({2.0 * p.up.sd[i] + 2.0 * p.down.sd[i] + std::abs(b),
                                           4.0 * p.up.sd[i], 4.0 * p.down.sd[i]}));
    of_both.push_back(0.5 * (p.up.mean[i] + p.down.mean[i]));
    means.push_back(p.up.mean[i]);
    means.push_back(p.down.mean[i]);
  }
  p.mean_reversal = mean_of(p.reversal);
  p.repeatability = *std::ranges::max_element(p.repeatability_at);
  p.systematic = range_of(means);
  p.mean_range = range_of(of_both);
  const Band a = band_of(p.up), b = band_of(p.down);
  p.accuracy = std::max(a.high, b.high) - std::min(a.low, b.low);
  return p;
}

}  // namespace frustum::instruments
