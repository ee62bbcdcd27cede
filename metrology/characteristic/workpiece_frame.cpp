#include "metrology/characteristic/workpiece_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "metrology/characteristic/best_shifted_line.hpp"

namespace frustum::metrology {
namespace {

Diagnostics of_frame(const PlannedFrame& frame, Diagnostics failure) {
  for (Diagnostic& d : failure) d.message = fmt::format("frame '{}': {}", frame.name, d.message);
  return failure;
}

const FittedFeature* measured_feature(std::span<const FittedFeature> features,
                                      const std::string& name) {
  const auto found = std::find_if(features.begin(), features.end(),
                                  [&](const FittedFeature& f) { return f.planned->name == name; });
  return found == features.end() ? nullptr : &*found;
}

Diagnostic missing(const PlannedFrame& frame, const std::string& name) {
  return error("feature-without-points"_id,
               fmt::format("frame '{}': feature '{}' has no points", frame.name, name),
               "measure it, or take the characteristics in this frame out of the plan");
}

Vec3 laid_into_base(const Vec3& direction, const Vec3& normal) {
  return (direction - direction.dot(normal) * normal).normalized();
}

Mat3 axes_of(const Vec3& x, const Vec3& z) {
  Mat3 axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace

Pose nominal_frame(const InspectionPlan& plan, const PlannedFrame& frame) {
  const PlannedFeature& plane = *find_feature(plan, frame.planes.front());
  const PlannedFeature& line = *find_feature(plan, frame.line);
  const Vec3 z = unit(plane.axis);
  return {axes_of(laid_into_base(line.axis, z), z), line.point};
}

Result<Pose> workpiece_from_frame(const InspectionPlan& plan, const PlannedFrame& frame,
                                  std::span<const FittedFeature> features) {
  const Pose nominal = nominal_frame(plan, frame);
  const Vec3 nominal_z = nominal.rotation.col(2);
  std::vector<Vec3> on_planes;
  for (const std::string& name : frame.planes) {
    const FittedFeature* feature = measured_feature(features, name);
    if (feature == nullptr) return missing(frame, name);
    for (const MeasuredPoint& p : feature->points) on_planes.push_back(p.point);
  }
  const FittedFeature* line = measured_feature(features, frame.line);
  if (line == nullptr) return missing(frame, frame.line);
  const auto plane = fit_plane(on_planes);
  if (!plane) return of_frame(frame, plane.error());

  const Vec3 normal = plane->element.axis;
  const Vec3 z = normal.dot(nominal_z) < 0.0 ? Vec3(-normal) : normal;
  const Vec3& planned = line->planned->point;
  const double planned_height =
      (planned - find_feature(plan, frame.planes.front())->point).dot(nominal_z);
  const double height = plane->element.point.dot(z) + planned_height;
  Vec3 x = laid_into_base(*axis_of(line->element), z);
  Vec3 origin = Vec3::Zero();
  // The surface leans as planned in the frame that is being found: an error of 1e-3 rad in X is one
  // of 1e-6 after a round, and 1e-12 after two.
  for (int round = 0; round < 4; ++round) {
    const LineAxes axes{x, z.cross(x), z};
    const Vec3 wall = axes_of(x, z) * nominal.rotation.transpose() * line->planned->normal;
    const auto fit = straight_line(shifted(line->points, axes, wall, height));
    if (!fit) return of_frame(frame, fit.error());
    const double along = planned.dot(x);
    origin = along * x + (fit->offset + fit->slope * along) * axes.across + height * z;
    x = (x + fit->slope * axes.across).normalized();
  }
  return Pose{axes_of(x, z), origin} * nominal.inverse();
}

}  // namespace frustum::metrology
