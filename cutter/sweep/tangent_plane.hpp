// The plane that touches a body where a ray leaves or enters it.
//
// Model    : a SupportingPlane. Wherever the body goes it stays on its side of it
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : 1e-12 mm normal to the plane
#pragma once

#include "cutter/body/profile.hpp"
#include "cutter/sweep/supporting_plane.hpp"

namespace frustum::cutter {

// Where the ray crosses a plane, and the cosine between them; infinite where it does not.
struct PlaneCrossing {
  double value = 0.0;
  double along = 0.0;
};

struct TangentPlane : SupportingPlane {
  // `leaving`: at chord.hi, else at chord.lo.
  TangentPlane(const Profile& body, const ToolPose& pose, const Ray& ray, const Chord& chord,
               bool leaving);
  // Where the ray crosses the plane when the body is at another pose, counted along the ray if
  // leaving, else against it: no end of the body's chord is beyond. Infinite if the ray runs along
  // the plane.
  [[nodiscard]] PlaneCrossing crossing(const ToolPose& pose, const Ray& ray) const;

  double value;      // where that pose leaves the ray: s if leaving, else -s
  double along;      // cosine between the normal there and the direction of counting
  double direction;  // of counting: 1 leaving, -1 entering
};

}  // namespace frustum::cutter
