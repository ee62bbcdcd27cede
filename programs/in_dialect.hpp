// A test piece whose NC program is written in the language of another controller.
//
// Units  : as the test piece
// Errors : what the language has no words for (tool vectors on LinuxCNC), with the remedy
#pragma once

#include "core/result.hpp"
#include "post/nc_writer.hpp"
#include "programs/test_piece.hpp"

namespace frustum::programs {

struct TranslatedPiece {
  TestPiece piece{};
  // The text again, with the line of the old program that each of its lines came from; empty where
  // nothing was to be translated.
  post::NcProgram program{};
};

[[nodiscard]] Result<TranslatedPiece> in_dialect(TestPiece piece, parser::Dialect dialect);

}  // namespace frustum::programs
