#include "programs/in_dialect.hpp"

#include <cctype>
#include <filesystem>

#include "parser/interpreter.hpp"
#include "post/nc_spelling.hpp"

namespace frustum::programs {

Result<TranslatedPiece> in_dialect(TestPiece piece, parser::Dialect dialect) {
  if (dialect == piece.dialect) return TranslatedPiece{std::move(piece), {}};
  const auto program = parser::parse_program(piece.program, piece.program_file, piece.dialect);
  if (!program) return program.error();
  const auto motions = parser::motions_of(*program);
  if (!motions) return motions.error();

  std::filesystem::path file = piece.program_file;
  std::string name = file.stem().string();
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  auto written = post::write_nc(*motions, dialect, {.name = name});
  if (!written) return written.error();
  for (Operation& operation : piece.operations) {
    const post::LineRange lines =
        post::lines_from(*written, {operation.first_line, operation.last_line});
    operation.first_line = lines.first;
    operation.last_line = lines.last;
  }
  piece.dialect = dialect;
  piece.program = written->text;
  piece.program_file = file.replace_extension(post::spelling_of(dialect)->extension).string();
  return TranslatedPiece{std::move(piece), *std::move(written)};
}

}  // namespace frustum::programs
