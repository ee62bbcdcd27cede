// How a unit of each column of a population moves the tool, to first order.
//
// Model    : kinematics/errors/error_gain.hpp, all columns in one walk
// Units    : mm, rad; frame: workpiece
// Errors   : none
// Accuracy : first order
// Source   : error_gain.hpp
#pragma once

#include <span>
#include <vector>

#include "kinematics/errors/error_gain.hpp"
#include "trials/population/population_laws.hpp"

namespace frustum::trials {

// At a share of the way from one state to the next, headings too.
[[nodiscard]] kinematics::AxisState state_between(const kinematics::AxisState& from,
                                                  const kinematics::AxisState& to, double share);

class ColumnMotion {
 public:
  ColumnMotion(const kinematics::Machine& machine, const PopulationLaws& laws,
               const Pose& table_from_workpiece);

  // One for each column.
  [[nodiscard]] std::vector<kinematics::PoseDisplacement> at(const kinematics::AxisState& state,
                                                             double tool_length) const;
  // By how much a column's weight may be off its middle.
  [[nodiscard]] std::span<const double> limits() const { return limits_; }

 private:
  struct Share {
    std::size_t column = 0, error = 0;
    double constant = 0.0;  // of errors that do not depend on the position
    const kinematics::ErrorFunction* function = nullptr;
    kinematics::AxisLetter axis = kinematics::AxisLetter::X;
  };
  const kinematics::Machine* machine_;
  Mat3 workpiece_from_table_;
  std::vector<kinematics::MachineError> errors_{};
  std::vector<Share> shares_{};
  std::vector<double> limits_{};
};

}  // namespace frustum::trials
