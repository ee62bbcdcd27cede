// The seeds of the fuzzer of machine files, and all that it has found, in the ordinary build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fuzz/files/one_file.hpp"
#include "tests/fuzz/seeds.hpp"

namespace frustum::kinematics {
namespace {

TEST(MachineSeeds, DoNoHarm) {
  const auto seeds = fuzz::seeds_of("machine");
  for (const auto& seed : seeds) {
    EXPECT_NO_THROW(fuzz::run_one_machine(fuzz::bytes_of(seed))) << seed;
  }
  EXPECT_GE(seeds.size(), 8U);
}

TEST(MachineSeeds, HaveADictionaryThatLibFuzzerReads) {
  const fuzz::Dictionary dictionary = fuzz::dictionary_of("machine");
  EXPECT_THAT(dictionary.broken, testing::IsEmpty());
  EXPECT_GE(dictionary.words, 40);
}

}  // namespace
}  // namespace frustum::kinematics
