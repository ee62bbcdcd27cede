// Where a probe ball comes to rest on a surface.
//
// Model    : the centre c on the approach line is at contact when c = x + r n(x) for a surface
//            point x. A ray shifted by -r m meets the surface at a point that the ball with that
//            centre touches in direction m; m is iterated to n(x). Every ray gives a bound, since
//            the ball cannot pass the point it met: the farthest one counts
// Units    : mm
// Shape    : 3 to 8 rays on smooth surfaces, 5 to 30 at a convex edge, some 70 where neither can be
//            proven
// Errors   : no_surface, starts_inside
// Accuracy : 1e-12 mm on smooth surfaces (second order in the direction), 1e-9 mm at a convex edge
//            of flat or hollow faces, whose sides are proven to meet there; else the bound along
//            the arc between two normals. Of two separate contacts, as deep in a groove, one is
//            found
// Source   : ours
#pragma once

#include <optional>

#include "metrology/probing/surface_probe.hpp"

namespace frustum::metrology {

struct BallApproach {
  Vec3 target = Vec3::Zero();        // nominal surface point
  UnitVec3 outward = UnitVec3::z();  // nominal normal; the ball moves against it
  double ball_radius = 1.5;
  double clearance = 2.0;  // between ball and nominal surface at the start
  double reach = 2.0;      // past the nominal surface
};

enum class ContactState { contact, no_surface, starts_inside };

struct BallContact {
  ContactState state = ContactState::no_surface;
  Vec3 centre = Vec3::Zero();  // of the ball; only with ContactState::contact
  Touch touch{};               // the point that it rests on; the normal is from there to the centre
  // mm past the nominal surface, with ContactState::no_surface: what the approach would meet.
  std::optional<double> surface_past{};
};

[[nodiscard]] BallContact touch_with_ball(const SurfaceProbeRef& part,
                                          const BallApproach& approach);

}  // namespace frustum::metrology
