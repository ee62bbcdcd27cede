#include "parser/motion.hpp"

#include <fmt/format.h>

namespace frustum::parser {

std::string work_offset_name(int number) {
  if (number > kExtendedWorkOffset) return fmt::format("G54.1 P{}", number - kExtendedWorkOffset);
  return number > 6 ? fmt::format("G59.{}", number - 6) : fmt::format("G{}", 53 + number);
}

}  // namespace frustum::parser
