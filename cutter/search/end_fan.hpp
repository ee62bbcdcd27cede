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

#include <cstdint>
#include <span>
#include <vector>

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
  // Whether the group at place i of the list surely covers nothing beyond that end.
  [[nodiscard]] bool holds(std::size_t i, const Beside& at) const {
    if (i >= planes_.size()) return false;
    const Plane& plane = planes_[i];
    return plane.normal.dot(at.off) + plane.least - plane.turn * at.away >= kFanMargin &&
           plane.normal.dot(at.beyond) > plane.turn;
  }

 private:
  struct Plane {
    Vec3 normal = Vec3::Zero();
    double least = 0.0;  // of the end of the fan over it, at any pose of the group (mm)
    double turn = 0.0;
  };
  Vec3 end_ = Vec3::Zero();
  std::vector<Plane> planes_{};  // as the list of groups
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
