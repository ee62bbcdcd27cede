// Tables of points as spreadsheets and CMM programs write them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "metrology/points/column_heading.hpp"
#include "metrology/points/point_file.hpp"

namespace frustum::metrology {
namespace {

std::string table_complaint(std::string_view text) {
  const auto points = parse_feature_points(text, "p.csv");
  return points ? "" : to_string(points.error().front());
}

const std::vector<Vec3> kTwoPoints{{1.5, -2.25, 3.0}, {1234.5, 0.0625, -6.0}};

void expect_two(std::string_view text) {
  const auto points = parse_feature_points(text, "p.csv");
  ASSERT_TRUE(points) << text << to_string(points.error().front());
  ASSERT_EQ(points->size(), 1U) << text;
  EXPECT_EQ(points->front().points, kTwoPoints) << text;
}

TEST(PointTable, ReadsDecimalCommasBetweenSemicolonsAndTabs) {
  for (const char* text :
       {"1,5;-2,25;3\n1234,5;0,0625;-6\n", "X;Y;Z\r\n1,5;-2,25;3,0\r\n1234,5;6,25e-2;-6,0\r\n",
        "sep=;\nx;y;z\n1,5;-2,25;3\n+1234,5;0,0625;-6\n", "2\n1,5;-2,25;3\n1234,5;0,0625;-6\n",
        "1,5\t-2,25\t3\n1234,5\t0,0625\t-6\n", "x\ty\tz\n 1,5\t-2,25 \t3,000\n1234,5\t0,0625\t-6\n",
        "1,5 ; -2,25 ; 3 # first\n\n1234,5;0,0625;-6\n",
        "i;j;k;z;y;x\n0,6;0,8;0;3;-2,25;1,5\n0;0;1;-6;0,0625;1234,5\n"}) {
    expect_two(text);
  }
  // A name is none of the numbers, whatever is in it.
  const auto named =
      parse_feature_points("Element;Nr;X;Y;Z\nA 1.5;1,2;1,5;2;3\n\"A;1,2\";2.1;4,5;5;6\n");
  ASSERT_TRUE(named) << to_string(named.error().front());
  ASSERT_EQ(named->size(), 2U);
  EXPECT_EQ((*named)[0].feature, "A 1.5");
  EXPECT_EQ((*named)[1].feature, "A;1,2");
  EXPECT_EQ((*named)[1].points, (std::vector<Vec3>{{4.5, 5, 6}}));
}

TEST(PointTable, ReadsWhatASpreadsheetSavesAsUnicode) {
  const std::u16string text =
      u"Punkt-Nr.\tX-Istwert [mm]\tY-Istwert [mm]\tZ-Istwert [mm]\r\n"
      u"1\t1,5\t-2,25\t3\r\n2\t1234,5\t0,0625\t-6\r\n";
  std::string bytes = "\xFF\xFE";
  for (const char16_t unit : text) {
    bytes += static_cast<char>(unit & 0xFFU);
    bytes += static_cast<char>(unit >> 8U);
  }
  expect_two(bytes);
  expect_two("\xEF\xBB\xBFX;Y;Z\r\n1,5;-2,25;3\r\n1234,5;0,0625;-6\r\n");
}

TEST(PointTable, TabsSeparateNamesWithBlanks) {
  const auto points =
      parse_feature_points("Element\tX Istwert\tY Istwert\tZ Istwert\nPlane 1\t1.5\t2\t3\n");
  ASSERT_TRUE(points) << to_string(points.error().front());
  EXPECT_EQ(points->front().feature, "Plane 1");
  EXPECT_EQ(points->front().points, (std::vector<Vec3>{{1.5, 2, 3}}));
  // Tabs beside blanks and commas are blanks, as before.
  for (const char* text :
       {"1.5\t\t-2.25\t3\n1234.5 0.0625 -6\n", "1.5,\t-2.25,\t3\n1234.5,\t0.0625,\t-6\n",
        "x,\ty,\tz\n1.5,-2.25,3\t\n1234.5,0.0625,-6\t\n"}) {
    expect_two(text);
  }
}

TEST(PointTable, NamesWhereSignsOfDecimalsDiffer) {
  EXPECT_EQ(table_complaint("x;y;z\n1,5;2;3\n4.5;5;6\n"),
            "p.csv:3:1: error: '4.5' has a point, '1,5' in line 2 a comma (hint: write all numbers "
            "of a table with the same sign of decimals)");
  EXPECT_EQ(table_complaint("1.5;2;3\n4;5,5;6\n"),
            "p.csv:2:3: error: '5,5' has a comma, '1.5' in line 1 a point (hint: write all numbers "
            "of a table with the same sign of decimals)");
  for (const char* number : {"1,234.5", "1.234,5", "1,234,567", "1.234.567"}) {
    EXPECT_EQ(table_complaint(fmt::format("x;y;z\n0,5;{};3\n", number)),
              fmt::format("p.csv:2:5: error: '{}' has more than one sign of decimals or thousands "
                          "(hint: write numbers without separators of thousands)",
                          number));
    EXPECT_NE(table_complaint(fmt::format("1\t2\t{}\n", number)).find("p.csv:1:5: error:"),
              std::string::npos);
  }
  // Where commas or blanks separate, a decimal comma is an error as before.
  EXPECT_NE(table_complaint("1,5 2,5 3,5\n")
                .find("p.csv:1:1: error: '1,5' is written with a decimal comma"),
            std::string::npos);
  EXPECT_NE(table_complaint("1,5;2;3\n1 2 3\n").find("is written with a decimal comma"),
            std::string::npos);
}

TEST(PointTable, DoesNotGuessWhatACommaBeforeThreeDigitsMeans) {
  const std::string doubtful = "x;y;z\n1,500;-2,250;3\n12,345;100,625;-6\n";
  EXPECT_EQ(table_complaint(doubtful),
            "p.csv:2:1: error: '1,500' may have a decimal comma or a separator of thousands: every "
            "comma here has three digits after it (hint: say which above the points: # decimal: "
            "comma; else leave separators out)");
  for (const char* shows : {"0,500", "-0,001", "1234,500", "1,50", "1,5000", "00,500"}) {
    EXPECT_EQ(table_complaint(doubtful + shows + ";1;1\n"), "") << shows;
  }
  EXPECT_EQ(table_complaint("# decimal: comma\n" + doubtful), "");
  EXPECT_EQ(table_complaint("# Decimal : Comma\n" + doubtful), "");
  EXPECT_EQ(
      table_complaint("# decimal: point\n" + doubtful),
      "p.csv:3:1: error: '1,500' has a comma, and the file states a point (hint: write numbers "
      "as the file says, or correct what it says)");
  EXPECT_NE(
      table_complaint("# decimal: dot\n" + doubtful).find("p.csv:1:1: error: 'dot' is not a sign"),
      std::string::npos);
}

TEST(PointTable, KnowsColumnsInEnglishAndGerman) {
  const auto name = [](std::string_view text) { return column_heading(text).name; };
  for (const char* text :
       {"X", "x [mm]", "X-Istwert", "x_act", "X Actual", "Ist X", "x_meas", "X / mm", "X in mm",
        "X-Koordinate [mm]", "x_act_mm", "X.Ist", "measured x", "x (mm)"}) {
    EXPECT_EQ(name(text), "x") << text;
  }
  for (const char* text :
       {"Z-Sollwert", "z_nom", "Nominal Z", "nominal_z", "Soll Z [mm]", "z theo"}) {
    EXPECT_EQ(name(text), "nominal_z") << text;
  }
  EXPECT_EQ(name("X-Abweichung"), "deviation_x");
  EXPECT_EQ(name("Abw."), "deviation");
  EXPECT_EQ(name("nx"), "i");
  EXPECT_EQ(name("Punkt-Nr."), "point");
  EXPECT_EQ(name("Schnitt"), "section");
  EXPECT_EQ(column_heading("Y-Istwert [inch]").unit, "inch");
  EXPECT_EQ(column_heading("x [\"]").unit, "inch");
  EXPECT_EQ(column_heading("x (\"\")").name, "x");
  EXPECT_EQ(column_heading("y_act_um").unit, "um");
  EXPECT_EQ(column_heading("Y in mm").unit, "mm");
  EXPECT_EQ(column_heading("y_in").unit, "in");
  // What may mean two things is not known.
  for (const char* text : {"Merkmal", "dx", "x y", "x_act_nom", "u", "xyz", "value", "X-Lage"}) {
    const auto known = known_columns();
    EXPECT_EQ(std::ranges::find(known, name(text)), known.end()) << text;
  }
}

TEST(PointTable, TakesUnitsFromHeadings) {
  const auto points = parse_feature_points(
      "X-Ist [inch];Y-Ist [inch];Z-Ist [inch];X-Soll [mm];X-Abw [\xc2\xb5m]\n1,5;2;3;25,4;7\n");
  ASSERT_TRUE(points) << to_string(points.error().front());
  EXPECT_EQ(points->front().points.front(), Vec3(1.5 * 25.4, 50.8, 3 * 25.4));
  // The micro sign of Windows-1252.
  const auto um = parse_feature_points("x [\xb5m];y [\xb5m];z [\xb5m]\n1500,5;2;3\n");
  ASSERT_TRUE(um) << to_string(um.error().front());
  EXPECT_DOUBLE_EQ(um->front().points.front().x(), 1.5005);
}

TEST(PointTable, RefusesColumnsByName) {
  EXPECT_EQ(
      table_complaint("X;Y;Z;Farbton\n1,5;2;3;4\n"),
      "p.csv:1:7: error: unknown column 'Farbton' (hint: known: feature, section, x, y, z, i, "
      "j, k, weight, nominal_x, nominal_y, nominal_z, deviation, deviation_x, deviation_y, "
      "deviation_z, point)");
  EXPECT_EQ(table_complaint("X;Y;Z;X-Istwert\n1,5;2;3;4\n"),
            "p.csv:1:7: error: 'X' and 'X-Istwert' are both column x (hint: each column once)");
}

TEST(PointTable, ReadsXyzijkFilesOfPcDmis) {
  const auto mm = parse_feature_points(
      "XYZIJK    METRIC\n1.5,2,3\n4,5,6,0,0,1\n7,8,9,0,0\n1,1,1,0,1,0,5,5\n", "part.xyz");
  ASSERT_TRUE(mm) << to_string(mm.error().front());
  ASSERT_EQ(mm->size(), 1U);
  EXPECT_EQ(mm->front().points, (std::vector<Vec3>{{1.5, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 1, 1}}));
  EXPECT_EQ(mm->front().lines, (std::vector<int>{2, 3, 4, 5}));
  const auto inch = parse_feature_points("XYZIJK\r\n1,2,3,0,0,1\r\n");
  ASSERT_TRUE(inch);
  EXPECT_EQ(inch->front().points.front(), Vec3(25.4, 50.8, 3 * 25.4));
  EXPECT_EQ(
      table_complaint("XYZIJK METRIC\n1,2,3\n"),
      "p.csv:1:8: error: 'METRIC' after XYZIJK does not state the unit (hint: METRIC in columns "
      "11 to 16 means mm, nothing there inches)");
  EXPECT_EQ(
      table_complaint("XYZIJK    METRIC\n25,280,750,25\n"),
      "p.csv:2:12: error: 4 numbers are a circle with its diameter, not a point (hint: export "
      "its measured points)");
  EXPECT_NE(table_complaint("XYZIJK\n1,2,3,0,0,1,8\n").find("7 numbers are a circle"),
            std::string::npos);
  EXPECT_NE(
      table_complaint("XYZIJK\n1,2\n").find("p.csv:2:3: error: 2 columns, expected 3, 5, 6 or 8"),
      std::string::npos);
  EXPECT_NE(
      table_complaint("XYZIJK\n1,2,3,a,0,1\n").find("p.csv:2:7: error: 'a' is not a finite number"),
      std::string::npos);
  const auto unlike = parse_feature_points("XYZIJK\n1,2,3\n", "p.csv", LengthUnit{"mm", 1.0});
  ASSERT_FALSE(unlike);
  EXPECT_EQ(unlike.error().front().id, "length-unit"_id);
}

TEST(PointTable, NamesTablesOfResultsThatHoldNoPoints) {
  EXPECT_EQ(
      table_complaint("planid\tpartnb\tid\ttype\tidsymbol\tactual\tnominal\tuppertol\tlowertol\n"
                      "ring\t1\tBore\tDurchmesser\tdiameter\t20.0\t20.0\t0.1\t-0.1\n"),
      "p.csv:1:1: error: a table of characteristics as Calypso writes it (_chr.txt) holds no "
      "points (hint: export the measured points of the features as text, one point a line)");
}

}  // namespace
}  // namespace frustum::metrology
