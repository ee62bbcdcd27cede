// Findings for programs: docs/check.md has the keys.
//
// Units : lines and columns from 1, columns count bytes
// Errors: none; bytes that are no text are replaced
#pragma once

#include <span>
#include <string>

#include "lint/checked_file.hpp"

namespace frustum::lint {

[[nodiscard]] std::string json_of(const CheckedFile& checked);
// Of several programs: {"status", "counts", "files": [..]}.
[[nodiscard]] std::string json_of(std::span<const CheckedFile> checked);

}  // namespace frustum::lint
