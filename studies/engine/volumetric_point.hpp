// The volumetric error at one position of the axes, over a population of machines.
//
// Model    : E = e + G w, the displacement of the tool to the workpiece in the frame of the table;
//            the characteristic is |E|. Where every law is normal E is normal, and its length has
//            exact quantiles (normal_length.hpp)
// Units    : mm, rad; lengths um
// Shape    : 3 x columns of the set
// Errors   : none
// Accuracy : first order: 0.005 um of 114 for all tool errors at their tolerances
//            (tests/studies/volumetric_point_test.cpp)
// Source   : volumetric error thesis, equations (4-15) to (4-17)
#pragma once

#include <optional>
#include <span>

#include "core/pose.hpp"
#include "kinematics/model/machine.hpp"
#include "studies/laws/factors.hpp"
#include "studies/statistics/normal_length.hpp"

namespace frustum::studies {

struct VolumetricPoint {
  Vec3 fixed = Vec3::Zero();  // um, of the errors that are not drawn
  Eigen::MatrixXd gains{};    // um per mm or rad, three rows

  [[nodiscard]] double length(std::span<const double> weights) const;
};

[[nodiscard]] VolumetricPoint volumetric_point(const kinematics::Machine& machine,
                                               const FactorSet& set,
                                               const kinematics::AxisPositions& at,
                                               double tool_length);

// |E| where it is exact: every drawn amount is one normal number that nothing cuts.
[[nodiscard]] std::optional<NormalLength> exact_length(const VolumetricPoint& point,
                                                       const FactorSet& set);

}  // namespace frustum::studies
