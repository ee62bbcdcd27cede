#include "trials/point_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "stock/proof/certificate.hpp"

namespace frustum::trials {
namespace {

struct ProbedPoint {
  const std::string* feature;
  std::size_t index;
  stock::SurfacePoint surface;
};

std::vector<ProbedPoint> probed_points(const metrology::Measurement& measurement) {
  std::vector<ProbedPoint> points;
  for (const metrology::MeasuredFeature& feature : measurement.features) {
    for (std::size_t i = 0; i < feature.touches.size(); ++i) {
      const metrology::Touch& touch = feature.touches[i];
      if (!touch.provenance) continue;
      const Provenance& by = *touch.provenance;
      points.push_back({&feature.name,
                        i,
                        {.point = touch.point,
                         .normal = touch.normal,
                         .segment = by.segment,
                         .source_line = by.source_line,
                         .t = by.t,
                         .sweep_bound = by.sweep_bound,
                         .bound = by.bound}});
    }
  }
  return points;
}

std::string described(const ProbedPoint& point, const std::string& reason) {
  return fmt::format("feature '{}', point {}: {}", *point.feature, point.index + 1, reason);
}

}  // namespace

PointProof prove_points(const stock::Workpiece& workpiece,
                        const metrology::Measurement& measurement, std::size_t sample) {
  const std::vector<ProbedPoint> points = probed_points(measurement);
  PointProof proof;
  proof.points = points.size();
  for (const ProbedPoint& p : points) {
    proof.worst_bound = std::max(proof.worst_bound, p.surface.bound);
    proof.worst_sweep_bound = std::max(proof.worst_sweep_bound, p.surface.sweep_bound);
  }
  proof.sampled = std::min(sample, points.size());
  if (proof.sampled == 0) return proof;
  const stock::Certifier certifier(workpiece);
  for (std::size_t k = 0; k < proof.sampled; ++k) {
    const ProbedPoint& p = points[k * points.size() / proof.sampled];
    const stock::Certificate certificate = certifier.certify(p.surface);
    proof.spans += certificate.spans;
    switch (certificate.verdict) {
      case stock::Verdict::proven:
        ++proof.proven;
        proof.regular += certificate.regular ? 1 : 0;
        break;
      case stock::Verdict::refuted:
        if (++proof.refuted == 1) proof.first_refuted = described(p, certificate.reason);
        break;
      case stock::Verdict::open:
        if (proof.first_open.empty()) proof.first_open = described(p, certificate.reason);
        break;
    }
  }
  return proof;
}

}  // namespace frustum::trials
