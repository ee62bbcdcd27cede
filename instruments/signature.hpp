// What a circle of two linear axes is made of: the terms that a ball bar reports, by least
// squares.
//
// Model    : both directions together, w = +1 ccw, -1 cw, L the nominal length:
//              dr = r0 + cx cos + cy sin + m cos2 - (S L / 2) sin2 + w (p / 2) sin2
//                   - (h1 / 2) head1 cos - (h2 / 2) head2 sin
//            head1 = -w sgn(sin), head2 = w sgn(cos); one direction alone does not tell p from S:
//            then p is left out
// Units    : mm, rad
// Shape    : one or two traces of at least ten samples together
// Errors   : too few samples, an arc that does not separate the terms
// Accuracy : 1e-9 mm on full circles (tests/instruments/circle_evaluation_test.cpp)
// Source   : ISO 230-4; Knapp 1983 (circular test); docs/motion-tests.md
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "instruments/circle_test.hpp"

namespace frustum::instruments {

// One run of a circle: deviations from the nominal radius.
struct CircleTrace {
  Sense sense = Sense::ccw;
  std::vector<double> angle{};      // rad
  std::vector<double> deviation{};  // mm
};

enum class SignatureTerm { r0, cx, cy, scale, square, servo, backlash_1, backlash_2 };
inline constexpr std::size_t kSignatureTerms = 8;

struct TermText {
  std::string_view name;         // "square_urad", in um and urad
  std::string_view cause;        // what makes it
  std::string_view looks_alike;  // what else the trace shows in the same way
};
[[nodiscard]] const TermText& text_of(SignatureTerm term);

struct Signature {
  std::array<double, kSignatureTerms> value{};  // mm; square rad
  // Standard deviations for samples with independent noise of 1 mm, and for the noise that the
  // residuals show. Neighbours of a real trace are not independent: these are lower bounds.
  std::array<double, kSignatureTerms> sd_per_noise{};
  std::array<double, kSignatureTerms> sd{};
  bool both_senses = true;  // else servo is not separated from square, and is 0
  double residual_rms = 0.0;

  [[nodiscard]] double operator[](SignatureTerm term) const {
    return value[static_cast<std::size_t>(term)];
  }
};

[[nodiscard]] Result<Signature> signature(std::span<const CircleTrace> traces, double length);

// What a unit of each term is at an angle; w: +1 ccw, -1 cw; square in multiples of rad * length,
// so that all are mm.
[[nodiscard]] Eigen::Matrix<double, kSignatureTerms, 1> signature_row(double angle, double w);

// Whether each term can be identified from a trace: with one reading a degree its standard
// deviation is below the noise of a single reading. A quadrant identifies backlash and servo
// mismatch only.
[[nodiscard]] std::array<bool, kSignatureTerms> told_terms(std::span<const CircleTrace> traces,
                                                           const Signature& signature,
                                                           double length);

// What is left of each trace without the terms.
[[nodiscard]] std::vector<std::vector<double>> residuals(std::span<const CircleTrace> traces,
                                                         const Signature& signature, double length);

// Peak to valley of a term alone over the samples: what G would be of it alone.
struct Contribution {
  std::optional<SignatureTerm> term{};  // nothing: the residual
  double width = 0.0;                   // mm
  double share = 0.0;                   // of the sum of all; the sum exceeds G where terms cancel
};
// Without r0, cx and cy, which are of the set-up. Largest first.
[[nodiscard]] std::vector<Contribution> contributions(std::span<const CircleTrace> traces,
                                                      const Signature& signature, double length);

}  // namespace frustum::instruments
