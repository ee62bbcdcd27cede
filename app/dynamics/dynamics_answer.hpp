// All that frustum dynamics answers in one position, and over the working space.
//
// Units  : as the headers of the module dynamics: SI
// Errors : a position in which nothing holds a body, a control that is unstable
#pragma once

#include <optional>
#include <vector>

#include "app/dynamics/dynamics_request.hpp"
#include "dynamics/harmonic_circle.hpp"
#include "dynamics/jerk_move.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/response.hpp"
#include "dynamics/servo.hpp"
#include "dynamics/workspace_map.hpp"

namespace frustum::app {

struct FrequencyAnswer {
  double frequency = 0.0;
  Eigen::Matrix3cd compliance{};  // of the closed loop, where axes are controlled
  Eigen::Matrix3Xcd inertial{};   // with the springs of the drives
  Eigen::Matrix3Xcd tracking{};   // only where axes are controlled
};

struct RatesAnswer {
  Vec3 tip_in_machine = Vec3::Zero(), tip_in_table = Vec3::Zero(), turn_in_table = Vec3::Zero();
};

struct ControlAnswer {
  Eigen::Index states = 0;
  dynamics::Poles poles{};
};

struct DynamicsAnswer {
  Vec3 tip_in_machine = Vec3::Zero();
  Eigen::Index coordinates = 0;
  std::vector<dynamics::BodyPlace> bodies{};
  dynamics::UndampedModes modes{};
  std::vector<dynamics::ModePlace> places{};
  dynamics::Poles damped{};
  dynamics::StaticResponse rest{};
  std::vector<dynamics::Peak> peaks{};
  std::optional<ControlAnswer> control{};
  std::vector<FrequencyAnswer> frequencies{};
  std::optional<RatesAnswer> rates{};
  std::optional<dynamics::WorkspaceMap> map{};
  std::optional<dynamics::HarmonicCircle> circle{};
  std::optional<dynamics::JerkMove> move{};
};

[[nodiscard]] Result<DynamicsAnswer> answer_dynamics(const dynamics::DynamicModel& model,
                                                     const DynamicsRequest& request);

// Inertial compliances of two machines, in um/gn, for each direction of the tip and each linear
// axis that both have; change in percent where the first is not 0.
struct ComparedRow {
  std::string name{};  // "Hx/X"
  double first = 0.0, second = 0.0;
  std::optional<double> change{};
};
[[nodiscard]] std::vector<ComparedRow> compare_inertial(const dynamics::DynamicModel& first,
                                                        const DynamicsAnswer& of_first,
                                                        const dynamics::DynamicModel& second,
                                                        const DynamicsAnswer& of_second);

}  // namespace frustum::app
