// Findings for programs: docs/check.md has the keys.
//
// Units : lines and columns from 1, columns count bytes
// Errors: none; bytes that are no text are replaced
#pragma once

#include <string>
#include <string_view>

#include "lint/program_check.hpp"

namespace frustum::lint {

struct CheckedFile {
  std::string file{};
  std::string_view dialect{};
  std::string machine{};  // empty: none
  bool passed = true;
};

[[nodiscard]] std::string json_of(const CheckReport& report, const CheckedFile& checked);

}  // namespace frustum::lint
