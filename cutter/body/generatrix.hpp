// The meridian of a body of revolution: straight lines and arcs in the half-plane of radius and
// height.
//
// Model    : a chain of segments from the tool axis, round the end and up the side, to the top; a
//            flat top face closes it. The body is what is between the chain and the axis. Concave
//            parts (a concave end, a waist, an inside radius) are ordinary. From the lowest point
//            on the chain never falls: the outer radius is a function of height, with steps
// Units    : mm; frame: tool (r from the axis, z from the tip towards the spindle; the lowest point
//            has z = 0,
//            or `bottom` for a shank or holder above the cutting part)
// Errors   : make() names the segment that is no part of such a chain: gaps, r < 0, points that are
//            not numbers, an arc whose ends are not on its circle, a chain that turns back on or
//            crosses itself
// Accuracy : distance() within 1e-12 mm for bodies below 1 m
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"

namespace frustum::cutter {

struct MeridianPoint {
  double r = 0.0;
  double z = 0.0;
  bool operator==(const MeridianPoint&) const = default;
};

struct GeneratrixSegment {
  MeridianPoint from{};
  MeridianPoint to{};
  double arc_radius = 0.0;  // 0: a straight line
  MeridianPoint centre{};   // of an arc, which spans less than half a turn
  bool bulges = true;       // an arc with its centre on the body's side; false: concave out
};

[[nodiscard]] inline bool is_arc(const GeneratrixSegment& s) { return s.arc_radius > 0.0; }

[[nodiscard]] GeneratrixSegment line(MeridianPoint from, MeridianPoint to);
[[nodiscard]] GeneratrixSegment arc(MeridianPoint from, MeridianPoint to, MeridianPoint centre,
                                    bool bulges = true);
// The same chain, with arcs cut where they turn in height, so that z rises, falls or stays along
// each.
[[nodiscard]] std::vector<GeneratrixSegment> monotone_in_height(
    std::span<const GeneratrixSegment> segments);
// Radius of such a piece, not horizontal, at a height between its ends.
[[nodiscard]] double radius_at(const GeneratrixSegment& piece, double z);

class Generatrix {
 public:
  [[nodiscard]] static Result<Generatrix> make(std::vector<GeneratrixSegment> segments,
                                               double bottom = 0.0);

  [[nodiscard]] std::span<const GeneratrixSegment> segments() const { return segments_; }
  // Signed distance to the body's surface, inside negative. At a corner it is that to the corner.
  [[nodiscard]] double distance(double r, double z) const;
  [[nodiscard]] double height() const { return segments_.back().to.z; }
  [[nodiscard]] double max_radius() const { return max_radius_; }
  // No point of the body is farther than this from the tip.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  explicit Generatrix(std::vector<GeneratrixSegment> segments);

  std::vector<GeneratrixSegment> segments_;
  std::vector<GeneratrixSegment> pieces_;  // the segments, cut where they turn in height
  double max_radius_ = 0.0;
  double reach_ = 0.0;
};

}  // namespace frustum::cutter
