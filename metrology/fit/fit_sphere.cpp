#include <Eigen/QR>
#include <array>
#include <cmath>

#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kWording{"sphere", "probe a larger part of the sphere"};

// Algebraic sphere: linear in centre and radius^2 - centre^2.
Sphere algebraic_sphere(const NormalisedPoints& local) {
  Eigen::MatrixX4d rows(static_cast<Eigen::Index>(local.points.size()), 4);
  Eigen::VectorXd right(rows.rows());
  for (std::size_t k = 0; k < local.points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double root = std::sqrt(local.weight(k));
    rows.row(i) << 2.0 * root * local.points[k].transpose(), root;
    right[i] = root * local.points[k].squaredNorm();
  }
  const Eigen::Vector4d s = rows.colPivHouseholderQr().solve(right);
  return {s.head<3>(), std::sqrt(std::max(s[3] + s.head<3>().squaredNorm(), 0.0))};
}

// A given radius leaves the centre on either side of the points, along their least spread.
std::vector<Element> starts_near(const Sphere& free, const PrincipalDirections& principal,
                                 const Constraints& keep) {
  if (!keep.radius) return {free};
  const double radius = *keep.radius;
  const double lift = std::sqrt(std::max(radius * radius - principal.spread.squaredNorm(), 0.0));
  const Vec3 lifted = lift * principal.directions.col(2);
  return {Sphere{lifted, radius}, Sphere{-lifted, radius}};
}

}  // namespace

Result<Fit<Sphere>> fit_sphere(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::sphere, kWording.what, 4}, options);
  if (!local) return std::move(local).error();
  const PrincipalDirections principal = principal_directions(*local);
  if (principal.spread[2] < kFlat * principal.spread[0] && !local->constraints.radius) {
    return error("degenerate points for a sphere: they lie in one plane",
                 "probe the sphere also away from that plane");
  }
  const PointBlocks all = PointBlocks::of(*local);
  const auto starts = starts_near(algebraic_sphere(*local), principal, local->constraints);
  auto found = best_minimum(starts, *local, all, kWording);
  if (!found) return std::move(found).error();
  const auto& best = std::get<Sphere>(found->element);
  constexpr std::array kIsAngle{false, false, false, false};
  return completed(*local, Sphere{local->back(best.point), best.radius * local->scale},
                   {found->residuals, found->cofactor, kIsAngle, redundancy(*local, *found),
                    found->iterations, found->condition});
}

}  // namespace frustum::metrology
