// Samples on disk: what is written is read again bit by bit, and the same samples are the same
// bytes however they came together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "core/whole_file.hpp"
#include "studies/samples/campaign.hpp"
#include "studies/samples/packed_chunk.hpp"
#include "studies/samples/sample_file.hpp"
#include "studies/samples/sample_folder.hpp"
#include "tests/law_count.hpp"

namespace frustum::studies {
namespace {

namespace fs = std::filesystem;

const SampleMark kMark{std::string(64, 'a'), 7};

bool same(const SampleBlock& a, const SampleBlock& b) {
  const auto same_column = [](const SampleColumn& c, const SampleColumn& d) {
    return c.name == d.name && c.unit == d.unit && c.values == d.values;
  };
  const auto same_pass = [](const PassColumn& c, const PassColumn& d) {
    return c.name == d.name && c.values == d.values;
  };
  const auto same_failure = [](const FailedSample& f, const FailedSample& g) {
    return f.draw == g.draw && f.message == g.message;
  };
  return a.first_draw == b.first_draw && a.count == b.count && a.draws == b.draws &&
         std::ranges::equal(a.columns, b.columns, same_column) &&
         std::ranges::equal(a.passes, b.passes, same_pass) && a.points == b.points &&
         a.deviations == b.deviations && std::ranges::equal(a.failed, b.failed, same_failure);
}

// Every hundredth draw fails.
SampleBlock drawn(std::uint64_t first, std::uint64_t count) {
  SampleBlock block{.first_draw = first, .count = count, .points = 2};
  block.columns = {{"characteristics/cone.form", "um", {}},
                   {"characteristics/Bohrung 1/\xC3\x98.pos", "um", {}},
                   {"amounts/EXX/0", "um", {}}};
  block.passes = {{"pass/cone.form", {}}};
  for (std::uint64_t d = first; d < first + count; ++d) {
    if (d % 100 == 99) {
      block.failed.push_back({d, "the draw " + std::to_string(d) + " failed"});
      continue;
    }
    block.draws.push_back(static_cast<std::int64_t>(d));
    const RandomKey key{.seed = 3, .draw = static_cast<std::uint32_t>(d)};
    for (std::uint64_t c = 0; c < block.columns.size(); ++c) {
      block.columns[c].values.push_back(normal(key, c));
    }
    block.passes[0].values.push_back(block.columns[0].values.back() < 1.0 ? 1 : 0);
    block.deviations.push_back(normal(key, 10));
    block.deviations.push_back(normal(key, 11));
  }
  return block;
}

// A folder of its own for each test, removed at its end.
class SampleFolders : public ::testing::Test {
 protected:
  SampleFolders() : folder_(fs::temp_directory_path() / unique_name()) { fs::remove_all(folder_); }
  ~SampleFolders() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  static std::string unique_name() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    return "frustum-" + std::to_string(::getpid()) + "-" + test->name();
  }
  static std::map<std::string, std::string> bytes_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder / "samples")) {
      files[entry.path().filename().string()] = *read_whole_file(entry.path());
    }
    return files;
  }
  static Campaign campaign() {
    Campaign all;
    all.evaluate = [](std::uint64_t first, std::uint64_t count) -> Result<SampleBlock> {
      return drawn(first, count);
    };
    return all;
  }
  fs::path folder_;
};

TEST(SampleFile, ReadsAgainWhatWasWrittenBitByBit) {
  for (const std::uint64_t count : {1U, 99U, 100U, 40000U}) {
    const SampleFile file{kMark, drawn(65536, count)};
    const auto bytes = encoded(file);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, *encoded(file)) << "equal samples are equal bytes";
    const auto again = decoded(*bytes, "file");
    ASSERT_TRUE(again) << to_string(again.error().front());
    EXPECT_EQ(again->mark, kMark);
    EXPECT_TRUE(same(again->block, file.block)) << count;
    const auto range = range_of(*bytes, "file");
    ASSERT_TRUE(range);
    EXPECT_EQ(range->count, count);
    EXPECT_EQ(range->first_draw, 65536U);
  }
}

TEST(SampleFile, OfFailedSamplesAloneHasNoColumns) {
  SampleBlock block{.first_draw = 0, .count = 1};
  block.failed = {{0, "no"}};
  const auto again = decoded(*encoded({kMark, block}), "file");
  ASSERT_TRUE(again);
  EXPECT_TRUE(same(again->block, block));
}

TEST(SampleFile, RefusesABlockThatCannotHaveItsNames) {
  SampleBlock block = drawn(0, 3);
  block.columns[1].name = "characteristics/cone.form/more";
  const auto bytes = encoded({kMark, block});
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().front().message, ::testing::HasSubstr("cone.form/more"));
}

TEST(SampleFileLaws, NoChangedByteIsReadAsSamples) {
  const std::string bytes = *encoded({kMark, drawn(0, 3000)});
  const auto tries = proof::law_count<std::uint32_t>(4000, 150);
  for (std::uint32_t i = 0; i < tries; ++i) {
    const RandomKey key{.seed = 11, .draw = i};
    std::string changed = bytes;
    const auto at = static_cast<std::size_t>(uniform(key, 0) * static_cast<double>(bytes.size()));
    changed[at] = static_cast<char>(changed[at] ^ (1 << static_cast<int>(8 * uniform(key, 1))));
    EXPECT_FALSE(decoded(changed, "file")) << at;
  }
  EXPECT_FALSE(decoded(bytes.substr(0, bytes.size() / 2), "file"));
  EXPECT_FALSE(decoded("", "file"));
}

TEST_F(SampleFolders, HoldTheSameBytesForAnyJobsStepsAndInterruptions) {
  constexpr std::uint64_t kEnd = 2 * kDrawsPerPart + 3000;
  const auto whole = SampleFolder::open(folder_ / "whole", kMark, false);
  ASSERT_TRUE(compute(campaign(), *whole, Ranks(), kEnd));
  const auto expected = bytes_in(folder_ / "whole");
  EXPECT_EQ(expected.size(), 3U);

  std::vector<fs::path> jobs;
  for (std::uint64_t job = 0; job < 3; ++job) {
    jobs.push_back(folder_ / std::to_string(job));
    const auto own = SampleFolder::open(jobs.back(), kMark, false);
    Campaign part = campaign();
    part.job = job;
    part.jobs = 3;
    ASSERT_TRUE(compute(part, *own, Ranks(), kEnd));
  }
  const auto merged = SampleFolder::open(folder_ / "merged", kMark, false);
  EXPECT_EQ(merged->merge(jobs).value(), kEnd);
  EXPECT_EQ(bytes_in(folder_ / "merged"), expected);
  const auto without = merged->merge(std::span(jobs).subspan(1));
  ASSERT_FALSE(without);
  EXPECT_THAT(without.error().front().message, ::testing::HasSubstr("draw 0 is missing"));

  int calls = 0;
  for (bool complete = false; !complete;) {
    const auto again = SampleFolder::open(folder_ / "again", kMark, calls > 0);
    ASSERT_TRUE(again) << to_string(again.error().front());
    Campaign some = campaign();
    some.keep_steps = calls % 2 == 0;
    int steps = 0;
    some.interrupted = [&] { return ++steps > 17 + calls % 5; };
    const auto end = compute(some, *again, Ranks(), kEnd);
    ASSERT_TRUE(end);
    complete = *end == CampaignEnd::complete;
    ASSERT_LT(++calls, 100);
  }
  EXPECT_GT(calls, 5);
  EXPECT_EQ(bytes_in(folder_ / "again"), expected);
}

TEST_F(SampleFolders, GrowAndEndWhereTheStudyDoes) {
  const auto folder = SampleFolder::open(folder_, kMark, false);
  ASSERT_TRUE(compute(campaign(), *folder, Ranks(), 4096));
  const auto few = bytes_in(folder_);
  std::uint64_t evaluated = 0;
  Campaign more = campaign();
  more.progress = [&](std::uint64_t draws) { evaluated += draws; };
  ASSERT_TRUE(compute(more, *folder, Ranks(), kDrawsPerPart + 10));
  EXPECT_EQ(evaluated, kDrawsPerPart + 10);
  EXPECT_EQ(bytes_in(folder_).size(), 2U);
  ASSERT_TRUE(folder->end_at(4096));
  EXPECT_EQ(bytes_in(folder_), few);
}

TEST_F(SampleFolders, RefuseAnotherStudyAndComputeAgainWhatIsBroken) {
  const auto folder = SampleFolder::open(folder_, kMark, false);
  ASSERT_TRUE(compute(campaign(), *folder, Ranks(), 2000));
  const auto expected = bytes_in(folder_);
  const auto other = SampleFolder::open(folder_, {std::string(64, 'b'), 7}, true);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().front().id, "another-study"_id);
  EXPECT_EQ(bytes_in(folder_), expected) << "refused, and nothing removed";

  std::string broken = expected.begin()->second;
  broken.resize(broken.size() / 2);
  ASSERT_TRUE(write_whole_file(folder->part_file(0), broken));
  ASSERT_TRUE(write_whole_file(folder_ / "samples" / "part-000001.h5.part", broken));
  const auto again = SampleFolder::open(folder_, kMark, true);
  ASSERT_TRUE(again);
  ASSERT_TRUE(compute(campaign(), *again, Ranks(), 2000));
  EXPECT_EQ(bytes_in(folder_), expected);
}

TEST_F(SampleFolders, KeepWhatWasComputedWhenADrawOrADiskFails) {
  const auto folder = SampleFolder::open(folder_, kMark, false);
  Campaign failing = campaign();
  failing.keep_steps = true;
  failing.evaluate = [](std::uint64_t first, std::uint64_t count) -> Result<SampleBlock> {
    if (first >= 3 * kDrawsPerStep) return error("the model broke");
    return drawn(first, count);
  };
  const auto failed = compute(failing, *folder, Ranks(), 5000);
  ASSERT_FALSE(failed);
  EXPECT_EQ(bytes_in(folder_).size(), 3U) << "three steps are kept";
  ASSERT_TRUE(compute(campaign(), *folder, Ranks(), 5000));
  EXPECT_EQ(bytes_in(folder_).size(), 1U);
  EXPECT_TRUE(same(*folder->read(0), drawn(0, 5000)));
}

TEST(PackedChunk, GivesBackNoisyEqualAndWholeNumbers) {
  const auto key = [](std::uint32_t i) { return RandomKey{1, i, RandomPurpose::error_amount}; };
  std::vector<double> noisy, equal(5000, 0.25);
  std::vector<std::int64_t> whole;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    noisy.push_back(5.0 + uniform(key(i), 7));
    whole.push_back(i);
  }
  const auto packed_size = [](const auto& numbers, bool are_real) {
    const std::span bytes(reinterpret_cast<const unsigned char*>(numbers.data()),
                          numbers.size() * 8);
    const auto packed = packed_chunk(bytes, 8, are_real);
    std::vector<unsigned char> some(1000 * 8);
    EXPECT_TRUE(unpack_chunk(packed, 8, bytes.size(), some));
    EXPECT_TRUE(std::ranges::equal(some, bytes.first(some.size())));
    EXPECT_FALSE(unpack_chunk(std::span(packed).first(packed.size() - 1), 8, bytes.size(), some));
    return packed.size();
  };
  EXPECT_LT(packed_size(noisy, true), 5000U * 7);  // two of eight bytes hardly change
  EXPECT_LT(packed_size(equal, true), 1000U);
  EXPECT_LT(packed_size(whole, false), 1000U);
}

}  // namespace
}  // namespace frustum::studies
