// Which segments of a path bring the cutter near a point.
//
// Model    : no point of a cutter goes farther than the travel of its segment: from a distance at
//            one pose on, segments are passed over until the path may have come near again
// Units    : mm; frame: workpiece
// Errors   : none
// Source   : ours
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/box.hpp"
#include "cutter/search/swept_cutter.hpp"

namespace frustum::trials {

class NearSegments {
 public:
  // Keeps a reference.
  explicit NearSegments(const cutter::SweptCutter& removed);

  // Calls visit(segment), in order, for all in which the cutter may be at most `within` off the
  // point (inside it counts, too), until that says false.
  template <class Visit>
  void for_each(const Vec3& point, double within, const Visit& visit) const {
    const Vec3 room = Vec3::Constant(within);
    const Box near{point - room, point + room};
    double away = 0.0;  // so much farther than `within` is the cutter where the segment begins
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      const Segment& segment = segments_[s];
      if (!segment.runs_on) away = 0.0;
      away -= segment.travel;
      if (away > 0.0) continue;
      away = 0.0;
      if (!overlap(segment.box, near)) continue;
      const auto [begin, end] = distances(s, point);
      away = std::max(0.0, end - within);
      if (0.5 * (begin + end - segment.travel) > within) continue;
      if (!visit(s)) return;
    }
  }

 private:
  struct Segment {
    Box box{};             // what the cutter sweeps
    double travel = 0.0;   // no point of the cutter goes farther
    bool runs_on = false;  // from the end of the one before, with the same tool
  };
  struct AtEnds {
    double begin = 0.0, end = 0.0;
  };
  // Of the cutter from the point.
  [[nodiscard]] AtEnds distances(std::uint32_t segment, const Vec3& point) const;

  const cutter::SweptCutter& removed_;
  std::vector<Segment> segments_{};
};

}  // namespace frustum::trials
