#include "kinematics/path/path_sampling.hpp"

#include <algorithm>
#include <utility>

namespace frustum::kinematics {
namespace {

// 2^20 parts of one NC block: beyond that rounding, not curvature, is what is left.
constexpr int kDeepestSampling = 20;
// The quarter points see at least 3/4 of the sagitta of a cubic; half the bound leaves room for more.
constexpr double kShareOfBound = 0.5;

double distance(const ToolPose& a, const ToolPose& b, double reach) {
  const Vec3 at_tip = a.tip - b.tip;
  return std::max(at_tip.norm(), (at_tip + reach * (a.axis - b.axis)).norm());
}

class Sampler {
 public:
  Sampler(const std::function<ToolPose(double)>& motion, const SamplingOptions& options)
      : motion_(motion), options_(options) {}

  void split(double u0, const ToolPose& from, double u1, const ToolPose& to, int depth) {
    const double middle_u = 0.5 * (u0 + u1);
    const ToolPose middle = motion_(middle_u);
    if (depth >= kDeepestSampling || straight(u0, from, u1, to, middle)) {
      samples_.push_back({u1, to});
      return;
    }
    split(u0, from, middle_u, middle, depth + 1);
    split(middle_u, middle, u1, to, depth + 1);
  }

  [[nodiscard]] std::vector<PathSample> samples() && { return std::move(samples_); }

 private:
  [[nodiscard]] bool straight(double u0, const ToolPose& from, double u1, const ToolPose& to,
                              const ToolPose& middle) const {
    const double limit = kShareOfBound * options_.bound;
    if (distance(middle, between(from, to, 0.5), options_.reach) > limit) return false;
    for (const double t : {0.25, 0.75}) {
      const ToolPose exact = motion_(u0 + t * (u1 - u0));
      if (distance(exact, between(from, to, t), options_.reach) > limit) return false;
    }
    return true;
  }

  const std::function<ToolPose(double)>& motion_;
  const SamplingOptions& options_;
  std::vector<PathSample> samples_;
};

}  // namespace

std::vector<PathSample> sample_motion(const std::function<ToolPose(double)>& motion,
                                      const ToolPose& from, const SamplingOptions& options) {
  Sampler sampler(motion, options);
  ToolPose before = from;
  for (int part = 1; part <= options.least_parts; ++part) {
    const double u0 = static_cast<double>(part - 1) / options.least_parts;
    const double u1 = static_cast<double>(part) / options.least_parts;
    const ToolPose after = motion(u1);
    sampler.split(u0, before, u1, after, 0);
    before = after;
  }
  return std::move(sampler).samples();
}

}  // namespace frustum::kinematics
