// The documents and faults of frustum motion.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/command_line.hpp"

namespace frustum {

using nlohmann::json;

class MotionCommands : public CommandLine {
 protected:
  json document(const std::string& arguments) const {
    const Outcome outcome = run("motion " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.err;
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
  }
  // The id of the first fault of a command that must be refused.
  std::string fault(const std::string& arguments) const {
    const Outcome outcome = run("motion " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    EXPECT_FALSE(outcome.err.empty() && outcome.out.empty()) << arguments;
    const json doc = json::parse(outcome.out, nullptr, false);
    if (doc.is_discarded()) return outcome.err;
    return doc["diagnostics"][0]["id"].get<std::string>();
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
};

inline void expect_all(const json& found, const json& expected, double within) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i].get<double>(), expected[i].get<double>(), within) << i;
  }
}

}  // namespace frustum
