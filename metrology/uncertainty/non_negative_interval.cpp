#include "metrology/uncertainty/non_negative_interval.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/linear_algebra.hpp"
#include "core/quantile.hpp"

namespace frustum::metrology {
namespace {

// More places than this are thinned: solving eigenvalues of more would take seconds.
constexpr std::size_t kMostPlaces = 240;

// How many waves a form may be made of, and how likely a single one can be beforehand.
constexpr std::array<double, 6> kModeCounts{0.1, 0.3, 1.0, 3.0, 10.0, 1e9};
constexpr double kMostLikely = 0.5;

Eigen::Index per_place(NonNegativeKind kind) {
  return kind == NonNegativeKind::twice_largest ? 3 : 1;
}

double size_by(const SizeRule& rule, const Eigen::VectorXd& parts) {
  return rule(std::span(parts.data(), static_cast<std::size_t>(parts.size())));
}

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& noise) {
  const Eigen::MatrixXd centred = noise.colwise() - noise.rowwise().mean();
  return centred * centred.transpose() /
         static_cast<double>(std::max<Eigen::Index>(noise.cols() - 1, 1));
}

// How alike a rough surface is at the places: its modes are waves, the long ones first. Parts of
// one place are independent.
Eigen::MatrixXd likeness(std::span<const Vec3> places, Eigen::Index parts) {
  const auto count = static_cast<Eigen::Index>(places.size());
  double size = 0.0;
  for (const Vec3& p : places) size = std::max(size, (p - places.front()).norm());
  Eigen::MatrixXd like = Eigen::MatrixXd::Zero(count * parts, count * parts);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double apart =
          (places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)]).norm();
      const double value = size > 0.0 ? std::exp(-apart / size) : (i == j ? 1.0 : 0.0);
      for (Eigen::Index k = 0; k < parts; ++k) like(i * parts + k, j * parts + k) = value;
    }
  }
  return like;
}

// Variances that differ from each other by no more than those of as few draws do become their mean:
// what is left of draws that differ by chance would mix the waves.
Eigen::VectorXd without_chance(const Eigen::VectorXd& variances, Eigen::Index draws) {
  const double middle = variances[variances.size() / 2];
  const double spread =
      std::sqrt(static_cast<double>(variances.size()) / static_cast<double>(draws));
  // Edges of the eigenvalues of sampled covariances (Marchenko, Pastur), and a tenth beyond.
  const double low = spread < 1.0 ? middle * (1.0 - spread) * (1.0 - spread) / 1.1 : 0.0;
  const double high = middle * (1.0 + spread) * (1.0 + spread) * 1.1;
  const auto like = (variances.array() >= low && variances.array() <= high).eval();
  const double mean = like.select(variances, 0.0).sum() / static_cast<double>(like.count());
  return like.select(mean, variances);
}

double normal_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

ShapeEstimate::ShapeEstimate(SizeRule rule, std::span<const Vec3> places,
                             const Eigen::MatrixXd& noise)
    : rule_(std::move(rule)) {
  if (noise.cols() > 0) any_ = noise.col(0);
  if (places.empty()) return;  // one vector has nothing to smooth
  const Eigen::Index parts = per_place(rule_.kind);
  thin(places, parts);
  std::vector<Vec3> few;
  for (std::size_t i = 0; i < chosen_.size(); i += static_cast<std::size_t>(parts)) {
    few.push_back(places[static_cast<std::size_t>(chosen_[i] / parts)]);
  }
  const Eigen::MatrixXd some = noise(chosen_, Eigen::all);
  const SymmetricEigen eigen = symmetric_eigen(covariance_of(some));
  const Eigen::VectorXd& variances = eigen.values;
  // What the fit took out of the residuals is left in second order, 1e-3 of the other deviations at
  // most.
  Eigen::Index first = 0;
  while (first < variances.size() && !(variances[first] > 1e-6 * variances.tail(1)[0])) ++first;
  const Eigen::Index rank = variances.size() - first;
  if (rank == 0) return;
  const Eigen::MatrixXd basis = eigen.vectors.rightCols(rank);
  const Eigen::VectorXd deviation = without_chance(variances.tail(rank), noise.cols()).cwiseSqrt();
  const Eigen::MatrixXd whiten = deviation.cwiseInverse().asDiagonal() * basis.transpose();
  const SymmetricEigen surface =
      symmetric_eigen(whiten * likeness(few, parts) * whiten.transpose());
  const Eigen::MatrixXd modes = surface.vectors.rowwise().reverse();
  to_modes_ = modes.transpose() * whiten;
  from_modes_ = basis * deviation.asDiagonal() * modes;
}

void ShapeEstimate::thin(std::span<const Vec3> places, Eigen::Index parts) {
  const std::size_t stride = (places.size() + kMostPlaces - 1) / kMostPlaces;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < places.size(); i += stride) kept.push_back(i);
  for (const std::size_t i : kept) {
    for (Eigen::Index k = 0; k < parts; ++k) {
      chosen_.push_back(static_cast<Eigen::Index>(i) * parts + k);
    }
  }
  for (const Vec3& place : places) {
    std::size_t best = 0;
    for (std::size_t j = 1; j < kept.size(); ++j) {
      if ((places[kept[j]] - place).squaredNorm() < (places[kept[best]] - place).squaredNorm()) {
        best = j;
      }
    }
    for (Eigen::Index k = 0; k < parts; ++k) {
      nearest_.push_back(static_cast<Eigen::Index>(best) * parts + k);
    }
  }
}

Eigen::VectorXd ShapeEstimate::smoothed(const Eigen::VectorXd& parts) const {
  if (to_modes_.size() == 0) return parts;
  const Eigen::VectorXd some = parts(chosen_);
  const Eigen::VectorXd seen = to_modes_ * some;
  const Eigen::ArrayXd squares = seen.array().square();
  const Eigen::ArrayXd order =
      Eigen::ArrayXd::LinSpaced(seen.size(), 1.0, static_cast<double>(seen.size()));
  Eigen::ArrayXd kept = Eigen::ArrayXd::Zero(seen.size());
  double total = 0.0;
  double best = -HUGE_VAL;
  for (const double count : kModeCounts) {
    // A form is made of few waves, of long ones rather than of short ones.
    const Eigen::ArrayXd before = (count / order).min(kMostLikely);
    for (double variance = 1.0; variance < 1e9; variance *= 4.0) {
      const double gain = variance / (1.0 + variance);
      const Eigen::ArrayXd ratio = before / (1.0 - before) / std::sqrt(1.0 + variance) *
                                   (0.5 * gain * squares).min(600.0).exp();
      const double fit = ((1.0 - before) * (1.0 + ratio)).log().sum();
      const double weight = std::exp(std::min(fit - best, 0.0));
      const double rescale = fit > best ? std::exp(best - fit) : 1.0;
      best = std::max(best, fit);
      if (weight < 1e-9) continue;
      kept = rescale * kept + weight * ratio / (1.0 + ratio);
      total = rescale * total + weight;
    }
  }
  // What no noise reaches is known.
  Eigen::VectorXd out = some - from_modes_ * seen;
  // Waves that are more likely there than not, or the initial_estimates one: the rest would be
  // ripples, whose peaks take from what noise adds to flat ones.
  kept /= total;
  const double least = std::min(0.5, kept.maxCoeff());
  out += from_modes_ * (kept >= least).select(seen.array(), 0.0).matrix();
  return out(nearest_);
}

Eigen::VectorXd ShapeEstimate::operator()(const Eigen::VectorXd& parts) const {
  Eigen::VectorXd shape = smoothed(parts);
  if (!(size_by(rule_, shape) > 0.0)) shape = any_;
  const double size = size_by(rule_, shape);
  return size > 0.0 ? Eigen::VectorXd(shape / size) : shape;
}

SizeUnderNoise::SizeUnderNoise(SizeRule rule, const Eigen::MatrixXd& noise,
                               const Eigen::VectorXd& shape, double coverage)
    : rule_(std::move(rule)), noise_(noise), shape_(shape), coverage_(coverage) {
  for (const double size : sizes(0.0)) {
    mean_at_zero_ += size / static_cast<double>(noise_.cols());
    largest_ = std::max(largest_, size);
  }
}

std::vector<double> SizeUnderNoise::sizes(double truth) const {
  std::vector<double> all(static_cast<std::size_t>(noise_.cols()));
  Eigen::VectorXd parts(shape_.size());
  const bool is_one_row = rule_.kind == NonNegativeKind::peak_to_valley && rule_.rows.empty();
  for (Eigen::Index i = 0; i < noise_.cols(); ++i) {
    parts = truth * shape_ + noise_.col(i);
    all[static_cast<std::size_t>(i)] =
        is_one_row ? parts.maxCoeff() - parts.minCoeff() : size_by(rule_, parts);
  }
  return all;
}

SizeUnderNoise::Likely SizeUnderNoise::likely(double truth) const {
  std::vector<double> all = sizes(truth);
  Likely out;
  const auto count = static_cast<double>(all.size());
  for (const double size : all) out.mean += size / count;
  for (const double size : all) {
    out.deviation += (size - out.mean) * (size - out.mean) / count;
  }
  out.deviation = std::sqrt(out.deviation);
  const double shift =
      out.deviation > 0.0 ? std::max(0.0, (out.mean - mean_at_zero_) / out.deviation) : HUGE_VAL;
  const Tails tails = tails_near_zero(truth > 0.0 ? shift : 0.0, coverage_);
  out.low = tails.low > 0.0 ? quantile(all, tails.low) : 0.0;
  out.high = quantile(all, 1.0 - tails.high);
  return out;
}

bool SizeUnderNoise::accepts(double measured, double truth) const {
  const Likely region = likely(truth);
  return measured >= region.low && measured <= region.high;
}

SizeInterval SizeUnderNoise::interval(double measured) const {
  if (!(largest_ > 0.0)) return {measured, measured, 0.0};
  // No size of that much is seen as `measured`: noise takes away no more than its own size.
  const double top = measured + 2.0 * largest_;
  // The largest truth of which `is_below` holds; it holds below and not above.
  const auto border = [&](const auto& is_below) {
    double below = 0.0;
    double above = top;
    // To a ten thousandth of the noise.
    while (above - below > 1e-4 * largest_) {
      const double middle = 0.5 * (below + above);
      (is_below(likely(middle)) ? below : above) = middle;
    }
    return 0.5 * (below + above);
  };
  SizeInterval out;
  const Likely nothing = likely(0.0);
  if (measured > nothing.high) {
    out.low = border([&](const Likely& region) { return region.high < measured; });
  }
  out.high = border([&](const Likely& region) { return region.low <= measured; });
  const double truth = measured > nothing.mean
                           ? border([&](const Likely& region) { return region.mean < measured; })
                           : 0.0;
  out.standard = likely(truth).deviation;
  return out;
}

Tails tails_near_zero(double shift, double coverage) {
  const double tail = 1.0 - coverage;
  // Far from zero both ends are alike; from 6 deviations on nothing is left of the limit.
  if (shift > 6.0) return {0.5 * tail, 0.5 * tail};
  // Both ends are equally likely beside the best mean that the limit allows.
  const auto low_end = [&](double high) {
    const double mirrored = 2.0 * shift - high;
    if (mirrored >= 0.0) return mirrored;
    return shift > 0.0 ? high * mirrored / (2.0 * shift) : -HUGE_VAL;
  };
  double less = shift;
  double more = shift + 6.0;
  for (int i = 0; i < 60; ++i) {
    const double high = 0.5 * (less + more);
    const double held = normal_below(high - shift) - normal_below(low_end(high) - shift);
    (held < coverage ? less : more) = high;
  }
  const double beyond = normal_below(shift - more);
  return {std::max(0.0, tail - beyond), beyond};
}

}  // namespace frustum::metrology
