#include "trials/cut_check.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace frustum::trials {
namespace {

struct PointCount {
  std::size_t uncut = 0;   // on the blank's own surface
  std::size_t others = 0;  // cut by another operation
};

PointCount count_strangers(const programs::Operation& operation, const stock::Workpiece& workpiece,
                           const metrology::MeasuredFeature& feature,
                           const Pose& workpiece_from_datum) {
  PointCount count;
  for (const metrology::MeasuredPoint& p : feature.points) {
    const auto surface = surface_at_point(workpiece, workpiece_from_datum.point(p.point),
                                          workpiece_from_datum.direction(p.normal));
    if (!surface) continue;  // a noisy measurement may be off the surface
    if (!surface->segment) {
      ++count.uncut;
    } else if (surface->source_line < operation.first_line ||
               surface->source_line > operation.last_line) {
      ++count.others;
    }
  }
  return count;
}

Diagnostic finding(const std::string& feature, const std::string& operation, std::size_t points,
                   const PointCount& count) {
  if (count.uncut > 0) {
    return warning(fmt::format("feature '{}': {} of {} measured points lie on the uncut blank, not "
                               "on what operation '{}' cuts",
                               feature, count.uncut, points, operation),
                   "the blank needs more allowance than the errors move the cut");
  }
  return warning(fmt::format("feature '{}': {} of {} measured points were cut by another operation "
                             "than '{}'",
                             feature, count.others, points, operation),
                 "look at the passes that come near this feature");
}

}  // namespace

std::optional<stock::SurfacePoint> surface_at_point(const stock::Workpiece& workpiece,
                                                    const Vec3& point, const Vec3& normal) {
  return workpiece.first_surface({point + kSurfaceSearch * normal, -normal},
                                 {0.0, 2.0 * kSurfaceSearch});
}

Diagnostics wrongly_cut_features(const programs::TestPiece& piece,
                                 const stock::Workpiece& workpiece,
                                 const metrology::Measurement& measurement) {
  Diagnostics findings;
  for (const programs::Operation& operation : piece.operations) {
    for (const std::string& name : operation.makes) {
      const auto feature =
          std::find_if(measurement.features.begin(), measurement.features.end(),
                       [&](const metrology::MeasuredFeature& f) { return f.name == name; });
      if (feature == measurement.features.end()) continue;
      const PointCount count =
          count_strangers(operation, workpiece, *feature, measurement.workpiece_from_datum);
      if (count.uncut + count.others > 0) {
        findings.push_back(finding(name, operation.name, feature->points.size(), count));
      }
    }
  }
  return findings;
}

}  // namespace frustum::trials
