// Where the tool is wanted along one block: where a machine without errors would have it.
//
// Model    : the commanded motion of the block through the nominal chain; places are u in [0, 1].
//            Less what moves the tool besides the errors (path_shift.hpp), where that is given.
//            It is sampled so finely that neither this tool nor one with the machine's errors
//            leaves straight lines and great circles between them by more than the bound
// Units    : mm, rad; frame: table
// Errors   : none
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::calibration {

class WantedBlock {
 public:
  // From where a machine without errors has the tool to where the errors have to take it.
  using Shift = std::function<kinematics::ToolPose(const kinematics::ToolPose&, double u)>;

  // Machine and motion must outlive it. The samples keep `bound` up to `reach` above the tip.
  WantedBlock(const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
              const kinematics::BlockMotion& motion, double tool_length, double reach, double bound,
              Shift shift = {});

  [[nodiscard]] kinematics::AxisPositions axes(double u) const { return motion_.at(u); }
  [[nodiscard]] kinematics::ToolPose pose(double u) const;
  [[nodiscard]] double tool_length() const { return tool_length_; }
  // Strictly between two places.
  [[nodiscard]] std::span<const double> samples_between(double from, double to) const;
  // mm: how far the tool goes, in tip and direction together.
  [[nodiscard]] double way() const { return way_; }

 private:
  const kinematics::Machine& machine_;
  const kinematics::BlockMotion& motion_;
  double tool_length_;
  Shift shift_;
  std::vector<double> samples_{};
  double way_ = 0.0;
};

}  // namespace frustum::calibration
