// frustum program: writes test pieces.
#include <CLI/CLI.hpp>

#include "app/view/console.hpp"

namespace frustum::app {

void add_program(CLI::App& program, int& exit_code) {
  CLI::App* kinds = program.add_subcommand("program", "Write a test piece: NC program, plan, job");
  kinds->require_subcommand(1);
  add_cone(*kinds, exit_code);
  add_step(*kinds, exit_code);
}

}  // namespace frustum::app
