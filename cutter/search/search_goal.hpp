// What a search of groups asks its goal.
//
// Model    : the goal knows what is covered and what it still wants of the ray. A class has, to be
//            one:
//   RaySpan span()            where on the ray
//   QuadLimit limit(quad, in_box)  what do the ends found so far, by their planes, leave of the
//                             groups, which are there on the ray?
//   double room(segment, from, to)  do they leave nothing of the segment, which is between these
//                             poses? Not if it is less than 0, the less the more is left
//   DoubleFour rooms(leaf, span)  the same of the segments of a leaf that reach no farther than
//                             the span, as counted() has it
//   RaySpan counted(reach)    what of a reach counts, slack and rounding considered
//   bool wants(group, span)   could this, as it counts, still add anything?
//   bool wants_lo(lo)         does it matter where a group begins whose representative does there?
//   double promise(reach)     the more, the sooner it is asked
//   void take(interval)       covered for certain
//   void take_solved(interval)  what a segment covers: its own ends
//   span<const Chord> known() is covered anyway
//   span<const Chord> floors() ends of segments inside these need not be exact
//   kFollowsFront             only what is at one place of the ray counts now; then also
//   bool leaves_for_later(group, motion)  does a segment surely cover nothing there? Its group is
//                             asked again when the place has moved
//   bool wants_piece(group, lo, hi)  could a piece of ray still add anything?
//   double begins_by()        what begins beyond adds nothing before more is covered
//   int change()              another number whenever more is covered
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as ray_search.hpp
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/constants.hpp"
#include "cutter/search/pose_group.hpp"
#include "cutter/search/separating_plane.hpp"

namespace frustum::cutter {

// What the ends found so far leave of a group: nothing, nothing of its representative, nothing
// before or beyond a place.
struct GroupLimit {
  bool holds = false;
  bool counts_representative = true;
  double hi = kInfinity, lo = -kInfinity;
};

// Of the groups of a quad.
using QuadLimit = std::array<GroupLimit, kSiblings>;

// The segments of a leaf; in lanes from `count` on the first of them.
struct LeafMotions {
  std::array<std::uint32_t, kMostInLeaf> segments{};
  MotionFour motions{};
  std::size_t count = 0;
};

}  // namespace frustum::cutter
