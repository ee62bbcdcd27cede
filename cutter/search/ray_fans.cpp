#include "cutter/search/ray_fans.hpp"

#include <algorithm>

namespace frustum::cutter {

// By any piece of what is covered, before both of its ends that are within the span.
void RayFans::look(std::size_t from) {
  change_ = goal_.change();
  const Ray& ray = question_.ray;
  const std::span<std::uint8_t> held = held_.by_four();
  std::ranges::fill(held.subspan(from / 4), std::uint8_t{0});
  HeldGroups by_hi = held_, by_lo = held_;
  for (const Chord& piece : goal_.known()) {
    for (const CoverFan& fan : fans_) {
      const bool has_hi = piece.hi < question_.span.hi;
      const bool has_lo = question_.span.lo < piece.lo;
      if (has_hi) {
        const auto at = fan.hi.beside(ray.at(piece.hi), ray.direction);
        fan.hi.find_held(at, from / 4, by_hi.by_four());
      }
      if (has_lo) {
        const auto at = fan.lo.beside(ray.at(piece.lo), -ray.direction);
        fan.lo.find_held(at, from / 4, by_lo.by_four());
      }
      for (std::size_t b = from / 4; b < held.size(); ++b) {
        const unsigned hi = has_hi ? by_hi.by_four()[b] : 0xFU;
        const unsigned lo = has_lo ? by_lo.by_four()[b] : 0xFU;
        held[b] = static_cast<std::uint8_t>(held[b] | (hi & lo));
      }
    }
  }
}

}  // namespace frustum::cutter
