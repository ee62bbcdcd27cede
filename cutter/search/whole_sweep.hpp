// What is covered of a ray so far, and which segments may still say more: a goal of GroupSearch.
//
// Model    : overlapping pieces become one. An end belongs to the segment that reaches farthest, in
//            steps of kSearchTolerance along the ray; of segments in the same step to the earliest.
//            It is where that segment's own solution puts it. So the answer depends on the segments
//            alone, not on the order in which a search comes to them: a search may leave aside what
//            surely does not reach the step of an end, or does so later in the program
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : an end is at most one step before where any segment's solution puts it
// Source   : ours
#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cutter/search/group_search.hpp"
#include "cutter/search/ray_search.hpp"
#include "cutter/search/separating_plane.hpp"

namespace frustum::cutter {

// The planes at the ends that a tool's own sweep has made so far.
class EndPlanes {
 public:
  EndPlanes(const RayQuestion& question, const Body& body) : question_(question), body_(body) {}

  [[nodiscard]] SeparatingPlane at(const SweptIntervalEnd& end, bool leaving) const;

 private:
  const RayQuestion& question_;
  const Body& body_;
};

class WholeSweep {
 public:
  // `swept` is what other tools cover: their ends have no planes here.
  WholeSweep(const RayQuestion& question, const ToolSweep& sweep, const EndPlanes& planes,
             std::span<const SweptInterval> swept);

  [[nodiscard]] std::vector<SweptInterval> swept() const;
  // A segment that has an end within the span but was not solved yet.
  [[nodiscard]] std::optional<std::uint32_t> unsolved() const;

  // When the segment makes an end of what is covered, that being at one of its poses: 0 or 1.
  [[nodiscard]] std::optional<double> end_at_pose_of(std::uint32_t segment) const;

  // That segment was solved: its ends are what they are.
  void settle(std::uint32_t segment);

  // As GroupSearch asks them.
  static constexpr bool kFollowsFront = false;
  [[nodiscard]] const RaySpan& span() const { return question_.span; }
  [[nodiscard]] static bool wants_lo(double) { return true; }
  [[nodiscard]] static double promise(const GroupReach& reach) { return reach.hi - reach.lo; }
  [[nodiscard]] int change() const { return change_; }
  [[nodiscard]] static RaySpan counted(const GroupReach& reach);
  [[nodiscard]] bool wants(std::uint32_t group, const RaySpan& counted) const;
  [[nodiscard]] bool wants_piece(std::uint32_t group, double lo, double hi) const;
  [[nodiscard]] static double begins_by() { return kInfinity; }
  [[nodiscard]] QuadLimit limit(const GroupQuad& groups, const QuadSpan& in_box);
  [[nodiscard]] double room(std::uint32_t segment, const ToolPose& from, const ToolPose& to);
  [[nodiscard]] DoubleFour rooms(const LeafMotions& leaf, const RaySpan& counted);
  [[nodiscard]] std::span<const Chord> known();
  // Solutions of ends that may count do not depend on what is covered already: an end is left
  // inexact only where it is well inside.
  [[nodiscard]] std::span<const Chord> floors();
  void take(const SweptInterval& next);
  void take_solved(const SweptInterval& next) { join(next, true); }

 private:
  struct End {
    SweptIntervalEnd at{};
    bool solved = false;
    bool has_plane = false;  // made when first asked for
    SeparatingPlane plane{};
  };
  struct Piece {
    End lo{}, hi{};
  };
  void join(const SweptInterval& next, bool solved);
  [[nodiscard]] static bool wins(const End& a, const End& b, bool leaving);
  [[nodiscard]] static bool behind(double depth, std::uint32_t earliest, const End& end,
                                   bool leaving);
  // What an end says of four groups: that they are held back; that they are not ahead of it, and
  // then whether a cutter in the middle likely covers more.
  struct Held {
    std::array<bool, kSiblings> holds{true, true, true, true}, bounds{true, true, true, true},
        is_beyond{};
    [[nodiscard]] bool any() const { return holds[0] || holds[1] || holds[2] || holds[3]; }
  };
  [[nodiscard]] Held held_by(End& end, const GroupQuad& groups, bool leaving) const;
  using HeldLanes = std::array<bool, kSiblings>;
  [[nodiscard]] HeldLanes held_by(End& end, const LeafMotions& leaf, bool leaving) const;
  [[nodiscard]] bool held_by(End& end, std::uint32_t segment, bool leaving) const;
  const SeparatingPlane& plane_at(End& end, bool leaving) const;

  const RayQuestion& question_;
  std::span<const GroupQuad> quads_;
  const EndPlanes& planes_;
  boost::container::small_vector<Piece, 4> pieces_{};
  boost::container::small_vector<Chord, 4> known_{};
  int change_ = 0;
};

}  // namespace frustum::cutter
