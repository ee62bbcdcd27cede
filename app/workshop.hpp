// A machine with its work offsets and tools: from a job, and from the words of the command line.
//
// Units    : mm, rad inside; options in mm
// Errors   : what is wrong with the job, a machine, a length or an offset, naming the option
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/controller.hpp"
#include "kinematics/machine.hpp"

namespace frustum::app {

struct WorkshopWords {
  std::string machine{};                    // file or name; empty: the job's
  std::string job{};                        // empty: none
  std::vector<std::string> tool_lengths{};  // "1=150"
  std::vector<std::string> offsets{};       // "G54=-65,0,150"
};

struct Workshop {
  kinematics::Machine machine;
  kinematics::Setup setup{};
};

[[nodiscard]] Result<Workshop> workshop_of(const WorkshopWords& words);

}  // namespace frustum::app
