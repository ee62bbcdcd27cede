// Error vectors over the working volume of a machine.
//
// Model    : at each point the tool tip nominally touches a point of the table's space. The actual
//            tool chain carries the tip, the actual work chain that point elsewhere:
//              tool      p_tip(actual) - p_tip(nominal)
//              workpiece p_point(actual) - p_point(nominal)
//              relative  tool - workpiece, as long as the displacement that the workpiece sees
// Units    : mm, rad; vectors in the frame of the bed
// Shape    : a grid over the travel of X, Y and Z (X fastest), the same for every rotary position
// Errors   : a grid without points; a held position outside the travel
// Accuracy : exact chain (tests/kinematics/volumetric_test.cpp)
// Source   : volumetric error thesis, equations (4-15) to (4-17)
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

// Axes held at a position; rotary axes not named are at home, linear ones cover their travel.
using HeldAxes = std::map<AxisLetter, double>;

struct VolumetricOptions {
  int grid = 5;  // points along each linear axis's travel
  double tool_length = 0.0;
  std::vector<HeldAxes> positions{HeldAxes{}};  // all name the same linear axes
};

struct VolumetricPoint {
  AxisPositions axes{};
  // Where the linear axes are: the nominal tip as the table sees it with all rotary axes at zero.
  Vec3 place = Vec3::Zero();
  Vec3 tool = Vec3::Zero();
  Vec3 workpiece = Vec3::Zero();
  Vec3 relative = Vec3::Zero();
};

// Of the lengths of one kind of vector over all points.
struct VolumetricStatistics {
  double max = 0.0;
  double mean = 0.0;
  double p95 = 0.0;  // the least length that 95 % of the points do not exceed
};

struct VolumetricErrors {
  std::array<int, 3> counts{};            // points along X, Y and Z
  std::vector<VolumetricPoint> points{};  // position after position
  std::size_t position_count = 1;
  VolumetricStatistics tool{};
  VolumetricStatistics workpiece{};
  VolumetricStatistics relative{};

  [[nodiscard]] std::span<const VolumetricPoint> at_position(std::size_t i) const {
    const std::size_t each = points.size() / position_count;
    return std::span(points).subspan(i * each, each);
  }
  // Where the relative error is largest.
  [[nodiscard]] const VolumetricPoint& worst() const;
};

[[nodiscard]] Result<VolumetricErrors> volumetric_errors(const Machine& machine,
                                                         const GeometricErrors& errors,
                                                         const VolumetricOptions& options);

// Root mean square over the points of each error's displacement of the tip by its unit, in the
// first row, for rank_by_gain() and rank_by_share() (error_ranking.hpp).
[[nodiscard]] GainMatrix mean_gains(const Machine& machine, std::span<const MachineError> errors,
                                    const VolumetricErrors& volume, double tool_length);

}  // namespace frustum::kinematics
