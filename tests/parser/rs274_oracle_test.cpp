// The stand-alone interpreter rs274 of LinuxCNC as oracle: both run the same programs, and command the same
// moves.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "tests/parser/canonical_moves.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

fs::path corpus() { return fs::path(FRUSTUM_SOURCE_DIR) / "tests/parser/rs274"; }

bool has_rs274() { return std::system("command -v rs274 >/dev/null 2>&1") == 0; }

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(corpus())) {
    if (entry.path().extension() == ".ngc") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// What rs274 prints; it writes its parameters, and shares its tools in a file at home, so each run has a folder of
// its own.
std::string run_rs274(const fs::path& program) {
  const fs::path folder = fs::temp_directory_path() /
                          fmt::format("frustum-rs274-{}-{}", getpid(), program.stem().string());
  fs::create_directories(folder);
  const std::string command =
      fmt::format("cd '{0}' && HOME='{0}' timeout 20 rs274 -g -t '{1}' '{2}' 2>&1 </dev/null",
                  folder.string(), (corpus() / "tools.tbl").string(), program.string());
  std::string output;
  std::array<char, 4096> part{};
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  while (std::fgets(part.data(), static_cast<int>(part.size()), pipe.get()) != nullptr) {
    output += part.data();
  }
  fs::remove_all(folder);
  return output;
}

class Rs274Oracle : public testing::TestWithParam<std::string> {};

TEST_P(Rs274Oracle, CommandsTheSameMoves) {
  if (!has_rs274()) GTEST_SKIP() << "rs274 is not installed: apt install linuxcnc-uspace";
  const fs::path file = corpus() / (GetParam() + ".ngc");
  const auto program = open_program(file, Dialect::linuxcnc);
  ASSERT_TRUE(program);
  InterpreterOptions options;
  options.search_path = {corpus()};
  for (const AxisLetter axis : kAxisLetters) options.start[axis] = 0.0;
  const auto motions = motions_of(*program, options);
  ASSERT_TRUE(motions) << to_string(motions.error().front());
  const std::string output = run_rs274(file);
  ASSERT_NE(output.find("PROGRAM_END"), std::string::npos) << output;
  const auto ours = without_standing_still(moves_of(*motions));
  const auto theirs = without_standing_still(moves_of_rs274(output));
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    ASSERT_TRUE(agree(ours[i], theirs[i])) << "move " << i + 1 << "\nours:   " << to_text(ours[i])
                                           << "\nrs274: " << to_text(theirs[i]);
  }
  EXPECT_EQ(ours.size(), theirs.size());
}

INSTANTIATE_TEST_SUITE_P(Corpus, Rs274Oracle, testing::ValuesIn(programs()),
                         [](const auto& program) { return program.param; });

}  // namespace
}  // namespace frustum::parser
