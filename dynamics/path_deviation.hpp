// The dynamic deviation put into a tool path, after the geometric errors.
//
// Model    : tip += R^T d, axis += (R^T r) x axis, R of the table, d and r of path_response.hpp.
//            The commanded motion is taken at the multiples of the time step, at which a path that
//            was recorded with it has poses (TravelOptions::time_step); poses in between have what
//            is between their neighbours. Before and after each tool's path the axes rest; when it
//            ends the tool stays until less than 0.01 um is left of a vibration, for 2 s at most
// Units    : path mm, s; frame: workpiece
// Shape    : one chain of poses for each tool; between two tools the machine comes to rest
// Errors   : none
// Accuracy : tests/dynamics/path_deviation_test.cpp
// Source   : path_response.hpp
#pragma once

#include "dynamics/dynamic_model.hpp"
#include "dynamics/path_response.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::dynamics {

enum class PathMethod : std::uint8_t { off, quasi_static, linear };

struct PathDynamics {
  PathMethod method = PathMethod::off;
  double time_step = 5e-4;  // s
  RenewalDistance renewal{};
};

// Of each pose of a path; mm and rad in the frame of the workpiece.
struct PoseDeviation {
  Vec3 tip = Vec3::Zero();
  Vec3 turn = Vec3::Zero();
};
[[nodiscard]] std::vector<PoseDeviation> pose_deviations(const DynamicModel& model,
                                                         const kinematics::Setup& setup,
                                                         const kinematics::ToolPath& path,
                                                         const PathDynamics& options);

[[nodiscard]] kinematics::ToolPath with_dynamics(const DynamicModel& model,
                                                 const kinematics::Setup& setup,
                                                 kinematics::ToolPath path,
                                                 const PathDynamics& options);

}  // namespace frustum::dynamics
