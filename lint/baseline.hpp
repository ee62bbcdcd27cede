// Findings that are known and accepted: a file that says which, so that only new ones count.
//
//   {"frustum_baseline": 1, "findings": [{"file": "old/part.nc", "id": "feed-low",
//     "fingerprint": "1a2b3c4d5e6f7081:1", "line": 12, "message": "..."}]}
//
// What counts is file, id and fingerprint (fingerprints.hpp); line and message are for people.
// Units : none
// Errors: read_baseline: what cannot be read or is no baseline
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <tuple>

#include "core/result.hpp"
#include "lint/checked_file.hpp"

namespace frustum::lint {

class Baseline {
 public:
  // Its files are named relative to its folder.
  [[nodiscard]] static Result<Baseline> read(const std::filesystem::path& file);
  // What is to be written to `file`: all findings that no comment suppresses.
  [[nodiscard]] static std::string text_of(std::span<const CheckedFile> checked,
                                           const std::filesystem::path& file);

  // Suppresses the findings that it has.
  void apply(CheckedFile& checked);
  // Of the files that it was applied to: entries that none of their findings has any more.
  [[nodiscard]] std::size_t gone() const;

 private:
  using Entry = std::tuple<std::string, std::string, std::string>;  // file, id, fingerprint

  std::filesystem::path folder_{};
  std::set<Entry> entries_{};
  std::set<Entry> met_{};
  std::set<std::string> files_{};  // that it was applied to
};

}  // namespace frustum::lint
