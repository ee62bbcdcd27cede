#include "core/whole_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace frustum {
namespace {

namespace fs = std::filesystem;

class WholeFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_ = fs::path(::testing::TempDir()) /
                     ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(WholeFile, WritesAndReplaces) {
  const fs::path file = folder_ / "a.txt";
  ASSERT_TRUE(write_whole_file(file, "first, and longer"));
  const auto again = write_whole_file(file, std::string("sec\0nd", 6));
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, file);
  EXPECT_EQ(content(file), std::string("sec\0nd", 6));
  EXPECT_EQ(files(), 1);
}

TEST_F(WholeFile, LeavesTheOldFileAndNothingElseWhenItCannotWrite) {
  const fs::path file = folder_ / "sub" / "a.txt";
  const auto written = write_whole_file(file, "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().front().file, file.string());
  EXPECT_EQ(files(), 0);
}

TEST_F(WholeFile, ReadsAllBytes) {
  const fs::path file = folder_ / "a.bin";
  for (const std::string& bytes :
       {std::string(), std::string("a\0\r\n\xff", 5), std::string(200000, 'x')}) {
    ASSERT_TRUE(write_whole_file(file, bytes));
    const auto read = read_whole_file(file);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, bytes);
  }
}

TEST_F(WholeFile, Attack3_2_ReadsNoDeviceWithoutEnd) {
  const auto read = read_whole_file("/dev/zero");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().front().id.text(), "file-unreadable");
  EXPECT_EQ(read.error().front().file, "/dev/zero");
}

TEST_F(WholeFile, SaysWhatCannotBeRead) {
  for (const fs::path& file : {folder_, folder_ / "absent"}) {
    const auto read = read_whole_file(file);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().id, "file-unreadable"_id);
    EXPECT_EQ(read.error().front().file, file.string());
  }
}

TEST_F(WholeFile, RefusesAFolder) {
  const auto written = write_whole_file(folder_, "x");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().front().message.find("it is a folder"), std::string::npos);
}

TEST_F(WholeFile, LeavesTheRestOfAnInterruptedWriteAlone) {
  std::ofstream(folder_ / "a.txt.part") << "somebody else's";
  ASSERT_TRUE(write_whole_file(folder_ / "a.txt", "mine"));
  EXPECT_EQ(content(folder_ / "a.txt"), "mine");
  EXPECT_EQ(content(folder_ / "a.txt.part"), "somebody else's");
}

}  // namespace
}  // namespace frustum
