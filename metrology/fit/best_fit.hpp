// The planned geometry laid into measured points: rigid best fit.
//
// Model    : the pose P that makes sum d_i^2 least, d_i = distance of P^-1 x_i from the planned
//            element of point i; degrees of freedom that the elements do not tell, and those that
//            are locked, keep their planned value: no shift along and no rotation about their axis.
//            What the deviations of the points tell only because surfaces are bent counts as not
//            told: how a section that is oval or of another size might be tilted
// Units    : mm, rad
// Shape    : any number of points on any elements
// Errors   : no points; not converged (points far from the planned geometry)
// Accuracy : the last step moves the points by less than 1e-13 of the size of the part, wherever
//            the part is
//            (tests/metrology/datum_system_test.cpp)
// Source   : Gauss-Newton on the six small motions
#pragma once

#include <array>
#include <span>

#include "core/result.hpp"
#include "metrology/fit/nominal_surface.hpp"

namespace frustum::metrology {

struct PointOnElement {
  Vec3 point = Vec3::Zero();                // measured
  const NominalSurface* planned = nullptr;  // outlives the call
};

struct BestFit {
  Pose measured_from_planned{};
  std::array<bool, 6>
      is_told{};  // shifts along x, y, z, rotations about them: free ones that points tell
  // mm: what a turn by 1 deg, or a shift by as much at the rim of the part, that is free and not
  // told makes of the deviations. 0, to rounding, if the part slides in itself: what is not told
  // does not matter then.
  double bend_of_untold = 0.0;
};
// What counts as told: all that the points say where they are, or what they would still say if the
// part lay 2 deg otherwise.
enum class Telling { any, steady };

// `locked`: degrees to leave alone, in the same order.
[[nodiscard]] Result<BestFit> best_fit(std::span<const PointOnElement> points,
                                       const std::array<bool, 6>& locked = {},
                                       Telling telling = Telling::any);

}  // namespace frustum::metrology
