// The page of a motion test: traces over one another, tables, bars, and what the test tells.
#include "report/page/motion_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

PolarRound lobed(int lobes) {
  PolarRound round;
  for (int i = 0; i < 90; ++i) {
    const double angle = i * 0.07;
    round.push_back({angle, 3.0 * std::cos(lobes * angle), i > 0});
  }
  return round;
}

TEST(MotionPage, DrawsTracesOverOneAnother) {
  MotionPage page{.title = "<circle>"};
  page.polar = {{"ccw", lobed(2)}, {"cw", lobed(3)}, {"fitted", lobed(2), true}};
  page.charts = {{.title = "over",
                  .along_title = "angle, °",
                  .value_title = "µm",
                  .lines = {{.name = "up",
                             .along = {0.0, 1.0, 2.0},
                             .value = {1.0, 2.0, 1.0},
                             .half_width = {0.1, 0.2, 0.1},
                             .dots = true}}}};
  page.arrows = {{"B 0°", {{0.0, 1.0, 0.0}, {1.0, 0.0, 2.0}}}};
  const std::string html = motion_html(page);
  EXPECT_THAT(html, HasSubstr("&lt;circle&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("<circle>")));
  EXPECT_THAT(html, HasSubstr("class=\"trace dashed s3\""));
  EXPECT_EQ(times_in(html, "class=\"band s1\""), 1U);
  EXPECT_EQ(times_in(html, "class=\"dot s1\""), 3U);
  EXPECT_EQ(times_in(html, "<figure"), 3U);
  EXPECT_THAT(html, Not(HasSubstr("Ranked contributions"))) << "there are none";
}

TEST(MotionPage, SaysWhatIsToldAndWhatIsNot) {
  MotionPage page{.told = {"EA0A + EA0C"}, .not_told = {"EX0C<"}};
  page.contributions = {{"square", 0.6, "3.000 µm"}, {"residual", 0.4, "2.000 µm"}};
  page.tables = {{.heading = "Values", .columns = {"um", ">G"}, .rows = {{"ccw", "-4.5"}}}};
  page.remarks = {"no evaluation"};
  const std::string html = motion_html(page);
  EXPECT_THAT(html, HasSubstr("<p>EA0A + EA0C.</p>"));
  EXPECT_THAT(html, HasSubstr("<p>EX0C&lt;.</p>"));
  EXPECT_THAT(html, HasSubstr("−4.5"));
  EXPECT_EQ(times_in(html, "class=\"column s1\""), 2U);
  EXPECT_THAT(html, HasSubstr("no evaluation"));
}

TEST(MotionPage, OfNothingIsStillAPage) { EXPECT_THAT(motion_html({}), HasSubstr("</html>")); }

}  // namespace
}  // namespace frustum::report
