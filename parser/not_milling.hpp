// Programs that are not for milling, though their blocks look alike: of lathes, wire erosion,
// 3D printers.
//
// Units : none
// Errors: "not-milling": one diagnostic for the whole program, at the word that says so
#pragma once

#include <optional>

#include "core/diagnostic.hpp"
#include "parser/program.hpp"

namespace frustum::parser {

// Looks at the first lines alone, of programs in the manner of Fanuc.
[[nodiscard]] std::optional<Diagnostic> not_milling(const Program& program);

}  // namespace frustum::parser
