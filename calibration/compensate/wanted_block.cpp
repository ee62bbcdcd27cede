#include "calibration/compensate/wanted_block.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/compensate/pose_distance.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/path/path_sampling.hpp"

namespace frustum::calibration {

WantedBlock::WantedBlock(const kinematics::Machine& machine,
                         const kinematics::GeometricErrors& errors,
                         const kinematics::BlockMotion& motion, double tool_length, double reach,
                         double bound, Shift shift)
    : machine_(machine), motion_(motion), tool_length_(tool_length), shift_(std::move(shift)) {
  const auto actual = [&](double u) {
    return kinematics::tool_pose(
        kinematics::actual_pose(machine, errors, motion.at(u), tool_length));
  };
  const auto samples = kinematics::sample_motion(
      actual, actual(0.0), {.bound = bound, .reach = reach, .least_parts = motion.least_parts()});
  samples_.reserve(samples.size());
  kinematics::ToolPose before = pose(0.0);
  for (const kinematics::PathSample& sample : samples) {
    samples_.push_back(sample.u);
    const kinematics::ToolPose now = pose(sample.u);
    way_ += distance(before, now);
    before = now;
  }
}

kinematics::ToolPose WantedBlock::pose(double u) const {
  const auto nominal =
      kinematics::tool_pose(kinematics::nominal_pose(machine_, motion_.at(u), tool_length_));
  return shift_ ? shift_(nominal, u) : nominal;
}

std::span<const double> WantedBlock::samples_between(double from, double to) const {
  const auto first = std::ranges::upper_bound(samples_, from);
  const auto last = std::lower_bound(first, samples_.end(), to);
  return {first, last};
}

}  // namespace frustum::calibration
