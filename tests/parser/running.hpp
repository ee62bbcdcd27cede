// Runs NC text in tests: its motions, or its diagnostics, in one line.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "parser/interpreter.hpp"
#include "parser/program.hpp"

namespace frustum::parser {

// A control whose unit is known, so that the programs of tests need no G21.
[[nodiscard]] inline InterpreterOptions in_millimetres(InterpreterOptions options) {
  if (!options.control.unit) options.control.unit = LengthUnit::millimetre;
  return options;
}

// Not to be confused with a pass: a program that fails gives no motions and a test failure.
[[nodiscard]] inline std::vector<Motion> motions(std::string_view text,
                                                 const InterpreterOptions& options = {},
                                                 Dialect dialect = Dialect::fanuc) {
  auto motions =
      parse_program(text, "part.nc", dialect).and_then([&options](const Program& program) {
        return motions_of(program, in_millimetres(options));
      });
  if (motions) return *std::move(motions);
  for (const Diagnostic& diagnostic : motions.error()) ADD_FAILURE() << to_string(diagnostic);
  return {};
}

// What is wrong with the program; nothing when it runs.
[[nodiscard]] inline Diagnostics failures_of(std::string_view text,
                                             const InterpreterOptions& options = {},
                                             Dialect dialect = Dialect::fanuc) {
  const auto motions =
      parse_program(text, "part.nc", dialect).and_then([&options](const Program& program) {
        return motions_of(program, options);
      });
  return motions ? Diagnostics{} : motions.error();
}

// "3:5: error: ... (hint: ...)" for each diagnostic; empty when the program runs.
[[nodiscard]] inline std::vector<std::string> complaints(std::string_view text,
                                                         const InterpreterOptions& options = {},
                                                         Dialect dialect = Dialect::fanuc) {
  const std::string file = "part.nc";
  std::vector<std::string> lines;
  for (const Diagnostic& diagnostic : failures_of(text, options, dialect)) {
    const std::string line = to_string(diagnostic);
    EXPECT_TRUE(line.starts_with(file + ":")) << line;
    lines.push_back(line.substr(file.size() + 1));
  }
  return lines;
}

// Their ids.
[[nodiscard]] inline std::vector<std::string> complaint_ids(std::string_view text,
                                                            const InterpreterOptions& options = {},
                                                            Dialect dialect = Dialect::fanuc) {
  std::vector<std::string> ids;
  for (const Diagnostic& diagnostic : failures_of(text, options, dialect)) {
    ids.emplace_back(diagnostic.id.text());
  }
  return ids;
}

// The commands of one kind, in order.
template <typename Kind>
[[nodiscard]] std::vector<Kind> all_of(const std::vector<Motion>& motions) {
  std::vector<Kind> commands;
  for (const Motion& motion : motions) {
    if (const auto* command = std::get_if<Kind>(&motion.command)) commands.push_back(*command);
  }
  return commands;
}

// The last command of one kind; a default one and a test failure when there is none.
template <typename Kind>
[[nodiscard]] Kind last_of(const std::vector<Motion>& motions) {
  const std::vector<Kind> commands = all_of<Kind>(motions);
  if (!commands.empty()) return commands.back();
  ADD_FAILURE() << "no such command among " << motions.size();
  return {};
}

}  // namespace frustum::parser
