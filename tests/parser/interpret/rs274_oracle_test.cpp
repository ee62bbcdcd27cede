// The stand-alone interpreter rs274 of LinuxCNC as oracle: both run the same programs, and command
// the same moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "tests/parser/interpret/rs274_runs.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

fs::path corpus() { return fs::path(FRUSTUM_SOURCE_DIR) / "tests/parser/rs274"; }

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

class Rs274Oracle : public testing::TestWithParam<std::string> {};

TEST_P(Rs274Oracle, CommandsTheSameMoves) {
  if (!has_rs274()) GTEST_SKIP() << "rs274 is not installed: scripts/setup --with-oracle";
  const fs::path file = corpus() / (GetParam() + ".ngc");
  const auto program = open_program(file, Dialect::linuxcnc);
  ASSERT_TRUE(program);
  const Rs274Start start{corpus() / "tools.tbl", corpus() / "subs"};
  const auto motions = motions_of(*program, options_like_rs274(start));
  ASSERT_TRUE(motions) << to_string(motions.error().front());
  const Rs274Run run = run_rs274(file, start);
  ASSERT_TRUE(run.ended()) << run.output;
  const std::string found = difference(without_standing_still(moves_of(*motions)),
                                       without_standing_still(moves_of_rs274(run.output)));
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
