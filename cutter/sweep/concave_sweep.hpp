// What a concave cutter covers of a ray on one segment of tool path.
//
// Model    : the sweep of a concave section's hull is known from segment_sweep.hpp. Where the hull
//            touches its end with the body's own surface, that is the body's end too, and often the
//            body there covers all the way up to it. What remains is walked: with d(x, t) the
//            signed distance of a point to the body at time t, phi(x) = min over t of d is below
//            zero exactly where the segment covers; along a ray it changes by at most the way, so
//            that steps as long as phi never pass an end. Longer steps are sure where the body as
//            it is at one moment, or at moments near it, goes on along the ray; and where no part
//            of the motion comes to a whole stretch of it, by the distance at both ends of the part
//            or because the stretch is in front of an end of the body. The same bounds leave parts
//            of the motion aside where phi is looked for
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : ends within 0.1 nm normal to the surface of what is sampled of phi, and that within 10
//            nm of the truth (concave_accuracy): valleys of d over t are separated by samples of
//            the motion, the denser the smaller the body's features are. A piece that the ray
//            enters by less than kMissedDepth may be missed; where a ray slides along the surface,
//            one of less than 1 um
// Source   : sphere tracing (Hart 1996) of a minimum of distances
#pragma once

#include <cstddef>
#include <vector>

#include "core/constants.hpp"
#include "cutter/body/body.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {

// No end is farther than this from the sweep of a body with concave sections, normal to it (mm).
[[nodiscard]] double concave_accuracy(const Body& body);

// Outward unit normal of the body's surface nearest to a point.
[[nodiscard]] Vec3 generatrix_normal(const Generatrix& generatrix, const ToolPose& pose,
                                     const Vec3& point);

class ConcaveSweep {
 public:
  ConcaveSweep(const Body& body, const SegmentMotion& motion, const Ray& ray);

  // Whether a hull touches this end of its sweep with the body's own surface.
  [[nodiscard]] bool is_of_body(const SweptEnd& end) const;
  // Whether the body, where it touches that end, covers all between it and `from`.
  [[nodiscard]] bool covers_from(double from, const SweptEnd& end) const;
  // Whether a ray slides along the end of a body that turns: sweeps of hulls take long then, and to
  // walk does not.
  [[nodiscard]] bool slides() const;
  // Appends what is covered between lo and hi and begins no farther than `begins_by`; of what does
  // not go on beyond that nothing, and what begins shortly before is said to begin there.
  void walk(double lo, double hi, SegmentIntervals& found, double begins_by = kInfinity) const;
  // When the body's surface, or its inside, is nearest to the ray's point at s.
  [[nodiscard]] double nearest_state(double s) const { return nearest(s, 0.5, Want::least).t; }
  // How often it has asked how far a point is from the body.
  [[nodiscard]] std::size_t looks() const { return looks_; }

 private:
  // The least signed distance over the segment, and when.
  struct Nearest {
    double distance = 0.0;
    double t = 0.0;
  };
  // Of the ray's point at a moment: how far it is from the body, counted from just below the
  // surface; where on the meridian, and how far from what the tool turns about; how fast the ray
  // climbs.
  struct Look {
    double t = 0.0;
    double distance = 0.0;
    MeridianPoint place{};
    double away = 0.0, climb = 0.0;
  };
  // The least distance there is, or only on which side of zero it is and a bound.
  enum class Want : bool { least, side };
  [[nodiscard]] Look look(double s, double t) const;
  [[nodiscard]] double distance(double s, double t) const { return look(s, t).distance; }
  // No distance is less at any moment from a to b, all along the ray as far as `reach` from their
  // place; more than `enough` is not asked for. And at one moment.
  [[nodiscard]] double least_between(const Look& a, const Look& b, double reach,
                                     double enough) const;
  [[nodiscard]] double least_beside(const Look& at, double reach) const;
  [[nodiscard]] bool is_outside(double lo, double hi, double& likely) const;
  [[nodiscard]] double outside_until(double s, double hi, double& likely, double& stretch) const;
  // How far the body as it is at time t surely covers the ray from s on, where it covers it; and
  // the most that moments near t do.
  [[nodiscard]] double covered_until(double s, double t, double hi) const;
  struct Covered {
    double until = 0.0;
    double t = 0.0;
  };
  [[nodiscard]] Covered covered_around(double s, double t, double hi) const;
  [[nodiscard]] bool covers_along(double s, double t, double next, double next_t) const;
  // What was done last: over how much of the ray to try, and how fast time went along it.
  struct Following {
    double stretch = 0.0;
    double pace = 0.0;
    bool is_longer = false;  // than what one moment covers
  };
  [[nodiscard]] Covered covered_along(double s, double t, double hi, Following& last) const;
  [[nodiscard]] Covered covered_from(double s, Nearest& here, double hi, Following& last) const;
  // `likely`: a moment to begin with.
  [[nodiscard]] Nearest nearest(double s, double likely, Want want) const;
  [[nodiscard]] Nearest lowest(double s, double lo, double hi) const;
  [[nodiscard]] SweptEnd close_in(double a, Nearest at_a, double b, Nearest at_b) const;

  const Body& body_;
  const SegmentMotion& motion_;
  const Ray& ray_;
  Vec3 step_ = Vec3::Zero();   // of the tip
  double run_ = 0.0;           // mm
  Vec3 pivot_ = Vec3::Zero();  // unit, what the tool turns about; 0: it does not
  double sample_ = 0.0;        // mm of motion
  int steps_ = 1;
  mutable std::size_t looks_ = 0;
};

}  // namespace frustum::cutter
