#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "metrology/fit/fixed_radius.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kSphereWording{"sphere", "probe a larger part of the sphere"};

// Algebraic sphere: linear in centre and radius^2 - centre^2.
Sphere algebraic_sphere(const NormalisedPoints& local) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(local.points.size()), 4);
  Eigen::VectorXd right(rows.rows());
  for (std::size_t k = 0; k < local.points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double root = std::sqrt(local.weight(k));
    rows.row(i) << 2.0 * root * local.points[k].transpose(), root;
    right[i] = root * local.points[k].squaredNorm();
  }
  const Eigen::Vector4d s = least_squares_solution(rows, right);
  return {s.head<3>(), std::sqrt(std::max(s[3] + s.head<3>().squaredNorm(), 0.0))};
}

// A given radius leaves the centre on either side of the points, along their least spread.
std::vector<Element> initial_spheres(const NormalisedPoints& local,
                                     const PrincipalDirections& principal) {
  if (!local.constraints.radius) return {algebraic_sphere(local)};
  const double radius = *local.constraints.radius;
  const double lift = std::sqrt(std::max(radius * radius - principal.spread.squaredNorm(), 0.0));
  const Vec3 lifted = lift * principal.directions.col(2);
  return {Sphere{lifted, radius}, Sphere{-lifted, radius},
          Sphere{algebraic_sphere(local).point, radius}};
}

Result<Minimum> solve_sphere(const NormalisedPoints& local) {
  const PrincipalDirections principal = principal_directions(local);
  const std::optional<double>& radius = local.constraints.radius;
  if (principal.spread[2] < kFlat * principal.spread[0] && !radius) {
    return error("degenerate-points"_id, "degenerate points for a sphere: they are in one plane",
                 "probe the sphere also away from that plane");
  }
  const PointBlocks all = PointBlocks::of(local);
  std::vector<Element> starts = initial_spheres(local, principal);
  auto direct = at_once(starts, local, all, principal.spread[2]);
  if (direct) return settled(std::move(*direct), all, local.constraints, kSphereWording);
  if (!radius) {
    for (const int i : {0, 1, 2}) {
      for (const Bend& bend : bends_along(principal.directions.col(i))) {
        starts.push_back(Sphere{bend.centre, bend.radius});
      }
    }
    return best_minimum(starts, local, all, kSphereWording);
  }
  for (const Vec3& centre : sphere_centres(thinned(local, kSearched), *radius, 8)) {
    starts.push_back(Sphere{centre, *radius});
  }
  return best_minimum(starts, local, all, kSphereWording);
}

}  // namespace

Result<Fit<Sphere>> fit_sphere(std::span<const Vec3> points, const FitOptions& options) {
  return round_fit<Sphere>(points, options, {ElementKind::sphere, kSphereWording.what, 4},
                           solve_sphere);
}

}  // namespace frustum::metrology
