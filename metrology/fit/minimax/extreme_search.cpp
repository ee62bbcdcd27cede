#include "metrology/fit/minimax/extreme_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustum::metrology {
namespace {

using namespace surface_parameter;

std::vector<Vec3> in_frame(const Pose& local_from_frame, std::span<const Vec3> points) {
  const Pose frame_from_local = local_from_frame.inverse();
  std::vector<Vec3> out;
  out.reserve(points.size());
  for (const Vec3& p : points) out.push_back(frame_from_local.point(p));
  return out;
}

// Points spread over the whole sequence, and the farthest of both sides.
std::vector<std::size_t> first_working_set(const Eigen::VectorXd& values) {
  constexpr std::size_t kAll = 40;
  constexpr std::size_t kSpread = 24;
  constexpr std::size_t kExtreme = 8;
  const auto n = static_cast<std::size_t>(values.size());
  std::vector<std::size_t> working;
  if (n <= kAll) {
    for (std::size_t i = 0; i < n; ++i) working.push_back(i);
    return working;
  }
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  const auto by_value = [&](std::size_t a, std::size_t b) {
    const double x = values[static_cast<Eigen::Index>(a)];
    const double y = values[static_cast<Eigen::Index>(b)];
    return x != y ? x < y : a < b;
  };
  std::partial_sort(order.begin(), order.begin() + kExtreme, order.end(), by_value);
  working.assign(order.begin(), order.begin() + kExtreme);
  std::partial_sort(order.begin(), order.begin() + kExtreme, order.end(),
                    [&](std::size_t a, std::size_t b) { return by_value(b, a); });
  working.insert(working.end(), order.begin(), order.begin() + kExtreme);
  for (std::size_t i = 0; i < kSpread; ++i) {
    const double at = std::fmod(static_cast<double>(i) * std::numbers::phi, 1.0);
    working.push_back(static_cast<std::size_t>(at * static_cast<double>(n)));
  }
  std::sort(working.begin(), working.end());
  working.erase(std::unique(working.begin(), working.end()), working.end());
  return working;
}

// Point `index` of a sequence that fills the cube [-1, 1]^k evenly.
Eigen::VectorXd filling(int index, Eigen::Index unknowns) {
  double root = 2.0;
  for (int i = 0; i < 40; ++i) root = std::pow(1.0 + root, 1.0 / static_cast<double>(unknowns + 1));
  Eigen::VectorXd out(unknowns);
  double step = 1.0;
  for (Eigen::Index j = 0; j < unknowns; ++j) {
    step /= root;
    out[j] = 2.0 * std::fmod(0.5 + step * index, 1.0) - 1.0;
  }
  return out;
}

bool plausible(const ExtremeSearch& search, const SurfaceParameters& at) {
  constexpr double kFar = 1e6;  // of the part: a plane or a line to rounding
  if (!at.allFinite() || at.cwiseAbs().maxCoeff() > kFar) return false;
  if (at.segment<2>(kTiltX).cwiseAbs().maxCoeff() > search.most_tilt) return false;
  const bool has_radius = search.kind->surface != Surface::plane && search.kind->has_sides;
  if (has_radius && !(at[kRadius] > 0.0) && !search.kind->has_size) return false;
  if (search.kind->name == "cone") {
    const double angle = std::abs(at[kShape]);
    return angle > 1e-9 && angle < std::numbers::pi / 2.0 - 1e-9;
  }
  return search.kind->surface != Surface::ring || at[kShape] > 0.0;
}

class Contest {
 public:
  Contest(const ExtremeSearch& search, std::span<const Vec3> points)
      : search_(search), points_(points) {}

  // `framed` are the points in the frame.
  void enter(const Pose& frame, std::span<const Vec3> framed, const SurfaceParameters& at) {
    ++best_.starts;
    const double worth = best_.solution.proven ? best_.solution.level + 1e-13
                                               : std::numeric_limits<double>::infinity();
    MinimaxSolution solution = minimax_near(search_.problem, framed, at, working_, worth);
    best_.iterations += solution.iterations;
    differ_ = differ_ || (solution.level > worth && best_.solution.proven);
    if (!solution.proven || !plausible(search_, solution.at)) return;
    if (best_.solution.proven) {
      differ_ = differ_ || std::abs(solution.level - best_.solution.level) > 1e-13;
      if (solution.level >= best_.solution.level - 1e-15) return;
    }
    best_.placed = {frame, solution.at};
    best_.solution = std::move(solution);
  }

  ExtremeFound run() {
    const Pose& frame = search_.start.local_from_frame;
    const std::vector<Vec3> framed = in_frame(frame, points_);
    const SurfaceParameters& at = search_.start.at;
    const Eigen::VectorXd values = distances(search_.problem.surface, at, framed);
    working_ = first_working_set(values);
    enter(frame, framed, at);
    const SurfaceSteps steps = even_steps(search_.problem, at, framed);
    const double spread = 0.5 * (values.maxCoeff() - values.minCoeff());
    constexpr std::array kScales{1.0, 3.0, 0.3, 10.0};
    const int unknowns = static_cast<int>(steps.cols());
    // Where all starts lead to one minimum a few of them tell; where there are several, many are
    // needed.
    for (int i = 0; i < (differ_ ? 6 : 1) * (unknowns + 2); ++i) {
      const double scale = kScales[static_cast<std::size_t>(i) % kScales.size()] * spread;
      SurfaceParameters step = steps * (scale * filling(i + 1, steps.cols()));
      const double far = std::max(step.segment<2>(kTiltX).cwiseAbs().maxCoeff(),
                                  std::max(std::abs(step[kShape]), 0.5 * step.head<3>().norm()));
      enter(frame, framed, at + step * std::min(1.0, 0.5 / std::max(far, 1e-300)));
    }
    for (const PlacedElement& other : search_.elsewhere) {
      enter(other.local_from_frame, in_frame(other.local_from_frame, points_), other.at);
    }
    return best_;
  }

 private:
  const ExtremeSearch& search_;
  std::span<const Vec3> points_;
  std::vector<std::size_t> working_{};
  ExtremeFound best_{};
  bool differ_ = false;  // starts led to minima that are not the same
};

}  // namespace

ExtremeFound best_extreme(const ExtremeSearch& search, std::span<const Vec3> points) {
  return Contest(search, points).run();
}

}  // namespace frustum::metrology
