#include "core/csv.hpp"

#include <gtest/gtest.h>

namespace frustum {
namespace {

TEST(Csv, ReadsRowsWithTheirPlaces) {
  const auto table = CsvTable::parse(
      "\xEF\xBB\xBFname, value\r\n# a remark\r\n\r\nx, 1.5\r\n\"a, \"\"b\"\"\",-2e3\r\n", "t.csv",
      {"name", "value"});
  ASSERT_TRUE(table);
  ASSERT_EQ(table->rows().size(), 2u);
  EXPECT_EQ(table->rows()[0].line, 4);
  EXPECT_EQ(table->rows()[0].fields[1].column, 4);
  EXPECT_EQ(table->number(table->rows()[0], 1).value(), 1.5);
  EXPECT_EQ(table->rows()[1].fields[0].text, "a, \"b\"");
  EXPECT_EQ(table->number(table->rows()[1], 1).value(), -2000.0);
}

TEST(Csv, SaysWhatIsWrongAndWhere) {
  const auto fault = [](const char* text) {
    const auto table = CsvTable::parse(text, "t.csv", {"a", "b"});
    return table ? std::string() : to_string(table.error().front());
  };
  EXPECT_TRUE(fault("a,c\n1,2\n").starts_with("t.csv:1:1: error: the header is a,c"));
  EXPECT_TRUE(fault("a,b\n1\n").starts_with("t.csv:2:1: error: 1 field, the header has 2"));
  EXPECT_TRUE(fault("a,b\n1, \"2\n").starts_with("t.csv:2:4: error: this quote is not closed"));
  EXPECT_TRUE(fault("").starts_with("t.csv:1:1: error: the file has no header"));
  const auto table = CsvTable::parse("a,b\n1,nan\n2,x\n3,\n", "t.csv", {"a", "b"});
  ASSERT_TRUE(table);
  for (const CsvRow& row : table->rows()) {
    const auto number = table->number(row, 1);
    ASSERT_FALSE(number);
    EXPECT_EQ(number.error().front().line, row.line);
    EXPECT_EQ(number.error().front().id, "csv"_id);
  }
}

}  // namespace
}  // namespace frustum
