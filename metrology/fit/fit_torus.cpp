#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "metrology/fit/element_rows.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/plausibility.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kTorusWording{"torus", "probe more of the ring and more of its tube"};

Torus kept(const Torus& start, const Constraints& keep) {
  return std::get<Torus>(constrained(Element(start), keep));
}

// The ring and its tube for a given axis: the circle through (away, along) of the points.
Torus around(const AxisCandidate& candidate, const NormalisedPoints& few) {
  Eigen::Matrix3d normal = 1e-12 * Eigen::Matrix3d::Identity();
  Vec3 right = Vec3::Zero();
  for (const Vec3& p : few.points) {
    const Vec3 w = p - candidate.point;
    const double along = w.dot(candidate.axis);
    const double away = (w - along * candidate.axis).norm();
    const Vec3 monomials(2.0 * away, 2.0 * along, 1.0);
    normal += monomials * monomials.transpose();
    right += (away * away + along * along) * monomials;
  }
  const Vec3 s = SymmetricFactors(normal).solve(Eigen::VectorXd(right));
  const double tube = std::sqrt(std::max(s[2] + s[0] * s[0] + s[1] * s[1], 1e-12));
  // A thicker tube would cut itself.
  const double radius = std::max(std::abs(s[0]), 1.1 * tube);
  return kept({candidate.point + s[1] * candidate.axis, unit(candidate.axis), radius, tube},
              few.constraints);
}

// A bent tube: the middle of a cylinder's sections as a parabola along it, from its residuals.
Torus bent(const Cylinder& tube, const NormalisedPoints& few) {
  using Row7 = Eigen::Matrix<double, 7, 1>;
  Eigen::Matrix<double, 7, 7> normal = 1e-9 * Eigen::Matrix<double, 7, 7>::Identity();
  Row7 right = Row7::Zero();
  for (const Vec3& p : few.points) {
    const auto at = row<double>(tube, p.x(), p.y(), p.z());
    const double along = (p - tube.point).dot(tube.axis.vec());
    const Eigen::Vector2d e(-at.gradient[0], -at.gradient[1]);
    Row7 monomials;
    monomials << e, along * e, along * along * e, 1.0;
    normal += monomials * monomials.transpose();
    right += at.residual * monomials;
  }
  const Row7 s = SymmetricFactors(normal).solve(Eigen::VectorXd(right));
  const auto uv = tangents(tube.axis);
  const auto across = [&](int i) -> Vec3 { return s[i] * uv.first + s[i + 1] * uv.second; };
  const UnitVec3 along = unit(tube.axis.vec() + across(2));
  const Vec3 bend = across(4) - across(4).dot(along.vec()) * along.vec();
  const UnitVec3 inward = UnitVec3::of(bend).value_or(unit(perpendicular_to(along)));
  const double thick = std::max(tube.radius + s[6], 1e-3);
  const double radius = std::clamp(0.5 / std::max(bend.norm(), 1e-4), 1.1 * thick, 1e4);
  return kept({tube.point + across(0) + radius * inward.vec(),
               unit(along.vec().cross(inward.vec())), radius, thick},
              few.constraints);
}

std::vector<Element> bent_tubes(const AxisSearch& search, const NormalisedPoints& few) {
  const PointBlocks points = PointBlocks::of(few);
  const Constraints free;
  std::vector<std::pair<double, Element>> tubes;
  for (const AxisCandidate& c : search.candidates(RoundKind::cylinder, kAxisCandidates)) {
    GaussNewton solver(Cylinder{c.point, unit(c.axis), c.radius}, points, free);
    solver.descend(12, 1e-3);
    if (!implausible(solver.element())) tubes.emplace_back(solver.cost(), solver.element());
  }
  std::stable_sort(tubes.begin(), tubes.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Element> starts;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, tubes.size()); ++i) {
    starts.push_back(bent(std::get<Cylinder>(tubes[i].second), few));
  }
  return starts;
}

std::vector<Element> rings(const std::vector<AxisCandidate>& candidates,
                           const AxialPoints& points) {
  return starts_from(candidates, [&](const AxisCandidate& c) { return around(c, points.few); });
}

std::vector<Element> initial_rings(const AxialPoints& points) {
  return rings(points.axes.initial_estimates(RoundKind::cylinder), points);
}

std::vector<Element> searched_torus(const AxialPoints& points) {
  std::vector<Element> starts = initial_rings(points);
  // The axis of the ring is no axis of a tube: its search keeps no direction.
  NormalisedPoints unbound = points.few;
  unbound.constraints = {};
  std::vector<Element> more = bent_tubes(AxisSearch(unbound, points.principal), points.few);
  starts.insert(starts.end(), more.begin(), more.end());
  for (const RoundKind kind : {RoundKind::cylinder, RoundKind::cone}) {
    more = rings(points.axes.candidates(kind, kAxisCandidates), points);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  return starts;
}

Result<Minimum> solve_torus(const NormalisedPoints& local) {
  return axial_minimum(local, kTorusWording, initial_rings, searched_torus);
}

}  // namespace

Result<Fit<Torus>> fit_torus(std::span<const Vec3> points, const FitOptions& options) {
  return round_fit<Torus>(points, options, {ElementKind::torus, kTorusWording.what, 7},
                          solve_torus);
}

}  // namespace frustum::metrology
