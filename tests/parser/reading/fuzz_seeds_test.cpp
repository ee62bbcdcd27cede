// The fuzzers' seeds, and with them all that a fuzzer has found, in the ordinary build.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/one_program.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(FRUSTUM_SOURCE_DIR) / "tests" / "fuzz";

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FuzzSeeds : public testing::TestWithParam<Dialect> {};

TEST_P(FuzzSeeds, DoNoHarm) {
  int seeds = 0;
  for (const auto& seed : fs::directory_iterator(kFolder / name_of(GetParam()) / "seeds")) {
    EXPECT_NO_THROW(run_one_program(bytes_of(seed.path()), GetParam())) << seed.path();
    ++seeds;
  }
  EXPECT_GE(seeds, 2);
}

// One broken line stops libFuzzer before it begins.
TEST_P(FuzzSeeds, HaveADictionaryThatLibFuzzerReads) {
  std::ifstream in(kFolder / name_of(GetParam()) / "words.dict");
  int words = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    ++words;
    EXPECT_TRUE(line.size() > 2 && line.front() == '"' && line.back() == '"') << line;
  }
  EXPECT_GE(words, 40);
}

INSTANTIATE_TEST_SUITE_P(Dialects, FuzzSeeds, testing::ValuesIn(kDialects),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace frustum::parser
