#include "core/ply.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace frustum {
namespace {

using testing::HasSubstr;

constexpr const char* kHeader =
    "ply\nformat ascii 1.0\ncomment unit: inch\nelement vertex 2\nproperty float x\n"
    "property list uchar int tags\nproperty float64 z\nend_header\n";

Diagnostic header_fault_of(const std::string& bytes) {
  const auto header = read_ply_header(bytes);
  return header ? Diagnostic{} : header.error().front();
}

TEST(Ply, ReadsTheHeaderAndItsComments) {
  const auto header = read_ply_header(std::string(kHeader) + "1 0 2\n");
  ASSERT_TRUE(header);
  ASSERT_EQ(header->elements.size(), 1U);
  const PlyElement& vertex = header->elements.front();
  EXPECT_EQ(vertex.count, 2U);
  EXPECT_EQ(vertex.value_column("z"), 2U);
  EXPECT_EQ(vertex.list_column("tags"), 1U);
  EXPECT_FALSE(vertex.value_column("tags"));
  ASSERT_EQ(header->comments.size(), 1U);
  EXPECT_EQ(header->comments.front().line, 3);
  EXPECT_EQ(header->comments.front().text, " unit: inch");
  EXPECT_EQ(header->lines, 8);
}

TEST(Ply, ReadsRowsOfValuesAndLists) {
  const std::string bytes = std::string(kHeader) + "1.5 2 7 8 -2\n4 0 1e3\n";
  const auto header = read_ply_header(bytes);
  ASSERT_TRUE(header);
  PlyBody body(bytes, *header);
  PlyRow row;
  ASSERT_FALSE(body.read(header->elements[0], 0, row));
  EXPECT_EQ(row.values[0], 1.5);
  EXPECT_THAT(row.lists[1], testing::ElementsAre(7.0, 8.0));
  EXPECT_EQ(row.values[2], -2.0);
  ASSERT_FALSE(body.read(header->elements[0], 1, row));
  EXPECT_TRUE(row.lists[1].empty());
  EXPECT_EQ(row.values[2], 1000.0);
  const auto ended = body.read(header->elements[0], 1, row);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->id, "file-cut-short"_id);
  EXPECT_THAT(ended->message, HasSubstr("ends within vertex 2 of 2"));
}

TEST(Ply, SaysWhatIsWrongInARow) {
  const std::string bytes = std::string(kHeader) + "1.5 0\nzero\n";
  const auto header = read_ply_header(bytes);
  ASSERT_TRUE(header);
  PlyRow row;
  const auto found = PlyBody(bytes, *header).read(header->elements[0], 0, row);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->id, "number-expected"_id);
  EXPECT_EQ(found->line, 10);
  EXPECT_THAT(found->message, HasSubstr("vertex 1 of 2 holds 'zero'"));
}

TEST(Ply, SaysWhatIsWrongInAHeader) {
  EXPECT_THAT(header_fault_of("polygon\n").message, HasSubstr("begins with the line 'ply'"));
  EXPECT_EQ(header_fault_of("ply\nelement vertex 1\nproperty quad x\n").line, 3);
  EXPECT_THAT(header_fault_of("ply\nformat cuneiform 1.0\n").message, HasSubstr("'cuneiform'"));
  EXPECT_THAT(header_fault_of("ply\nelement vertex -1\n").message,
              HasSubstr("'-1' is not a count"));
  EXPECT_THAT(header_fault_of("ply\nformat ascii 1.0\n").message, HasSubstr("no end_header"));
  EXPECT_THAT(header_fault_of("ply\nend_header\n").message, HasSubstr("names no format"));
  for (const char* bytes : {"", "ply\nproperty float x\n", "ply\nelement\n"}) {
    EXPECT_EQ(header_fault_of(bytes).id, "ply-header"_id) << bytes;
  }
}

}  // namespace
}  // namespace frustum
