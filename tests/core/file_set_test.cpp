#include "core/file_set.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace frustum {
namespace {

namespace fs = std::filesystem;

class FileSets : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void put(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  [[nodiscard]] static Result<FileSet> opened(const fs::path& folder) {
    return FileSet::open(folder, {"result", "points", "page"});
  }
  // Both files say which set they are of.
  static bool write_set(const fs::path& folder, const std::string& text) {
    auto set = opened(folder);
    if (!set) return false;
    set->add("result", text);
    set->add("points", text);
    return set->write().has_value();
  }
  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(root_), fs::directory_iterator());
  }

  fs::path root_ = fs::path(::testing::TempDir()) /
                   ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path out_ = root_ / "made" / "out";
};

TEST_F(FileSets, Fault2_32_ReplacesASetAndKeepsWhatIsNotOfIt) {
  ASSERT_TRUE(write_set(out_, "old"));
  put(out_ / "page", "old");
  put(out_ / "notes.txt", "of the user");
  put(out_ / "photos" / "a.png", "of the user");
  fs::permissions(out_, fs::perms::owner_all | fs::perms::group_read);
  ASSERT_TRUE(write_set(out_, "new"));
  EXPECT_EQ(content(out_ / "result"), "new");
  EXPECT_EQ(content(out_ / "points"), "new");
  EXPECT_FALSE(fs::exists(out_ / "page")) << "a page of the older set beside the new result";
  EXPECT_EQ(content(out_ / "notes.txt"), "of the user");
  EXPECT_EQ(content(out_ / "photos" / "a.png"), "of the user");
  EXPECT_EQ(fs::status(out_).permissions(), fs::perms::owner_all | fs::perms::group_read);
  EXPECT_EQ(std::distance(fs::directory_iterator(out_.parent_path()), fs::directory_iterator()), 1);
}

TEST_F(FileSets, Fault2_32_IsOneWheneverTheRunIsKilled) {
  ASSERT_TRUE(write_set(out_, std::string(300'000, '0')));
  put(out_ / "notes.txt", "of the user");
  for (int round = 0; round < 30; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (char digit = '0';; digit = digit == '9' ? '0' : static_cast<char>(digit + 1)) {
        if (!write_set(out_, std::string(300'000, digit))) _exit(1);
      }
    }
    usleep(static_cast<useconds_t>(1000 + 371 * round));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "a set could not be written";
    ASSERT_EQ(content(out_ / "result"), content(out_ / "points")) << round;
    ASSERT_EQ(content(out_ / "result").size(), 300'000U) << round;
    ASSERT_EQ(content(out_ / "notes.txt"), "of the user") << round;
  }
  ASSERT_TRUE(write_set(out_, "last"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out_.parent_path()), fs::directory_iterator()), 1)
      << "what killed runs have left is removed";
}

TEST_F(FileSets, Fault2_32_TwoRunsDoNotWriteToOneFolder) {
  const auto first = opened(out_);
  ASSERT_TRUE(first);
  const auto second = opened(out_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().front().id, "output-in-use"_id);
  EXPECT_EQ(second.error().front().file, out_.string());
  EXPECT_TRUE(opened(root_ / "another"));
}

TEST_F(FileSets, Fault2_32_TheWorkingFolderStaysWhereItIs) {
  ASSERT_TRUE(write_set(out_, "old"));
  put(out_ / "page", "old");
  const fs::path before = fs::current_path();
  fs::current_path(out_);
  const bool written = write_set(".", "new");
  std::error_code gone;
  const fs::path here = fs::current_path(gone);
  fs::current_path(before);
  ASSERT_TRUE(written);
  EXPECT_FALSE(gone);
  EXPECT_EQ(here, fs::canonical(out_));
  EXPECT_EQ(content(out_ / "result"), "new");
  EXPECT_FALSE(fs::exists(out_ / "page"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out_), fs::directory_iterator()), 2);
}

TEST_F(FileSets, LeavesNoFolderWhereNothingWasWritten) {
  { ASSERT_TRUE(opened(out_)); }
  EXPECT_EQ(entries(), 0);
  put(root_ / "file", "");
  const auto refused = opened(root_ / "file");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().id, "file-unwritable"_id);
  EXPECT_FALSE(opened(root_ / "file" / "out"));
  EXPECT_EQ(entries(), 1);
}

TEST_F(FileSets, FollowsALinkToAFolder) {
  fs::create_directories(root_ / "disk");
  fs::create_directory_symlink(root_ / "disk", root_ / "out");
  ASSERT_TRUE(write_set(root_ / "out", "new"));
  EXPECT_TRUE(fs::is_symlink(root_ / "out"));
  EXPECT_EQ(content(root_ / "disk" / "points"), "new");
  auto set = opened(root_ / "out");
  ASSERT_TRUE(set);
  EXPECT_EQ(set->name_of(root_ / "disk" / "part.qif"), "part.qif");
  EXPECT_EQ(set->name_of(root_ / "out" / "sub" / "part.qif"), "sub/part.qif");
  EXPECT_EQ(set->name_of(root_ / "part.qif"), std::nullopt);
}

}  // namespace
}  // namespace frustum
