// Canonical motions as the NC text of a controller.
//
// Model    : one writer for all dialects; what differs is data (motion_spelling.hpp). Words that
//            say what is in force already are left out. Positions are forgotten wherever a
//            controller might: after machine coordinates and changes of offset, compensation or
//            plane.
// Units    : mm, rad in; mm, degrees, mm/min, 1/min or seconds in the text
// Errors   : motions that a dialect has no words for (tool vectors on LinuxCNC, return to home
//            outside Fanuc and LinuxCNC, a length offset other than the tool's own, ...), with the
//            source line
// Accuracy : half of 1e-6 mm, 1e-7 deg, 1e-10 of a direction, 1e-9 of a feed (WriterOptions)
#pragma once

#include <cstdint>
#include <span>

#include "core/result.hpp"
#include "parser/dialect.hpp"
#include "parser/motion.hpp"
#include "parser/writing/nc_lines.hpp"

namespace frustum::parser {

[[nodiscard]] Result<NcProgram> write_nc(std::span<const Motion> motions, Dialect dialect,
                                         const WriterOptions& options = {});

}  // namespace frustum::parser
