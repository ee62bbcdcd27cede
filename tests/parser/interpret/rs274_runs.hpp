// One program run by the stand-alone interpreter rs274 of LinuxCNC and by ours, from the same
// start: all parameters zero, the inch the machine's unit.
//
// Units : as CanonicalMove
// Errors: a failure of rs274 is in its output; a table that cannot be read fails the test
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "parser/interpreter.hpp"
#include "tests/parser/interpret/canonical_moves.hpp"

namespace frustum::parser {

[[nodiscard]] bool has_rs274();

struct Rs274Start {
  std::filesystem::path tools{};  // the tool table
  std::filesystem::path subs{};   // the folder with subprograms of their own file
};

struct Rs274Run {
  std::string output{};
  bool timed_out = false;
  int exit_code = 0;

  // It came to the end of the program.
  [[nodiscard]] bool ended() const;
};
// rs274 writes its parameters and shares its tools in a file at home, so that each run has a folder
// of its own.
[[nodiscard]] Rs274Run run_rs274(const std::filesystem::path& program, const Rs274Start& start);

[[nodiscard]] InterpreterOptions options_like_rs274(const Rs274Start& start);

// Empty when both command the same.
[[nodiscard]] std::string difference(const std::vector<CanonicalMove>& ours,
                                     const std::vector<CanonicalMove>& theirs);

}  // namespace frustum::parser
