// What single cutters cover of all rays of a tile, and by how much groups of poses stay behind.
//
// Model    : a convex cutter that covers places on the corner rays covers all between these, and
//            what a plane of a group leaves of a place is a concave function of it (end_fan.hpp):
//            where the four corners are clear of the group, so are all rays between
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm)
// Source   : ours
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/box.hpp"
#include "core/constants.hpp"
#include "core/ray.hpp"
#include "cutter/body/profile.hpp"
#include "cutter/search/pose_group.hpp"
#include "cutter/search/separating_plane.hpp"

namespace frustum::cutter {

// The rays of a tile: between four corner rays, whose origins are in one plane across them.
struct RayTile {
  std::array<Ray, 4> corners{};
  RaySpan span{};  // of all, along the corner rays
  Box box{};
  double size = 0.0;  // mm across
};

// A cutter that covers all rays of a tile beyond the span. Groups that are left aside for it may
// hold its own segment: so it is asked itself.
struct TileAnchor {
  const Profile* part = nullptr;
  ToolPose pose{};
  std::uint32_t segment = 0;
  std::uint32_t section = 0;
  double t = 0.0;
};

// One end of what a cutter at a pose covers, on all rays of a tile.
struct HalfCover {
  std::array<Chord, 4> chords{};  // of the corners
  std::array<Vec3, 4> ends{};     // where they end
  SeparatingPlane plane{};        // at the end of the middle ray
  bool is_beyond = false;         // the end is beyond the span on all rays
  TileAnchor anchor{};

  // All rays of the tile leave what is covered so far before any cutter of four groups, by planes,
  // normal to these (mm). Between the corners the end is farther out than a straight line, and a
  // plane of a group no nearer than one.
  [[nodiscard]] DoubleFour behind(const GroupQuad& groups) const {
    const QuadPlanes planes = plane.planes(groups);
    DoubleFour all;
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      const Vec3 normal = planes.normal_of(lane);
      const double turn = planes.turn[lane];
      double least = kInfinity;
      for (const Vec3& end : ends) {
        const Vec3 off = end - plane.end();
        least = std::min(normal.dot(off) - turn * off.norm(), least);
      }
      all[lane] = normal.dot(plane.beyond()) > turn
                      ? least + planes.height[lane] - planes.lost[lane]
                      : -kInfinity;
    }
    return all;
  }
};

// What is covered for certain on all rays of a tile: between two planes.
struct TileCover {
  HalfCover lo{}, hi{};
};

}  // namespace frustum::cutter
