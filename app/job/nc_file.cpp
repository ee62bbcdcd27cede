#include "app/job/nc_file.hpp"

#include <cctype>
#include <utility>

#include "parser/dialect.hpp"
#include "parser/interpreter.hpp"
#include "parser/program.hpp"

namespace frustum::app {
namespace {

constexpr const char* kStandardInput = "<stdin>";  // as diagnostics name it

}  // namespace

Result<std::vector<parser::Motion>> motions_of_file(const std::string& file,
                                                    const std::string& dialect_name,
                                                    const MachineSetup& machine) {
  const auto nc = open_nc(file, dialect_name);
  if (!nc) return nc.error();
  parser::InterpreterOptions options = options_for(file);
  options.tools = machine.tools;
  options.control = machine.control;
  return parser::motions_of(nc->program, options);
}

Result<NcFile> open_nc(const std::string& file, const std::string& dialect_name) {
  constexpr std::size_t kLook = std::size_t{1} << 20U;
  auto text = parser::ProgramText::open(file);
  if (!text) return text.error();
  NcFile nc;
  if (const auto named = parser::dialect_named(dialect_name)) {
    nc.program.dialect = *named;
  } else {
    const auto found = parser::recognise_dialect(text->head(kLook), file);
    nc.program.dialect = found.dialect;
    nc.reason = found.reason;
  }
  nc.program.file = file == "-" ? kStandardInput : file;
  nc.program.text = *std::move(text);
  return nc;
}

std::string text_of_program(const parser::ProgramText& text) {
  std::string all;
  parser::LineReader lines(text);
  while (!lines.at_end()) {
    all += lines.next();
    all += '\n';
  }
  return all;
}

parser::InterpreterOptions options_for(const std::string& file) {
  parser::InterpreterOptions options;
  options.search_path = {std::filesystem::path(file).parent_path()};
  return options;
}

std::string program_name(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    c = std::isalnum(byte) != 0 ? static_cast<char>(std::toupper(byte)) : '_';
  }
  return name.empty() ? "FRUSTUM" : name;
}

Diagnostics in_file(Diagnostics diagnostics, const std::string& file) {
  for (Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.file.empty() && diagnostic.line > 0) diagnostic.file = file;
  }
  return diagnostics;
}

}  // namespace frustum::app
