// Findings as SARIF 2.1.0, which code hosts show beside the lines.
//
// Files are named relative to a folder (the working one, as a rule), with percent-encoding; one
// that is not below it keeps its absolute place. A fingerprint of the check and the text of its
// line lets a host know a finding again when lines move. What a comment or a baseline suppresses is
// there too, as suppressed.
//
// Units : lines and columns from 1, columns count UTF-16 units, as SARIF has it
// Errors: none; bytes that are no text are replaced
// Source: OASIS, Static Analysis Results Interchange Format 2.1.0, sections 3.13 to 3.58
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"
#include "lint/checked_file.hpp"

namespace frustum::lint {

struct SarifOptions {
  std::filesystem::path folder{};  // absolute
  std::string_view version{};      // of the program
  std::string documents{};         // URI of the folder with docs/check.md; empty: none
  Diagnostics troubles{};          // what could not be read
};

[[nodiscard]] std::string sarif_of(std::span<const CheckedFile> checked,
                                   const SarifOptions& options);
// file:///..., of an absolute path.
[[nodiscard]] std::string file_uri(const std::filesystem::path& path);

}  // namespace frustum::lint
