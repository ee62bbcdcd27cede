#include "cutter/search/ray_fans.hpp"

#include <algorithm>

namespace frustum::cutter {

bool RayFans::hold(std::size_t i) {
  if (fans_.empty()) return false;
  if (goal_.change() != change_) look();
  return std::ranges::any_of(held_, [&](const Held& by) {
    return (by.hi == nullptr || by.hi->holds(i, by.at_hi)) &&
           (by.lo == nullptr || by.lo->holds(i, by.at_lo));
  });
}

void RayFans::look() {
  change_ = goal_.change();
  held_.clear();
  const Ray& ray = question_.ray;
  for (const Chord& piece : goal_.known()) {
    for (const CoverFan& fan : fans_) {
      Held by;
      if (piece.hi < question_.span.hi) {
        by.hi = &fan.hi;
        by.at_hi = fan.hi.beside(ray.at(piece.hi), ray.direction);
      }
      if (piece.lo > question_.span.lo) {
        by.lo = &fan.lo;
        by.at_lo = fan.lo.beside(ray.at(piece.lo), -ray.direction);
      }
      held_.push_back(by);
    }
  }
}

}  // namespace frustum::cutter
