// The cone's form as the tool tip alone would write it: no cutter, no workpiece.
//
// Model    : the actual tips at the block ends of one operation; metrology::equivalent_cone_form
//            judges them
// Units    : mm
// Errors   : none; an unknown operation has no tips
// Source   : ETH thesis, section 3.9
#pragma once

#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "programs/test_piece.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

// Actual tips at the ends of the operation's blocks, workpiece frame, mm.
[[nodiscard]] std::vector<Vec3> tips_of(const Trial& trial, const programs::TestPiece& piece,
                                        std::string_view operation);

}  // namespace frustum::trials
