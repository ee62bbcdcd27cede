// NC text that was written, read again.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parser/interpreter.hpp"
#include "parser/writing/motion_writer.hpp"

namespace frustum::parser {

inline std::string first_of(const Diagnostics& problems) { return to_string(problems.front()); }

inline std::vector<Motion> motions_in(const std::string& text, Dialect dialect) {
  const auto program = parse_program(text, "written", dialect);
  if (!program) {
    ADD_FAILURE() << first_of(program.error());
    return {};
  }
  auto motions = motions_of(*program);
  if (!motions) {
    ADD_FAILURE() << first_of(motions.error());
    return {};
  }
  return *std::move(motions);
}

// Languages that are both written and read.
inline std::vector<Dialect> written_dialects() {
  return {Dialect::fanuc, Dialect::linuxcnc, Dialect::sinumerik, Dialect::heidenhain};
}

}  // namespace frustum::parser
