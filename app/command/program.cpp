// frustum program: writes test pieces.

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/view/console.hpp"

namespace frustum::app {

void add_program(Command& program) {
  Command kinds = program.command("program", "Write a test piece: NC program, plan, job");
  kinds.needs_a_command();
  add_cone(kinds);
  add_step(kinds);
}

}  // namespace frustum::app
