// The outline of a cutter: zones stacked along the tool axis, together one convex body of revolution.
//
// Model    : radius r(z) over height z above the tip, z in [0, height]; a zone is the part of a cylinder
//            or a sphere about the tool axis between two heights; r(z) is concave over all zones, so
//            that a ray meets the body in one interval
// Units    : mm; frame: tool (tip at the origin, axis +Z towards the spindle)
// Accuracy : chords within 1e-12 mm for bodies within 1 m of the ray's origin
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/pose.hpp"
#include "cutter/ray.hpp"
#include "kinematics/tool_path.hpp"

namespace frustum::cutter {

using kinematics::ToolPose;

struct CylinderZone {
  double radius = 0.0;
};
struct SphereZone {
  double radius = 0.0;
  double centre = 0.0;  // height of the centre above the tip
};
struct Zone {
  std::variant<CylinderZone, SphereZone> shape;
  double z_lo = 0.0;
  double z_hi = 0.0;
};

// Where a ray runs inside the body at one instant.
struct Chord {
  double lo = 0.0;
  double hi = 0.0;
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
  // Outward unit normal of the body's surface nearest to `point`.
  [[nodiscard]] Vec3 normal(const ToolPose& pose, const Vec3& point) const;
  // True when `point` lies on the body's surface, within `tolerance` of it.
  [[nodiscard]] bool touches(const ToolPose& pose, const Vec3& point, double tolerance) const;

  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] double max_radius() const { return max_radius_; }
  // No point of the body is farther than this from the tip.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  struct Nearest {
    double distance = 0.0;
    Vec3 normal = Vec3::UnitZ();
  };
  [[nodiscard]] Nearest nearest_surface(const ToolPose& pose, const Vec3& point) const;

  std::vector<Zone> zones_;
  double height_ = 0.0;
  double max_radius_ = 0.0;
  double reach_ = 0.0;
};

}  // namespace frustum::cutter
