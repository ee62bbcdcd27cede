// Where along a ray the cutter may cover anything at the poses of a group.
//
// Model    : the planes that touch the representative where the ray enters and leaves it, moved out
//            by the group's bounds; where they bound badly, or where the ray misses the
//            representative, the representative grown all round
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm)
#pragma once

#include <limits>
#include <optional>

#include "cutter/body/profile.hpp"
#include "cutter/search/pose_group.hpp"

namespace frustum::cutter {

struct GroupReach {
  double lo = 0.0;
  double hi = 0.0;
  double lo_slack = 0.0;  // what kSearchTolerance normal to the surface makes along the ray
  double hi_slack = 0.0;
};
inline constexpr GroupReach kNoReach{
    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

// Which ends are worth a bound; the other may be reported as infinite.
struct WantedEnds {
  bool lo = true;
  bool hi = true;
};

// `known`: the chord of the representative.
[[nodiscard]] GroupReach reach_of(const PoseGroup& group, const ToolPose& representative,
                                  const Profile& part, const Ray& ray,
                                  const std::optional<Chord>& known, WantedEnds wanted);

}  // namespace frustum::cutter
