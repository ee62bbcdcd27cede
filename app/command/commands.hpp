// The commands of the program, each of which adds itself to the command line, and the options that
// several share.
//
// Units  : as each option says
// Errors : those of the command line (command_line.hpp); each command reports its own on stderr
#pragma once

#include <string>
#include <vector>

namespace frustum::app {

class Command;
struct ErrorWords;
struct SetupWords;

void add_run(Command& program);
void add_sensitivity(Command& program);
void add_identify(Command& program);
void add_design(Command& program);
void add_program(Command& program);
void add_parse(Command& program);
void add_check(Command& program);
void add_post(Command& program);
void add_pose(Command& program);
void add_cut(Command& program);
void add_cmm(Command& program);
void add_measure(Command& program);
void add_diff(Command& program);
void add_compensate(Command& program);
void add_fit(Command& program);
void add_machines(Command& program);
void add_errors(Command& program);
void add_volumetric(Command& program);

// Kinds of test pieces: commands of `program`.
void add_cone(Command& kinds);
void add_step(Command& kinds);

// The options by which a command takes errors: --error, --errors, --draw.
void add_error_options(Command& command, ErrorWords& words);
// The options by which a command takes a machine and its set-up: --machine, --job, --tool-length,
// --offset.
void add_setup_options(Command& command, SetupWords& words);
// --export FILE, which may be repeated.
void add_export_option(Command& command, std::vector<std::string>& files);

}  // namespace frustum::app
