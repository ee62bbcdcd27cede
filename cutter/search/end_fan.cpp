#include "cutter/search/end_fan.hpp"

namespace frustum::cutter {

EndFan::EndFan(const SeparatingPlane& plane, std::span<const GroupQuad> quads,
               std::span<const std::uint32_t> groups)
    : end_(plane.end()) {
  if (!plane.has_proof()) return;
  planes_.reserve(groups.size());
  QuadPlanes of_quad;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    // Its siblings are mostly the next.
    const std::uint32_t quad = groups[i] / kSiblings, lane = groups[i] % kSiblings;
    if (i == 0 || groups[i - 1] / kSiblings != quad) of_quad = plane.planes(quads[quad]);
    planes_.push_back(
        {of_quad.normal_of(lane), of_quad.height[lane] - of_quad.lost[lane], of_quad.turn[lane]});
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
