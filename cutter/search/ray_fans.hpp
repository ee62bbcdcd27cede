// Fans of planes at both ends of what is covered of a ray, as they serve the rays beside it.
//
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as end_fan.hpp
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cutter/search/end_fan.hpp"
#include "cutter/search/ray_search.hpp"
#include "cutter/search/whole_sweep.hpp"

namespace frustum::cutter {

// The planes at both ends of what is covered on one ray, for groups of a list.
struct CoverFan {
  EndFan lo{}, hi{};
};

// What the fans of a tile hold back on one ray, as its ends are found.
class RayFans {
 public:
  RayFans(const RayQuestion& question, WholeSweep& goal, std::span<const CoverFan> fans)
      : question_(question), goal_(goal), fans_(fans) {}

  // Whether group number i of the list adds nothing to what is covered now.
  [[nodiscard]] bool hold(std::size_t i);

 private:
  // By one piece of what is covered; null: that end is beyond the span.
  struct Held {
    const EndFan* lo = nullptr;
    const EndFan* hi = nullptr;
    EndFan::Beside at_lo{}, at_hi{};
  };
  void look();

  const RayQuestion& question_;
  WholeSweep& goal_;
  std::span<const CoverFan> fans_;
  std::vector<Held> held_{};
  int change_ = -1;
};

}  // namespace frustum::cutter
