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

// Of four groups: how far along the ray they may cover more than the end (mm; not positive: surely
// nothing), and about how far the end is beyond the plane of a cutter in their middle (less than 0:
// it may well cover more).
struct Overreach {
  DoubleFour most = four_of(std::numeric_limits<double>::infinity());
  DoubleFour height = four_of(-1.0);
  DoubleFour rounding{};  // of `most` (mm): what 1e-12 mm normal to the plane makes along the ray
};

// Planes that touch the cutters of four groups, each where it comes nearest to the end: none of any
// pose of its group passes it, but for what it is lowered by. At a place that is y from the end the
// plane is normal.y higher, and lowered by at most turn |y| more.
struct QuadPlanes {
  std::array<DoubleFour, 3> normal{};  // out of the cutters; units
  DoubleFour height{};                 // of the end over the plane that comes nearest (mm)
  DoubleFour lost{};                   // over that of any pose it may be lower by so much
  DoubleFour turn{};                   // no axis of the group is farther from the middle's

  [[nodiscard]] Vec3 normal_of(std::size_t lane) const {
    return {normal[0][lane], normal[1][lane], normal[2][lane]};
  }
};

// Four motions of a cutter from pose to pose, side by side.
struct MotionFour {
  std::array<DoubleFour, 3> from_tip{}, from_axis{}, to_tip{}, to_axis{};

  void set(std::size_t lane, const ToolPose& from, const ToolPose& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = static_cast<Eigen::Index>(k);
      from_tip[k][lane] = from.tip[d];
      from_axis[k][lane] = from.axis[d];
      to_tip[k][lane] = to.tip[d];
      to_axis[k][lane] = to.axis[d];
    }
  }
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
  [[nodiscard]] QuadPlanes planes(const GroupQuad& groups,
                                  LaneChoice lanes = LaneChoice::best) const;

  // `slack`: so much beyond the plane, normal to it, does not count (mm). Negative: the proof is
  // that the cutter stays so much before the end.
  [[nodiscard]] Overreach overreach(const GroupQuad& groups, double slack = kSearchTolerance,
                                    LaneChoice lanes = LaneChoice::best) const;
  // Cosine between the ray and the plane's normal when the body is at the pose; 0: no plane.
  [[nodiscard]] double along(const ToolPose& pose) const;
  // The end is at least so far beyond the plane (mm) while the body moves from pose to pose; if it
  // is not less than 0, the body surely covers nothing beyond the end. Where that cannot be told it
  // is less than 0.
  [[nodiscard]] double room(const ToolPose& from, const ToolPose& to,
                            double slack = kSearchTolerance) const;
  // The same of four.
  [[nodiscard]] DoubleFour rooms(const MotionFour& motions, double slack,
                                 LaneChoice lanes = LaneChoice::best) const;
  [[nodiscard]] bool holds(const ToolPose& from, const ToolPose& to,
                           double slack = kSearchTolerance) const {
    return room(from, to, slack) >= 0.0;
  }
  [[nodiscard]] bool holds(const SegmentMotion& motion) const {
    return holds(motion.at(0.0), motion.at(1.0));
  }

 private:
  // What is written once for two and for four lanes.
  template <class Lanes>
  struct OfLanes;
#ifdef FRUSTUM_HAS_FOUR_LANES
  FRUSTUM_FOUR_LANES void planes_four(const GroupQuad& groups, QuadPlanes& all) const;
  FRUSTUM_FOUR_LANES void rooms_four(const MotionFour& motions, double slack,
                                     DoubleFour& rooms) const;
  FRUSTUM_FOUR_LANES void overreach_four(const GroupQuad& groups, double slack,
                                         Overreach& over) const;
#endif
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
