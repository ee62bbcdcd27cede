// Adaptive sampling of a continuous tool motion to the ToolPath bound.
//
// Model    : the motion is halved until straight line + great circle between neighbours stays
//            within `bound` of it at the tip and at `reach` above the tip, checked at the quarter
//            points
// Units    : mm
// Errors   : none
// Accuracy : tests/kinematics/path_sampling_test.cpp holds the bound at a thousand points a block
#pragma once

#include <functional>
#include <vector>

#include "kinematics/model/tool_pose.hpp"

namespace frustum::kinematics {

struct SamplingOptions {
  double bound = 1e-5;  // mm
  double reach = 50.0;  // mm: height of the cutter above the tip, where an axis error weighs most
  int least_parts = 1;  // the motion is cut into this many equal parts first
};

// Whether `exact`, a share t of the way, is where the straight way from one pose to the other has
// it.
[[nodiscard]] bool is_on_the_way(const ToolPose& from, const ToolPose& to, double t,
                                 const ToolPose& exact, const SamplingOptions& options);

// `Motion` takes u in [0, 1] to a value with a member `pose`, which is passed on with the sample.
template <typename Motion>
class PathSampler {
 public:
  using Place = std::invoke_result_t<Motion, double>;

  PathSampler(const Motion& motion, const SamplingOptions& options)
      : motion_(motion), options_(options) {}

  // add(u, place) for samples in (0, 1], in order; motion(0) is at `from` and is left out.
  template <typename Add>
  void sample(const ToolPose& from, const Add& add) const {
    ToolPose before = from;
    for (int part = 1; part <= options_.least_parts; ++part) {
      const double u0 = static_cast<double>(part - 1) / options_.least_parts;
      const double u1 = static_cast<double>(part) / options_.least_parts;
      const Place after = motion_(u1);
      split(u0, before, u1, after, 0, add);
      before = after.pose;
    }
  }

 private:
  // 2^20 parts of one NC block: beyond that rounding, not curvature, is what is left.
  static constexpr int kDeepest = 20;

  template <typename Add>
  void split(double u0, const ToolPose& from, double u1, const Place& to, int depth,
             const Add& add) const {
    const double middle_u = 0.5 * (u0 + u1);
    const Place middle = motion_(middle_u);
    if (depth >= kDeepest || is_straight(u0, from, u1, to.pose, middle.pose)) {
      add(u1, to);
      return;
    }
    split(u0, from, middle_u, middle, depth + 1, add);
    split(middle_u, middle.pose, u1, to, depth + 1, add);
  }

  [[nodiscard]] bool is_straight(double u0, const ToolPose& from, double u1, const ToolPose& to,
                                 const ToolPose& middle) const {
    if (!is_on_the_way(from, to, 0.5, middle, options_)) return false;
    for (const double t : {0.25, 0.75}) {
      if (!is_on_the_way(from, to, t, motion_(u0 + t * (u1 - u0)).pose, options_)) return false;
    }
    return true;
  }

  const Motion& motion_;
  const SamplingOptions& options_;
};

struct PathSample {
  double u = 0.0;
  ToolPose pose{};  // motion(u)
};

// Samples of motion(u), u in (0, 1]; motion(0) is `from` and is left out.
[[nodiscard]] std::vector<PathSample> sample_motion(const std::function<ToolPose(double)>& motion,
                                                    const ToolPose& from,
                                                    const SamplingOptions& options);

}  // namespace frustum::kinematics
