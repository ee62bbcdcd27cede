// A body of revolution, cut across its axis into convex parts.
//
// Model    : the generatrix is the truth. Each section is convex: parts() are inside the body; what
//            of the body is in none of them (around a concave end, beside an inside radius) is in
//            concave(), the convex hulls of what is not convex itself
// Units    : mm; frame: tool (tip at the origin, axis +Z towards the spindle)
// Errors   : make() refuses what Generatrix::make() refuses
// Accuracy : faces of parts() are on the generatrix within 1e-12 mm
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cutter/body/generatrix.hpp"
#include "cutter/body/profile.hpp"

namespace frustum::cutter {

// In place of a convex section's index: the concave surface of the body.
inline constexpr std::uint32_t kConcaveSurface = std::numeric_limits<std::uint32_t>::max();

class Body {
 public:
  explicit Body(Generatrix generatrix);

  [[nodiscard]] const Generatrix& generatrix() const { return generatrix_; }
  // The convex sections: the parts, then the hulls of the concave ones.
  [[nodiscard]] std::span<const Profile> sections() const { return sections_; }
  [[nodiscard]] std::span<const Profile> parts() const { return sections().first(part_count_); }
  [[nodiscard]] std::span<const Profile> concave() const { return sections().subspan(part_count_); }
  [[nodiscard]] bool is_convex() const { return sections_.size() == 1 && part_count_ == 1; }

  // Whether the body at the pose covers some of the ray between lo and hi.
  [[nodiscard]] bool meets(const ToolPose& pose, const Ray& ray, double lo, double hi) const;
  // Of the point from the surface of the body at the pose: negative inside.
  [[nodiscard]] double distance(const ToolPose& pose, const Vec3& point) const;
  // Largest value of x.n over the body (tip at the origin), for a unit direction n with n.axis = u.
  [[nodiscard]] double support(double u) const;
  // What of the ray is inside the body at the pose, by more than this; ends within 1 um where it is
  // concave. For finding collisions.
  [[nodiscard]] std::vector<Chord> core(const ToolPose& pose, const Ray& ray,
                                        double deeper_than) const;
  // The smallest arc, piece or rim radius of the generatrix beside a concave section.
  [[nodiscard]] double finest_concave() const { return finest_concave_; }
  [[nodiscard]] double height() const { return generatrix_.height(); }
  [[nodiscard]] double max_radius() const { return generatrix_.max_radius(); }
  // No point of the body is farther than this from the tip.
  [[nodiscard]] double reach() const { return generatrix_.reach(); }

 private:
  Generatrix generatrix_;
  std::vector<Profile> sections_;
  std::size_t part_count_ = 0;
  double finest_concave_ = 0.0;
};

}  // namespace frustum::cutter
