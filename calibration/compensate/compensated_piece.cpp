#include "calibration/compensate/compensated_piece.hpp"

#include <cctype>
#include <filesystem>
#include <utility>

#include "calibration/compensate/compensation_proof.hpp"
#include "parser/writing/motion_spelling.hpp"
#include "parser/writing/motion_writer.hpp"

namespace frustum::calibration {
namespace {

Diagnostics in_file(Diagnostics problems, const std::string& file) {
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = file;
  }
  return problems;
}

}  // namespace

Result<CompensatedPiece> compensated_piece(const kinematics::Machine& machine,
                                           const kinematics::GeometricErrors& errors,
                                           const programs::TestPiece& piece,
                                           const CompensationOptions& options,
                                           std::optional<parser::Dialect> dialect) {
  const auto commanded = trials::command_piece(machine, piece);
  if (!commanded) return commanded.error();
  return compensated_piece(machine, errors, piece, *commanded, options, dialect);
}

Result<CompensatedPiece> compensated_piece(const kinematics::Machine& machine,
                                           const kinematics::GeometricErrors& errors,
                                           const programs::TestPiece& piece,
                                           const trials::CommandedPiece& commanded,
                                           const CompensationOptions& options,
                                           std::optional<parser::Dialect> dialect) {
  const kinematics::Setup setup = trials::setup_of(piece);
  auto result = corrected(machine, errors, setup, commanded.motions, commanded.program, options);
  if (!result) return in_file(std::move(result).error(), piece.program_file);

  CompensatedPiece made{.piece = piece, .before = result->before};
  if (piece.dialect == parser::Dialect::cldata) made.piece.dialect = parser::Dialect::fanuc;
  parser::WriterOptions layout;
  if (dialect && *dialect != made.piece.dialect) {
    std::filesystem::path file = piece.program_file;
    layout.name = file.stem().string();
    for (char& c : layout.name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    made.piece.dialect = *dialect;
    if (const auto* spelling = parser::spelling_of(*dialect); spelling != nullptr) {
      made.piece.program_file = file.replace_extension(spelling->extension).string();
    }
  }
  const auto text = parser::write_nc(result->motions, made.piece.dialect, layout);
  if (!text) return in_file(text.error(), piece.program_file);
  made.piece.program = text->text;
  for (programs::Operation& operation : made.piece.operations) {
    const auto lines = parser::lines_from(*text, {operation.first_line, operation.last_line});
    operation.first_line = lines.first;
    operation.last_line = lines.last;
  }
  // What is proven is the text.
  const auto written = trials::command_piece(machine, made.piece);
  if (!written) return written.error();
  const auto proof =
      prove(machine, errors, setup, commanded.program, written->program, result->sources, options);
  if (!proof) return in_file(proof.error(), made.piece.program_file);
  made.after = proof->beside;
  made.at_turns = proof->at_turns;
  return made;
}

}  // namespace frustum::calibration
