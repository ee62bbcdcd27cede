// The stand-alone interpreter rs274 of LinuxCNC as oracle: both run the same programs, and command
// the same moves.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "core/units.hpp"
#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "parser/tool_table.hpp"
#include "tests/parser/interpret/canonical_moves.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

fs::path corpus() { return fs::path(FRUSTUM_SOURCE_DIR) / "tests/parser/rs274"; }

bool has_rs274() { return std::system("command -v rs274 >/dev/null 2>&1") == 0; }

// Where they differ and rs274 is at fault. An entry that no longer differs is stale, which fails
// too.
struct KnownDifference {
  std::string_view program;
  std::string_view rs274;  // what it does
  std::string_view why;    // that is wrong
};
constexpr std::array kKnownDifferences{
    KnownDifference{
        "tool_number", "keeps the old tool in #5400 after M61",
        "M61 says which tool is in the spindle; the stand-alone tool table is not told"},
    KnownDifference{"probe_twice", "stops 0.254 mm (0.01 in) before the end of a probing move",
                    "nothing is there to be touched: a probe that meets nothing goes to its end"},
};

const KnownDifference* known_difference(std::string_view program) {
  const auto* const found =
      std::find_if(kKnownDifferences.begin(), kKnownDifferences.end(),
                   [program](const KnownDifference& entry) { return entry.program == program; });
  return found == kKnownDifferences.end() ? nullptr : found;
}

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(corpus())) {
    if (entry.path().extension() == ".ngc") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// What rs274 prints; it writes its parameters, and shares its tools in a file at home, so each run
// has a folder of its own.
std::string run_rs274(const fs::path& program) {
  const fs::path folder = fs::temp_directory_path() /
                          fmt::format("frustum-rs274-{}-{}", getpid(), program.stem().string());
  fs::create_directories(folder);
  for (const auto& sub : fs::directory_iterator(corpus() / "subs")) fs::copy(sub, folder);
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

// Empty when both command the same.
std::string difference(const std::vector<CanonicalMove>& ours,
                       const std::vector<CanonicalMove>& theirs) {
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    if (agree(ours[i], theirs[i])) continue;
    return fmt::format("move {}\nours:  {}\nrs274: {}", i + 1, to_text(ours[i]),
                       to_text(theirs[i]));
  }
  if (ours.size() == theirs.size()) return {};
  return fmt::format("{} moves, of rs274 {}", ours.size(), theirs.size());
}

TEST_P(Rs274Oracle, CommandsTheSameMoves) {
  if (!has_rs274()) GTEST_SKIP() << "rs274 is not installed: scripts/setup --with-oracle";
  const fs::path file = corpus() / (GetParam() + ".ngc");
  const auto program = open_program(file, Dialect::linuxcnc);
  ASSERT_TRUE(program);
  InterpreterOptions options;
  options.search_path = {corpus() / "subs"};
  // The oracle begins with all parameters at zero, and its own unit is the inch.
  AxisTarget zero;
  for (const AxisLetter axis : kAxisLetters) zero[axis] = 0.0;
  options.start = zero;
  for (int number = 1; number <= 9; ++number) options.work_offsets[number].origin = zero;
  options.reference_points.fill(zero);
  options.machine_unit = LengthUnit::inch;
  auto tools = read_tool_table(corpus() / "tools.tbl", LengthUnit::inch);
  ASSERT_TRUE(tools) << to_string(tools.error().front());
  options.tools = *std::move(tools);
  const auto motions = motions_of(*program, options);
  ASSERT_TRUE(motions) << to_string(motions.error().front());
  const std::string output = run_rs274(file);
  const bool ended =
      output.find("PROGRAM_END") != std::string::npos || output.find("FINISH") != std::string::npos;
  ASSERT_TRUE(ended) << output;
  const std::string found = difference(without_standing_still(moves_of(*motions)),
                                       without_standing_still(moves_of_rs274(output)));
  if (const KnownDifference* known = known_difference(GetParam())) {
    EXPECT_FALSE(found.empty()) << "no longer so, take it out of the table: rs274 " << known->rs274;
  } else {
    EXPECT_TRUE(found.empty()) << found;
  }
}

TEST(Rs274KnownDifferences, AreOfProgramsOfTheCorpusAndSayWhy) {
  for (const KnownDifference& entry : kKnownDifferences) {
    EXPECT_TRUE(fs::exists(corpus() / (std::string(entry.program) + ".ngc"))) << entry.program;
    EXPECT_FALSE(entry.rs274.empty() || entry.why.empty()) << entry.program;
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, Rs274Oracle, testing::ValuesIn(programs()),
                         [](const auto& program) { return program.param; });

}  // namespace
}  // namespace frustum::parser
