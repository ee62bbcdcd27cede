// What `frustum check` goes by: options of the command line, and .frustum.toml, the file with
// settings that is found upwards from a program.
//
// Keys of the file have the names of the options with _ for -, and say the same; what the command
// line says goes before, lists are joined. `endings` and `exclude` are the file's alone.
// Units : as of the options
// Errors: a misspelt key, a value of another type, a check that does not exist, with line and key
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/job/machine_setup.hpp"
#include "core/result.hpp"
#include "lint/check.hpp"

namespace frustum::app {

struct CheckSettings {
  std::filesystem::path file{};  // empty: none
  SetupWords setup_words{};
  std::string dialect{};  // recognised when not given
  std::vector<std::string> search{};
  std::vector<std::string> disabled{};
  std::string fail_on{};                        // empty: error
  std::string tools{};                          // a tool table
  std::string baseline{};                       // empty: none
  std::optional<std::uint64_t> most_repeats{};  // none: the check's own
  bool inch_machine = false;
  bool block_delete = false;
  // Of files in folders.
  std::vector<std::string> endings{};  // "prg": of programs too
  std::vector<std::string> exclude{};  // patterns of names or paths from the file's folder
};

[[nodiscard]] Result<CheckSettings> read_check_settings(const std::filesystem::path& file);
// .frustum.toml in the folder or the nearest one above it.
[[nodiscard]] std::optional<std::filesystem::path> find_check_settings(
    const std::filesystem::path& folder);
// What the command line says, and where it says nothing what the file does.
[[nodiscard]] CheckSettings joined(CheckSettings command_line, const CheckSettings& file);

// `option`: what messages begin with ("--disable").
[[nodiscard]] Result<std::set<lint::Check>> checks_named(const std::vector<std::string>& ids,
                                                         const std::string& option = {});

}  // namespace frustum::app
