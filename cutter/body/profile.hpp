// The generatrix of a cutter: zones stacked along the tool axis, together one convex body of
// revolution.
//
// Model    : radius r(z) over height z above the tip, z in [bottom, height]; a zone is the part of
//            a cylinder, cone, sphere or torus about the tool axis between two heights; r(z) is
//            concave over all zones, so that a ray meets the body in one interval
// Units    : mm; frame: tool (tip at the origin, axis +Z towards the spindle)
// Accuracy : chords within 1e-12 mm for bodies within 1 m of the ray's origin
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "core/ray.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::cutter {

using kinematics::ToolPose;

enum class ZoneKind : std::uint8_t {
  cone,    // r = radius + slope (z - z_lo); a cylinder has slope 0
  sphere,  // about the axis point at height `centre`
  // Outer side of a tube of `radius` about the circle of radius `major` at height `centre`; major
  // below 0: the lens that such arcs make when their centre is beyond the axis.
  torus,
};
struct Zone {
  ZoneKind kind = ZoneKind::cone;
  double z_lo = 0.0;
  double z_hi = 0.0;
  double radius = 0.0;
  double slope = 0.0;
  double centre = 0.0;
  double major = 0.0;
};
[[nodiscard]] Zone cone_zone(double radius_lo, double radius_hi, double z_lo, double z_hi);
[[nodiscard]] Zone sphere_zone(double radius, double centre, double z_lo, double z_hi);
[[nodiscard]] Zone torus_zone(double major, double minor, double centre, double z_lo, double z_hi);

// What of a profile an end of a chord is on: a zone by its index, or one of the flat ends.
using ProfileFace = std::int32_t;
inline constexpr ProfileFace kBottomFace = -1;
inline constexpr ProfileFace kTopFace = -2;

// Where a ray runs inside the body at one instant.
struct Chord {
  double lo = 0.0;
  double hi = 0.0;
  ProfileFace lo_face = kTopFace;
  ProfileFace hi_face = kTopFace;
};

// The outward unit normal of a body of revolution at a point: lateral * side + axial * axis.
struct Facing {
  double axial = 1.0;
  double lateral = 0.0;
  Vec3 side = Vec3::UnitX();  // unit, normal to the axis; where lateral is 0 any such
};

class Profile {
 public:
  // `zones` from the tip upwards, without gaps. Precondition: the body is convex.
  explicit Profile(std::vector<Zone> zones);

  // The chord of the body at `pose`, grown outwards by at least `grown_by` (0: the body itself;
  // negative: shrunk by at least as much).
  [[nodiscard]] std::optional<Chord> chord(const ToolPose& pose, const Ray& ray,
                                           double grown_by = 0.0) const;
  // Largest value of x.n over the body (tip at the origin), for a unit direction n with n.axis = u.
  [[nodiscard]] double support(double u) const;
  // The same for a direction of any length: `across` of it normal to the axis, u along.
  [[nodiscard]] double support(double across, double u) const;
  // Outward normal of a face at a point on it. A pointed end has many: that along the axis, or, if
  // it leans more towards that direction, one of the flank's.
  [[nodiscard]] Facing facing(ProfileFace face, const ToolPose& pose, const Vec3& point,
                              const Vec3& towards = Vec3::Zero()) const;
  [[nodiscard]] Vec3 normal_of(ProfileFace face, const ToolPose& pose, const Vec3& point) const;
  [[nodiscard]] double bottom() const { return bottom_; }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] std::span<const Zone> zones() const { return zones_; }
  [[nodiscard]] double max_radius() const { return max_radius_; }
  // No point of the body is farther than this from the tip.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  std::vector<Zone> zones_;
  std::vector<double> secants_{};  // of the flanks' slopes: sqrt(1 + slope^2)
  double bottom_ = 0.0;
  double height_ = 0.0;
  double max_radius_ = 0.0;
  double reach_ = 0.0;
};

}  // namespace frustum::cutter
