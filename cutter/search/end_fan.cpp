#include "cutter/search/end_fan.hpp"

namespace frustum::cutter {

EndFan::EndFan(const SeparatingPlane& plane, std::span<const GroupPair> pairs,
               std::span<const std::uint32_t> groups)
    : end_(plane.end()) {
  if (!plane.has_proof()) return;
  planes_.reserve(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const PairPlanes both = plane.planes(pairs[groups[i] / 2]);
    const auto add = [&](std::size_t half) {
      planes_.push_back({Vec3(both.normal.x[half], both.normal.y[half], both.normal.z[half]),
                         both.height[half] - both.lost[half], both.turn[half]});
    };
    add(groups[i] % 2);
    // Its sibling is mostly the next.
    if (groups[i] % 2 == 0 && i + 1 < groups.size() && groups[i + 1] == groups[i] + 1) {
      add(1);
      ++i;
    }
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
                          std::span<const GroupPair> pairs, std::span<const std::uint32_t> groups) {
  constexpr std::size_t kMost = 32;
  if (const EndFan* nearest = near_by(maker, plane)) return nearest;
  if (all_.size() == kMost) return nullptr;
  if (all_.empty()) all_.reserve(kMost);
  all_.push_back({maker, EndFan(plane, pairs, groups)});
  return &all_.back().fan;
}

}  // namespace frustum::cutter
