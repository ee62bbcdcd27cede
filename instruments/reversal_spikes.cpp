#include "instruments/reversal_spikes.hpp"

#include <cmath>

#include "core/golden_section.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::instruments {
namespace {

constexpr auto kTerms = static_cast<Eigen::Index>(kSignatureTerms);
constexpr Eigen::Index kColumns = kTerms + 2;
using Distances = std::array<double, 2>;

double head_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

// How far an axis has moved since it last turned back, on a circle; `cosine`: of the angle from
// the positive end of the axis, `toward`: whether it moves to that end.
double travel_since(double length, double cosine, bool toward) {
  return length * (toward ? 1.0 + cosine : 1.0 - cosine);
}

struct Fit {
  Eigen::VectorXd x{};          // of the terms, then of the spikes
  Eigen::VectorXd variances{};  // for noise of one
  double squares = 0.0;
};

// What the signature has left over, by its terms again and by spikes.
class SpikeFit {
 public:
  SpikeFit(std::span<const CircleTrace> traces, const Signature& plain, double length) {
    const auto left = residuals(traces, plain, length);
    Eigen::Index count = 0;
    for (const auto& of_trace : left) count += static_cast<Eigen::Index>(of_trace.size());
    terms_.resize(count, kTerms);
    left_over_.resize(count);
    length_ = length;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      lag_.at(axis).resize(count);
      travel_.at(axis).resize(count);
      place_.at(axis).resize(count);
    }
    Eigen::Index at = 0;
    for (std::size_t t = 0; t < traces.size(); ++t) {
      const double w = sign_of(traces[t].sense);
      for (std::size_t i = 0; i < traces[t].angle.size(); ++i, ++at) {
        const double c = std::cos(traces[t].angle[i]), s = std::sin(traces[t].angle[i]);
        const double head1 = -w * head_of(s), head2 = w * head_of(c);
        terms_.row(at) = signature_row(traces[t].angle[i], w);
        lag_[0][at] = -head1 * c;
        lag_[1][at] = -head2 * s;
        travel_[0][at] = travel_since(length, c, head1 > 0.0);
        travel_[1][at] = travel_since(length, s, head2 > 0.0);
        place_[0][at] = length * c;
        place_[1][at] = length * s;
        left_over_[at] = left[t][i];
      }
    }
    // Servo mismatch looks like squareness where one sense alone was run.
    constexpr auto kServo = static_cast<Eigen::Index>(SignatureTerm::servo);
    if (!plain.both_senses) terms_.col(kServo).setZero();
    normal_ = Eigen::MatrixXd::Zero(kColumns, kColumns);
    normal_.topLeftCorner(kTerms, kTerms) = terms_.transpose() * terms_;
    if (!plain.both_senses) normal_(kServo, kServo) = 1.0;
    right_ = Eigen::VectorXd::Zero(kColumns);
    right_.head(kTerms) = terms_.transpose() * left_over_;
  }

  [[nodiscard]] Eigen::Index count() const { return left_over_.size(); }
  [[nodiscard]] Fit with(const Distances& distances) const {
    Eigen::MatrixXd normal = normal_;
    Eigen::VectorXd right = right_;
    std::array<Eigen::VectorXd, 2> columns;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      Eigen::VectorXd& column = columns.at(axis);
      column = lag_.at(axis).array() * (-travel_.at(axis).array() / distances.at(axis)).exp();
      const Eigen::Index k = kTerms + static_cast<Eigen::Index>(axis);
      normal.col(k).head(kTerms) = terms_.transpose() * column;
      normal.row(k).head(kTerms) = normal.col(k).head(kTerms).transpose();
      normal(k, k) = column.squaredNorm();
      right[k] = column.dot(left_over_);
    }
    normal(kTerms, kTerms + 1) = normal(kTerms + 1, kTerms) = columns[0].dot(columns[1]);
    const SymmetricFactors factors(normal);
    Fit fit{.x = factors.solve(right)};
    fit.variances =
        factors.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(kColumns, kColumns))).diagonal();
    const Eigen::VectorXd rest = left_over_ - terms_ * fit.x.head(kTerms) -
                                 fit.x[kTerms] * columns[0] - fit.x[kTerms + 1] * columns[1];
    fit.squares = rest.squaredNorm();
    return fit;
  }

  // How much of the spike's shape there is near the two ends of the axis however it came there,
  // root mean square of both, by least squares together with the terms and the spikes.
  [[nodiscard]] double of_position(const Distances& distances, std::size_t axis) const {
    Eigen::MatrixXd columns(count(), kColumns + 2);
    columns.leftCols(kTerms) = terms_;
    for (std::size_t of = 0; of < 2; ++of) {
      columns.col(kTerms + static_cast<Eigen::Index>(of)) =
          lag_.at(of).array() * (-travel_.at(of).array() / distances.at(of)).exp();
    }
    const Eigen::ArrayXd place = place_.at(axis).array();
    columns.col(kColumns) = place / length_ * ((place - length_) / distances.at(axis)).exp();
    columns.col(kColumns + 1) = place / length_ * ((-place - length_) / distances.at(axis)).exp();
    Eigen::MatrixXd normal = columns.transpose() * columns;
    // Where one sense alone was run the column of servo mismatch is empty.
    normal.diagonal().array() += 1e-9 * normal.diagonal().maxCoeff();
    const Eigen::VectorXd x =
        SymmetricFactors(normal).solve(Eigen::VectorXd(columns.transpose() * left_over_));
    return std::sqrt(0.5 * x.tail<2>().squaredNorm());
  }

 private:
  double length_ = 0.0;
  Eigen::MatrixXd terms_{};
  Eigen::VectorXd left_over_{};
  std::array<Eigen::VectorXd, 2> lag_{}, travel_{}, place_{};
  Eigen::MatrixXd normal_{};
  Eigen::VectorXd right_{};
};

}  // namespace

Result<ReversalSpikes> reversal_spikes(std::span<const CircleTrace> traces, double length) {
  const auto plain = signature(traces, length);
  if (!plain) return plain.error();
  const SpikeFit spikes(traces, *plain, length);
  // From the play of a screw to a good part of a small circle, mm.
  constexpr double kShortest = 0.02, kLongest = 10.0;
  const double low = std::log(kShortest), high = std::log(std::min(kLongest, 0.3 * length));
  constexpr int kSteps = 8, kRounds = 4, kNarrowings = 16;
  const double wide = (high - low) / kSteps;
  Distances best{std::exp(low + 0.5 * (high - low)), std::exp(low + 0.5 * (high - low))};
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t axis = 0; axis < best.size(); ++axis) {
      const auto squares = [&](double log_distance) {
        Distances tried = best;
        tried.at(axis) = std::exp(log_distance);
        return spikes.with(tried).squares;
      };
      double middle = std::log(best.at(axis));
      // All over at first; each axis is found while the other is not yet right.
      if (round < 2) {
        double least = HUGE_VAL;
        for (int i = 0; i <= kSteps; ++i) {
          const double at = low + wide * i;
          if (const double value = squares(at); value < least) {
            least = value;
            middle = at;
          }
        }
      }
      const double half = round < 2 ? wide : 0.1 * wide;
      const auto found = golden_section(squares, middle - half, middle + half, 0.0, kNarrowings);
      best.at(axis) = std::exp(found.at);
    }
  }
  const Fit fit = spikes.with(best);
  ReversalSpikes result;
  const auto count = static_cast<double>(spikes.count());
  const double free = count - static_cast<double>(kColumns) - 2.0;
  const double variance = free > 0.0 ? fit.squares / free : 0.0;
  result.residual_rms = std::sqrt(fit.squares / count);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    constexpr double kClear = 5.0, kWorthReporting = 1e-4, kAtTheEdge = 0.05;
    const Eigen::Index column = kTerms + static_cast<Eigen::Index>(axis);
    Spike& spike = result.axes.at(axis);
    spike.height = fit.x[column];
    spike.distance = best.at(axis);
    spike.sd =
        std::max(std::sqrt(variance * fit.variances[column]), spikes.of_position(best, axis));
    spike.seen = std::abs(spike.height) > std::max(kClear * spike.sd, kWorthReporting) &&
                 std::log(spike.distance) < high - kAtTheEdge;
  }
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const bool angle = static_cast<SignatureTerm>(k) == SignatureTerm::square;
    result.signature.at(k) =
        plain->value.at(k) + fit.x[static_cast<Eigen::Index>(k)] / (angle ? length : 1.0);
  }
  return result;
}

}  // namespace frustum::instruments
