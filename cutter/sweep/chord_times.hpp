// The moments at which a moving convex cutter meets a ray, and moments between them at which it
// does not.
//
// Model    : samples of the chord, refined until between two neighbours that both have one the
//            covered places hang together (their chords overlap, or one body has gone from the one
//            to the other), and until two without one are proven to have none between, by planes
//            along the ray that part it from the body on its whole way
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : runs end within 1e-9 mm of motion; what is passed over enters the sweep by less than
//            kMissedDepth
#pragma once

#include <boost/container/small_vector.hpp>
#include <optional>
#include <span>

#include "cutter/body/profile.hpp"
#include "cutter/sweep/segment_motion.hpp"

namespace frustum::cutter {

// Times where chords begin or end are found to this much motion.
inline constexpr double kTangentMotion = 1e-9;  // mm
// The body turns by at most this between two samples of its chord: bounds between them hold up to
// 0.1 rad. That chords which overlap have all between them is not proven of a body that turns.
inline constexpr double kTurnPerSample = 0.06;  // rad

struct ChordSample {
  double t = 0.0;
  ToolPose pose{};
  std::optional<Chord> chord{};
};

[[nodiscard]] bool overlap(const Chord& a, const Chord& b);

class ChordTimes {
 public:
  ChordTimes(const Profile& body, const SegmentMotion& motion, const Ray& ray);

  // Sorted by time; a sample without a chord parts two runs.
  [[nodiscard]] std::span<const ChordSample> samples() const {
    return {samples_.data(), samples_.size()};
  }

  // Adds a moment between sample i and the next, with what is around it.
  void insert(std::size_t i, double t);

 private:
  [[nodiscard]] ChordSample sample(double t) const;
  void refine_between(const ChordSample& a, const ChordSample& b, int depth);
  void join(const ChordSample& a, const ChordSample& b, int depth);
  [[nodiscard]] double departure(const ChordSample& a, const ChordSample& b) const;
  void search_beside_run(const ChordSample& run_end, const ChordSample& outside, int depth);
  [[nodiscard]] bool leaves_for_good(const ChordSample& run_end, const ChordSample& gone,
                                     const ChordSample& outside) const;
  // So much a point of the body may leave the straight way between two samples.
  [[nodiscard]] double slack_between(const ChordSample& a, const ChordSample& b) const;
  [[nodiscard]] double resolution() const;
  [[nodiscard]] ChordSample end_of_run(ChordSample inside, ChordSample outside) const;
  void search_empty(const ChordSample& a, const ChordSample& b);
  [[nodiscard]] bool stays_beyond_end(const ChordSample& a, const ChordSample& b) const;
  [[nodiscard]] double reach_of_plane(const ChordSample& start, const ChordSample& end,
                                      double slack) const;

  const Profile& body_;
  const SegmentMotion& motion_;
  const Ray& ray_;
  boost::container::small_vector<ChordSample, 8> samples_{};
};

}  // namespace frustum::cutter
