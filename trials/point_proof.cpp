#include "trials/point_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "stock/proof/certificate.hpp"
#include "trials/cut_check.hpp"

namespace frustum::trials {
namespace {

struct Named {
  const std::string* feature;
  std::size_t index;
  stock::SurfacePoint surface;
};

std::vector<Named> surface_of(const stock::Workpiece& workpiece,
                              const metrology::Measurement& measurement) {
  std::vector<Named> points;
  const Pose& workpiece_from_datum = measurement.workpiece_from_datum;
  for (const metrology::MeasuredFeature& feature : measurement.features) {
    for (std::size_t i = 0; i < feature.points.size(); ++i) {
      const auto surface =
          surface_at_point(workpiece, workpiece_from_datum.point(feature.points[i].point),
                           workpiece_from_datum.direction(feature.points[i].normal));
      if (surface) points.push_back({&feature.name, i, *surface});
    }
  }
  return points;
}

std::string told(const Named& point, const std::string& reason) {
  return fmt::format("feature '{}', point {}: {}", *point.feature, point.index + 1, reason);
}

}  // namespace

PointProof prove_points(const stock::Workpiece& workpiece,
                        const metrology::Measurement& measurement, std::size_t sample) {
  const std::vector<Named> points = surface_of(workpiece, measurement);
  PointProof proof;
  proof.points = points.size();
  for (const Named& p : points) {
    proof.worst_bound = std::max(proof.worst_bound, p.surface.bound);
    proof.worst_sweep_bound = std::max(proof.worst_sweep_bound, p.surface.sweep_bound);
  }
  proof.sampled = std::min(sample, points.size());
  if (proof.sampled == 0) return proof;
  const stock::Certifier certifier(workpiece);
  for (std::size_t k = 0; k < proof.sampled; ++k) {
    const Named& p = points[k * points.size() / proof.sampled];
    const stock::Certificate certificate = certifier.certify(p.surface);
    proof.spans += certificate.spans;
    switch (certificate.verdict) {
      case stock::Verdict::proven:
        ++proof.proven;
        proof.regular += certificate.regular ? 1 : 0;
        break;
      case stock::Verdict::refuted:
        if (++proof.refuted == 1) proof.first_refuted = told(p, certificate.reason);
        break;
      case stock::Verdict::open:
        if (proof.first_open.empty()) proof.first_open = told(p, certificate.reason);
        break;
    }
  }
  return proof;
}

}  // namespace frustum::trials
