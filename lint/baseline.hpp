// Findings that are known and accepted: a file that says which, so that only new ones count.
//
//   {"frustum_baseline": 1, "findings": [{"file": "old/part.nc", "id": "feed-low",
//     "fingerprint": "1a2b3c4d5e6f7081", "count": 2, "line": 12, "message": "..."}]}
//
// What counts is file, id and fingerprint (fingerprints.hpp), and on how many lines the like is
// found in a run of one program; line and message are for people. What a program has beyond the
// count is new, in the order of the lines.
// Units : none
// Errors: read_baseline: what cannot be read or is no baseline
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/result.hpp"
#include "lint/checked_file.hpp"

namespace frustum::lint {

class Baseline {
 public:
  // Its files are named relative to its folder.
  [[nodiscard]] static Result<Baseline> read(const std::filesystem::path& file);
  // What is to be written to `file`: all findings that no comment suppresses.
  [[nodiscard]] static std::string text_of(std::span<const CheckedFile* const> checked,
                                           const std::filesystem::path& file);

  // Suppresses the findings that it has.
  void apply(CheckedFile& checked);
  // Of the files that it was applied to: lines that it has and the programs no longer do.
  [[nodiscard]] std::size_t gone() const;

 private:
  using Entry = std::tuple<std::string, std::string, std::string>;  // file, id, fingerprint
  using Counts = std::map<Entry, std::uint64_t>;                    // lines

  // Each finding with its entry.
  [[nodiscard]] static std::vector<Entry> entries_of(const CheckedFile& checked,
                                                     const std::filesystem::path& folder);

  std::filesystem::path folder_{};
  Counts known_{};
  Counts met_{};                   // the most of one program
  std::set<std::string> files_{};  // that it was applied to
};

}  // namespace frustum::lint
