// Findings for programs: docs/check.md has the keys.
//
// Units : lines and columns from 1, columns count bytes
// Errors: none; bytes that are no text are replaced
#pragma once

#include <span>
#include <string>

#include "core/diagnostic.hpp"
#include "lint/checked_file.hpp"

namespace frustum::lint {

// `troubles`, where there are some: what could not be read; then the status is "fail".
[[nodiscard]] std::string json_of(const CheckedFile& checked, const Diagnostics& troubles = {});
// Of several programs: {"status", "counts", "files": [..]}.
[[nodiscard]] std::string json_of(std::span<const CheckedFile> checked,
                                  const Diagnostics& troubles = {});

}  // namespace frustum::lint
