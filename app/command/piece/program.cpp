// frustum program: writes test pieces.
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "programs/milling/posed_program.hpp"
#include "programs/retraction.hpp"

namespace frustum::app {

int write_piece(const PieceOptions& options, const WritesPiece& write) {
  const auto file = find_machine(options.machine, ".");
  if (!file) return refuse(file.error(), options);
  const auto loaded = kinematics::Machine::load(*file);
  if (!loaded) return refuse(loaded.error(), options);
  const auto written = write(*loaded, *file);
  if (!written) return refuse(written.error(), options);
  if (auto doubt = programs::doubt_of_retraction(*loaded)) {
    doubt->file = file->string();
    print(std::cerr, {*doubt});
  }
  if (options.json) {
    nlohmann::ordered_json doc{{"schema", "frustum/program/1"},
                               {"version", program_version()},
                               {"files", nlohmann::json::array()}};
    for (const auto& each : *written) doc["files"].push_back(each.string());
    std::cout << doc.dump(2) << '\n';
  } else if (!options.quiet) {
    for (const auto& each : *written) std::cout << each.string() << '\n';
  }
  return kDone;
}

void add_piece_options(Command& kind, PieceOptions& options, const std::string& files) {
  kind.option("machine,--machine", options.machine,
              "Machine file, or the name of a shipped machine")
      .required();
  kind.option("--out", options.out, "Folder for " + files).required();
  kind.option("--dialect", options.dialect,
              "Of the NC program: fanuc (default), linuxcnc, sinumerik, heidenhain")
      .one_of({"fanuc", "linuxcnc", "sinumerik", "heidenhain"});
  add_answer_options(kind, options);
}

void add_form_option(Command& kind, std::string& form) {
  kind.option("--form", form,
              "vector (G43.5; default), angles (G43.4; default for linuxcnc) or axes (axis "
              "positions)")
      .one_of({"vector", "angles", "axes"});
}

programs::ProgramForm form_of(const std::string& form, const std::string& dialect) {
  if (form == "axes") return programs::ProgramForm::axes;
  const bool no_vectors = form.empty() && dialect == "linuxcnc";
  return form == "angles" || no_vectors ? programs::ProgramForm::angles
                                        : programs::ProgramForm::vector;
}

void add_program(Command& program) {
  Command kinds = program.command("program", "Write a test piece: NC program, plan, job");
  kinds.needs_a_command();
  add_cone(kinds);
  add_step(kinds);
  add_contour(kinds);
  add_s_piece(kinds);
  add_surface(kinds);
}

}  // namespace frustum::app
