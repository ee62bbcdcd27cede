#include "core/files_read.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/file_set.hpp"
#include "core/whole_file.hpp"

namespace frustum {
namespace {

namespace fs = std::filesystem;

TEST(FilesRead, AreNotWrittenOverWhateverTheirNamesOnceThatIsAskedFor) {
  const fs::path folder = fs::path(::testing::TempDir()) / "files_read";
  fs::remove_all(folder);
  fs::create_directories(folder / "out");
  ASSERT_TRUE(write_whole_file(folder / "a.txt", "a"));
  ASSERT_TRUE(write_whole_file(folder / "b.txt", "b"));
  fs::create_symlink(folder / "a.txt", folder / "link.txt");
  fs::create_hard_link(folder / "a.txt", folder / "out" / "same.txt");

  ASSERT_TRUE(read_whole_file(folder / "a.txt"));
  ASSERT_TRUE(write_whole_file(folder / "a.txt", "a")) << "a library does not ask for it";
  fs::remove(folder / "out" / "same.txt");
  fs::create_hard_link(folder / "a.txt", folder / "out" / "same.txt");

  keep_what_is_read();
  ASSERT_TRUE(read_whole_file(folder / "link.txt"));
  ASSERT_TRUE(read_to_replace(folder / "b.txt"));
  EXPECT_TRUE(write_whole_file(folder / "b.txt", "c"));
  const auto refused = write_whole_file(folder / "a.txt", "c");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().id, "output-overwrites-input"_id);
  EXPECT_TRUE(unwritable(folder / "a.txt"));
  EXPECT_FALSE(FileSet::open(folder / "out", {"same.txt"}));
  auto set = FileSet::open(folder / "out", {"other.txt"});
  ASSERT_TRUE(set);
  set->add("same.txt", "c");
  EXPECT_FALSE(set->write());
  EXPECT_EQ(*read_to_replace(folder / "a.txt"), "a");
  EXPECT_FALSE(would_be_lost("/dev/null"));
  keep_what_is_read(false);
  EXPECT_TRUE(write_whole_file(folder / "a.txt", "c"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace frustum
