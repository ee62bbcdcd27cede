// Which check an error of the interpreter or the controller belongs to, by its id.
//
// Units : none
// Errors: none
#pragma once

#include "core/diagnostic.hpp"
#include "lint/check.hpp"

namespace frustum::lint {

// `otherwise`: what an error of no check of its own is.
[[nodiscard]] Check check_of(const Diagnostic& error, Check otherwise);
// Whether it only says what an earlier error did: a position that is not known since.
[[nodiscard]] bool follows_from_an_earlier_one(const Diagnostic& error);

}  // namespace frustum::lint
