// What frustum dynamics is asked for, from the words of its options.
//
// Units  : words in mm, deg, Hz; rates and limits of a move in m, rad, s; positions mm, rad in the
//          request, all else SI
// Errors : each word that is wrong, with what is expected: axes that the machine lacks, ranges that
//          are none, quantities that are unknown, values outside of what is meant
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "dynamics/dynamic_model.hpp"
#include "dynamics/jerk_move.hpp"
#include "dynamics/workspace_map.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

// In a metre.
constexpr double kMillimetres = 1e3;
constexpr double kMicrometres = 1e6;

struct DynamicsWords {
  std::string axes{};
  double tool_length = 0.0;
  std::string frequencies{};  // "20,57", "1:200", "1:200:0.5"
  std::string rates{};        // "X=0.1:1,B=-1.5:3"
  std::string map{};          // "Y=-300:300:20,Z=-100:500:20"
  std::string quantity{};     // empty: "Hx/x"
  std::string circle{};       // "XY"
  std::optional<double> radius{}, feed{};
  std::string move{};  // "X:100:0.5:4:100"
};

struct RatesRequest {
  kinematics::AxisPositions velocity{}, acceleration{};  // mm, rad, s
};
struct WorkspaceMapRequest {
  dynamics::MapAxis rows{}, columns{};
  dynamics::MapQuantity quantity{};
  std::string title{};  // "|Hx/X..| um/gn"
};
struct CircleRequest {
  std::size_t first = 0, second = 0;  // axes of the model
  double radius = 0.0, speed = 0.0;
};
struct MoveRequest {
  std::size_t axis = 0;  // of the model
  dynamics::MoveLimits limits{};
};

struct DynamicsRequest {
  kinematics::AxisPositions axes{};
  double tool_length = 0.0;  // mm
  std::vector<double> frequencies{};
  std::optional<RatesRequest> rates{};
  std::optional<WorkspaceMapRequest> map{};
  std::optional<CircleRequest> circle{};
  std::optional<MoveRequest> move{};
};

[[nodiscard]] Result<DynamicsRequest> read_dynamics_request(const kinematics::Machine& machine,
                                                            const dynamics::DynamicModel& model,
                                                            const DynamicsWords& words);

}  // namespace frustum::app
