// How far one end of the chord gets while a convex cutter moves over one segment.
//
// Model    : the end is at B(t), or at -A(t). A plane that touches the body where the chord ends
//            goes with the body and bounds the end at all other times: two such planes close in on
//            the maximum from above while chords close in from below. A top where the end's speed
//            is zero is looked for first, and so is one on an edge of the profile; the plane there
//            that the motion runs along mostly proves it at once
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : within kSearchTolerance, normal to the surface
// Source   : envelope condition of swept volumes; Kelley 1960 (cutting planes) in one dimension
#pragma once

#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "cutter/sweep/chord_times.hpp"
#include "cutter/sweep/segment_sweep.hpp"
#include "cutter/sweep/tangent_plane.hpp"

namespace frustum::cutter {

class HighestEnd {
 public:
  // `leaving`: of B, else of -A; what is not higher than `floor` need not be exact.
  HighestEnd(const Profile& body, const SegmentMotion& motion, const Ray& ray, bool leaving,
             double floor)
      : body_(body), motion_(motion), ray_(ray), leaving_(leaving), floor_(floor) {}

  void offer(const ChordSample& sample) {
    const Chord& chord = *sample.chord;
    const double value = leaving_ ? chord.hi : -chord.lo;
    if (value > best_value_) note(value, sample.t, leaving_ ? chord.hi_face : chord.lo_face);
  }
  // No end is higher than that, it is known: where one is as high, nothing needs a proof.
  void stop_at(double ceiling) { ceiling_ = ceiling; }

  // Where a ray slides along the body there are gaps without end, of rounding. From now on there is
  // no gap() any more: up to kMostPassed moments without a chord are passed over, of the two parts
  // beside one the longer is searched first, and what is left after that and kFewLooks is lost.
  void pass_gaps() {
    passes_gaps_ = true;
    looks_left_ = kFewLooks;
  }

  // Looks between two samples with chords. Nothing is lost unless gap() has a value then.
  void search(const ChordSample& from, const ChordSample& to);
  // The same; returns the planes that touch the body at both.
  std::pair<TangentPlane, TangentPlane> search_with_planes(const ChordSample& from,
                                                           const ChordSample& to);
  // The same of samples between which all that the ray meets hangs together: what surely stays
  // below the floor is not looked at.
  void search_joined(const ChordSample& from, const ChordSample& to);

  // A moment between the samples at which the body does not meet the ray.
  [[nodiscard]] std::optional<double> gap() const { return gap_; }
  [[nodiscard]] SweptEnd best() const {
    return {leaving_ ? best_value_ : -best_value_, best_t_, best_face_};
  }

 private:
  struct Touched {
    double t;
    ToolPose pose;
    TangentPlane plane;
    ProfileFace face;
    bool is_on_edge = false;  // then the plane is between those of two faces
  };
  [[nodiscard]] ChordSample sample_at(double t) const;
  [[nodiscard]] Touched touched(const ChordSample& s) const;
  void note(const Touched& end) {
    if (end.plane.value > best_value_) note(end.plane.value, end.t, end.face);
  }
  void note(double value, double t, ProfileFace face) {
    best_value_ = value;
    best_t_ = t;
    best_face_ = face;
  }

  void look(const Touched& a, const Touched& b);
  // `is_sought`: a top between them has been looked for.
  void close_in(const Touched& a, const Touched& b, int depth, bool is_sought = false);
  [[nodiscard]] bool stays_below_floor(const Touched& a, const Touched& b) const;
  [[nodiscard]] bool surely_no_deeper(const Touched& a, const Touched& b) const;
  [[nodiscard]] double height_holds(const Touched& from, const Touched& to,
                                    const Vec3& point) const;

  [[nodiscard]] std::optional<Touched> summit_between(const Touched& a, const Touched& b,
                                                      double enough);
  [[nodiscard]] double slope_of(const Touched& at) const;
  [[nodiscard]] static bool is_edge_between(const Touched& a, const Touched& b);
  [[nodiscard]] std::optional<Touched> edge_top_between(const Touched& a, const Touched& b) const;
  void come_to_edge();
  void climb(double lo, double hi);
  void note_gap(double t, double dt);
  void pass_gap(const Touched& a, double t, const Touched& b, int depth, bool is_sought);
  [[nodiscard]] ChordSample last_chord(const Touched& inside, double outside) const;

  // A search that needs more looks runs along the surface within rounding; others need tens.
  static constexpr int kMostLooks = 20000, kFewLooks = 1000, kMostPassed = 16;

  const Profile& body_;
  const SegmentMotion& motion_;
  const Ray& ray_;
  bool leaving_;
  double floor_, ceiling_ = kInfinity;
  double best_value_ = -kInfinity;
  double best_t_ = 0.0;
  ProfileFace best_face_ = kTopFace;
  std::optional<double> gap_{};
  bool passes_gaps_ = false;
  int passed_ = 0;
  // The last two samples that the best was one of, and that an edge is between.
  std::optional<std::pair<Touched, Touched>> beside_edge_{};
  int looks_left_ = kMostLooks;
};

}  // namespace frustum::cutter
