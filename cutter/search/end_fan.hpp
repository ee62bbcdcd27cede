// Planes at one end of what is covered that hold back groups of poses at ends beside it, too.
//
// Model    : for each group of a list the plane of its cutters that comes nearest to the end
//            (separating_plane.hpp). At other places it bounds the group as well, by a height that
//            is linear in place but for how far the axes differ: found once, it is one scalar
//            product for every ray near by
// Units    : mm; frame: workpiece
// Errors   : none; false says nothing
// Accuracy : what is held back is at least kFanMargin before the end, normal to its plane
// Source   : ours
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cutter/search/lanes.hpp"
#include "cutter/search/pose_group.hpp"
#include "cutter/search/separating_plane.hpp"

namespace frustum::cutter {

// Many times what may decide between two segments (kSearchTolerance), and little enough for
// neighbours that cut less deep (mm).
inline constexpr double kFanMargin = 1e-8;

class EndFan {
 public:
  // Holds nothing back.
  EndFan() = default;
  // `groups` by number in the tree.
  EndFan(const SeparatingPlane& plane, std::span<const GroupQuad> quads,
         std::span<const std::uint32_t> groups);

  // The end of a ray, seen from the end of the fan.
  struct Beside {
    Vec3 off = Vec3::Zero();
    double away = 0.0;
    Vec3 beyond = Vec3::Zero();  // unit, along the ray, away from what is covered
  };
  [[nodiscard]] const Vec3& end() const { return end_; }
  [[nodiscard]] Beside beside(const Vec3& end, const Vec3& beyond) const {
    const Vec3 off = end - end_;
    return {off, off.norm(), beyond};
  }
  // Whether groups of the list surely cover nothing beyond that end: bit k of held[b] of the one at
  // place 4 b + k, from b = `from` on. `held` has one byte for every four groups of the list.
  void find_held(const Beside& at, std::size_t from, std::span<std::uint8_t> held,
                 LaneChoice lanes = LaneChoice::best) const;

 private:
  // Of four groups, side by side; of none the normal is zero.
  struct Planes {
    std::array<DoubleFour, 3> normal{};
    DoubleFour least{};  // of the end of the fan over it, at any pose of the group (mm)
    DoubleFour turn{};
  };
  template <class Lanes>
  struct OfLanes;
#ifdef FRUSTUM_HAS_FOUR_LANES
  FRUSTUM_FOUR_LANES void find_held_four(const Beside& at, std::size_t from,
                                         std::span<std::uint8_t> held) const;
#endif

  Vec3 end_ = Vec3::Zero();
  std::vector<Planes> planes_{};  // as the list of groups
};

// Which groups of a list are held back, in the order of the list.
class HeldGroups {
 public:
  explicit HeldGroups(std::size_t count) : count_(count), held_((count + 3) / 4, 0) {}

  // The first from place i on that is not; the length of the list if there is none.
  [[nodiscard]] std::size_t next_open(std::size_t i) const {
    for (; i < count_ && (held_[i / 4] >> i % 4 & 1U) != 0; ++i) {
      if (i % 4 == 0 && held_[i / 4] == 0xF) i += 3;
    }
    return std::min(i, count_);
  }
  [[nodiscard]] std::span<std::uint8_t> by_four() { return {held_.data(), held_.size()}; }

 private:
  std::size_t count_;
  boost::container::small_vector<std::uint8_t, 64> held_;
};

// Fans of one list of groups, each for the ends near by that one face of the cutter makes.
class EndFans {
 public:
  EndFans() = default;
  // An end farther than this from all fans of its face has one of its own (mm).
  explicit EndFans(double near_by) : near_by_(near_by) {}

  // What makes an end: the section of the body, and the face of that.
  struct Maker {
    std::uint32_t section = 0;
    ProfileFace face = kTopFace;
    bool operator==(const Maker&) const = default;
  };
  // The nearest, made now where none is near by; null: there are enough of others.
  [[nodiscard]] const EndFan* of(const Maker& maker, const SeparatingPlane& plane,
                                 std::span<const GroupQuad> quads,
                                 std::span<const std::uint32_t> groups);
  // The nearest; null: none is near by.
  [[nodiscard]] const EndFan* near_by(const Maker& maker, const SeparatingPlane& plane) const;

 private:
  struct Made {
    Maker maker{};
    EndFan fan{};
  };
  double near_by_ = 0.0;
  std::vector<Made> all_{};
};

}  // namespace frustum::cutter
