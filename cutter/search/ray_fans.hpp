// Fans of planes at both ends of what is covered of a ray, as they serve the rays beside it.
//
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as end_fan.hpp
#pragma once

#include <cstddef>
#include <span>

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
  // `count`: of the groups in the list.
  RayFans(const RayQuestion& question, WholeSweep& goal, std::span<const CoverFan> fans,
          std::size_t count)
      : question_(question), goal_(goal), fans_(fans), held_(count) {}

  // The first group from place i of the list on that may add to what is covered now.
  [[nodiscard]] std::size_t next_open(std::size_t i) {
    if (!fans_.empty() && goal_.change() != change_) look(i);
    return held_.next_open(i);
  }

 private:
  void look(std::size_t from);

  const RayQuestion& question_;
  WholeSweep& goal_;
  std::span<const CoverFan> fans_;
  HeldGroups held_;
  int change_ = -1;
};

}  // namespace frustum::cutter
