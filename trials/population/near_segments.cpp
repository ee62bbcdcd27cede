#include "trials/population/near_segments.hpp"

#include "cutter/sweep/segment_motion.hpp"

namespace frustum::trials {

NearSegments::NearSegments(const cutter::SweptCutter& removed) : removed_(removed) {
  const kinematics::ToolPath& path = removed.path();
  segments_.reserve(path.segments.size());
  for (std::uint32_t s = 0; s < path.segments.size(); ++s) {
    const kinematics::PathSegment& segment = path.segments[s];
    const int tool = path.blocks[segment.block].tool;
    const double reach = removed.tool(tool).body().reach();
    Segment one{removed.box(s), cutter::SegmentMotion(path, segment, reach).travel()};
    if (s > 0) {
      const kinematics::PathSegment& before = path.segments[s - 1];
      one.runs_on =
          segment.first_pose == before.first_pose + 1 && path.blocks[before.block].tool == tool;
    }
    segments_.push_back(one);
  }
}

NearSegments::AtEnds NearSegments::distances(std::uint32_t segment, const Vec3& point) const {
  const kinematics::ToolPath& path = removed_.path();
  const kinematics::PathSegment& at = path.segments[segment];
  const cutter::Body& body = removed_.tool(path.blocks[at.block].tool).body();
  return {body.distance(path.from(at), point), body.distance(path.to(at), point)};
}

}  // namespace frustum::trials
