// The fuzzers' seeds, and with them all that a fuzzer has found, in the ordinary build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fuzz/one_program.hpp"
#include "tests/fuzz/seeds.hpp"

namespace frustum::parser {
namespace {

class FuzzSeeds : public testing::TestWithParam<Dialect> {};

TEST_P(FuzzSeeds, DoNoHarm) {
  const auto seeds = fuzz::seeds_of(name_of(GetParam()));
  for (const auto& seed : seeds) {
    EXPECT_NO_THROW(run_one_program(fuzz::bytes_of(seed), GetParam())) << seed;
  }
  EXPECT_GE(seeds.size(), 2U);
}

TEST_P(FuzzSeeds, HaveADictionaryThatLibFuzzerReads) {
  const fuzz::Dictionary dictionary = fuzz::dictionary_of(name_of(GetParam()));
  EXPECT_THAT(dictionary.broken, testing::IsEmpty());
  EXPECT_GE(dictionary.words, 40);
}

INSTANTIATE_TEST_SUITE_P(Dialects, FuzzSeeds, testing::ValuesIn(kDialects),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace frustum::parser
