// A plane through the end of what is covered that goes with the cutter: proof that it goes no
// farther.
//
// Model    : where a cutter touches the end of what is covered it has a tangent plane. Another
//            cutter near by has its own plane of that latitude, turned about its axis towards the
//            end; if the end is beyond that plane, and the ray leaves it, then this cutter covers
//            nothing beyond the end. For a group of poses, or the motion from pose to pose, the
//            plane's distance is bounded
// Units    : mm; frame: workpiece
// Errors   : none; false says nothing
// Accuracy : proofs hold but for kSearchTolerance normal to the surface, or for another slack
#pragma once

#include <limits>
#include <optional>

#include "cutter/body/body.hpp"
#include "cutter/search/pose_tree.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/segment_sweep.hpp"
#include "cutter/sweep/supporting_plane.hpp"

namespace frustum::cutter {

// Which convex section of a body the end of a swept interval is on, and the body's pose then.
struct EndContact {
  double s = 0.0;             // mm along the ray
  std::uint32_t section = 0;  // or kConcaveSurface
  ProfileFace face = kTopFace;
  ToolPose pose{};
};

// How far along the ray a group may cover more than the end, and whether its representative may.
struct Overreach {
  double most = std::numeric_limits<double>::infinity();  // mm; not positive: surely nothing
  bool by_representative = true;
  double rounding = 0.0;  // of `most` (mm): what 1e-12 mm normal to the plane makes along the ray
};

class SeparatingPlane {
 public:
  // Holds nothing back: for ends that no convex section makes.
  SeparatingPlane() = default;
  // `leaving`: what is covered is before the end, else after it.
  SeparatingPlane(const Body& body, const Ray& ray, const EndContact& end, bool leaving);

  // `slack`: so much beyond the plane, normal to it, does not count (mm). Negative: the proof is
  // that the cutter stays so much before the end.
  [[nodiscard]] Overreach overreach(const PoseGroup& group, double slack = kSearchTolerance) const;
  // Cosine between the ray and the plane's normal when the body is at the pose; 0: no plane.
  [[nodiscard]] double along(const ToolPose& pose) const;
  // Whether the moving body surely covers nothing beyond the end.
  [[nodiscard]] bool holds(const SegmentMotion& motion, double slack = kSearchTolerance) const;

 private:
  // The plane that touches the body at the pose, perpendicular to the way to the end.
  [[nodiscard]] std::optional<SupportingPlane> touching(const ToolPose& pose) const;
  [[nodiscard]] double support(double lateral, double axial) const;
  [[nodiscard]] double support_of_round(double lateral, double axial) const;

  const Body* body_ = nullptr;  // null: no proof
  Vec3 end_ = Vec3::Zero();
  Vec3 beyond_ = Vec3::Zero();  // unit, along the ray, away from what is covered
  // Latitude of the plane: fixed on flat, cylindrical and conical faces, on round ones towards the
  // end.
  double axial_ = 0.0, lateral_ = 0.0, offset_ = 0.0;
  bool is_round_ = false;
  Zone round_{};  // a rim is a torus of no minor radius
};

}  // namespace frustum::cutter
