#include "kinematics/path/path_sampling.hpp"

#include <algorithm>

namespace frustum::kinematics {
namespace {

// The quarter points see at least 3/4 of the sagitta of a cubic; half the bound leaves room for
// more.
constexpr double kShareOfBound = 0.5;

double pose_distance(const ToolPose& a, const ToolPose& b, double reach) {
  const Vec3 at_tip = a.tip - b.tip;
  return std::max(at_tip.norm(), (at_tip + reach * (a.axis - b.axis)).norm());
}

}  // namespace

bool is_on_the_way(const ToolPose& from, const ToolPose& to, double t, const ToolPose& exact,
                   const SamplingOptions& options) {
  return pose_distance(exact, between(from, to, t), options.reach) <= kShareOfBound * options.bound;
}

std::vector<PathSample> sample_motion(const std::function<ToolPose(double)>& motion,
                                      const ToolPose& from, const SamplingOptions& options) {
  const auto sampled = [&](double u) { return PathSample{u, motion(u)}; };
  std::vector<PathSample> samples;
  PathSampler(sampled, options).sample(from, [&](double /*u*/, const PathSample& sample) {
    samples.push_back(sample);
  });
  return samples;
}

}  // namespace frustum::kinematics
