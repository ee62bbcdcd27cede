// Spikes of a circular test: how far an axis lags just after it has turned back.
//
// Model    : after a reversal axis i lags by a_i exp(-travel / d_i), which dies away as it moves
//            on: -a_i head_i exp(-travel / d_i) times cos (first axis) or sin (second), head_i as
//            of signature.hpp. a_i and the terms of the signature by least squares together, d_i
//            those that leave least
// Units    : mm; square rad
// Shape    : one or two runs
// Errors   : those of signature()
// Accuracy : 1e-6 mm and 1e-3 of d_i on a trace of such terms; of a spike that dies away within few
//            samples a_i and d_i hang together
// Source   : ours; ISO 230-4 and bar makers know such spikes by sight
#pragma once

#include <array>
#include <span>

#include "instruments/signature.hpp"

namespace frustum::instruments {

struct Spike {
  double height = 0.0;    // a; above 0: a lag
  double distance = 0.0;  // d
  // Of the height: for independent noise of the size of the residuals, and at least what the same
  // shape takes that does not ask where the axis comes from, as an error of its position does.
  double sd = 0.0;
  // Above five standard deviations and a tenth of a micrometre, and dying away within the distances
  // that are tried; else nothing is seen of it.
  bool seen = false;
};

struct ReversalSpikes {
  std::array<Spike, 2> axes{};  // of the plane, in its order
  // The terms of the signature without what spikes make of them.
  std::array<double, kSignatureTerms> signature{};
  double residual_rms = 0.0;
};

[[nodiscard]] Result<ReversalSpikes> reversal_spikes(std::span<const CircleTrace> traces,
                                                     double length);

}  // namespace frustum::instruments
