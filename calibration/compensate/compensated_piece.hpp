// A test piece with its program compensated for a machine's errors, ready to be cut again.
//
// Model    : the program is compensated (compensation.hpp) and written in `dialect`, or its own;
//            APT CLDATA, which no controller runs, becomes a Fanuc program. Operations keep their
//            blocks
// Units    : mm, rad
// Errors   : those of reading, executing and writing the program, with file and NC line
#pragma once

#include <optional>

#include "calibration/compensate/compensation.hpp"
#include "parser/dialect.hpp"
#include "programs/test_piece.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {

struct CompensatedPiece {
  programs::TestPiece piece{};
  PathError before{};
  PathError after{};     // of the program as written, beside the places where an axis turns
  PathError at_turns{};  // there
};

[[nodiscard]] Result<CompensatedPiece> compensated_piece(
    const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
    const programs::TestPiece& piece, const CompensationOptions& options = {},
    std::optional<parser::Dialect> dialect = {});
// Of a piece that has been commanded before.
[[nodiscard]] Result<CompensatedPiece> compensated_piece(
    const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
    const programs::TestPiece& piece, const trials::CommandedPiece& commanded,
    const CompensationOptions& options = {}, std::optional<parser::Dialect> dialect = {});

}  // namespace frustum::calibration
