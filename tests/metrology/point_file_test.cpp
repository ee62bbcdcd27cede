#include "metrology/point_file.hpp"

#include <gtest/gtest.h>

namespace frustum::metrology {
namespace {

std::string complaint(std::string_view text) {
  const auto points = parse_feature_points(text, "p.csv");
  return points ? "" : to_string(points.error().front());
}

TEST(PointFile, ReadsColumnsAndCommas) {
  for (const char* text : {"1 2 3\n4 5 6\n", "2\n1,2,3\r\n4, 5 ,6",
                           "# mm\nx,y,z\n\n1,2,3\n4,5,6 # last", "  1\t2\t3  \n+4 5e0 6.0"}) {
    const auto points = parse_feature_points(text);
    ASSERT_TRUE(points) << text << to_string(points.error().front());
    ASSERT_EQ(points->size(), 1U) << text;
    EXPECT_EQ(points->front().points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}})) << text;
    EXPECT_TRUE(points->front().sections.empty());
  }
}

TEST(PointFile, SortsPointsByFeature) {
  const auto points =
      parse_feature_points("feature,section,x,y,z\nA,0,1,2,3\ncone,2,4,5,6\nA,1,7,8,9\n");
  ASSERT_TRUE(points) << to_string(points.error().front());
  ASSERT_EQ(points->size(), 2U);
  EXPECT_EQ((*points)[0].feature, "A");
  EXPECT_EQ((*points)[0].points, (std::vector<Vec3>{{1, 2, 3}, {7, 8, 9}}));
  EXPECT_EQ((*points)[0].sections, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ((*points)[1].sections, (std::vector<std::size_t>{2}));
}

TEST(PointFile, NamesLineAndColumnOfEveryMistake) {
  EXPECT_EQ(complaint("1,2\n"),
            "p.csv:1:3: error: 2 columns, expected 3 (hint: a line holds x, y, z)");
  EXPECT_EQ(complaint("1 2 3\n4 nan 6\n"),
            "p.csv:2:3: error: 'nan' is not a finite number (hint: y expected here)");
  EXPECT_EQ(complaint("1 2 3\n4 5 6x\n"),
            "p.csv:2:5: error: '6x' is not a finite number (hint: z expected here)");
  EXPECT_EQ(complaint("1 2 1e999\n"),
            "p.csv:1:5: error: '1e999' is not a finite number (hint: z expected here)");
  EXPECT_EQ(complaint("feature,sektion,x,y,z\n"),
            "p.csv:1:9: error: unknown column 'sektion' (hint: did you mean section?)");
  EXPECT_EQ(complaint("feature,x,y\nA,1,2\n"),
            "p.csv:1:1: error: the header has no column 'z' (hint: a point needs x, y and z)");
  EXPECT_EQ(complaint("3\n1 2 3\n"),
            "p.csv: error: the first line announces 3 points, the file holds 1 (hint: correct the "
            "count or leave the line out)");
  EXPECT_EQ(complaint("# nothing\n"),
            "p.csv: error: the file holds no points (hint: write one point x y z (mm) a line)");
  EXPECT_EQ(
      complaint("feature,section,x,y,z\nA,1.5,1,2,3\n"),
      "p.csv:2:3: error: '1.5' is not a section (hint: sections are whole numbers, the first is "
      "0)");
}

}  // namespace
}  // namespace frustum::metrology
