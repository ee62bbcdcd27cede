#include "instruments/signature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"

namespace frustum::instruments {
namespace {

using Terms = Eigen::Matrix<double, kSignatureTerms, 1>;
using TermsSquare = Eigen::Matrix<double, kSignatureTerms, kSignatureTerms>;

constexpr auto kServo = static_cast<Eigen::Index>(SignatureTerm::servo);

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

Terms in_mm(const Signature& signature, double length) {
  Terms x;
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const bool angle = static_cast<SignatureTerm>(k) == SignatureTerm::square;
    x[static_cast<Eigen::Index>(k)] = signature.value[k] * (angle ? length : 1.0);
  }
  return x;
}

bool has_both(std::span<const CircleTrace> traces) {
  const auto any = [&](Sense sense) {
    return std::ranges::any_of(traces, [&](const CircleTrace& t) { return t.sense == sense; });
  };
  return any(Sense::ccw) && any(Sense::cw);
}

struct Extremes {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void include(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
};

}  // namespace

Eigen::Matrix<double, kSignatureTerms, 1> signature_row(double angle, double w) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double cos2 = c * c - s * s, sin2 = 2.0 * s * c;
  const double head1 = -w * sign(s), head2 = w * sign(c);
  Terms row;
  row << 1.0, c, s, cos2, -0.5 * sin2, 0.5 * w * sin2, -0.5 * head1 * c, -0.5 * head2 * s;
  return row;
}

const TermText& text_of(SignatureTerm term) {
  static constexpr std::array<TermText, kSignatureTerms> kTexts{{
      {"r0", "mean radius: mean scale, equal lag", "the length of the bar"},
      {"cx", "centre along the first axis",
       "the table ball, a tilt times the offset of the centre"},
      {"cy", "centre along the second axis",
       "the table ball, a tilt times the offset of the centre"},
      {"scale", "scales of the axes differ", "angular error motion times the offset of the centre"},
      {"square_urad", "squareness of the axes here",
       "angular error motion times the offset of the centre"},
      {"servo", "servo gains differ", "nothing, where both directions are run"},
      {"backlash_1", "reversal of the first axis", "spikes and stick-slip at its reversals"},
      {"backlash_2", "reversal of the second axis", "spikes and stick-slip at its reversals"},
  }};
  return kTexts[static_cast<std::size_t>(term)];
}

Result<Signature> signature(std::span<const CircleTrace> traces, double length) {
  Signature found{.both_senses = has_both(traces)};
  TermsSquare normal = TermsSquare::Zero();
  Terms right = Terms::Zero();
  std::size_t count = 0;
  for (const CircleTrace& trace : traces) {
    for (std::size_t i = 0; i < trace.angle.size(); ++i) {
      const Terms row = signature_row(trace.angle[i], sign_of(trace.sense));
      normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
      right += trace.deviation[i] * row;
    }
    count += trace.angle.size();
  }
  if (count <= kSignatureTerms + 1) {
    return error("too-few-samples"_id,
                 fmt::format("the terms of a circle need ten samples, given are {}", count));
  }
  normal = TermsSquare(normal.selfadjointView<Eigen::Lower>());
  if (!found.both_senses) {  // the column of p is that of S
    normal.row(kServo).setZero();
    normal.col(kServo).setZero();
    normal(kServo, kServo) = static_cast<double>(count);
    right[kServo] = 0.0;
  }
  const SymmetricFactors factors(normal);
  // A quadrant leaves 1e-5; 1e-11 is an arc of a few degrees, whose terms are all alike.
  const Eigen::VectorXd pivots = factors.pivots();
  if (!(pivots.minCoeff() > 1e-11 * pivots.maxCoeff())) {
    return error("arc-too-short"_id, "the arc is too short to separate the terms of the circle",
                 "measure at least a quadrant");
  }
  Terms x = factors.solve(Eigen::VectorXd(right));
  if (!found.both_senses) x[kServo] = 0.0;
  const auto left_over = [&](std::size_t t, std::size_t i) {
    return traces[t].deviation[i] -
           signature_row(traces[t].angle[i], sign_of(traces[t].sense)).dot(x);
  };
  Terms left = Terms::Zero();
  for (std::size_t t = 0; t < traces.size(); ++t) {
    for (std::size_t i = 0; i < traces[t].angle.size(); ++i) {
      left += left_over(t, i) * signature_row(traces[t].angle[i], sign_of(traces[t].sense));
    }
  }
  if (!found.both_senses) left[kServo] = 0.0;
  x += factors.solve(Eigen::VectorXd(left));  // restores the digits that the normal equations lose
  double squares = 0.0;
  for (std::size_t t = 0; t < traces.size(); ++t) {
    for (std::size_t i = 0; i < traces[t].angle.size(); ++i) {
      squares += left_over(t, i) * left_over(t, i);
    }
  }
  found.residual_rms = std::sqrt(squares / static_cast<double>(count));
  const double noise = std::sqrt(squares / static_cast<double>(count - kSignatureTerms));
  const TermsSquare covariance = factors.solve(Eigen::MatrixXd(TermsSquare::Identity()));
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const double unit = static_cast<SignatureTerm>(k) == SignatureTerm::square ? length : 1.0;
    found.value[k] = x[at] / unit;
    if (!found.both_senses && at == kServo) continue;
    found.sd_per_noise[k] = std::sqrt(covariance(at, at)) / unit;
    found.sd[k] = noise * found.sd_per_noise[k];
  }
  return found;
}

std::array<bool, kSignatureTerms> told_terms(std::span<const CircleTrace> traces,
                                             const Signature& signature, double length) {
  double count = 0.0, degrees = 0.0;
  for (const CircleTrace& trace : traces) {
    if (trace.angle.empty()) continue;
    const auto [least, most] = std::ranges::minmax(trace.angle);
    count += static_cast<double>(trace.angle.size());
    degrees += (most - least) * kDegPerRad;
  }
  std::array<bool, kSignatureTerms> told{};
  for (std::size_t k = 0; k < kSignatureTerms; ++k) {
    const auto term = static_cast<SignatureTerm>(k);
    if (term == SignatureTerm::servo && !signature.both_senses) continue;
    const double unit = term == SignatureTerm::square ? 0.5 * length : 1.0;
    told[k] = signature.sd_per_noise[k] * unit * std::sqrt(count / degrees) < 1.0;
  }
  return told;
}

std::vector<std::vector<double>> residuals(std::span<const CircleTrace> traces,
                                           const Signature& signature, double length) {
  const Terms x = in_mm(signature, length);
  std::vector<std::vector<double>> left;
  for (const CircleTrace& trace : traces) {
    std::vector<double>& of_trace = left.emplace_back();
    of_trace.reserve(trace.angle.size());
    for (std::size_t i = 0; i < trace.angle.size(); ++i) {
      of_trace.push_back(trace.deviation[i] -
                         signature_row(trace.angle[i], sign_of(trace.sense)).dot(x));
    }
  }
  return left;
}

std::vector<Contribution> contributions(std::span<const CircleTrace> traces,
                                        const Signature& signature, double length) {
  const Terms x = in_mm(signature, length);
  std::array<Extremes, kSignatureTerms> of_terms;
  Extremes rest;
  for (const CircleTrace& trace : traces) {
    for (std::size_t i = 0; i < trace.angle.size(); ++i) {
      const Terms row = signature_row(trace.angle[i], sign_of(trace.sense));
      for (std::size_t k = 0; k < kSignatureTerms; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        of_terms[k].include(row[at] * x[at]);
      }
      rest.include(trace.deviation[i] - row.dot(x));
    }
  }
  std::vector<Contribution> all;
  double sum = 0.0;
  for (std::size_t k = static_cast<std::size_t>(SignatureTerm::scale); k < kSignatureTerms; ++k) {
    if (!signature.both_senses && k == static_cast<std::size_t>(SignatureTerm::servo)) continue;
    all.push_back({static_cast<SignatureTerm>(k), of_terms[k].most - of_terms[k].least});
    sum += all.back().width;
  }
  all.push_back({std::nullopt, rest.most - rest.least});
  sum += all.back().width;
  for (Contribution& each : all) each.share = sum > 0.0 ? each.width / sum : 0.0;
  std::ranges::stable_sort(all, std::ranges::greater{}, &Contribution::width);
  return all;
}

}  // namespace frustum::instruments
