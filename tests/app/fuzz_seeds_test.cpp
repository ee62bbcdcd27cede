// The seeds of the fuzzer of jobs, and all that it has found, through the program.
#include <gmock/gmock.h>

#include "tests/app/command_line.hpp"
#include "tests/fuzz/seeds.hpp"

namespace frustum {
namespace {

class JobSeedsSystem : public CommandLine {};

TEST_F(JobSeedsSystem, DoNoHarm) {
  fs::copy(FRUSTUM_SOURCE_DIR "/tests/fuzz/job/beside", folder_);
  const auto seeds = fuzz::seeds_of("job");
  for (const auto& seed : seeds) {
    std::ofstream(folder_ / "job.toml", std::ios::binary) << fuzz::bytes_of(seed);
    const Outcome checked = run("check part.nc --job job.toml");
    EXPECT_TRUE(checked.exit_code >= 0 && checked.exit_code <= 2) << seed << checked.err;
  }
  EXPECT_GE(seeds.size(), 11U);
}

TEST_F(JobSeedsSystem, HaveADictionaryThatLibFuzzerReads) {
  const fuzz::Dictionary dictionary = fuzz::dictionary_of("job");
  EXPECT_THAT(dictionary.broken, testing::IsEmpty());
  EXPECT_GE(dictionary.words, 40);
}

}  // namespace
}  // namespace frustum
