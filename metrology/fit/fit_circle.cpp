#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/linear_algebra.hpp"
#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/fixed_radius.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/plane_through.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kCircleWording{"circle", "a circle needs three points that differ in direction"};

// Algebraic circle about a given direction: linear in centre and radius^2 - centre^2.
Circle algebraic_circle(const NormalisedPoints& local, const UnitVec3& normal) {
  const auto [u, v] = tangents(normal);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(local.points.size()), 3);
  Eigen::VectorXd right(rows.rows());
  for (std::size_t k = 0; k < local.points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const Eigen::Vector2d p(local.points[k].dot(u), local.points[k].dot(v));
    const double root = std::sqrt(local.weight(k));
    rows.row(i) << 2.0 * root * p.transpose(), root;
    right[i] = root * p.squaredNorm();
  }
  const Eigen::Vector3d s = least_squares_solution(rows, right);
  return {s.x() * u + s.y() * v, normal,
          std::sqrt(std::max(s[2] + s.head<2>().squaredNorm(), 0.0))};
}

// A given radius leaves the centre on the side to which the points bend, or on the other when they
// hardly bend.
std::vector<Element> starts_near(const Circle& free, const Constraints& keep) {
  const double ratio = keep.radius && free.radius > 0.0 ? *keep.radius / free.radius : 1.0;
  std::vector<Element> starts;
  for (const double factor : {ratio, -ratio}) {
    const Element start = Circle{factor * free.point, free.axis, free.radius};
    starts.push_back(constrained(start, keep));
    if (!keep.radius) break;
  }
  return starts;
}

Result<Minimum> solve_circle(const NormalisedPoints& local, const UnitVec3& normal) {
  const Constraints& keep = local.constraints;
  const PointBlocks all = PointBlocks::of(local);
  std::vector<Element> starts = starts_near(algebraic_circle(local, normal), keep);
  if (keep.axis) return best_minimum(starts, local, all, kCircleWording);
  const PrincipalDirections principal = principal_directions(local);
  auto direct = at_once(starts, local, all, principal.spread[1]);
  if (direct) return settled(std::move(*direct), all, keep, kCircleWording);
  if (!keep.radius) {
    for (const int i : {0, 1}) {
      const Vec3 across = principal.directions.col(i);
      for (const Bend& bend : bends_along(across - across.dot(normal.vec()) * normal.vec())) {
        starts.push_back(Circle{bend.centre, normal, bend.radius});
      }
    }
    return best_minimum(starts, local, all, kCircleWording);
  }
  for (const Vec3& centre : circle_centres(thinned(local, kSearched), normal, *keep.radius, 8)) {
    starts.push_back(Circle{centre, normal, *keep.radius});
  }
  return best_minimum(starts, local, all, kCircleWording);
}

// A circle in a coordinate plane has its normal already.
std::optional<Diagnostic> elsewhere(const Constraints& keep, const UnitVec3& normal) {
  const auto parallel = [&](const UnitVec3& d) {
    return d.vec().cross(normal.vec()).norm() < 1e-9;
  };
  const bool agrees =
      (!keep.parallel_to || parallel(*keep.parallel_to)) &&
      (!keep.axis || parallel(keep.axis->axis)) &&
      (!keep.perpendicular_to || std::abs(keep.perpendicular_to->vec().dot(normal.vec())) < 1e-9);
  if (agrees) return std::nullopt;
  return error("constraint-not-applicable"_id,
               "the normal of a circle2d is not the direction to keep",
               "a circle2d is in the coordinate plane of its points, or in x y");
}

// The plane's parameters are those of its own fit.
struct PlaneInformation {
  Mat3 products = Mat3::Zero();
  double squares = 0.0;
};

PlaneInformation plane_information(const NormalisedPoints& local, const UnitVec3& normal) {
  const auto [u, v] = tangents(normal);
  PlaneInformation all;
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    const Vec3& p = local.points[i];
    const Vec3 row(1.0, p.dot(u), p.dot(v));
    all.products += local.weight(i) * row * row.transpose();
    all.squares += local.weight(i) * p.dot(normal.vec()) * p.dot(normal.vec());
  }
  return all;
}

// Which ways the plane of a circle may tilt.
struct PlaneFreedom {
  bool tilts = true;
  std::optional<UnitVec3>
      about{};  // the one axis that it may turn about, if it may not turn freely
};

// Of the plane's offset and its two tilts, the slopes along tangents(normal).
Mat3 plane_cofactor(const PlaneInformation& plane, const PlaneFreedom& freedom,
                    const UnitVec3& normal) {
  Mat3 cofactor = Mat3::Zero();
  if (freedom.tilts && !freedom.about) return plane.products.inverse();
  if (!freedom.tilts) {
    cofactor(0, 0) = 1.0 / plane.products(0, 0);
    return cofactor;
  }
  // A turn about the axis changes the slopes across it alone.
  const auto [u, v] = tangents(normal);
  const Vec3 across = freedom.about->vec().cross(normal.vec());
  Eigen::Matrix<double, 3, 2> free = Eigen::Matrix<double, 3, 2>::Zero();
  free(0, 0) = 1.0;
  free(1, 1) = u.dot(across);
  free(2, 1) = v.dot(across);
  const Eigen::Matrix2d products = free.transpose() * plane.products * free;
  return free * products.inverse() * free.transpose();
}

Result<Fit<Circle>> circle_in(const NormalisedPoints& local, const UnitVec3& normal,
                              const PlaneFreedom& freedom) {
  auto found = solved(
      local, [&](const NormalisedPoints& some) { return solve_circle(some, normal); },
      kCircleWording.what);
  if (!found) return std::move(found).error();
  const auto& best = std::get<Circle>(found->element);
  // Within its plane, which goes through the centroid of the points.
  const Vec3 centre = best.point - best.point.dot(best.axis.vec()) * best.axis.vec();
  const Circle circle{local.back(centre), best.axis, best.radius * local.scale};
  const double redundant = redundancy(local, *found);
  const PlaneInformation plane = plane_information(local, circle.axis);
  Eigen::MatrixXd cofactor = Eigen::MatrixXd::Zero(6, 6);
  cofactor.topLeftCorner<3, 3>() = found->cofactor;
  cofactor.bottomRightCorner<3, 3>() = plane_cofactor(plane, freedom, circle.axis);
  constexpr std::array kIsAngle{false, false, false, false, true, true};
  Fit<Circle> fit = completed(
      local, circle,
      {found->residuals, cofactor, kIsAngle, redundant, found->iterations, found->condition});
  // The plane has its own scatter.
  const double plane_variance =
      redundant > 0.0 ? plane.squares * local.scale * local.scale * local.largest_weight / redundant
                      : 0.0;
  fit.covariance.bottomRightCorner<3, 3>() =
      fit.cofactor.bottomRightCorner<3, 3>() * plane_variance;
  return fit;
}

}  // namespace

Result<Fit<Circle>> fit_circle(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::circle, kCircleWording.what, 3}, options);
  if (!local) return std::move(local).error();
  auto normal = plane_normal(*local, kCircleWording.what);
  if (!normal) return std::move(normal).error();
  const Constraints& keep = local->constraints;
  return circle_in(*local, *normal, {!keep.parallel_to && !keep.axis, keep.perpendicular_to});
}

Result<Fit<Circle>> fit_circle_2d(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::circle, kCircleWording.what, 3}, options);
  if (!local) return std::move(local).error();
  const UnitVec3 normal = coordinate_plane(points);
  if (auto problem = elsewhere(options.constraints, normal)) return *problem;
  return circle_in(*local, normal, {});
}

}  // namespace frustum::metrology
