// For how long one surface point is touched by the pass that made it.
//
// Model    : a generatrix touches a point at one instant; a flat end face that moves in its own
//            plane, or a side face that moves along its own axis, touches it as long as the point
//            is under the face. The range begins and ends where the face leaves the point
// Units    : mm
// Shape    : one point of one block; walks over the neighbouring segments of that block
// Errors   : none
// Accuracy : touched means as near as at the contact's own state, at best 1e-10 mm; the ends are
//            found to
//            1e-9 of a segment
// Source   : ours
#pragma once

#include <vector>

#include "cutter/search/swept_cutter.hpp"

namespace frustum::cutter {

// A state of a tool path: within a segment, t in [0, 1].
struct PathState {
  std::uint32_t segment = 0;
  double t = 0.0;
};

// First and last state of the path, and the ends of segments between them, in order; one state for
// a contact that is gone at once. The contact's own state is between the first and the last.
[[nodiscard]] std::vector<PathState> contact_range(const SweptCutter& swept,
                                                   const PathState& contact, const Vec3& point);

}  // namespace frustum::cutter
