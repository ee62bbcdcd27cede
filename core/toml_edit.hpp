// The text of a TOML file with some of its values changed; all else stays as people wrote it:
// order, spacing, comments, and keys that this program does not know.
//
// Keys are paths from the root: "program.file", "operation[0].lines" (the first has index 0).
// Values are TOML, as they are to be written.
// Units : none
// Errors: a text that is not TOML, a key that it does not have
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace frustum {

struct TomlChanges {
  // Key and value. Nested ones are not changed together.
  std::vector<std::pair<std::string, std::string>> replaced{};
  // A further key of a table: its neighbour there, its own name, and its value.
  struct Added {
    std::string after{};
    std::string name{};
    std::string value{};
  };
  std::vector<Added> added{};
  // Tables that lose their keys; those that are not there are empty already.
  std::vector<std::string> emptied{};
};

[[nodiscard]] Result<std::string> changed_toml(std::string_view text, const TomlChanges& changes);

}  // namespace frustum
