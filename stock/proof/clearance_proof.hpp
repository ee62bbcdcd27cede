// Proof that a cutter stays clear of a point for a whole path segment, or the instant at which it
// does not.
//
// Model    : a plane that touches a slice of the body at one instant goes with the body, tip and
//            axis as the path says. How far the point is on its free side is a function of time;
//            value and slope at that instant are enclosed, the rest is bounded by the square of the
//            time:
//              f(x) >= f0 + x f1 - x^2 (w^2 (|m| + |x| v) / 2 + w v)
//            with the turn w, the way v of the tip and m from tip to point, all for x = 1. Where
//            that stays above zero the body stays clear; else the span of time is halved.
//            Directions at the halves are midpoints of great circles, so that square roots are all
//            that is needed
// Units    : mm, rad; frame: workpiece; time as a fraction of the segment
// Errors   : none; a proof that takes too many spans, or coordinates above 1e5 mm, end as `open`
// Accuracy : `apart` is a proof, `covered` is found in double precision
// Source   : mean value form (Moore 1966); independent of cutter/sweep/segment_sweep.hpp
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cutter/body/cutter.hpp"
#include "kinematics/path/tool_path.hpp"
#include "stock/proof/enclosure.hpp"
#include "stock/proof/meridian_zone.hpp"

namespace frustum::stock {

// A unit vector that is known to be within `radius` of `middle`.
struct UnitBall {
  Vec3 middle = Vec3::UnitZ();
  double radius = 0.0;

  // The direction that an axis of the tool path means: of length one, exactly.
  [[nodiscard]] static UnitBall of(const Vec3& axis);
  [[nodiscard]] Enclosure3 enclosure() const { return enclose(middle, radius); }
};
// The middle of the great circle between two directions.
[[nodiscard]] UnitBall halfway(const UnitBall& a, const UnitBall& b);

// The poses of one segment between two of its instants.
struct PoseSpan {
  Vec3 begin = Vec3::Zero();  // tips of the whole segment
  Vec3 end = Vec3::Zero();
  double t0 = 0.0, t1 = 1.0;
  UnitBall axis0{}, axis1{};

  [[nodiscard]] static PoseSpan of(const kinematics::ToolPose& from,
                                   const kinematics::ToolPose& to);
  [[nodiscard]] double middle() const { return 0.5 * (t0 + t1); }
  [[nodiscard]] PoseSpan first_half() const;
  [[nodiscard]] PoseSpan second_half() const;
  [[nodiscard]] Vec3 tip(double t) const { return begin + t * (end - begin); }
  [[nodiscard]] Enclosure3 enclosed_tip(double t) const;
};

// What a proof needs to know of a cutter.
struct BodyGeneratrix {
  const cutter::Generatrix* generatrix = nullptr;
  std::vector<MeridianZone> zones{};
  bool filled = true;  // the zones are the body; false: it is concave and they enclose it

  explicit BodyGeneratrix(const cutter::Body& body)
      : generatrix(&body.generatrix()),
        zones(zones_of(body.generatrix())),
        filled(body.concave().empty()) {}
};

// Signed distance of a point from the body at a pose, in double precision: within 1e-11 mm.
[[nodiscard]] double distance_from(const BodyGeneratrix& body, const Vec3& tip, const Vec3& axis,
                                   const Vec3& point);
// True is a proof: the point is inside the body, deeper than `margin`, at that instant of the
// segment (or the nearest one that halving comes to).
[[nodiscard]] bool surely_inside(const BodyGeneratrix& body, const PoseSpan& segment, double t,
                                 const Vec3& point, double margin = 0.0);

enum class Clearance : std::uint8_t { apart, covered, open };

struct ClearanceProof {
  Clearance clearance = Clearance::apart;
  double t = 0.0;         // when it is covered
  std::size_t spans = 0;  // of time that were looked at
};
// Whether all points within `margin` of `point` stay outside over the segment.
[[nodiscard]] ClearanceProof prove_clearance(const BodyGeneratrix& body, const PoseSpan& segment,
                                             const Vec3& point, double margin,
                                             std::size_t most_spans);

}  // namespace frustum::stock
