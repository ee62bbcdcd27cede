// Directions in which the axis of a cylinder or cone may be, best first: starting values for fits.
//
// Model    : for a given axis a, |x|^2 - (a.x)^2 (cylinder) or |x|^2 (cone) is a linear function of
//            few monomials of x. Its least-squares residual needs only the moments of the points up
//            to degree four, so a direction costs the same for any number of points. 200 directions
//            over the half sphere and the principal directions are ranked, or those that
//            constraints leave
// Units    : local frame of size one
// Shape    : at most `most` and the principal directions, at least 12 deg apart
// Errors   : none
// Accuracy : starting values only
// Source   : ours
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"
#include "metrology/fit/normalised_points.hpp"

namespace frustum::metrology {

struct AxisCandidate {
  Vec3 axis = Vec3::UnitZ();
  Vec3 point = Vec3::Zero();  // on the axis, perpendicular to it from the origin
  double radius = 1.0;        // cylinder only
};

enum class RoundKind { cylinder, cone };

class AxisSearch {
 public:
  AxisSearch(const NormalisedPoints& local, const PrincipalDirections& principal);

  // The principal directions, or the one that the constraints give, each with its best point.
  [[nodiscard]] std::vector<AxisCandidate> initial_estimates(RoundKind kind) const;
  [[nodiscard]] std::vector<AxisCandidate> candidates(RoundKind kind, std::size_t most) const;

 private:
  [[nodiscard]] std::vector<Vec3> directions() const;

  Constraints keep_;
  Mat3 principal_;
  Eigen::Matrix<double, 10, 10> moments_;
};

}  // namespace frustum::metrology
