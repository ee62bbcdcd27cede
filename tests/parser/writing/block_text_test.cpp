// Law: reading what was printed gives the same blocks, and printing that the same text.
#include "parser/writing/block_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "parser/program.hpp"
#include "tests/law_count.hpp"
#include "tests/parser/random_languages.hpp"
#include "tests/parser/random_program.hpp"
#include "tests/parser/random_text.hpp"
#include "tests/parser/same_block.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

void expect_identity(const std::vector<Block>& blocks, Dialect dialect) {
  const std::string text = to_text(blocks, dialect);
  const auto again = parse_program(text, "printed", dialect);
  ASSERT_TRUE(again) << text << to_string(again.error().front());
  const std::vector<Block> read = blocks_of(*again);
  ASSERT_EQ(read.size(), blocks.size()) << text;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    ASSERT_TRUE(same_block(read[i], blocks[i])) << "block " << i + 1 << " of\n" << text;
  }
  ASSERT_EQ(to_text(read, dialect), text);
}

class PrintLaws : public testing::TestWithParam<Dialect> {};

TEST_P(PrintLaws, PrintThenParseIsTheIdentityOnRandomPrograms) {
  for (std::uint64_t seed = 1; seed <= proof::law_count(5000U, 500U); ++seed) {
    const std::string text = random_text(seed, GetParam());
    const auto program = parse_program(text, "random", GetParam());
    ASSERT_TRUE(program) << "seed " << seed << "\n" << text << to_string(program.error().front());
    expect_identity(blocks_of(*program), GetParam());
    if (HasFatalFailure()) FAIL() << "seed " << seed << "\n" << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Dialects, PrintLaws, testing::ValuesIn(kDialects),
                         [](const auto& test) { return std::string(name_of(test.param)); });

// Blocks that were made, not read: expressions of any shape, words in any order.
TEST(PrintLawsOfBlocks, HoldForWhatTheGrammarMayProduce) {
  for (const Dialect dialect : {Dialect::fanuc, Dialect::linuxcnc}) {
    for (std::uint64_t seed = 1; seed <= proof::law_count(3000U, 400U); ++seed) {
      expect_identity(random_blocks(seed, dialect), dialect);
      if (testing::Test::HasFatalFailure()) FAIL() << name_of(dialect) << ", seed " << seed;
    }
  }
}

// All programs of the tests and examples that are read without a mistake.
TEST(PrintLawsOfBlocks, HoldForTheCorpus) {
  std::size_t programs = 0;
  for (const char* folder : {"tests/parser", "tests/fuzz", "examples"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(FRUSTUM_SOURCE_DIR) / folder)) {
      static const std::set<std::string> kEndings{".nc", ".ngc", ".mpf", ".spf", ".h", ".apt"};
      if (!kEndings.contains(entry.path().extension().string())) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      const Dialect dialect = recognise_dialect(text, entry.path().string()).dialect;
      const auto program = parse_program(text, entry.path().string(), dialect);
      if (!program) continue;
      expect_identity(blocks_of(*program), dialect);
      if (testing::Test::HasFatalFailure()) FAIL() << entry.path();
      ++programs;
    }
  }
  EXPECT_GE(programs, 400U);
}

}  // namespace
}  // namespace frustum::parser
