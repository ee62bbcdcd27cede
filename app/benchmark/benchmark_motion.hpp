// What motion tests of a machine of the benchmark read: how far the tip is from where it should be.
//
// Model : deviation of the tip of a tool of 150 mm in the table frame, um; readings have normal
//         noise of 0.2 um. R-test: the tip stays at a ball on the table while the rotary axes turn.
//         Ball bar: circles of 100 mm in three planes, both ways
// Units : mm and deg for axes, um for deviations
// Errors: none; poses out of travel are left out
#pragma once

#include <string>

#include "app/benchmark/benchmark_laws.hpp"
#include "core/pose.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::app {

// mm, in the table frame.
[[nodiscard]] Vec3 tip_deviation(const kinematics::Machine& machine,
                                 const kinematics::GeometricErrors& errors,
                                 const kinematics::AxisState& at);
// ",X,Y,.." and the positions under it.
[[nodiscard]] std::string axes_header(const kinematics::Machine& machine);
[[nodiscard]] std::string axes_text(const kinematics::Machine& machine,
                                    const kinematics::AxisPositions& q);

[[nodiscard]] std::string rtest_csv(const kinematics::Machine& machine,
                                    const kinematics::GeometricErrors& errors,
                                    const KeyedNumbers& numbers);
[[nodiscard]] std::string ballbar_csv(const kinematics::Machine& machine,
                                      const kinematics::GeometricErrors& errors,
                                      const KeyedNumbers& numbers);

}  // namespace frustum::app
