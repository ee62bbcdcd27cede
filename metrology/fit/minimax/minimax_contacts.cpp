#include "metrology/fit/minimax/minimax_contacts.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::metrology {
namespace {

// Rows s_i grad d_i, values s_i d_i and the Hessian of the Lagrangian, in steps of the basis.
struct Linearised {
  Eigen::MatrixXd rows;
  Eigen::VectorXd values;
  Eigen::MatrixXd hessian;
  Eigen::VectorXd multipliers;
};

Linearised linearised(const MinimaxProblem& problem, std::span<const Vec3> points,
                      const SurfaceSteps& basis, const SurfaceParameters& at,
                      const std::vector<ActiveRow>& contacts, bool bends) {
  const auto count = static_cast<Eigen::Index>(contacts.size());
  Linearised out{Eigen::MatrixXd(count, basis.cols()), Eigen::VectorXd(count),
                 Eigen::MatrixXd::Zero(basis.cols(), basis.cols()), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const ActiveRow& contact = contacts[static_cast<std::size_t>(i)];
    const Vec3& point = points[static_cast<std::size_t>(contact.row)];
    out.values[i] = contact.sign * distance(problem.surface, at, point);
    out.rows.row(i) = contact.sign * slopes(problem.surface, at, {&point, 1}).row(0) * basis;
    out.multipliers[i] = contact.multiplier;
    if (bends) {
      out.hessian +=
          contact.multiplier * contact.sign * curvature(problem.surface, at, point, basis);
    }
  }
  return out;
}

Linearised linearised(const MinimaxProblem& problem, std::span<const Vec3> points,
                      const SurfaceSteps& basis, const SurfaceParameters& at,
                      const std::vector<ActiveRow>& contacts) {
  // As many contacts as unknowns and level hold the element without curvature.
  const bool bends = static_cast<Eigen::Index>(contacts.size()) <= basis.cols();
  return linearised(problem, points, basis, at, contacts, bends);
}

// Least eigenvalue of the Hessian along the directions that no contact feels, in units of its size.
double least_bend(const Linearised& at) {
  const double size = at.hessian.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return 0.0;
  const Eigen::MatrixXd free = null_space(at.rows, 1e-9);
  if (free.cols() == 0) return 0.0;
  const Eigen::MatrixXd orthogonal = orthonormal_columns(free);
  const Eigen::MatrixXd reduced = orthogonal.transpose() * at.hessian * orthogonal;
  return symmetric_eigenvalues(reduced)[0] / size;
}

std::optional<Eigen::VectorXd> newton(const Linearised& at) {
  const Eigen::Index unknowns = at.rows.cols();
  const Eigen::Index count = at.rows.rows();
  const Eigen::Index size = unknowns + 1 + count;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  matrix.topLeftCorner(unknowns, unknowns) = at.hessian;
  matrix.block(0, unknowns + 1, unknowns, count) = at.rows.transpose();
  matrix.block(unknowns, unknowns + 1, 1, count).setConstant(-1.0);
  matrix.block(unknowns + 1, 0, count, unknowns) = at.rows;
  matrix.block(unknowns + 1, unknowns, count, 1).setConstant(-1.0);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  right[unknowns] = -1.0;
  right.tail(count) = -at.values;
  const Eigen::VectorXd solution = solution_of(matrix, right);
  if (!solution.allFinite()) return std::nullopt;
  return solution.head(unknowns);
}

// Multipliers that balance the gradients best and add up to one; the shortest such vector, which
// ties share.
Eigen::VectorXd balanced(const Eigen::MatrixXd& rows) {
  Eigen::MatrixXd matrix(rows.cols() + 1, rows.rows());
  matrix << rows.transpose(), Eigen::RowVectorXd::Ones(rows.rows());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(rows.cols() + 1);
  right[rows.cols()] = 1.0;
  return shortest_solution(matrix, right);
}

// 1e-9 mm on a part of 100 mm: what is farther from a minimum is none.
constexpr double kProof = 5e-12;

void certify(const MinimaxProblem& problem, std::span<const Vec3> points, const SurfaceSteps& basis,
             MinimaxSolution& found) {
  Linearised here = linearised(problem, points, basis, found.at, found.contacts);
  here.multipliers = balanced(here.rows);
  found.proven = here.multipliers.allFinite() && here.multipliers.minCoeff() > 0.0;
  for (std::size_t i = 0; i < found.contacts.size(); ++i) {
    found.contacts[i].multiplier = here.multipliers[static_cast<Eigen::Index>(i)];
  }
  // In the parameters themselves: those have the size of the part.
  const Linearised plain = linearised(problem, points, problem.allowed, found.at, found.contacts);
  found.imbalance = (plain.rows.transpose() * here.multipliers).norm();
  found.gap = std::max(0.0, found.level - here.multipliers.dot(here.values)) + found.imbalance;
  if (!(found.gap <= kProof)) found.proven = false;
  if (found.proven && here.rows.rows() <= here.rows.cols()) {
    here = linearised(problem, points, basis, found.at, found.contacts);
    // Differences of slopes carry ten digits; a bend nearer to none holds nothing and loses
    // nothing.
    found.proven = least_bend(here) > -1e-7;
  }
}

// Where distances tie, the contacts that a linear programme picks among them may carry nothing, and
// leave free what the others hold. All that tie, those taken out that would have to pull, prove it
// together.
void certify_ties(const MinimaxProblem& problem, std::span<const Vec3> points,
                  const SurfaceSteps& basis, MinimaxSolution& found) {
  const Eigen::VectorXd values = distances(problem.surface, found.at, points);
  std::vector<ActiveRow> ties;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      const bool counts = sign > 0.0 ? problem.sides.high : problem.sides.low;
      if (counts && sign * values[i] > found.level - problem.tie) ties.push_back({i, sign});
    }
  }
  constexpr double kNothing = 1e-9;  // of a sum of one
  Eigen::VectorXd multipliers;
  for (bool all_push = false; !all_push && !ties.empty();) {
    multipliers = balanced(linearised(problem, points, basis, found.at, ties, false).rows);
    std::vector<ActiveRow> pushing;
    for (std::size_t i = 0; i < ties.size(); ++i) {
      ties[i].multiplier = multipliers[static_cast<Eigen::Index>(i)];
      if (ties[i].multiplier > kNothing) pushing.push_back(ties[i]);
    }
    all_push = pushing.size() == ties.size();
    ties = std::move(pushing);
  }
  if (ties.empty()) return;
  MinimaxSolution tied = found;
  tied.contacts = std::move(ties);
  const Linearised plain =
      linearised(problem, points, problem.allowed, found.at, tied.contacts, false);
  tied.imbalance = (plain.rows.transpose() * multipliers).norm();
  tied.gap = std::max(0.0, found.level - multipliers.dot(plain.values)) + tied.imbalance;
  if (!(tied.gap <= problem.tie)) return;
  tied.proven =
      least_bend(linearised(problem, points, basis, found.at, tied.contacts, true)) > -1e-7;
  if (tied.proven) found = std::move(tied);
}

}  // namespace

std::optional<Eigen::VectorXd> contact_step(const MinimaxProblem& problem,
                                            std::span<const Vec3> points, const SurfaceSteps& basis,
                                            const SurfaceParameters& at,
                                            const std::vector<ActiveRow>& contacts) {
  if (contacts.empty()) return std::nullopt;
  Linearised here = linearised(problem, points, basis, at, contacts);
  // Where the Lagrangian bends downward, a Hessian that bends upward still tells a way down.
  const double lack = 1e-3 - least_bend(here);
  if (lack > 1e-3) {
    here.hessian.diagonal().array() += 2.0 * lack * here.hessian.cwiseAbs().maxCoeff();
  }
  return newton(here);
}

MinimaxSolution settled_on_contacts(const MinimaxProblem& problem, std::span<const Vec3> points,
                                    const SurfaceSteps& basis, const SurfaceParameters& at,
                                    double level, const std::vector<ActiveRow>& contacts) {
  MinimaxSolution found;
  found.at = at;
  found.level = level;
  found.contacts = contacts;
  found.gap = std::numeric_limits<double>::infinity();
  if (contacts.empty() || !std::isfinite(level)) return found;
  double previous = std::numeric_limits<double>::infinity();
  constexpr double kRounding =
      1e-15;  // of distances of order one, and of the roots and sums in them
  for (int i = 0; i < 8; ++i) {
    const auto step = newton(linearised(problem, points, basis, found.at, found.contacts));
    if (!step) break;
    const double length = step->norm();
    // Converging steps shrink at once; others lead to other contacts.
    if (!(length < 0.5 * previous) || length > 1e-3) break;
    const SurfaceParameters moved = found.at + basis * *step;
    const double reached = level_of(distances(problem.surface, moved, points), problem.sides);
    if (!(reached <= level + kRounding * std::max(1.0, std::abs(level)))) break;
    found.at = moved;
    found.level = reached;
    previous = length;
    if (length < 1e-16) break;
  }
  certify(problem, points, basis, found);
  if (!found.proven) certify_ties(problem, points, basis, found);
  return found;
}

}  // namespace frustum::metrology
