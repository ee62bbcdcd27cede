#include <array>

#include "metrology/least_squares.hpp"
#include "metrology/round_fit.hpp"

namespace frustum::metrology {
namespace {

struct CylinderModel {
  static constexpr int kParameters = 5;
  Vec3 point = Vec3::Zero();  // nearest the origin
  Vec3 axis = Vec3::UnitZ();
  double radius = 1.0;

  void linearise(std::span<const Vec3> points, Linearised<5>& out) const {
    const Vec3 u = perpendicular_to(axis);
    const Vec3 v = axis.cross(u);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const Vec3 w = points[k] - point;
      const double along = w.dot(axis);
      const Vec3 lateral = w - along * axis;
      const double away = lateral.norm();
      const Vec3 e = away > 0.0 ? Vec3(lateral / away) : u;
      const double eu = e.dot(u);
      const double ev = e.dot(v);
      out.residuals[i] = away - radius;
      out.jacobian.row(i) << -eu, -ev, -along * eu, -along * ev, -1.0;
    }
  }
  [[nodiscard]] CylinderModel moved(const Eigen::Matrix<double, 5, 1>& wanted) const {
    // Beyond a third of a radian the linear model of the tilts means nothing.
    const double turn = wanted.segment<2>(2).norm();
    const Eigen::Matrix<double, 5, 1> step = wanted * std::min(1.0, 0.3 / turn);
    const Vec3 u = perpendicular_to(axis);
    const Vec3 v = axis.cross(u);
    CylinderModel next;
    next.axis = (axis + step[2] * u + step[3] * v).normalized();
    next.point = point + step[0] * u + step[1] * v;
    next.point -= next.axis.dot(next.point) * next.axis;
    next.radius = radius + step[4];
    return next;
  }
  // A radius of 1e6 times the part is a plane to rounding.
  [[nodiscard]] bool plausible() const { return radius > 0.0 && radius < 1e6; }
};

}  // namespace

Result<Fit<Cylinder>> fit_cylinder(std::span<const Vec3> points) {
  auto local = normalise(points, "cylinder", 5);
  if (!local) return std::move(local).error();
  if (auto flat = coplanar(*local, "cylinder")) return *flat;
  std::vector<CylinderModel> starts;
  for (const AxisCandidate& c : axis_candidates(*local, RoundKind::cylinder, kAxisCandidates)) {
    starts.push_back({c.point, c.axis, c.radius});
  }
  auto found = best_minimum(starts, *local, "cylinder");
  if (!found) return std::move(found).error();
  const CylinderModel& model = found->model;
  const UnitVec3 axis = canonical(model.axis);
  // The cofactor belongs to the tangents of the model's axis; settle once more on the final sign.
  GaussNewton<CylinderModel> last({model.point, axis, model.radius}, local->points);
  const Minimum<CylinderModel> final = last.settle();
  constexpr std::array kIsAngle{false, false, true, true, false};
  return completed(*local,
                   Cylinder{local->back(final.model.point), unit(final.model.axis),
                            final.model.radius * local->scale},
                   final.residuals, final.cofactor, kIsAngle,
                   static_cast<double>(points.size()) - 5.0, found->iterations + final.iterations);
}

}  // namespace frustum::metrology
