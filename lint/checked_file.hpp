// A program that has been checked, with what is said of it.
//
// Units : lines and columns from 1, columns count bytes
// Errors: none
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lint/program_check.hpp"
#include "lint/source_lines.hpp"

namespace frustum::lint {

struct CheckedFile {
  std::string file{};
  std::string_view dialect{};
  std::string machine{};  // empty: none
  bool passed = true;
  CheckReport report{};
  SourceLines lines{};
  bool subprogram = false;  // checked as one: the rest is looked at through its callers
};

struct FindingCounts {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t notes = 0;
  std::size_t suppressed = 0;  // which none of the others counts
  std::uint64_t blocks = 0;
};
[[nodiscard]] FindingCounts counts_of(std::span<const CheckedFile> files);

}  // namespace frustum::lint
