// The test pieces of the benchmark: those that are given as cut and measured, and others of the
// same kinds, elsewhere on the table, that are asked for.
//
// Units : mm, rad
// Errors: pieces that do not fit on the machine
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"

namespace frustum::app {

// `machine_name`: of the shipped file. Nothing where the machine does not cut such a piece: step
// patterns need a tilting table that carries Y.
[[nodiscard]] Result<std::optional<programs::TestPiece>> benchmark_piece(
    const std::string& name, const std::string& machine_name, const kinematics::Machine& machine,
    bool asked);

}  // namespace frustum::app
