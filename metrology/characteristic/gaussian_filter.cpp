#include "metrology/characteristic/gaussian_filter.hpp"
#include "core/constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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

// Samples in order of their place, each with the length of profile around it.
struct Samples {
  std::vector<std::size_t> order{};
  std::vector<double> place{};
  std::vector<double> value{};
  std::vector<double> share{};
  double widest = 0.0;  // largest step
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
    s.widest = std::max(s.widest, step);
  }
  return s;
}

std::vector<double> unsorted(const Samples& s, const std::vector<double>& smooth) {
  std::vector<double> out(smooth.size());
  for (std::size_t i = 0; i < smooth.size(); ++i) out[s.order[i]] = smooth[i];
  return out;
}

Diagnostic too_coarse(double widest, double cutoff, std::string_view what) {
  return error(
      "profile-filter"_id,
      fmt::format("the {} has {:.3g} points a wave of the filter's cut-off, it needs {:.0f}", what,
                  cutoff / widest, kSamplesPerWave),
      "measure more points, or choose a cut-off of longer waves");
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
  [[nodiscard]] double mean() const { return wy / w; }
  [[nodiscard]] double line_at_zero() const {
    const double determinant = w * wxx - wx * wx;
    // One sample within reach: no line, its own value.
    if (!(determinant > 1e-12 * w * wxx)) return mean();
    return (wxx * wy - wx * wxy) / determinant;
  }
};

}  // namespace

Result<std::vector<double>> open_waviness(std::span<const double> place,
                                          std::span<const double> deviation, double cutoff) {
  if (place.size() < 2) return error("too-few-points"_id, "too few points to filter: 2 needed");
  const Samples s = sorted({place.begin(), place.end()}, deviation);
  if (s.widest * kSamplesPerWave > cutoff * kUneven) {
    return too_coarse(s.widest, cutoff, "profile");
  }
  std::vector<double> smooth;
  std::size_t first = 0;
  for (std::size_t i = 0; i < s.place.size(); ++i) {
    while (s.place[i] - s.place[first] > kReach * cutoff) ++first;
    Moments around;
    for (std::size_t j = first; j < s.place.size(); ++j) {
      const double away = s.place[j] - s.place[i];
      if (away > kReach * cutoff) break;
      around.add(s.share[j] * weight(away, cutoff), away, s.value[j]);
    }
    smooth.push_back(around.line_at_zero());
  }
  return unsorted(s, smooth);
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
  const double across_zero = s.place.front() + kTurn - s.place.back();
  s.share.front() += 0.5 * across_zero;
  s.share.back() += 0.5 * across_zero;
  s.widest = std::max(s.widest, across_zero);
  const double cutoff = kTurn / undulations;
  if (s.widest * kSamplesPerWave > cutoff * kUneven) {
    return too_coarse(s.widest, cutoff, "closed profile");
  }
  const auto count = static_cast<std::ptrdiff_t>(s.place.size());
  const auto place = [&](std::ptrdiff_t j) {  // j may run beyond the ends, turn after turn
    const std::ptrdiff_t turn = j >= 0 ? j / count : -((count - 1 - j) / count);
    return s.place[static_cast<std::size_t>(j - turn * count)] + kTurn * static_cast<double>(turn);
  };
  const auto index = [&](std::ptrdiff_t j) {
    return static_cast<std::size_t>(((j % count) + count) % count);
  };
  std::vector<double> smooth;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    Moments around;
    const auto add = [&](std::ptrdiff_t j) {
      const double away = place(j) - place(i);
      if (std::abs(away) > kReach * cutoff) return false;
      around.add(s.share[index(j)] * weight(away, cutoff), away, s.value[index(j)]);
      return true;
    };
    add(i);
    for (std::ptrdiff_t step = 1; add(i + step); ++step) {
    }
    for (std::ptrdiff_t step = 1; add(i - step); ++step) {
    }
    smooth.push_back(around.mean());
  }
  return unsorted(s, smooth);
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
