#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "core/quantile.hpp"
#include "core/random.hpp"
#include "metrology/characteristic/measured_values.hpp"
#include "metrology/probing/cmm_errors.hpp"
#include "metrology/uncertainty/non_negative_interval.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"
#include "metrology/uncertainty/refit.hpp"

namespace frustum::metrology {
namespace {

constexpr std::size_t kFewestBlocks = 5;
constexpr std::size_t kMostBlocks = 100;

// What one block of draws says of a characteristic, in its own unit.
struct Estimate {
  double low = 0.0;
  double high = 0.0;
  double standard = 0.0;
};

Estimate of_values(std::vector<double> values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double v : values) mean += v / count;
  double square = 0.0;
  for (const double v : values) square += (v - mean) * (v - mean) / (count - 1.0);
  const double low = quantile(values, 0.025);
  return {low, quantile(values, 0.975), std::sqrt(square)};
}

// One characteristic through all blocks.
class Tally {
 public:
  explicit Tally(const CharacteristicResult& measured)
      : rule_(measured.measurand.rule),
        places_(measured.measurand.places),
        parts_(Eigen::Map<const Eigen::VectorXd>(
            measured.measurand.parts.data(),
            static_cast<Eigen::Index>(measured.measurand.parts.size()))),
        value_(measured.value),
        per_mm_(1.0 / internal_value(1.0, measured.unit)),
        size_(value_ / per_mm_) {}

  void begin() {
    values_.clear();
    if (rule_.kind != NonNegativeKind::none) noise_.resize(parts_.size(), kBlockOfDraws);
  }
  void add(const CharacteristicResult& drawn) {
    if (rule_.kind != NonNegativeKind::none) {
      const auto& parts = drawn.measurand.parts;
      noise_.col(static_cast<Eigen::Index>(values_.size())) =
          Eigen::Map<const Eigen::VectorXd>(parts.data(), parts_.size()) - parts_;
    }
    // What errors add to the measured value is what they have added to the true one: they count the
    // other way.
    values_.push_back(2.0 * value_ - drawn.value);
  }
  void end() {
    if (rule_.kind == NonNegativeKind::none) {
      blocks_.push_back(of_values(values_));
      return;
    }
    // The first block tells the shape for all.
    if (blocks_.empty()) take_bias();
    noise_.colwise() -= bias_;
    if (blocks_.empty()) shape_ = ShapeEstimate(rule_, places_, noise_)(parts_);
    const SizeInterval found = SizeUnderNoise(rule_, noise_, shape_).interval(size_);
    blocks_.push_back({per_mm_ * found.low, per_mm_ * found.high, per_mm_ * found.standard});
  }

  [[nodiscard]] bool is_stable(int digits) const {
    if (blocks_.size() < kFewestBlocks) return false;
    const double standard = mean(&Estimate::standard);
    if (!(standard > 0.0)) return true;
    // JCGM 101, 7.9.2: half a unit of the last of `digits` digits.
    const double unit = std::pow(10.0, std::floor(std::log10(standard)) - (digits - 1));
    const auto stands = [&](double Estimate::*of) { return 2.0 * error_of(of) <= 0.5 * unit; };
    return stands(&Estimate::standard) && stands(&Estimate::low) && stands(&Estimate::high);
  }
  [[nodiscard]] SimulatedUncertainty result(int digits) const {
    return {mean(&Estimate::low), mean(&Estimate::high), mean(&Estimate::standard),
            blocks_.size() * kBlockOfDraws, is_stable(digits)};
  }

 private:
  // What all draws share, such as the lobes of a probe or a part that is warm: the parts are
  // corrected for it.
  void take_bias() {
    constexpr double kSure = 5.0;  // standard deviations of a mean
    const auto count = static_cast<double>(noise_.cols());
    bias_ = noise_.rowwise().mean();
    const Eigen::VectorXd deviation =
        ((noise_.colwise() - bias_).rowwise().squaredNorm() / (count * (count - 1.0))).cwiseSqrt();
    bias_ = (bias_.array().abs() > kSure * deviation.array()).select(bias_, 0.0);
    if (bias_.isZero(0.0)) return;
    parts_ -= bias_;
    size_ = rule_({parts_.data(), static_cast<std::size_t>(parts_.size())});
  }

  [[nodiscard]] double mean(double Estimate::*of) const {
    double sum = 0.0;
    for (const Estimate& block : blocks_) sum += block.*of;
    return sum / static_cast<double>(blocks_.size());
  }
  [[nodiscard]] double error_of(double Estimate::*of) const {
    const double middle = mean(of);
    double square = 0.0;
    for (const Estimate& block : blocks_) square += (block.*of - middle) * (block.*of - middle);
    const auto count = static_cast<double>(blocks_.size());
    return std::sqrt(square / (count * (count - 1.0)));
  }

  SizeRule rule_;
  std::vector<Vec3> places_;
  Eigen::VectorXd parts_;
  double value_;
  double per_mm_;
  double size_;             // mm, of non-negative measurands
  Eigen::VectorXd bias_{};  // of their parts
  Eigen::MatrixXd noise_{};
  Eigen::VectorXd shape_{};
  std::vector<double> values_{};
  std::vector<Estimate> blocks_{};
};

// Beyond noise and a linear field: every draw is another machine of the same kind, with the probe
// and in the temperature that are stated.
ErrorDraws drawn_machines(const CmmModel& cmm, std::uint64_t seed) {
  return [cmm, seed](std::uint32_t draw) -> MeasuringErrors {
    CmmModel other = cmm;
    other.seed = seed + draw;
    return [machine = CmmErrors(other)](const Vec3& centre, const Vec3& approach,
                                        std::size_t feature, std::size_t point) -> Vec3 {
      const double misjudged = machine.ball_radius(0.0);
      return machine.measured({centre, unit(approach), point_index(feature, point)}) -
             misjudged * approach;
    };
  };
}

}  // namespace

ErrorDraws error_draws(const CmmModel& cmm, std::uint64_t seed) {
  const PointUncertainty u = point_uncertainty(cmm);
  // The seeds of measurements are small numbers; this keeps clear of them.
  const std::uint64_t own = seed ^ 0x6a09e667f3bcc908U;
  if (cmm.kind == CmmKind::field || cmm.probe || cmm.temperature) return drawn_machines(cmm, own);
  return [u, own](std::uint32_t draw) -> MeasuringErrors {
    const RandomKey points{.seed = own, .draw = draw, .purpose = RandomPurpose::cmm_point};
    const RandomKey scales{.seed = own, .draw = draw, .purpose = RandomPurpose::cmm_scale};
    const auto term = [&](std::uint64_t i) {
      return u.scale > 0.0 ? u.scale * normal(scales, i) : 0.0;
    };
    Mat3 field;
    field << term(0), term(3), term(4),  //
        0.0, term(1), term(5),           //
        0.0, 0.0, term(2);
    return [field, points, u](const Vec3& centre, const Vec3& approach, std::size_t feature,
                              std::size_t point) -> Vec3 {
      Vec3 seen = centre + field * centre;
      if (u.probing > 0.0) {
        const std::uint64_t index = (static_cast<std::uint64_t>(feature) << 32U) | point;
        seen += u.probing * normal(points, index) * approach;
      }
      return seen;
    };
  };
}

Result<std::vector<FittedFeature>> remeasured_features(const InspectionPlan& plan,
                                                       std::span<const FittedFeature> features,
                                                       const MeasuringErrors& errors) {
  const double ball_radius = 0.5 * plan.probe.ball_diameter;
  std::vector<FittedFeature> moved;
  for (const FittedFeature& feature : features) {
    const auto index = static_cast<std::size_t>(feature.planned - plan.features.data());
    std::vector<Vec3> points;
    points.reserve(feature.points.size());
    for (const MeasuredPoint& p : feature.points) {
      const Vec3 centre = p.point + ball_radius * p.normal;
      points.push_back(p.point + (errors(centre, p.normal, index, points.size()) - centre));
    }
    auto fit = refit(feature, points);
    if (!fit) return std::move(fit).error();
    moved.push_back(std::move(*fit));
  }
  return moved;
}

Result<Measurement> remeasured(const InspectionPlan& plan, std::span<const FittedFeature> features,
                               const MeasuringErrors& errors) {
  auto moved = remeasured_features(plan, features, errors);
  if (!moved) return std::move(moved).error();
  return evaluated_values(plan, *std::move(moved));
}

Result<std::vector<SimulatedUncertainty>> simulated_uncertainties(
    const InspectionPlan& plan, std::span<const FittedFeature> features, const ErrorDraws& draws,
    const MonteCarloSettings& settings) {
  const auto still = [](const Vec3& centre, const Vec3&, std::size_t, std::size_t) -> Vec3 {
    return centre;
  };
  const auto measured = remeasured(plan, features, still);
  if (!measured) return measured.error();
  std::vector<Tally> tallies(measured->characteristics.begin(), measured->characteristics.end());
  const std::size_t fewest =
      settings.draws ? (*settings.draws + kBlockOfDraws - 1) / kBlockOfDraws : kFewestBlocks;
  const auto all_stable = [&] {
    return std::all_of(tallies.begin(), tallies.end(),
                       [&](const Tally& t) { return t.is_stable(settings.digits); });
  };
  std::uint32_t draw = 0;
  for (std::size_t block = 0;; ++block) {
    if (block >= fewest && (settings.draws || block >= kMostBlocks || all_stable())) break;
    for (Tally& tally : tallies) tally.begin();
    for (std::size_t i = 0; i < kBlockOfDraws; ++i) {
      const auto drawn = remeasured(plan, features, draws(draw++));
      if (!drawn) return drawn.error();
      for (std::size_t c = 0; c < tallies.size(); ++c) tallies[c].add(drawn->characteristics[c]);
    }
    for (Tally& tally : tallies) tally.end();
  }
  std::vector<SimulatedUncertainty> results;
  for (const Tally& tally : tallies) results.push_back(tally.result(settings.digits));
  return results;
}

}  // namespace frustum::metrology
