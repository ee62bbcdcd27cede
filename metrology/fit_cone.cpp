#include <Eigen/Eigenvalues>
#include <array>
#include <numbers>

#include "metrology/least_squares.hpp"
#include "metrology/round_fit.hpp"

namespace frustum::metrology {
namespace {

struct ConeModel {
  static constexpr int kParameters = 6;
  Vec3 point = Vec3::Zero();  // of the axis, nearest the origin
  Vec3 axis = Vec3::UnitZ();  // toward growing radius
  double radius = 1.0;        // orthogonal distance from `point` to the surface
  double half_angle = 0.25;

  void linearise(std::span<const Vec3> points, Linearised<6>& out) const {
    const Vec3 u = perpendicular_to(axis);
    const Vec3 v = axis.cross(u);
    const double c = std::cos(half_angle);
    const double s = std::sin(half_angle);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const Vec3 w = points[k] - point;
      const double along = w.dot(axis);
      const Vec3 lateral = w - along * axis;
      const double away = lateral.norm();
      const Vec3 e = away > 0.0 ? Vec3(lateral / away) : u;
      const double eu = e.dot(u);
      const double ev = e.dot(v);
      const double slant = along * c + away * s;  // along the generatrix
      out.residuals[i] = away * c - along * s - radius;
      out.jacobian.row(i) << -c * eu, -c * ev, -slant * eu, -slant * ev, -1.0, -slant;
    }
  }
  [[nodiscard]] ConeModel moved(const Eigen::Matrix<double, 6, 1>& wanted) const {
    // Beyond a third of a radian the linear model of the angles means nothing.
    const double turn = std::max(wanted.segment<2>(2).norm(), std::abs(wanted[5]));
    const Eigen::Matrix<double, 6, 1> step = wanted * std::min(1.0, 0.3 / turn);
    const Vec3 u = perpendicular_to(axis);
    const Vec3 v = axis.cross(u);
    ConeModel next;
    next.half_angle = half_angle + step[5];
    next.axis = (axis + step[2] * u + step[3] * v).normalized();
    if (next.half_angle < 0.0) {  // the same cone, opening the other way
      next.half_angle = -next.half_angle;
      next.axis = -next.axis;
    }
    next.radius = radius + step[4];
    if (next.half_angle > std::numbers::pi / 2.0) {  // the same again, past the plane
      next.half_angle = std::numbers::pi - next.half_angle;
      next.axis = -next.axis;
      next.radius = -next.radius;
    }
    next.point = point + step[0] * u + step[1] * v;
    const double back = next.axis.dot(next.point);
    next.point -= back * next.axis;
    next.radius -= back * std::sin(next.half_angle);
    return next;
  }
  // Half angles nearer than 1e-9 to 0 or 90 deg are a cylinder or a plane to rounding, and so is a
  // radius of 1e6 times the part.
  [[nodiscard]] bool plausible() const {
    return radius > 0.0 && radius < 1e6 && half_angle > 1e-9 &&
           half_angle < std::numbers::pi / 2.0 - 1e-9;
  }
};

// Angle and radius for a given axis: the straight line through (along, away) of the points.
ConeModel start_on(const AxisCandidate& candidate, const std::vector<Vec3>& points) {
  std::vector<Eigen::Vector2d> places;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Vec3& p : points) {
    const Vec3 w = p - candidate.point;
    const double along = w.dot(candidate.axis);
    places.emplace_back(along, (w - along * candidate.axis).norm());
    mean += places.back() / static_cast<double>(points.size());
  }
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : places) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
  const Eigen::Vector2d generatrix = eigen.eigenvectors().col(1);
  ConeModel start;
  start.point = candidate.point;
  // Away from the cylinder and the plane, where the angle would have nothing to hold on to.
  start.half_angle =
      std::clamp(std::atan2(std::abs(generatrix.y()), std::abs(generatrix.x())), 0.02, 1.55);
  const bool opens_back = generatrix.x() * generatrix.y() < 0.0;
  start.axis = opens_back ? Vec3(-candidate.axis) : candidate.axis;
  start.radius = mean.y() * std::cos(start.half_angle) -
                 (opens_back ? -mean.x() : mean.x()) * std::sin(start.half_angle);
  return start;
}

}  // namespace

Result<Fit<Cone>> fit_cone(std::span<const Vec3> points) {
  auto local = normalise(points, "cone", 6);
  if (!local) return std::move(local).error();
  if (auto flat = coplanar(*local, "cone")) return *flat;
  std::vector<ConeModel> starts;
  const std::vector<Vec3> few = thinned(local->points, 200);
  for (const RoundKind kind : {RoundKind::cone, RoundKind::cylinder}) {
    for (const AxisCandidate& c : axis_candidates(*local, kind, kAxisCandidates)) {
      starts.push_back(start_on(c, few));
    }
  }
  auto found = best_minimum(starts, *local, "cone");
  if (!found) return std::move(found).error();
  const ConeModel& model = found->model;
  constexpr std::array kIsAngle{false, false, true, true, false, true};
  return completed(*local,
                   Cone{local->back(model.point), unit(model.axis), model.radius * local->scale,
                        model.half_angle},
                   found->residuals, found->cofactor, kIsAngle,
                   static_cast<double>(points.size()) - 6.0, found->iterations);
}

}  // namespace frustum::metrology
