// The seeds of the fuzzers of plans and points, and all that these have found, in the ordinary
// build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fuzz/files/one_file.hpp"
#include "tests/fuzz/seeds.hpp"

namespace frustum::metrology {
namespace {

struct FuzzedFile {
  std::string name;
  void (*run)(std::string_view text);
};

class FileSeeds : public testing::TestWithParam<FuzzedFile> {};

TEST_P(FileSeeds, DoNoHarm) {
  const auto seeds = fuzz::seeds_of(GetParam().name);
  for (const auto& seed : seeds) {
    EXPECT_NO_THROW(GetParam().run(fuzz::bytes_of(seed))) << seed;
  }
  EXPECT_GE(seeds.size(), 6U);
}

TEST_P(FileSeeds, HaveADictionaryThatLibFuzzerReads) {
  const fuzz::Dictionary dictionary = fuzz::dictionary_of(GetParam().name);
  EXPECT_THAT(dictionary.broken, testing::IsEmpty());
  EXPECT_GE(dictionary.words, 40);
}

INSTANTIATE_TEST_SUITE_P(Files, FileSeeds,
                         testing::Values(FuzzedFile{"plan", fuzz::run_one_plan},
                                         FuzzedFile{"points", fuzz::run_one_points}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace frustum::metrology
