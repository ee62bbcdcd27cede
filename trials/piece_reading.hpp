// How a piece's program is read: what its control knows of tools and words, where subprograms are,
// which files it has opened.
//
// Units : mm
// Errors: a file that the program has opened and that can no longer be read
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "parser/interpreter.hpp"
#include "programs/test_piece.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

[[nodiscard]] parser::InterpreterOptions reading_of(const kinematics::Machine& machine,
                                                    const programs::TestPiece& piece);
// The same, but that each file it opens is noted in `opened`, which must outlive the run.
[[nodiscard]] parser::InterpreterOptions reading_of(const kinematics::Machine& machine,
                                                    const programs::TestPiece& piece,
                                                    std::vector<std::string>& opened);
[[nodiscard]] Result<std::vector<ProgramFile>> hashed(const std::vector<std::string>& files);

// Those with a line but no file are of this one.
[[nodiscard]] Diagnostics in_file(Diagnostics diagnostics, const std::string& file);

}  // namespace frustum::trials
