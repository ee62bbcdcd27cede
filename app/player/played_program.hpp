// What `frustum view` plays: a job, or an NC program on a machine.
//
// Model    : a program alone is cut from no blank; its tools are end mills of the diameters and
//            lengths that are given, and of assumed ones where nothing is. With --job it takes
//            everything else from that job
// Units    : mm; options as they say
// Errors   : those of the job, the machine, the options and the program; options that contradict a
//            job that is played
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "app/job/machine_setup.hpp"
#include "core/result.hpp"

namespace frustum::app {

struct PlayerWords {
  std::string file{};     // a job (.toml) or an NC program
  std::string dialect{};  // empty: the job's, or recognised
  SetupWords setup{};
  JobOverrides overrides{};
};

struct PlayedProgram {
  Job job;
  bool has_blank = true;
  std::vector<std::string> notes{};  // what was assumed
};
[[nodiscard]] Result<PlayedProgram> played_program(const PlayerWords& words);

}  // namespace frustum::app
