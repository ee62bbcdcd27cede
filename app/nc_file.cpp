#include "app/nc_file.hpp"

#include <cctype>
#include <fstream>
#include <sstream>

#include "parser/dialect.hpp"
#include "parser/interpreter.hpp"
#include "parser/program.hpp"

namespace frustum::app {

Result<std::vector<parser::Motion>> motions_of_file(const std::string& file,
                                                    const std::string& dialect_name) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in && std::filesystem::is_regular_file(file)) text << in.rdbuf();
  if (!in || text.view().empty()) {
    Diagnostic failure = error("the file cannot be read", "check the path and permissions");
    failure.file = file;
    return failure;
  }
  const auto dialect = parser::dialect_named(dialect_name)
                           .value_or(parser::recognise_dialect(text.view(), file).dialect);
  const auto program = parser::parse_program(text.view(), file, dialect);
  if (!program) return program.error();
  return parser::motions_of(*program);
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
