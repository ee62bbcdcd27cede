// Comments that turn checks off for a line or a file.
//
//   G1 X10 F0.5 (frustum: ignore feed-low -- a slow cut on purpose)
//   ; frustum: ignore feed-low arc-tiny        on a line of its own: for the next block
//   (frustum: ignore-file not-simulated)       for the whole file, wherever it is
//
// A comment is one of the program's dialect; case does not count, commas between the ids may be
// written. What is after -- or ; is the reason.
// Units : lines and columns from 1
// Shape : a file is read once, the main program at the start and others when a check finds
//         something in them
// Errors: none; a comment that names no check or turns nothing off is a finding
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lint/check.hpp"
#include "parser/motion.hpp"
#include "parser/program.hpp"

namespace frustum::lint {

// One id of a comment.
struct Suppression {
  parser::SourcePlace place{};  // of the comment
  std::uint32_t line = 0;       // whose findings it takes; 0: those of the whole file
  std::string id{};             // as written; empty: none
  std::optional<Check> check{};
  std::string reason{};
  bool used = false;
};

// Of one file, in its order.
[[nodiscard]] std::vector<Suppression> suppressions_of(const parser::Program& program);

class Suppressions {
 public:
  explicit Suppressions(const parser::Program& main);

  // The comment that takes a finding at this place; null: none. It counts as used.
  [[nodiscard]] const Suppression* taking(Check check, const parser::SourcePlace& place);
  // Of the files that have been looked at.
  [[nodiscard]] std::vector<Suppression> all() const;

 private:
  struct OfFile {
    OfFile() = default;
    explicit OfFile(std::vector<Suppression> found);

    std::vector<Suppression> list{};
    std::map<std::pair<std::uint32_t, Check>, std::vector<std::size_t>> by_line{};
  };

  [[nodiscard]] OfFile& of_file(const parser::SourcePlace& place);

  parser::Dialect dialect_;
  OfFile main_;
  std::map<std::string, OfFile> others_{};
};

}  // namespace frustum::lint
