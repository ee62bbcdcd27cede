#include "metrology/fit/minimax/minimax.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"
#include "metrology/fit/minimax/minimax_contacts.hpp"

namespace frustum::metrology {
namespace {

class Descent {
 public:
  Descent(const MinimaxProblem& problem, std::span<const Vec3> points,
          const SurfaceParameters& start)
      : problem_(problem), points_(points), basis_(even_steps(problem, start, points)) {
    move_to(start, distances(problem.surface, start, points));
    const double spread = values_.maxCoeff() - values_.minCoeff();
    // The first steps may change distances by as much as they differ.
    reach_ = std::max(spread, 1e-6);
    measure_bends();
  }

  MinimaxSolution run() {
    constexpr int kMost = 40;
    for (int i = 0; i < kMost && std::isfinite(level_); ++i) {
      ++iterations_;
      if (!step()) break;
    }
    MinimaxSolution found = settled_on_contacts(problem_, points_, basis_, at_, level_, active_);
    found.iterations = iterations_;
    return found;
  }

 private:
  void move_to(const SurfaceParameters& at, Eigen::VectorXd values) {
    at_ = at;
    values_ = std::move(values);
    level_ = level_of(values_, problem_.sides);
    gradients_ = slopes(problem_.surface, at_, points_) * basis_;
  }

  // How much distances bend along each step: what is left of them at the ends of the first box.
  void measure_bends() {
    bend_ = Eigen::VectorXd::Zero(basis_.cols());
    for (Eigen::Index j = 0; j < basis_.cols(); ++j) {
      const SurfaceParameters whole = reach_ * basis_.col(j);
      const double share = bounded_share(whole);
      const SurfaceParameters step = share * whole;
      const Eigen::VectorXd left = distances(problem_.surface, at_ + step, points_) +
                                   distances(problem_.surface, at_ - step, points_) - 2.0 * values_;
      bend_[j] = left.cwiseAbs().maxCoeff() / (share * share * reach_ * reach_);
    }
  }

  // Steps that neither in first nor in second order change distances by more than the reach.
  [[nodiscard]] Eigen::VectorXd box() const {
    return (2.0 * reach_ / bend_.array().max(2.0 / reach_)).sqrt().min(reach_);
  }

  // False when nothing is left to gain.
  bool step() {
    const LinearMinimax linear = linear_minimax(values_, gradients_, problem_.sides, box());
    if (!linear.solved) return shrink();
    active_ = linear.active;
    const double promised = level_ - linear.level;
    // Distances of order one are rounded to 1e-16 each.
    if (promised <= 4e-16 * std::max(1.0, std::abs(level_))) return false;
    const double share = bounded_share(basis_ * linear.step);
    Trial best = trial(at_ + share * (basis_ * linear.step));
    bool by_curvature = false;
    if (linear.at_bound) {
      if (const auto newton = contact_step(problem_, points_, basis_, at_, active_)) {
        Trial other = along_contacts(*newton);
        by_curvature = other.level < best.level;
        if (by_curvature) best = std::move(other);
      }
    }
    const double gain = level_ - best.level;
    if (!(gain > 0.0))
      return linear.at_bound || share < 1.0 || reach_ > 1e-9 ? shrink(linear) : false;
    if (!by_curvature) {
      if (gain < 0.25 * share * promised) reach_ *= 0.25;
      if (gain > 0.75 * share * promised && linear.at_bound) reach_ *= 2.0;
    }
    move_to(best.at, std::move(best.values));
    return true;
  }

  bool shrink() {
    reach_ *= 0.25;
    return reach_ > 1e-14;
  }
  // Inside the box a step that fails must be cut to less than itself.
  bool shrink(const LinearMinimax& failed) {
    reach_ = std::min(reach_, failed.step.cwiseAbs().maxCoeff());
    return shrink();
  }

  struct Trial {
    SurfaceParameters at;
    Eigen::VectorXd values;
    double level;
  };
  [[nodiscard]] Trial trial(const SurfaceParameters& at) const {
    Trial t{at, distances(problem_.surface, at, points_), 0.0};
    t.level = level_of(t.values, problem_.sides);
    if (!std::isfinite(t.level)) t.level = std::numeric_limits<double>::infinity();
    return t;
  }

  // As much of a step that keeps the contacts as the other points allow.
  [[nodiscard]] Trial along_contacts(const Eigen::VectorXd& step) const {
    const SurfaceParameters whole = basis_ * step;
    double share = bounded_share(whole);
    Trial best = trial(at_ + share * whole);
    for (int i = 0; i < 6 && !(best.level < level_); ++i) {
      share *= 0.4;
      best = trial(at_ + share * whole);
    }
    return best;
  }

  // Beyond a third of a radian or the size of the part the linear model means nothing.
  [[nodiscard]] static double bounded_share(const SurfaceParameters& moved) {
    using namespace surface_parameter;
    const double turn =
        std::max(moved.segment<2>(kTiltX).cwiseAbs().maxCoeff(), std::abs(moved[kShape]));
    return std::min(1.0, 0.3 / std::max({turn, 1e-300}));
  }

  const MinimaxProblem& problem_;
  std::span<const Vec3> points_;
  SurfaceSteps basis_;
  SurfaceParameters at_ = SurfaceParameters::Zero();
  Eigen::VectorXd values_{};
  Gradients gradients_{};
  double level_ = 0.0;
  double reach_ = 1.0;
  Eigen::VectorXd bend_{};
  std::vector<ActiveRow> active_{};
  int iterations_ = 0;
};

std::vector<Vec3> chosen(std::span<const Vec3> points, const std::vector<std::size_t>& indices) {
  std::vector<Vec3> some;
  some.reserve(indices.size());
  for (const std::size_t i : indices) some.push_back(points[i]);
  return some;
}

// Adds those farthest above the level, at most `most`; false when none is.
bool add_violators(const Eigen::VectorXd& values, Sides sides, double level, std::size_t most,
                   std::vector<std::size_t>& working) {
  std::vector<std::pair<double, std::size_t>> above;
  // Two roundings of the distances: the contacts themselves are no violators.
  const double limit = level + 4e-16 * std::max(1.0, std::abs(level));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double high = sides.high ? values[i] : -std::numeric_limits<double>::infinity();
    const double reached = sides.low ? std::max(high, -values[i]) : high;
    if (reached > limit) above.emplace_back(reached, static_cast<std::size_t>(i));
  }
  const auto far_first = [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  };
  const std::size_t count = std::min(most, above.size());
  std::partial_sort(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(count), above.end(),
                    far_first);
  bool added = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::find(working.begin(), working.end(), above[i].second) != working.end()) continue;
    working.push_back(above[i].second);
    added = true;
  }
  return added;
}

}  // namespace

double level_of(const Eigen::VectorXd& distances, Sides sides) {
  if (!distances.allFinite()) return std::numeric_limits<double>::infinity();
  const double high = sides.high ? distances.maxCoeff() : -std::numeric_limits<double>::infinity();
  return sides.low ? std::max(high, -distances.minCoeff()) : high;
}

SurfaceSteps even_steps(const MinimaxProblem& problem, const SurfaceParameters& at,
                        std::span<const Vec3> points) {
  Eigen::MatrixXd rows = slopes(problem.surface, at, points) * problem.allowed;
  rows /= std::sqrt(static_cast<double>(points.size()));
  const Eigen::Index unknowns = rows.cols();
  if (rows.rows() < unknowns) {
    rows.conservativeResizeLike(Eigen::MatrixXd::Zero(unknowns, unknowns));
  }
  auto [triangle, columns] = pivoted_triangle(rows);
  // What the points hardly tell is moved no farther than a millionfold.
  const double floor = std::max(1e-6 * std::abs(triangle(0, 0)), 1e-12);
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    if (!(std::abs(triangle(i, i)) > floor)) triangle(i, i) = floor;
  }
  const Eigen::MatrixXd inverse =
      triangle.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  return problem.allowed * (columns * inverse);
}

MinimaxSolution minimax_near(const MinimaxProblem& problem, std::span<const Vec3> points,
                             const SurfaceParameters& start) {
  return Descent(problem, points, start).run();
}

MinimaxSolution minimax_near(const MinimaxProblem& problem, std::span<const Vec3> points,
                             const SurfaceParameters& start, std::vector<std::size_t>& working,
                             double worth) {
  const auto batch = 2 * static_cast<std::size_t>(problem.allowed.cols() + 1);
  MinimaxSolution found;
  found.at = start;
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    const int before = found.iterations;
    found = minimax_near(problem, chosen(points, working), found.at);
    found.iterations += before;
    for (ActiveRow& contact : found.contacts) {
      contact.row = static_cast<Eigen::Index>(working[static_cast<std::size_t>(contact.row)]);
    }
    const Eigen::VectorXd all = distances(problem.surface, found.at, points);
    const double inside = found.level;
    found.level = level_of(all, problem.sides);
    found.gap += std::max(0.0, found.level - inside);
    if (inside > worth) {
      found.proven = false;
      return found;
    }
    if (!add_violators(all, problem.sides, inside, batch, working)) return found;
  }
  found.proven = false;
  return found;
}

}  // namespace frustum::metrology
