// What a concave cutter covers of a ray on one segment of tool path.
//
// Model    : the sweep of a concave section's hull is known from segment_sweep.hpp. Where the hull
//            touches its end with the body's own surface, that is the body's end too, and often the
//            body there covers all the way up to it. What remains is walked: with d(x, t) the
//            signed distance of a point to the body at time t, phi(x) = min over t of d is below
//            zero exactly where the segment covers; along a ray it changes by at most the way, so
//            that steps as long as phi never pass an end. Longer steps are sure where the body as
//            it is at one moment goes on along the ray, and in front of its ends
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
  // Appends what is covered between lo and hi.
  void walk(double lo, double hi, std::vector<SegmentInterval>& found) const;
  // When the body's surface, or its inside, is nearest to the ray's point at s.
  [[nodiscard]] double nearest_state(double s) const { return nearest(s).t; }
  // How often it has asked how far a point is from the body.
  [[nodiscard]] std::size_t looks() const { return looks_; }

 private:
  // The least signed distance over the segment, and when.
  struct Nearest {
    double distance = 0.0;
    double t = 0.0;
  };
  // Whether all of lo to hi is in front of one end of the body, or on it, all the time.
  [[nodiscard]] bool is_in_front(double lo, double hi) const;
  [[nodiscard]] double in_front_from(double s, double hi) const;
  // How far the body as it is at time t surely covers the ray from s on, where it covers it.
  [[nodiscard]] double covered_until(double s, double t, double hi) const;
  [[nodiscard]] Nearest nearest(double s) const;
  [[nodiscard]] Nearest lowest(double s, double lo, double hi) const;
  [[nodiscard]] SweptEnd close_in(double a, Nearest at_a, double b, Nearest at_b) const;
  [[nodiscard]] double distance(double s, double t) const;

  const Body& body_;
  const SegmentMotion& motion_;
  const Ray& ray_;
  double sample_ = 0.0;  // mm of motion
  int steps_ = 1;
  mutable std::size_t looks_ = 0;
};

}  // namespace frustum::cutter
