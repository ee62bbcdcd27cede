// Risks of a decision on a part's conformity by a measured value: consumer's and producer's.
//
// Model    : the true value y has a density g (prior), the measured one is normal about y with
//            standard uncertainty u; a part is accepted when the measured value is within the
//            acceptance interval.
//              R_C = integral over y that do not conform of P(accept | y) g(y)
//              R_P = integral over y that conform of P(reject | y) g(y)
//            Sampled prior: the mean over the draws, without a kernel. Specific risk: that one part
//            with a measured value does not conform, by a flat or a normal prior
// Units    : those of the values
// Shape    : intervals with one end or two: an end may be infinite
// Errors   : none; u above 0
// Accuracy : closed or quadrature, 1e-12 (tests/studies/conformity_risk_test.cpp)
// Source   : JCGM 106:2012, sections 7, 9.3 and 9.5
#pragma once

#include <limits>
#include <span>
#include <string>

#include "core/result.hpp"

namespace frustum::studies {

struct ClosedInterval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool contains(double x) const { return x >= lo && x <= hi; }
};

struct Risks {
  double conform = 0.0;  // P(y conforms)
  double accept = 0.0;   // P(accepted)
  double consumer = 0.0;
  double producer = 0.0;
  // Of sampled risks: standard errors from the scatter of the draws.
  double consumer_se = 0.0;
  double producer_se = 0.0;
};

// True values normal with mean and sd.
[[nodiscard]] Risks risks_of_normal(double mean, double sd, double u,
                                    const ClosedInterval& tolerance,
                                    const ClosedInterval& acceptance);
// True values as drawn.
[[nodiscard]] Risks risks_of_sample(std::span<const double> values, double u,
                                    const ClosedInterval& tolerance,
                                    const ClosedInterval& acceptance);

// What is known of one part after its measurement.
struct NormalBelief {
  double mean = 0.0;
  double sd = 0.0;
};
[[nodiscard]] NormalBelief after_measuring(double measured, double u);
[[nodiscard]] NormalBelief after_measuring(double measured, double u, const NormalBelief& prior);
[[nodiscard]] double conformance_probability(const NormalBelief& belief,
                                             const ClosedInterval& tolerance);
// The same where the prior is the population as drawn.
[[nodiscard]] double conformance_probability(double measured, double u,
                                             std::span<const double> population,
                                             const ClosedInterval& tolerance);
// The largest measured value that conforms to an upper limit with this probability (flat prior).
[[nodiscard]] double acceptance_limit_for(double conformance, double u, double limit);

// How limits of acceptance follow from those of tolerance.
struct DecisionRule {
  enum class Kind { simple, guard, consumer };
  Kind kind = Kind::simple;
  double value = 0.0;     // guard: of U = 2 u; consumer: the largest R_C
  std::string written{};  // "simple", "guard 1.0", "consumer 0.005"

  [[nodiscard]] static Result<DecisionRule> parse(std::string_view text);
};
// Acceptance within `limit` (of a form, or of an absolute deviation where `both_sides`): the limit
// itself, limit - g U, or the largest limit whose consumer's risk is not above the rule's.
[[nodiscard]] double acceptance_limit(const DecisionRule& rule, std::span<const double> values,
                                      double u, double limit, bool both_sides = false);
[[nodiscard]] ClosedInterval within(double limit, bool both_sides);

}  // namespace frustum::studies
