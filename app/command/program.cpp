// frustum program: writes test pieces.
#include <iostream>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/view/console.hpp"

namespace frustum::app {

int write_piece(const std::string& machine, const WritesPiece& write) {
  const auto file = find_machine(machine, ".");
  if (!file) return refuse(file.error());
  const auto loaded = kinematics::Machine::load(*file);
  if (!loaded) return refuse(loaded.error());
  const auto written = write(*loaded, *file);
  if (!written) return refuse(written.error());
  for (const auto& each : *written) std::cout << each.string() << '\n';
  return kDone;
}

void add_piece_options(Command& kind, PieceOptions& options, const std::string& files) {
  kind.option("--machine", options.machine, "Machine file, or the name of a shipped machine")
      .required();
  kind.option("--out", options.out, "Folder for " + files).required();
  kind.option("--dialect", options.dialect,
              "Of the NC program: fanuc (default), linuxcnc, sinumerik, heidenhain")
      .one_of({"fanuc", "linuxcnc", "sinumerik", "heidenhain"});
}

void add_program(Command& program) {
  Command kinds = program.command("program", "Write a test piece: NC program, plan, job");
  kinds.needs_a_command();
  add_cone(kinds);
  add_step(kinds);
}

}  // namespace frustum::app
