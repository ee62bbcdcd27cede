// NC programs and CLDATA as files.
//
// Units    : those of parser/motion.hpp
// Errors   : what cannot be read or understood, with file, line and column
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/job/machine_setup.hpp"
#include "core/result.hpp"
#include "parser/interpreter.hpp"

namespace frustum::app {

struct NcFile {
  parser::Program program{};
  std::string reason{};  // why it is taken for its dialect; empty when that was given
};
// `dialect` as --dialect writes it; empty: recognised.
[[nodiscard]] Result<NcFile> open_nc(const std::string& file, const std::string& dialect);
// Its lines, each with its end.
[[nodiscard]] std::string text_of_program(const parser::ProgramText& text);
// Subprograms are looked for beside the program.
[[nodiscard]] parser::InterpreterOptions options_for(const std::string& file);

// `dialect` as --dialect writes it; empty: recognised. Read as that machine's control does; radius
// compensation counts with its tools.
[[nodiscard]] Result<std::vector<parser::Motion>> motions_of_file(const std::string& file,
                                                                  const std::string& dialect,
                                                                  const MachineSetup& machine);

// A name that controllers take, from a file's: letters, digits and _.
[[nodiscard]] std::string program_name(const std::filesystem::path& file);

// Diagnostics with a line but no file get this one.
[[nodiscard]] Diagnostics in_file(Diagnostics diagnostics, const std::string& file);

}  // namespace frustum::app
