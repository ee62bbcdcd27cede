#include "cutter/search/end_fan.hpp"

#include <cassert>

namespace frustum::cutter {

template <class Lanes>
struct EndFan::OfLanes {
  LanesVec<Lanes> off, beyond;
  Lanes away;

  FRUSTUM_OF_LANES explicit OfLanes(const Beside& at)
      : off(vec_of<Lanes>(at.off)),
        beyond(vec_of<Lanes>(at.beyond)),
        away(lanes_of<Lanes>(at.away)) {}

  // Bits of the lanes from number `lane` on.
  FRUSTUM_OF_LANES unsigned held(const Planes& planes, std::size_t lane) const {
    const LanesVec<Lanes> normal = vec_of<Lanes>(planes.normal, lane);
    const Lanes turn = lanes_of<Lanes>(planes.turn, lane);
    const Lanes clear = normal.dot(off) + lanes_of<Lanes>(planes.least, lane) - turn * away;
    const auto holds = (clear >= kFanMargin) & (normal.dot(beyond) > turn);
    unsigned bits = 0;
    for (std::size_t k = 0; k < kLanes<Lanes>; ++k)
      bits |= static_cast<unsigned>(holds[k] & 1) << (lane + k);
    return bits;
  }
};

#ifdef FRUSTUM_HAS_FOUR_LANES
void EndFan::find_held_four(const Beside& at, std::size_t from,
                            std::span<std::uint8_t> held) const {
  const OfLanes<Four> lanes(at);
  for (std::size_t b = from; b < held.size(); ++b)
    held[b] = static_cast<std::uint8_t>(lanes.held(planes_[b], 0));
}
#endif

void EndFan::find_held(const Beside& at, std::size_t from, std::span<std::uint8_t> held,
                       [[maybe_unused]] LaneChoice choice) const {
  if (planes_.empty()) {
    std::ranges::fill(held, std::uint8_t{0});
    return;
  }
  assert(planes_.size() == held.size());
#ifdef FRUSTUM_HAS_FOUR_LANES
  if (has_four_lanes(choice)) {
    find_held_four(at, from, held);
    return;
  }
#endif
  const OfLanes<Both> lanes(at);
  for (std::size_t b = from; b < held.size(); ++b)
    held[b] = static_cast<std::uint8_t>(lanes.held(planes_[b], 0) | lanes.held(planes_[b], 2));
}

EndFan::EndFan(const SeparatingPlane& plane, std::span<const GroupQuad> quads,
               std::span<const std::uint32_t> groups)
    : end_(plane.end()) {
  if (!plane.has_proof()) return;
  planes_.resize((groups.size() + 3) / 4);
  QuadPlanes of_quad;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    // Its siblings are mostly the next.
    const std::uint32_t quad = groups[i] / kSiblings, lane = groups[i] % kSiblings;
    if (i == 0 || groups[i - 1] / kSiblings != quad) of_quad = plane.planes(quads[quad]);
    Planes& planes = planes_[i / 4];
    for (std::size_t d = 0; d < 3; ++d) planes.normal[d][i % 4] = of_quad.normal[d][lane];
    planes.least[i % 4] = of_quad.height[lane] - of_quad.lost[lane];
    planes.turn[i % 4] = of_quad.turn[lane];
  }
}

const EndFan* EndFans::near_by(const Maker& maker, const SeparatingPlane& plane) const {
  const EndFan* nearest = nullptr;
  double nearest2 = near_by_ * near_by_;
  for (const Made& made : all_) {
    const double away2 = (made.fan.end() - plane.end()).squaredNorm();
    if (made.maker != maker || away2 > nearest2) continue;
    nearest = &made.fan;
    nearest2 = away2;
  }
  return nearest;
}

const EndFan* EndFans::of(const Maker& maker, const SeparatingPlane& plane,
                          std::span<const GroupQuad> quads, std::span<const std::uint32_t> groups) {
  constexpr std::size_t kMost = 32;
  if (const EndFan* nearest = near_by(maker, plane)) return nearest;
  if (all_.size() == kMost) return nullptr;
  if (all_.empty()) all_.reserve(kMost);
  all_.push_back({maker, EndFan(plane, quads, groups)});
  return &all_.back().fan;
}

}  // namespace frustum::cutter
