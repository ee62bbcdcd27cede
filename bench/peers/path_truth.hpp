// How far a point is from the true surface, by standing cutters: no ray, chord or envelope of ours.
//
// Model    : the material's signed distance is max(blank's, -void's); the void's is the least
//            signed distance to the cutter at any time (tests/cutter/standing_cutters.hpp). Parts
//            of the path are left out when a bound on their motion proves them farther away
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : 1e-4 nm in the material and where the surface is smooth; at most the distance outside
//            beyond a convex edge, where it is the larger of those to the two faces
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <vector>

#include "bench/peers/scene.hpp"

namespace frustum::bench {

class PathTruth {
 public:
  // Farther points are said to be as far as this.
  static constexpr double kFarthest = 1.0;

  explicit PathTruth(const PeerScene& scene);

  struct Offset {
    double distance = 0.0;      // outside the material positive
    bool is_machined = false;   // the cutter's surface is nearer than the blank's
    bool is_near_edge = false;  // within kFarthest of both: where they meet is not far
  };
  [[nodiscard]] Offset of(const Vec3& point) const;

 private:
  // Neighbours on the path, and a cylinder around the cutter in their midst.
  struct Part {
    proof::StandingCutters cutters;
    kinematics::ToolPose middle;
    double motion;  // no point of the cutter is farther than this from where it is there
  };
  [[nodiscard]] double lower_bound(const Part& part, const Vec3& point) const;
  [[nodiscard]] double to_void(const Vec3& point) const;

  std::vector<Part> parts_{};
  Box blank_{};
  double radius_;
  double height_;
};

}  // namespace frustum::bench
