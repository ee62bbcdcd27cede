// NC text that was written, read again.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parser/interpreter.hpp"
#include "post/nc_writer.hpp"

namespace frustum::post {

inline std::string first_of(const Diagnostics& problems) { return to_string(problems.front()); }

inline std::vector<parser::Motion> motions_in(const std::string& text, parser::Dialect dialect) {
  const auto program = parser::parse_program(text, "written", dialect);
  if (!program) {
    ADD_FAILURE() << first_of(program.error());
    return {};
  }
  auto motions = parser::motions_of(*program);
  if (!motions) {
    ADD_FAILURE() << first_of(motions.error());
    return {};
  }
  return *std::move(motions);
}

// Languages that are both written and read.
inline std::vector<parser::Dialect> written_dialects() {
  return {parser::Dialect::fanuc, parser::Dialect::linuxcnc, parser::Dialect::sinumerik,
          parser::Dialect::heidenhain};
}

}  // namespace frustum::post
