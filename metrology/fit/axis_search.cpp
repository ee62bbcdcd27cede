#include "metrology/fit/axis_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/linear_algebra.hpp"

namespace frustum::metrology {
namespace {

// Coefficients of x^2, y^2, z^2, xy, xz, yz, x, y, z, 1.
using Polynomial = Eigen::Matrix<double, 10, 1>;
using Moments = Eigen::Matrix<double, 10, 10>;

Polynomial monomials(const Vec3& x) {
  Polynomial m;
  m << x.x() * x.x(), x.y() * x.y(), x.z() * x.z(), x.x() * x.y(), x.x() * x.z(), x.y() * x.z(),
      x.x(), x.y(), x.z(), 1.0;
  return m;
}

Moments moments_of(const std::vector<Vec3>& points) {
  Moments sum = Moments::Zero();
  for (const Vec3& x : points) {
    const Polynomial m = monomials(x);
    sum.selfadjointView<Eigen::Lower>().rankUpdate(m);
  }
  const Moments full = sum.selfadjointView<Eigen::Lower>();
  return full / static_cast<double>(points.size());
}

Polynomial square_of_length() {
  Polynomial p = Polynomial::Zero();
  p.head<3>().setOnes();
  return p;
}
Polynomial square_along(const Vec3& a) {
  Polynomial p = Polynomial::Zero();
  p.head<6>() << a.x() * a.x(), a.y() * a.y(), a.z() * a.z(), 2.0 * a.x() * a.y(),
      2.0 * a.x() * a.z(), 2.0 * a.y() * a.z();
  return p;
}
Polynomial along(const Vec3& a) {
  Polynomial p = Polynomial::Zero();
  p.segment<3>(6) = a;
  return p;
}
Polynomial one() {
  Polynomial p = Polynomial::Zero();
  p[9] = 1.0;
  return p;
}

struct Ranked {
  AxisCandidate candidate;
  double cost = std::numeric_limits<double>::infinity();
};

Ranked ranked(const Moments& moments, const Vec3& axis, RoundKind kind) {
  const Vec3 u = perpendicular_to(axis);
  const Vec3 v = axis.cross(u);
  const Polynomial lateral = square_of_length() - square_along(axis);
  Eigen::Matrix<double, 10, Eigen::Dynamic, 0, 10, 5> basis(10, kind == RoundKind::cone ? 5 : 3);
  basis.col(0) = along(u);
  basis.col(1) = along(v);
  basis.col(2) = one();
  if (kind == RoundKind::cone) {
    basis.col(3) = along(axis);
    basis.col(4) = square_along(axis);
  }
  const auto count = basis.cols();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 5, 5> normal =
      basis.transpose() * moments * basis;
  // Keeps the factorisation finite when points are in a plane or on a circle; too small to matter
  // else.
  normal += 1e-13 * Eigen::MatrixXd::Identity(count, count);
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 5, 1> right =
      basis.transpose() * moments * lateral;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 5, 1> solution =
      SymmetricFactors(normal).solve(Eigen::VectorXd(right));
  Ranked result;
  result.candidate.axis = axis;
  result.candidate.point = 0.5 * (solution[0] * u + solution[1] * v);
  const double left = lateral.dot(moments * lateral) - right.dot(solution);
  // Mean square distance from the axis: the algebraic residual is about 2 rho times the distance.
  const double rho2 = lateral.dot(moments * one()) + result.candidate.point.squaredNorm();
  result.candidate.radius = std::sqrt(std::max(rho2, 0.0));
  if (std::isfinite(left) && rho2 > 0.0) result.cost = std::max(left, 0.0) / (4.0 * rho2);
  return result;
}

}  // namespace

AxisSearch::AxisSearch(const NormalisedPoints& local, const PrincipalDirections& principal)
    : keep_(local.constraints),
      principal_(principal.directions),
      moments_(moments_of(local.points)) {}

std::vector<Vec3> AxisSearch::directions() const {
  std::vector<Vec3> all;
  if (keep_.perpendicular_to) {
    constexpr int kTurns = 36;  // 5 deg apart
    const auto [u, v] = tangents(*keep_.perpendicular_to);
    for (int i = 0; i < kTurns; ++i) {
      const double turn = std::numbers::pi * i / kTurns;
      all.emplace_back(std::cos(turn) * u + std::sin(turn) * v);
    }
    return all;
  }
  constexpr int kDirections = 200;  // about 10 deg apart
  for (int i = 0; i < kDirections; ++i) {
    const double z = (i + 0.5) / kDirections;
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;  // the golden angle
    const double r = std::sqrt(1.0 - z * z);
    all.emplace_back(Vec3(r * std::cos(turn), r * std::sin(turn), z).normalized());
  }
  return all;
}

std::vector<AxisCandidate> AxisSearch::initial_estimates(RoundKind kind) const {
  if (keep_.axis) return {ranked(moments_, keep_.axis->axis, kind).candidate};
  if (keep_.parallel_to) return {ranked(moments_, *keep_.parallel_to, kind).candidate};
  std::vector<Ranked> all;
  for (int i = 0; i < 3; ++i) {
    Vec3 axis = principal_.col(i);
    if (keep_.perpendicular_to) {
      const Vec3& d = keep_.perpendicular_to->vec();
      const auto lying = UnitVec3::of(axis - axis.dot(d) * d);
      if (!lying) continue;
      axis = *lying;
    }
    all.push_back(ranked(moments_, axis, kind));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  std::vector<AxisCandidate> chosen;
  for (const Ranked& r : all) chosen.push_back(r.candidate);
  return chosen;
}

std::vector<AxisCandidate> AxisSearch::candidates(RoundKind kind, std::size_t most) const {
  // The principal directions whatever their rank: a flat or a slender part shows its axis there.
  std::vector<AxisCandidate> chosen = initial_estimates(kind);
  if (keep_.axis || keep_.parallel_to) return chosen;
  std::vector<Ranked> all;
  for (const Vec3& axis : directions()) all.push_back(ranked(moments_, axis, kind));
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  const double apart = std::cos(12.0 * kRadPerDeg);  // wider than the grid, so neighbours are one
  for (const Ranked& r : all) {
    if (chosen.size() >= most || !std::isfinite(r.cost)) break;
    const bool fresh = std::none_of(chosen.begin(), chosen.end(), [&](const AxisCandidate& c) {
      return std::abs(c.axis.dot(r.candidate.axis)) > apart;
    });
    if (fresh) chosen.push_back(r.candidate);
  }
  return chosen;
}

}  // namespace frustum::metrology
