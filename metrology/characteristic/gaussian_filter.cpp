#include "metrology/characteristic/gaussian_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/constants.hpp"
#include "core/units.hpp"

namespace frustum::metrology {
namespace {

constexpr double kSamplesPerWave = 7.0;
// Steps of a displaced part are not quite equal.
constexpr double kUneven = 1.05;
// Weights farther than this many cut-offs are below 1e-17 of the largest.
constexpr double kReach = 1.66;

double weight(double distance, double cutoff) {
  const double x = distance / cutoff;
  return std::exp(-std::numbers::pi * std::numbers::pi / std::numbers::ln2 * x * x);
}

std::vector<std::size_t> order_of(const std::vector<double>& place) {
  std::vector<std::size_t> order(place.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
  return order;
}

bool fits(double step, double cutoff) { return step * kSamplesPerWave <= cutoff * kUneven; }

// How places are told to people.
struct ProfileWords {
  std::string_view profile;
  std::string_view unit;
  double per_place;
};
constexpr ProfileWords kOpen{"profile", "mm", 1.0};
constexpr ProfileWords kClosed{"closed profile", "deg", kDegPerRad};

// Samples in order of their place, each with the length of profile around it.
struct Samples {
  std::vector<std::size_t> order{};
  std::vector<double> place{};
  std::vector<double> value{};
  std::vector<double> share{};
  double widest = 0.0;        // largest step
  std::size_t widest_at = 0;  // and the sample that it follows
  double turn = 0.0;          // after which a closed profile comes again; 0: it is open
};

Samples sorted(std::vector<double> place, std::span<const double> deviation) {
  Samples s;
  s.order = order_of(place);
  for (const std::size_t i : s.order) {
    s.place.push_back(place[i]);
    s.value.push_back(deviation[i]);
  }
  s.share.assign(place.size(), 0.0);
  for (std::size_t i = 0; i + 1 < place.size(); ++i) {
    const double step = s.place[i + 1] - s.place[i];
    s.share[i] += 0.5 * step;
    s.share[i + 1] += 0.5 * step;
    if (step > s.widest) {
      s.widest = step;
      s.widest_at = i;
    }
  }
  return s;
}

std::vector<double> unsorted(const Samples& s, const std::vector<double>& smooth) {
  std::vector<double> out(smooth.size());
  for (std::size_t i = 0; i < smooth.size(); ++i) out[s.order[i]] = smooth[i];
  return out;
}

// Why samples with a widest step of `s.widest` do not suffice: all of them are too far apart, or
// some are missing.
Diagnostic too_coarse(const Samples& s, double cutoff, const ProfileWords& words) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < s.place.size(); ++i) {
    steps.push_back(s.place[i + 1] - s.place[i]);
  }
  const auto wide = static_cast<double>(
      std::count_if(steps.begin(), steps.end(), [&](double step) { return !fits(step, cutoff); }));
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  if (!fits(*middle, cutoff)) {
    return error("profile-filter"_id,
                 fmt::format("the {} has {:.3g} points a wave of the filter's cut-off, it needs "
                             "{:.0f}",
                             words.profile, cutoff / s.widest, kSamplesPerWave),
                 "measure more points, or choose a cut-off of longer waves");
  }
  const bool across_end = s.widest_at + 1 == s.place.size();
  const double gaps = wide + (across_end ? 1.0 : 0.0);
  return error(
      "profile-filter"_id,
      fmt::format(
          "the {} has {} of {:.4g} {} after {:.4g} {}: a point every {:.3g} {} is needed for "
          "{:.0f} a wave of the filter's cut-off",
          words.profile, gaps > 1.5 ? fmt::format("{:.0f} gaps, the largest", gaps) : "a gap",
          s.widest * words.per_place, words.unit, s.place[s.widest_at] * words.per_place,
          words.unit, cutoff / kSamplesPerWave * words.per_place, words.unit, kSamplesPerWave),
      "measure there, leave the filter out, or choose a cut-off of longer waves: the filter takes "
      "each place from a whole wave around it");
}

// Sums that a weighted straight line is made of.
struct Moments {
  double w = 0.0, wx = 0.0, wxx = 0.0, wy = 0.0, wxy = 0.0;
  void add(double weight, double x, double y) {
    w += weight;
    wx += weight * x;
    wxx += weight * x * x;
    wy += weight * y;
    wxy += weight * x * y;
  }
  void add_scaled(double factor, const Moments& m) {
    w += factor * m.w;
    wx += factor * m.wx;
    wxx += factor * m.wxx;
    wy += factor * m.wy;
    wxy += factor * m.wxy;
  }
  [[nodiscard]] Moments divided_by(double divisor) const {
    return {w / divisor, wx / divisor, wxx / divisor, wy / divisor, wxy / divisor};
  }
  [[nodiscard]] double mean() const { return wy / w; }
  [[nodiscard]] double line_at_zero() const {
    const double determinant = w * wxx - wx * wx;
    // One sample within reach: no line, its own value.
    if (!(determinant > 1e-12 * w * wxx)) return mean();
    return (wxx * wy - wx * wxy) / determinant;
  }
};

// Those around one place, of all samples within reach; places in cut-offs.
Moments moments_around(const Samples& s, double at, double cutoff) {
  const double reach = kReach * cutoff;
  Moments around;
  const auto add_turn = [&](double shift) {
    const auto first = std::lower_bound(s.place.begin(), s.place.end(), at - reach - shift);
    for (auto j = static_cast<std::size_t>(first - s.place.begin()); j < s.place.size(); ++j) {
      const double away = s.place[j] + shift - at;
      if (away > reach) break;
      around.add(s.share[j] * weight(away, cutoff), away / cutoff, s.value[j]);
    }
  };
  if (!(s.turn > 0.0)) {
    add_turn(0.0);
    return around;
  }
  const double first_turn = std::floor((at - reach) / s.turn);
  const double last_turn = std::floor((at + reach) / s.turn);
  for (double turn = first_turn; turn <= last_turn; ++turn) add_turn(turn * s.turn);
  return around;
}

// Moments of many places within a cell of a profile, by interpolation between a few: they are sums
// of Gaussians, which are smooth.
class MomentCell {
 public:
  // Half a cut-off wide, 0.94 of the Gaussian's own length to either side: the remainder of 24
  // Chebyshev nodes is below 1e-15 of the largest weight.
  static constexpr double kWidth = 0.5;  // cut-offs
  static constexpr std::size_t kNodes = 24;

  MomentCell(const Samples& s, double from, double cutoff) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / kNodes;
      node_[i] = from + 0.5 * kWidth * cutoff * (1.0 - std::cos(angle));
      factor_[i] = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle);
      moments_[i] = moments_around(s, node_[i], cutoff);
    }
  }

  [[nodiscard]] Moments at(double place) const {
    Moments sum;
    double factors = 0.0;
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double away = place - node_[i];
      if (away == 0.0) return moments_[i];
      const double f = factor_[i] / away;
      factors += f;
      sum.add_scaled(f, moments_[i]);
    }
    return sum.divided_by(factors);
  }

 private:
  std::array<double, kNodes> node_{};    // places
  std::array<double, kNodes> factor_{};  // of barycentric interpolation
  std::array<Moments, kNodes> moments_{};
};

// `value` of the moments around every sample, in order of their places.
template <typename Value>
std::vector<double> smoothed(const Samples& s, double cutoff, const Value& value) {
  // Where nodes would not save work the samples are summed around each place itself.
  constexpr std::size_t kWorthwhile = 4 * MomentCell::kNodes;
  const double width = MomentCell::kWidth * cutoff;
  std::vector<double> smooth;
  smooth.reserve(s.place.size());
  std::size_t first = 0;
  while (first < s.place.size()) {
    const double from = s.place[first];
    const auto end = std::upper_bound(s.place.begin() + static_cast<std::ptrdiff_t>(first),
                                      s.place.end(), from + width);
    const auto last = static_cast<std::size_t>(end - s.place.begin());
    if (last - first < kWorthwhile) {
      smooth.push_back(value(moments_around(s, from, cutoff)));
      ++first;
      continue;
    }
    const MomentCell cell(s, from, cutoff);
    for (; first < last; ++first) smooth.push_back(value(cell.at(s.place[first])));
  }
  return smooth;
}

}  // namespace

Result<std::vector<double>> open_waviness(std::span<const double> place,
                                          std::span<const double> deviation, double cutoff) {
  if (place.size() < 2) return error("too-few-points"_id, "too few points to filter: 2 needed");
  const Samples s = sorted({place.begin(), place.end()}, deviation);
  if (!fits(s.widest, cutoff)) return too_coarse(s, cutoff, kOpen);
  return unsorted(s, smoothed(s, cutoff, [](const Moments& m) { return m.line_at_zero(); }));
}

Result<std::vector<double>> closed_waviness(std::span<const double> angle,
                                            std::span<const double> deviation, double undulations) {
  if (angle.size() < 2) return error("too-few-points"_id, "too few points to filter: 2 needed");
  if (!(undulations >= 1.0)) {
    return error("profile-filter"_id,
                 fmt::format("a closed profile has no cut-off at {:.3g} undulations per revolution",
                             undulations),
                 "1 or more");
  }
  std::vector<double> within;  // one turn
  for (const double a : angle) within.push_back(a - kTurn * std::floor(a / kTurn));
  Samples s = sorted(std::move(within), deviation);
  s.turn = kTurn;
  const double across_zero = s.place.front() + kTurn - s.place.back();
  s.share.front() += 0.5 * across_zero;
  s.share.back() += 0.5 * across_zero;
  if (across_zero > s.widest) {
    s.widest = across_zero;
    s.widest_at = s.place.size() - 1;
  }
  const double cutoff = kTurn / undulations;
  if (!fits(s.widest, cutoff)) return too_coarse(s, cutoff, kClosed);
  return unsorted(s, smoothed(s, cutoff, [](const Moments& m) { return m.mean(); }));
}

namespace {

// Short waves taken away at the one cut-off, then long ones at the other; 0: none there.
template <typename Waviness>
Result<std::vector<double>> band(double shortest, double longest, std::span<const double> place,
                                 std::span<const double> deviation, const Waviness& waviness) {
  std::vector<double> left(deviation.begin(), deviation.end());
  if (shortest > 0.0) {
    auto smooth = waviness(place, left, shortest);
    if (!smooth) return smooth;
    left = std::move(*smooth);
  }
  if (longest > 0.0) {
    const auto smooth = waviness(place, left, longest);
    if (!smooth) return smooth.error();
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= (*smooth)[i];
  }
  return left;
}

}  // namespace

Result<std::vector<double>> closed_band(const ProfileFilter& filter, std::span<const double> angle,
                                        std::span<const double> deviation) {
  return band(filter.upr, filter.upr_from, angle, deviation, closed_waviness);
}
Result<std::vector<double>> open_band(const ProfileFilter& filter, std::span<const double> place,
                                      std::span<const double> deviation) {
  return band(filter.cutoff, filter.cutoff_long, place, deviation, open_waviness);
}

}  // namespace frustum::metrology
