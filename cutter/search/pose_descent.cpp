#include "cutter/search/pose_descent.hpp"

#include <cstddef>

#include "cutter/search/axis_distance.hpp"
#include "cutter/search/prefetch.hpp"

namespace frustum::cutter {

std::optional<std::uint32_t> likely_segment_at(const Vec3& point, const RayQuestion& question,
                                               const ToolSweep& sweep) {
  if (sweep.tree.empty()) return std::nullopt;
  const AxisDistance distance(point, *sweep.body);
  for (std::uint32_t quad = 0;;) {
    const GroupQuad& groups = sweep.tree.quads()[quad];
    const FloatFour away2 = distance.squares(groups);
    std::size_t best = kSiblings, second = kSiblings;
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      if (groups.earliest[lane] >= question.first_excluded) continue;
      if (best == kSiblings || away2[lane] < away2[best]) {
        second = best;
        best = lane;
      } else if (second == kSiblings || away2[lane] < away2[second]) {
        second = lane;
      }
    }
    if (best == kSiblings) return std::nullopt;
    if (groups.count[best] > 0) {
      const std::uint32_t middle = groups.representative_segment[best];
      // What a climb from there looks at, and what a search asks of the leaf.
      fetch(&question.path->poses[groups.representative_pose[best]], 3);
      fetch(&question.path->segments[middle], 1);
      fetch(&sweep.tree.segments()[groups.next[best]], 1);
      return middle < question.first_excluded ? middle : groups.earliest[best];
    }
    quad = groups.next[best];
    fetch(&sweep.tree.quads()[quad], 1);
    // A search that follows mostly comes there, too.
    if (second != kSiblings && groups.count[second] == 0)
      fetch(&sweep.tree.quads()[groups.next[second]], 1);
  }
}

}  // namespace frustum::cutter
