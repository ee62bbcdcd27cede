// A plane through the end of what is covered that goes with the cutter: proof that it goes no
// farther.
//
// Model    : where a cutter touches the end of what is covered it has a tangent plane. Another
//            cutter near by has its own plane of that latitude, turned about its axis towards the
//            end; if the end is beyond that plane, and the ray leaves it, then this cutter covers
//            nothing beyond the end. For the poses of groups, or of a motion, the height of the end
//            over the plane is bounded as in group_bound.hpp, from the pose of the box that comes
//            nearest
// Units    : mm; frame: workpiece
// Errors   : none; false says nothing
// Accuracy : proofs hold but for kSearchTolerance normal to the surface, or for another slack
#pragma once

#include <limits>

#include "cutter/body/body.hpp"
#include "cutter/search/pose_group.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {

// Which convex section of a body the end of a swept interval is on, and the body's pose then.
struct EndContact {
  double s = 0.0;             // mm along the ray
  std::uint32_t section = 0;  // or kConcaveSurface
  ProfileFace face = kTopFace;
  ToolPose pose{};
};

// Of two groups: how far along the ray they may cover more than the end (mm; not positive: surely
// nothing), and about how far the end is beyond the plane of a cutter in their middle (less than 0:
// it may well cover more).
struct Overreach {
  Both most = both(std::numeric_limits<double>::infinity());
  Both height = both(-1.0);
  Both rounding =
      both(0.0);  // of `most` (mm): what 1e-12 mm normal to the plane makes along the ray
};

// Planes that touch the cutters of two groups, each where it comes nearest to the end: none of any
// pose of its group passes it, but for what it is lowered by. At a place that is y from the end the
// plane is normal.y higher, and lowered by at most turn |y| more.
struct PairPlanes {
  BothVec normal{};                // out of the cutters; units
  Both height = both(0.0);         // of the end over the plane that comes nearest (mm)
  Both lost = both(0.0);           // over that of any pose it may be lower by so much
  Both turn = both(0.0);           // no axis of the group is farther from the middle's
  Both in_the_middle = both(0.0);  // about the height over the plane of a cutter there
};

class SeparatingPlane {
 public:
  // Holds nothing back: for ends that no convex section makes.
  SeparatingPlane() = default;
  // `leaving`: what is covered is before the end, else after it.
  SeparatingPlane(const Body& body, const Ray& ray, const EndContact& end, bool leaving);
  // The plane of a latitude, whatever made the end: (lateral, axial) is a unit normal in a
  // meridian of the body.
  struct Latitude {
    double axial = 0.0, lateral = 1.0;
  };
  SeparatingPlane(const Body& body, const Vec3& end, const Vec3& beyond, const Latitude& latitude);

  [[nodiscard]] bool has_proof() const { return body_ != nullptr; }
  [[nodiscard]] const Vec3& end() const { return end_; }
  // Unit, along the ray, away from what is covered.
  [[nodiscard]] const Vec3& beyond() const { return beyond_; }
  // Precondition: has_proof().
  [[nodiscard]] PairPlanes planes(const GroupPair& groups) const;

  // `slack`: so much beyond the plane, normal to it, does not count (mm). Negative: the proof is
  // that the cutter stays so much before the end.
  [[nodiscard]] Overreach overreach(const GroupPair& groups, double slack = kSearchTolerance) const;
  // Cosine between the ray and the plane's normal when the body is at the pose; 0: no plane.
  [[nodiscard]] double along(const ToolPose& pose) const;
  // The end is at least so far beyond the plane (mm) while the body moves from pose to pose; if it
  // is not less than 0, the body surely covers nothing beyond the end. Where that cannot be told it
  // is less than 0.
  [[nodiscard]] double room(const ToolPose& from, const ToolPose& to,
                            double slack = kSearchTolerance) const;
  [[nodiscard]] bool holds(const ToolPose& from, const ToolPose& to,
                           double slack = kSearchTolerance) const {
    return room(from, to, slack) >= 0.0;
  }
  [[nodiscard]] bool holds(const SegmentMotion& motion) const {
    return holds(motion.at(0.0), motion.at(1.0));
  }

 private:
  // The planes of two cutters towards the end, which is at `m` from their tips.
  struct Planes {
    Both axial, lateral;
    BothVec across;  // unit vectors across the meridians
    BothVec normal;
    Both height;  // of the end above the plane
  };
  [[nodiscard]] Planes touching(const BothVec& m, const BothVec& axis) const;
  // Of the end above the plane of a cutter, about.
  [[nodiscard]] Both height_about(const BothVec& m, const BothVec& axis) const;
  // From the tip to where it is nearest to the end, as if it could go anywhere.
  [[nodiscard]] BothVec way_to_end(const BothVec& m, const BothVec& axis) const;
  [[nodiscard]] double support(double lateral, double axial) const;

  const Body* body_ = nullptr;  // null: no proof
  Vec3 end_ = Vec3::Zero();
  Vec3 beyond_ = Vec3::Zero();
  // Latitude of the plane: fixed on flanks, on round faces and at edges towards the end, but
  // between the normals that they have.
  double axial_ = 0.0, lateral_ = 0.0, offset_ = 0.0;
  bool is_round_ = false;
  Zone round_{};  // a rim is a torus of no minor radius
  double least_axial_ = -1.0, most_axial_ = 1.0;
};

}  // namespace frustum::cutter
