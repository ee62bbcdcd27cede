#include "trials/piece_reading.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/sha256.hpp"
#include "core/whole_file.hpp"

namespace frustum::trials {

parser::InterpreterOptions reading_of(const kinematics::Machine& machine,
                                      const programs::TestPiece& piece) {
  parser::InterpreterOptions options;
  options.tools = called_tools_of(piece);
  options.control = piece.reading.control.value_or(machine.controller().settings());
  options.block_delete = piece.reading.block_delete;
  // Subprograms are beside the program.
  options.search_path = {std::filesystem::path(piece.program_file).parent_path()};
  options.search_path.insert(options.search_path.end(), piece.reading.search_path.begin(),
                             piece.reading.search_path.end());
  return options;
}

parser::InterpreterOptions reading_of(const kinematics::Machine& machine,
                                      const programs::TestPiece& piece,
                                      std::vector<std::string>& opened) {
  parser::InterpreterOptions options = reading_of(machine, piece);
  options.watch = [&opened](const parser::BlockAhead& ahead) {
    const bool is_new =
        ahead.file != nullptr && std::ranges::find(opened, *ahead.file) == opened.end();
    if (is_new) opened.push_back(*ahead.file);
    return true;
  };
  return options;
}

Result<std::vector<ProgramFile>> hashed(const std::vector<std::string>& files) {
  std::vector<ProgramFile> known;
  for (const std::string& file : files) {
    const auto bytes = read_whole_file(file);
    if (!bytes) return bytes.error();
    known.push_back({file, sha256(*bytes)});
  }
  return known;
}

Diagnostics in_file(Diagnostics diagnostics, const std::string& file) {
  for (Diagnostic& d : diagnostics) {
    if (d.file.empty() && d.line > 0) d.file = file;
  }
  return diagnostics;
}

}  // namespace frustum::trials
