// A program commanded and travelled at once, for tests that look at what comes of it.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kinematics/controller/controller.hpp"
#include "kinematics/path/travel.hpp"

namespace frustum::kinematics {

struct Execution {
  ToolPath path{};
  std::vector<AxisSample> axes{};  // the first entry is the start position
  double cycle_time = 0.0;         // s
  Diagnostics warnings{};
};

inline Result<Execution> execute(const Machine& machine, const GeometricErrors& errors,
                                 const Setup& setup, std::span<const parser::Motion> motions,
                                 const TravelOptions& options = {}) {
  auto commanded = command(machine, setup, motions);
  if (!commanded) return commanded.error();
  auto done = travel(machine, setup, *commanded, errors, options);
  return Execution{std::move(done.path), block_ends(*commanded), done.cycle_time,
                   std::move(commanded->warnings)};
}

}  // namespace frustum::kinematics
