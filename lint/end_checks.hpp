// The modes that a program leaves for the next one.
//
// Units : mm
// Errors: none
#pragma once

#include "lint/finding_list.hpp"
#include "lint/motion_state.hpp"
#include "parser/dialect.hpp"
#include "parser/interpret/state/modal_state.hpp"

namespace frustum::lint {

// `modes`: of the interpreter at the end. What M30 of the control puts right itself is not
// reported.
void check_end(const MotionState& state, const parser::ModalState& modes, parser::Dialect dialect,
               FindingList& findings);

}  // namespace frustum::lint
