#include "metrology/fit/normalised_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/counted.hpp"
#include "core/linear_algebra.hpp"
#include "metrology/fit/constraint_steps.hpp"

namespace frustum::metrology {

namespace {

std::optional<Diagnostic> bad_weights(const std::vector<double>& weights, std::size_t points) {
  if (weights.empty()) return std::nullopt;
  if (weights.size() != points) {
    return error(
        "point-weights"_id,
        fmt::format("{} for {}", counted(weights.size(), "weight"), counted(points, "point")),
        "give one weight a point, or none");
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] >= 0.0) || !std::isfinite(weights[i])) {
      return error("point-weights"_id,
                   fmt::format("the weight of point {} is {}", i + 1, weights[i]),
                   "weights are finite and not negative");
    }
  }
  return std::nullopt;
}

// The largest becomes 1: factors common to all weights change no element.
double made_relative(std::vector<double>& weights) {
  if (weights.empty()) return 1.0;
  const double largest = *std::max_element(weights.begin(), weights.end());
  if (!(largest > 0.0)) return 1.0;
  for (double& w : weights) w /= largest;
  return largest;
}

// Parameters that the constraints take away.
std::size_t fixed_count(const Constraints& constraints, ElementKind kind) {
  if (!constraints.any()) return 0;
  const Element any = constrained(element_of(kind), constraints);
  return parameters_of(kind).size() -
         static_cast<std::size_t>(allowed_steps(any, constraints).cols());
}

Constraints localised(Constraints constraints, const NormalisedPoints& local) {
  if (constraints.axis) {
    constraints.axis->point = (constraints.axis->point - local.centre) / local.scale;
  }
  if (constraints.radius) *constraints.radius /= local.scale;
  if (constraints.tube_radius) *constraints.tube_radius /= local.scale;
  return constraints;
}

// Its point is moved along the axis to the middle of the points, where shift and tilt do not
// correlate.
Element localised(Element element, const NormalisedPoints& local) {
  std::visit(
      [&](auto& e) {
        e.point = (e.point - local.centre) / local.scale;
        if constexpr (requires { e.radius; }) e.radius /= local.scale;
        if constexpr (requires { e.tube_radius; }) {
          e.tube_radius /= local.scale;
        } else if constexpr (requires { e.axis; }) {
          const double along = -e.point.dot(e.axis.vec());
          e.point += along * e.axis.vec();
          if constexpr (requires { e.half_angle; }) e.radius += along * std::sin(e.half_angle);
        }
      },
      element);
  return element;
}

}  // namespace

double NormalisedPoints::all_weights() const {
  if (weights.empty()) return static_cast<double>(points.size());
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

std::size_t NormalisedPoints::count() const {
  if (weights.empty()) return points.size();
  return static_cast<std::size_t>(
      std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; }));
}

Result<NormalisedPoints> normalise(std::span<const Vec3> points, const Needed& needed,
                                   const FitOptions& options) {
  const std::string_view what = needed.what;
  if (auto problem = refused(options.constraints, needed.kind, what)) return *problem;
  if (auto problem = bad_weights(options.weights, points.size())) return *problem;
  NormalisedPoints local;
  local.weights = options.weights;
  local.largest_weight = made_relative(local.weights);
  local.points.reserve(points.size());
  local.points.assign(points.begin(), points.end());
  const std::size_t parameters =
      needed.parameters -
      std::min(needed.parameters, fixed_count(options.constraints, needed.kind));
  const std::size_t least =
      std::max<std::size_t>(1, (parameters + needed.per_point - 1) / needed.per_point);
  if (local.count() < least) {
    return error("too-few-points"_id,
                 fmt::format("too few points for a {}: {} {}, {} needed", what, local.count(),
                             local.weights.empty() ? "given" : "with weight", least));
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      return error("point-not-finite"_id, fmt::format("point {} is not finite", i + 1),
                   "remove it from the points");
    }
    sum += local.weight(i) * points[i];
  }
  const double all = local.all_weights();
  local.centre = sum / all;
  double farthest = 0.0;
  for (Vec3& p : local.points) {
    p -= local.centre;
    farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  }
  // Beyond, squares and fourth powers leave the doubles.
  if (!(farthest < 1e60)) {
    return error("points-far-apart"_id,
                 fmt::format("the points of the {} lie {} mm from each other", what, farthest),
                 "check the unit and the numbers");
  }
  // Coordinates of 1000 mm are rounded to 1e-13 mm: what is nearer than ten times that is one
  // point.
  if (!(farthest > 1e-15 * (1e3 + local.centre.norm()))) {
    return error("degenerate-points"_id,
                 fmt::format("degenerate points for a {}: all of them coincide", what));
  }
  local.scale = std::exp2(std::round(std::log2(farthest)));
  const double inverse = 1.0 / local.scale;  // a power of two: exact
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    local.points[i] *= inverse;
    mean += local.weight(i) * local.points[i];
  }
  mean /= all;
  // The first mean was rounded at the size of the coordinates; this one at the size of the part.
  for (Vec3& p : local.points) p -= mean;
  local.centre += local.scale * mean;
  local.constraints = localised(options.constraints, local);
  if (options.expected) local.expected = localised(*options.expected, local);
  return local;
}

NormalisedPoints thinned(const NormalisedPoints& local, std::size_t most) {
  NormalisedPoints few;
  few.largest_weight = local.largest_weight;
  few.constraints = local.constraints;
  few.centre = local.centre;
  few.scale = local.scale;
  const std::size_t all = local.points.size();
  const std::size_t wanted = std::min(most, all);
  few.points.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) {
    const double part = std::fmod(static_cast<double>(i) * std::numbers::phi, 1.0);
    const std::size_t at =
        all <= most ? i : static_cast<std::size_t>(part * static_cast<double>(all));
    if (!(local.weight(at) > 0.0)) continue;
    few.points.push_back(local.points[at]);
    if (!local.weights.empty()) few.weights.push_back(local.weights[at]);
  }
  // Few of them weigh: take all.
  return few.points.size() < std::min(wanted, local.count()) / 2 ? local : few;
}

double condition_of(const Eigen::MatrixXd& normal_equations) {
  if (normal_equations.size() == 0) return 1.0;
  const Eigen::VectorXd scale = normal_equations.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd values =
      symmetric_eigenvalues(scale.asDiagonal() * normal_equations * scale.asDiagonal());
  return std::sqrt(values[values.size() - 1] / std::max(values[0], 1e-300));
}

PrincipalDirections principal_directions(const NormalisedPoints& local) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(local.points.size()), 3);
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) =
        std::sqrt(local.weight(i)) * local.points[i].transpose();
  }
  // Directions from the points themselves, not from their covariance matrix, which squares the
  // errors.
  const PivotedTriangle qr = pivoted_triangle(rows);
  const SingularValues svd =
      singular_values(qr.triangle * qr.columns.transpose(), SingularVectors::full_right);
  PrincipalDirections principal;
  if (svd.converged) {  // always, for finite points
    principal.spread = svd.values / std::sqrt(local.all_weights());
    principal.directions = svd.right;
  }
  return principal;
}

Quality quality_of(const NormalisedPoints& local, const LocalSolution& solution) {
  Quality quality;
  double squares = 0.0;
  double weighted = 0.0;
  quality.residuals.reserve(solution.residuals.size());
  for (std::size_t i = 0; i < solution.residuals.size(); ++i) {
    const double d = solution.residuals[i] * local.scale;
    quality.residuals.push_back(d);
    squares += d * d;
    weighted += local.weight(i) * d * d;
  }
  const auto [low, high] = std::minmax_element(quality.residuals.begin(), quality.residuals.end());
  quality.form = *high - *low;
  quality.rms = std::sqrt(squares / static_cast<double>(quality.residuals.size()));
  Eigen::MatrixXd& cofactor = quality.cofactor;
  cofactor = solution.cofactor;
  for (Eigen::Index i = 0; i < cofactor.rows(); ++i) {
    for (Eigen::Index j = 0; j < cofactor.cols(); ++j) {
      if (solution.is_angle[static_cast<std::size_t>(i)]) cofactor(i, j) /= local.scale;
      if (solution.is_angle[static_cast<std::size_t>(j)]) cofactor(i, j) /= local.scale;
    }
  }
  quality.covariance =
      cofactor * (solution.redundancy > 0.0 ? weighted / solution.redundancy : 0.0);
  cofactor /= local.largest_weight;
  return quality;
}

UnitVec3 canonical(const Vec3& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return unit(axis(largest) < 0.0 ? Vec3(-axis) : axis);
}

}  // namespace frustum::metrology
