// How near the measured points are to the true surface, and a proof of it for some of them.
//
// Model    : every touched point keeps its bound (core/provenance.hpp); a sample of them, evenly
//            spread over the features, goes through interval arithmetic
//            (stock/proof/certificate.hpp)
// Units    : mm
// Errors   : none; points whose provenance nobody knows are left out
// Accuracy : the bounds are those of stock::SurfacePoint
// Source   : ours
#pragma once

#include <cstddef>
#include <string>

#include "metrology/measurement.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::trials {

struct PointProof {
  std::size_t points = 0;
  double worst_bound = 0.0;        // of all points, against the commanded motion
  double worst_sweep_bound = 0.0;  // of all points, against the tool path: what is proven
  std::size_t sampled = 0;
  std::size_t proven = 0;
  std::size_t regular = 0;  // proven along their own normal, not on an edge
  std::size_t refuted = 0;
  std::size_t spans = 0;        // of time that the proofs took
  std::string first_refuted{};  // where and why
  std::string first_open{};     // neither proven nor refuted
};

[[nodiscard]] PointProof prove_points(const stock::Workpiece& workpiece,
                                      const metrology::Measurement& measurement,
                                      std::size_t sample = 40);

}  // namespace frustum::trials
