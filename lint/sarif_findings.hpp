// Findings as SARIF 2.1.0, which code hosts show beside the lines.
//
// Files are named relative to a folder (the working one, as a rule), with percent-encoding; one
// that is not below it keeps its absolute place. A fingerprint of the check and the text of its
// line lets a host know a finding again when lines move.
//
// Units : lines and columns from 1, columns count UTF-16 units, as SARIF has it
// Errors: none; bytes that are no text are replaced
// Source: OASIS, Static Analysis Results Interchange Format 2.1.0, sections 3.13 to 3.52
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lint/program_check.hpp"
#include "lint/source_lines.hpp"

namespace frustum::lint {

struct SarifOptions {
  std::filesystem::path folder{};  // absolute
  std::string_view version{};      // of the program
};

[[nodiscard]] std::string sarif_of(const CheckReport& report, const SourceLines& lines,
                                   const SarifOptions& options);

}  // namespace frustum::lint
