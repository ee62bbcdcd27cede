// The commands that list what there is over several files, each of which adds itself to the command
// line.
//
// Units  : as each option says
// Errors : those of the command line (command_line.hpp); each command reports its own on stderr
#pragma once

namespace frustum::app {

class Command;

void add_history(Command& program);
void add_tools(Command& program);

}  // namespace frustum::app
