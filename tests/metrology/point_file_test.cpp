#include "metrology/points/point_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "metrology/plan/point_scale.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/points/ply_points.hpp"

namespace frustum::metrology {
namespace {

std::string point_file_complaint(std::string_view text) {
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
  EXPECT_EQ(point_file_complaint("1,2\n"),
            "p.csv:1:3: error: 2 columns, expected 3 (hint: a line holds x, y, z)");
  EXPECT_EQ(point_file_complaint("1 2 3\n4 nan 6\n"),
            "p.csv:2:3: error: 'nan' is not a finite number (hint: y expected here)");
  EXPECT_EQ(point_file_complaint("1 2 3\n4 5 6x\n"),
            "p.csv:2:5: error: '6x' is not a finite number (hint: z expected here)");
  EXPECT_EQ(point_file_complaint("1 2 1e999\n"),
            "p.csv:1:5: error: '1e999' is not a finite number (hint: z expected here)");
  EXPECT_EQ(point_file_complaint("# unit: inch\n1 2 1e308\n"),
            "p.csv:2:5: error: '1e308' is not a finite number of mm (hint: z expected here)");
  EXPECT_EQ(point_file_complaint("feature,sektion,x,y,z\n"),
            "p.csv:1:9: error: unknown column 'sektion' (hint: did you mean section?)");
  EXPECT_EQ(point_file_complaint("feature,x,y\nA,1,2\n"),
            "p.csv:1:1: error: the header has no column 'z' (hint: a point needs x, y and z)");
  EXPECT_EQ(point_file_complaint("3\n1 2 3\n"),
            "p.csv: error: the first line announces 3 points, the file holds 1 (hint: correct the "
            "count or leave the line out)");
  EXPECT_EQ(point_file_complaint("# nothing\n"),
            "p.csv: error: the file holds no points (hint: write one point x y z (mm) a line)");
  EXPECT_EQ(
      point_file_complaint("feature,section,x,y,z\nA,1.5,1,2,3\n"),
      "p.csv:2:3: error: '1.5' is not a section (hint: sections are whole numbers, the first is "
      "0)");
}

TEST(PointFile, Fault2_60_NamesADecimalComma) {
  for (const char* line : {"1,5 2,25 3", "1,5, 2,5, 3,5", "1 2 3\n4,5 6 7", "1 2 3\n4,5;6;7"}) {
    EXPECT_NE(point_file_complaint(line).find("is written with a decimal comma"), std::string::npos)
        << line << ": " << point_file_complaint(line);
  }
  EXPECT_EQ(point_file_complaint("1 2 3\n1 2,5 3\n"),
            "p.csv:2:3: error: '2,5' is written with a decimal comma (hint: write a decimal point, "
            "or separate all columns by semicolons or by tabs: then decimal commas are read)");
}

TEST(PointFile, Fault2_60_ReadsUtf16AndLinesThatEndWithCr) {
  const std::string text = "feature,x,y,z\n\u2300 \u00e4,1,2,3\n\U0001F600,4,5,6\n";
  const auto utf16 = [](const std::u16string& units, bool big, bool mark) {
    std::string bytes;
    const auto add = [&](unsigned unit) {
      const char low = static_cast<char>(unit & 0xFFU), high = static_cast<char>(unit >> 8U);
      bytes += big ? std::string{high, low} : std::string{low, high};
    };
    if (mark) add(0xFEFFU);
    for (const char16_t unit : units) add(unit);
    return bytes;
  };
  const std::u16string wide = u"feature,x,y,z\r\n\u2300 \u00e4,1,2,3\r\n\U0001F600,4,5,6\r\n";
  std::string by_cr = text;
  std::replace(by_cr.begin(), by_cr.end(), '\n', '\r');
  for (const std::string& bytes :
       {text, by_cr, "\xEF\xBB\xBF" + by_cr, utf16(wide, false, true), utf16(wide, true, true),
        utf16(wide, false, false), utf16(wide, true, false)}) {
    const auto points = parse_feature_points(bytes);
    ASSERT_TRUE(points) << to_string(points.error().front());
    ASSERT_EQ(points->size(), 2U);
    EXPECT_EQ((*points)[0].feature, "\u2300 \u00e4");
    EXPECT_EQ((*points)[1].feature, "\U0001F600");
    EXPECT_EQ((*points)[1].points, (std::vector<Vec3>{{4, 5, 6}}));
    EXPECT_EQ((*points)[1].lines, std::vector<int>{3});
  }
  EXPECT_EQ(point_file_complaint(utf16(wide, false, true) + "1"),
            "p.csv: error: the file is UTF-16 and ends within a character (hint: save the file as "
            "UTF-8)");
  EXPECT_EQ(point_file_complaint(utf16(wide + u"\xD800", true, true)),
            "p.csv: error: the file is UTF-16 and has half a character (hint: save the file as "
            "UTF-8)");
  EXPECT_EQ(point_file_complaint(std::string("\xFF\xFE\0\0"
                                             "1\0\0\0",
                                             8)),
            "p.csv: error: the file is UTF-32 (hint: save the file as UTF-8)");
}

TEST(PointFile, Fault2_60_ReadsPointsWithTheirDirections) {
  for (const char* text :
       {"x,y,z,i,j,k\n1,2,3,0.6,0.8,0\n4,5,6,0,0,7\n", "1 2 3 0.577 0.577 0.577\n4 5 6 0 -1 0\n",
        "i;j;k;x;y;z\n0;0;1;1;2;3\n0;0;1;4;5;6\n"}) {
    const auto points = parse_feature_points(text);
    ASSERT_TRUE(points) << text << to_string(points.error().front());
    EXPECT_EQ(points->front().points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}})) << text;
  }
  EXPECT_EQ(point_file_complaint("1,2,3,4,5,6\n"),
            "p.csv:1:7: error: 6 columns, and the last three are no unit direction (hint: a line "
            "holds x, y, z, or x, y, z and the direction i, j, k of length 1; decimals have a "
            "point)");
  EXPECT_NE(point_file_complaint("1 2 3 0 0 1\n1 2 3 0 0 2\n").find("p.csv:2:7"),
            std::string::npos);
  // Directions are no lengths: no factor applies to them, and they state no unit.
  const auto inch = parse_feature_points("# unit: inch\n1 2 3 0 0 1\n");
  ASSERT_TRUE(inch);
  EXPECT_EQ(inch->front().points.front(), Vec3(25.4, 50.8, 3 * 25.4));
  EXPECT_NE(point_file_complaint("x,y,z,i [inch],j,k\n").find("not a unit for column 'i'"),
            std::string::npos);
}

TEST(PointFile, Fault2_60_TakesTheApostropheOffANameThatIsNoFormula) {
  const auto points =
      parse_feature_points("feature,x,y,z\n'=1,1,2,3\n''=1,1,2,3\n'quoted,1,2,3\n=1,4,5,6\n");
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), 3U);
  EXPECT_EQ((*points)[0].feature, "=1");
  EXPECT_EQ((*points)[0].points.size(), 2U);
  EXPECT_EQ((*points)[1].feature, "'=1");
  EXPECT_EQ((*points)[2].feature, "'quoted");
}

TEST(PointFile, Fault2_60_ShortensWhatNobodyReads) {
  const std::string digits(5000000, '7');
  for (const std::string& text : {digits + " 1 2\n", "1 2 " + digits + "x\n", digits + ".5\n"}) {
    EXPECT_LT(point_file_complaint(text).size(), 300U);
  }
}

TEST(PointFile, HonoursTheUnitThatAFileStates) {
  for (const char* text : {"# unit: inch\n1 2 3\n", "# Units = IN\n1,2,3\n", "# inch\n1 2 3\n",
                           "x [inch],y [inch],z [inch]\n1,2,3\n", "x_in,y_in,z_in\n1,2,3\n",
                           "x (inches),y_in,z_in\n1,2,3 # no comment is too late\n",
                           "# unit: inch\nx [inch],y,z\n1,2,3\n"}) {
    const auto points = parse_feature_points(text);
    ASSERT_TRUE(points) << text << to_string(points.error().front());
    EXPECT_LT((points->front().points.front() - Vec3(25.4, 50.8, 76.2)).norm(), 1e-13) << text;
  }
  const auto um = parse_feature_points("x [\u00b5m],y [um],z_um\n1000,0,0\n");
  ASSERT_TRUE(um);
  EXPECT_EQ(um->front().points.front(), Vec3(1, 0, 0));
  // What the caller knows counts where the file says nothing, and only there.
  const auto inch = length_unit("inch");
  EXPECT_EQ(parse_feature_points("10 0 0\n", {}, inch)->front().points.front(), Vec3(254, 0, 0));
  EXPECT_EQ(parse_feature_points("# inch\n10 0 0\n", {}, inch)->front().points.front(),
            Vec3(254, 0, 0));
  // The unit that the other columns have anyway.
  EXPECT_EQ(parse_feature_points("x_mm,y,z\n1,2,3\n")->front().points.front(), Vec3(1, 2, 3));
}

TEST(PointFile, RefusesUnitsThatItCannotHonour) {
  EXPECT_EQ(point_file_complaint("# unit: furlong\n1 2 3\n"),
            "p.csv:1:1: error: 'furlong' is not a unit of length (hint: write unit: mm, um, nm, "
            "cm, m or inch)");
  EXPECT_EQ(point_file_complaint("x [deg],y,z\n1,2,3\n"),
            "p.csv:1:1: error: 'deg' is not a unit for column 'x' (hint: mm, um, nm, cm, m or "
            "inch)");
  EXPECT_EQ(point_file_complaint("x [mm],y [inch],z\n1,2,3\n"),
            "p.csv:1:8: error: the unit is inch here, mm before (hint: a file has one unit)");
  EXPECT_EQ(point_file_complaint("x_um,y,z\n1,2,3\n"),
            "p.csv:1:8: error: 'x_um' states a unit, 'z' does not (hint: state the unit at each of "
            "x, y and z, or once above: # unit: um)");
  const auto said = parse_feature_points("# mm\n10 0 0\n", "p.csv", length_unit("inch"));
  ASSERT_FALSE(said);
  EXPECT_EQ(to_string(said.error().front()),
            "p.csv:1:1: error: the file states the unit mm, --unit says inch (hint: leave --unit "
            "out, or correct the file)");
  EXPECT_EQ(point_file_complaint("1 2 3\n# unit: um\n4 5 6\n"),
            "p.csv:2:1: error: the unit um is after points (hint: state it before the first "
            "point)");
}

TEST(PointFile, TellsEmptyFilesFromDirectoriesAndFromNone) {
  const std::string folder = testing::TempDir();
  const std::string empty = folder + "frustum_empty.csv";
  std::ofstream(empty).close();
  const auto message = [](const std::string& file) {
    const auto points = read_feature_points(file);
    return points ? std::string() : points.error().front().message;
  };
  EXPECT_EQ(message(empty), "the file holds no points");
  EXPECT_EQ(message(folder), "this is a directory, not a file of points");
  EXPECT_EQ(message(folder + "frustum_none.csv"), "the file cannot be read");
}

TEST(PointFile, KnowsWhereEachFeatureBegins) {
  const auto points = parse_feature_points("feature,x,y,z\nA,1,2,3\nA,4,5,6\n\nB,1,2,3\n", "p.csv");
  ASSERT_TRUE(points);
  EXPECT_EQ(points->at(1).file, "p.csv");
  EXPECT_EQ(points->at(0).line, 2);
  EXPECT_EQ(points->at(1).line, 5);
}

TEST(PointFile, ReadsQuotedNamesAndByteOrderMarks) {
  const auto points = parse_feature_points(
      "\xef\xbb\xbf"
      "feature,x,y,z\r\n\"bore, \"\"upper\"\" #1\",1,2,3\r\n");
  ASSERT_TRUE(points) << to_string(points.error().front());
  EXPECT_EQ(points->front().feature, "bore, \"upper\" #1");
}

TEST(PointFile, OfSeveralFeaturesIsNoCloud) {
  const auto file = std::filesystem::path(testing::TempDir()) / "several.csv";
  std::ofstream(file) << "feature,x,y,z\na,1,2,3\nb,4,5,6\na,7,8,9\n";
  const auto cloud = read_point_cloud(file);
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().front().message, "the file has points of 2 features: a, b");
  std::ofstream(file) << "feature,x,y,z\na,1,2,3\na,7,8,9\n";
  ASSERT_TRUE(read_point_cloud(file));
  EXPECT_EQ(read_point_cloud(file)->points.size(), 2U);
}

TEST(PointFile, KeepsWeightsForFitsAndRefusesThemForPlans) {
  const std::string file = testing::TempDir() + "frustum_weights.csv";
  std::ofstream(file) << "x,y,z,weight\n1,2,3,0.5\n4,5,6,2\n";
  const auto cloud = read_point_cloud(file);
  ASSERT_TRUE(cloud) << to_string(cloud.error().front());
  EXPECT_EQ(cloud->weights, (std::vector<double>{0.5, 2.0}));
  EXPECT_EQ(cloud->points[1], Vec3(4, 5, 6));
  EXPECT_FALSE(read_feature_points(file));
  EXPECT_EQ(point_file_complaint("x,y,z,weight\n1,2,3,-1\n"),
            "p.csv:2:7: error: '-1' is not a weight (hint: weights are 0 or more)");
}

// The number as bytes of one order or the other.
template <typename T>
std::string raw(T value, bool big) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST(PlyPoints, ReadsTextAndBothByteOrders) {
  const std::vector<Vec3> expected{{1.5, -2.0, 3.25}, {4.0, 5.0, -6.5}};
  const std::string text =
      "ply\nformat ascii 1.0\ncomment made by hand\nelement note 2\nproperty list uchar int "
      "word\nelement vertex 2\nproperty float x\nproperty uchar red\nproperty double z\n"
      "property float y\nend_header\n2 7 8\n0\n1.5 255 3.25 -2\n4 0 -6.5 5\n";
  const auto read = parse_ply_points(text);
  ASSERT_TRUE(read) << to_string(read.error().front());
  EXPECT_EQ(read->points, expected);
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\ncomment units: inch\nelement note 1\nproperty list uchar "
                        "short word\nelement vertex 2\nproperty double x\nproperty float32 y\n"
                        "property int8 flag\nproperty double z\nend_header\n";
    bytes += raw<std::uint8_t>(2, big) + raw<std::int16_t>(7, big) + raw<std::int16_t>(8, big);
    for (const Vec3& p : expected) {
      bytes += raw(p.x(), big) + raw(static_cast<float>(p.y()), big) + raw<std::int8_t>(-1, big) +
               raw(p.z(), big);
    }
    const auto binary = parse_ply_points(bytes);
    ASSERT_TRUE(binary) << to_string(binary.error().front());
    EXPECT_EQ(binary->points, expected) << big;
    EXPECT_EQ(binary->unit, length_unit("inch"));
    // Cut anywhere within the vertices, it is refused.
    for (std::size_t cut = 1; cut < 42; cut += 5) {
      EXPECT_FALSE(parse_ply_points(bytes.substr(0, bytes.size() - cut))) << cut;
    }
  }
}

TEST(PlyPoints, NamesWhatIsWrong) {
  const auto fault = [](const std::string& rest) {
    const auto read = parse_ply_points("ply\nformat ascii 1.0\n" + rest);
    if (read) return std::string();
    return fmt::format("{}: {}", read.error().front().line, read.error().front().message);
  };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_NE(fault("element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n")
                .find("no property z"),
            std::string::npos);
  EXPECT_NE(
      fault("element vertex 1\n" + xyz + "1 nan 2\n").find("8: vertex 1 of the PLY is not finite"),
      std::string::npos);
  EXPECT_NE(fault("element vertex 1\n" + xyz + "1 a 2\n").find("8: vertex 1 of 1 holds"),
            std::string::npos);
  EXPECT_NE(fault("element vertex 2\n" + xyz + "1 2 3\n").find("ends within vertex 2 of 2"),
            std::string::npos);
  EXPECT_NE(fault("element vertex 1\nproperty quad x\n").find("'quad' is no type"),
            std::string::npos);
  EXPECT_NE(fault("comment unit: cubit\nelement vertex 0\n" + xyz).find("'cubit' is not a unit"),
            std::string::npos);
  EXPECT_NE(fault("element face 0\nend_header\n").find("has no vertices"), std::string::npos);
}

TEST(PointScale, TellsUnitsFromParts) {
  InspectionPlan plan;
  PlannedFeature bore;
  bore.name = "bore";
  bore.kind = FeatureKind::cylinder;
  bore.radius = 20.0;
  bore.strategy = SectionStrategy{.sections = {0.0, 30.0}};
  plan.features = {bore};
  const auto fault = [&](double factor) {
    FeaturePoints measured{"bore", {}, {}};
    for (const PlannedPoint& p : planned_points(bore)) {
      measured.points.push_back(factor * p.point + Vec3(500, 0, 0));
    }
    const auto found = scale_fault(plan, std::vector{measured});
    return found ? to_string(*found) : "";
  };
  for (const double honest : {1.0, 0.3, 0.12, 3.0, 9.0}) EXPECT_EQ(fault(honest), "") << honest;
  EXPECT_NE(fault(1.0 / 25.4).find("look like inch (hint: state the unit with --unit inch"),
            std::string::npos)
      << fault(1.0 / 25.4);
  EXPECT_NE(fault(1e-3).find("look like m ("), std::string::npos);
  EXPECT_NE(fault(1.1e3).find("look like um"), std::string::npos);
  EXPECT_NE(fault(25.4).find("its numbers look like inches"), std::string::npos);
  const std::vector<Vec3> scan{{-30, -30, -5}, {30, 30, 40}};
  EXPECT_FALSE(scale_fault(plan, scan));
  const std::vector<Vec3> small{{-3, -3, -1}, {3, 3, 4}};
  EXPECT_TRUE(scale_fault(plan, small));
}

}  // namespace
}  // namespace frustum::metrology
