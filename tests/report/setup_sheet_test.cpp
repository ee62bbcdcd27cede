#include "report/sheet/setup_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "report/sheet/setup_drawing.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

SheetFace level(double half, double z) {
  return {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
}

// A cube on a wider plate, and two opposite steps over the plate, both fed along X.
SetupSheet small_sheet() {
  SetupSheet sheet;
  sheet.title = "Step patterns 1-a on zx-yac";
  sheet.facts = {{"Machine", "zx-yac"}, {"Tool", "end mill D20"}};
  sheet.workpiece = {level(40.0, 120.0), level(30.0, 150.0)};
  sheet.tilt_axis = "A";
  sheet.turn_axis = "C";
  sheet.tool_radius = 10.0;
  sheet.tool_length = 45.0;
  SheetStep c{.name = "1-a c", .cuts = "S by the side edge", .table = "A0 C0", .size = "H 120.5"};
  c.from = {60.0, -40.0, 120.5};
  c.to = {-60.0, -40.0, 120.5};
  c.line_from = {25.0, -30.0, 120.5};
  c.line_to = {-25.0, -30.0, 120.5};
  c.opposite = {0.0, 30.0, 120.5};
  c.height = 120.5;
  c.width = 60.0;
  c.first_line = 14;
  c.last_line = 25;
  SheetStep d = c;
  d.name = "1-a d";
  d.table = "A0 C-180";
  d.machine_from_workpiece = rotation_z(3.14159265358979323846);
  sheet.steps = {c, d};
  return sheet;
}

// The number after ` name="` of the element that is before `content`.
double attribute_before(const std::string& svg, const std::string& content, const char* name) {
  const auto at = svg.find(content);
  EXPECT_NE(at, std::string::npos) << content;
  const std::string mark = std::string(" ") + name + "=\"";
  const auto from = svg.rfind(mark, at);
  return std::stod(svg.substr(from + mark.size()));
}

TEST(SetupSheet, HoldsEveryFactAndEveryStepWithItsPositions) {
  const std::string page = setup_sheet(small_sheet());
  for (const char* text :
       {"<dt>Tool</dt><dd>end mill D20</dd>", ">1-a c</td>", ">1-a d</td>", ">A0 C-180</td>",
        ">60.000</td>", ">\u221260.000</td>", ">120.500</td>", "14\u201325", "S by the side edge",
        "aria-label=\"step 1-a c\"", "aria-label=\"step 1-a d\"", ">L 60</text>", ">H 120.5</text>",
        ">G54</text>"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

TEST(SetupSheet, OpensWithoutANetwork) {
  const std::string page = setup_sheet(small_sheet());
  for (const char* word : {"http", "url(", "@import", "src=", "href=", "<script"}) {
    EXPECT_THAT(page, Not(HasSubstr(word)));
  }
}

TEST(SetupSheet, EscapesEveryText) {
  SetupSheet sheet = small_sheet();
  const std::string hostile = "\"><script>alert(1)</script>";
  sheet.title = sheet.tilt_axis = sheet.turn_axis = hostile;
  sheet.facts = {{hostile, hostile}};
  for (SheetStep& step : sheet.steps) {
    step.name = step.cuts = step.table = step.size = hostile;
  }
  const std::string page = setup_sheet(sheet);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("aria-label=\"step &quot;&gt;&lt;script"));
}

TEST(SetupSheet, MarksTheHeightBesideThePartAwayFromTheTool) {
  const SetupSheet sheet = small_sheet();
  const std::string c = step_drawing(sheet, sheet.steps[0], SheetView::along_x);
  // Half of the cube stands right of the middle of the line opposite: beyond it is free.
  EXPECT_GT(attribute_before(c, ">H 120.5</text>", "x"), attribute_before(c, ">L 60</text>", "x"));
  // The tool is on the left, over the line that is cut.
  EXPECT_LT(attribute_before(c, ">H 120.5</text>", "x"), 320.0);
  EXPECT_THAT(step_drawing(sheet, sheet.steps[0], SheetView::from_top), Not(HasSubstr(">H ")));
  // Tilted, a height is none.
  SheetStep tilted = sheet.steps[0];
  tilted.machine_from_workpiece = rotation_x(0.5);
  EXPECT_THAT(step_drawing(sheet, tilted, SheetView::along_x), Not(HasSubstr(">H ")));
}

TEST(SetupSheet, WritesThePageOrNamesTheFile) {
  const auto written = write_setup_sheet(testing::TempDir() + "setup.html", small_sheet());
  ASSERT_TRUE(written);
  std::ostringstream content;
  content << std::ifstream(*written).rdbuf();
  EXPECT_EQ(content.str(), setup_sheet(small_sheet()));
  const auto refused = write_setup_sheet("/no/such/folder/setup.html", small_sheet());
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error().front()), HasSubstr("/no/such/folder/setup.html"));
}

}  // namespace
}  // namespace frustum::report
