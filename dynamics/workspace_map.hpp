// One quantity over two axes, all others held: where in the working space a machine is worst.
//
// Model    : a grid of positions; in each the structure is assembled anew. Quantities:
//              |H i/j|  displacement i of the tip for unit acceleration of axis j, at rest
//              f n      the nth undamped natural frequency
//              |G ij|   static compliance
// Units    : um/gn (linear axis), um/(rad/s^2) (rotary axis), Hz, um/N; axes mm, rad
// Shape    : a row for each position of the first axis, a column for each of the second
// Errors   : a position in which nothing holds a body
// Accuracy : that of modes.hpp and response.hpp
// Source   : ETH thesis, section 6.3; quartiles between the values of neighbouring ranks
#pragma once

#include <Eigen/Core>
#include <array>
#include <variant>
#include <vector>

#include "core/result.hpp"
#include "dynamics/structure.hpp"

namespace frustum::dynamics {

struct InertialQuantity {
  Eigen::Index direction = 0;
  kinematics::AxisLetter axis = kinematics::AxisLetter::X;
};
struct FrequencyQuantity {
  Eigen::Index mode = 0;
};
struct ComplianceQuantity {
  Eigen::Index motion = 0, force = 0;
};
using MapQuantity = std::variant<InertialQuantity, FrequencyQuantity, ComplianceQuantity>;

// Evenly spaced, both ends included.
struct MapAxis {
  kinematics::AxisLetter letter = kinematics::AxisLetter::X;
  double from = 0.0, to = 0.0;
  int count = 1;
  [[nodiscard]] double at(int i) const;
};

// Least, quartiles, median and largest.
struct BoxOfValues {
  double min = 0.0, q1 = 0.0, median = 0.0, q3 = 0.0, max = 0.0;
};
[[nodiscard]] BoxOfValues box_of(std::vector<double> values);

struct WorkspaceMap {
  Eigen::MatrixXd values{};
  BoxOfValues box{};
  std::vector<std::array<double, 2>> frequency_ranges{};  // Hz: of the first three modes
};
enum class Frequencies { ranges, none };
[[nodiscard]] Result<WorkspaceMap> map_workspace(const DynamicModel& model,
                                                 const kinematics::AxisPositions& held,
                                                 double tool_length, const MapAxis& rows,
                                                 const MapAxis& columns,
                                                 const MapQuantity& quantity,
                                                 Frequencies frequencies = Frequencies::ranges);

// um/gn of a linear axis, um/(rad/s^2) of a rotary one, from m per unit acceleration.
[[nodiscard]] double inertial_scale(const kinematics::Joint& joint);

}  // namespace frustum::dynamics
