#include "programs/piece_program.hpp"

#include <cctype>
#include <filesystem>
#include <utility>

#include "parser/writing/motion_spelling.hpp"

namespace frustum::programs {

using parser::AxisLetter;

PieceProgram::PieceProgram(std::string number, std::string title) : number_(std::move(number)) {
  comment(std::move(title));
}

void PieceProgram::block(std::vector<parser::Command> commands) {
  ++blocks_;
  for (parser::Command& command : commands) {
    motions_.push_back({.place = {.line = blocks_, .column = 1}, .command = std::move(command)});
  }
}

void PieceProgram::comment(std::string text) {
  block({parser::Event{.name = "comment", .text = std::move(text)}});
}

void PieceProgram::without_compensation() {
  motions_.push_back({.command = parser::CompensationChange{}});
}

Result<parser::NcProgram> PieceProgram::write(TestPiece& piece, parser::Dialect dialect) const {
  std::filesystem::path file = piece.program_file;
  parser::WriterOptions options{.name = file.stem().string(), .number = number_, .feed_digits = 6};
  for (char& c : options.name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (dialect == parser::Dialect::fanuc) {
    options.layout = parser::NcLayout::as_given;
    options.restate_feed = restate_feed_;
    options.vector_decimals = 9;
  }
  auto written = parser::write_nc(motions_, dialect, options);
  if (!written) {
    Diagnostics problems = written.error();
    for (Diagnostic& problem : problems) problem.line = problem.column = 0;  // of no text
    return problems;
  }
  for (Operation& operation : piece.operations) {
    const parser::LineRange lines =
        parser::lines_from(*written, {operation.first_line, operation.last_line});
    operation.first_line = lines.first;
    operation.last_line = lines.last;
  }
  piece.dialect = dialect;
  piece.program = written->text;
  piece.program_file = file.replace_extension(parser::spelling_of(dialect)->extension).string();
  return written;
}

parser::AxisTarget tip_target(const Vec3& tip) {
  parser::AxisTarget target;
  target[AxisLetter::X] = tip.x();
  target[AxisLetter::Y] = tip.y();
  target[AxisLetter::Z] = tip.z();
  return target;
}

parser::Command machine_traverse(const parser::AxisTarget& end) {
  return parser::Traverse{.end = end, .coordinates = parser::Coordinates::machine};
}

}  // namespace frustum::programs
