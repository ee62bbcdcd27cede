// Canonical motions as the NC text of a controller.
//
// Model    : one writer for all dialects; what differs is data (nc_spelling.hpp). Words that say
//            what is in force already are left out. Positions are forgotten wherever a controller
//            might: after machine coordinates and changes of offset, compensation or plane.
// Units    : mm, rad in; mm, degrees, mm/min, 1/min or seconds in the text
// Errors   : motions that a dialect has no words for (tool vectors on LinuxCNC, return to home
//            outside Fanuc and LinuxCNC, a length offset other than the tool's own, ...), with the
//            source line
// Accuracy : half of 1e-6 mm, 1e-7 deg, 1e-10 of a direction, 1e-9 of a feed (WriterOptions)
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "parser/dialect.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

struct WriterOptions {
  std::string name = "FRUSTUM";  // of the program, where dialects name it
  bool comments = true;
  bool source_lines = false;  // a comment after each block: the line of the program it came from
  int length_decimals = 6;
  int angle_decimals = 7;
  int vector_decimals = 10;
  int feed_digits = 9;  // significant
};

struct NcProgram {
  std::string text{};
  // Of each line of the text, the line of the program it came from; 0: from none.
  std::vector<std::uint32_t> source_lines{};
};

[[nodiscard]] Result<NcProgram> write_nc(std::span<const parser::Motion> motions,
                                         parser::Dialect dialect,
                                         const WriterOptions& options = {});

// Lines of the text that came from lines first .. last of the source, both included; {0, 0} if
// none.
struct LineRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};
[[nodiscard]] LineRange lines_from(const NcProgram& program, LineRange source);

}  // namespace frustum::post
