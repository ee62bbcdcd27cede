// The player's page as HTML alone, and the numbers that its script reads.
#include "report/player/player_page.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "report/player/path_drawing.hpp"
#include "report/player/player_data.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

PlayerPage two_moves() {
  PlayerPage page;
  page.title = "A <slot>";
  page.facts = {{"Machine", "three & more"}};
  page.notes = {"no </script> here"};
  page.deviation = "of the tip.";
  page.joints = {{.letter = 'X', .side = -1},
                 {.letter = 'C', .rotary = true, .side = -1, .direction = Vec3::UnitZ()}};
  page.texts = {{"slot.nc", "G0 X1\nG1 X2 </script>\n"}};
  page.blocks = {{.line = 1, .is_rapid = true, .tool = 3}, {.line = 2, .tool = 3, .feed = 600.0}};
  page.points = {{.time = 0.5, .tip = {0, 0, 5}, .axes = {0.0, 0.1}, .block = 0, .starts = true},
                 {.time = 1.0, .tip = {1, 0, 5}, .axes = {1.0, 0.1}, .block = 0},
                 {.time = 2.0,
                  .tip = {2, 0, 5},
                  .deviation = {0.001, 0, -0.002},
                  .axes = {2.0, -0.2},
                  .block = 1}};
  return page;
}

TEST(PlayerPage, IsSafeHtmlWithALabelOnEveryControl) {
  const std::string html = player_html(two_moves());
  EXPECT_THAT(html, HasSubstr("A &lt;slot&gt;"));
  EXPECT_THAT(html, HasSubstr("three &amp; more"));
  EXPECT_THAT(html, HasSubstr("no &lt;/script&gt; here"));
  EXPECT_THAT(html, Not(HasSubstr("</script> here")));
  EXPECT_THAT(html, HasSubstr("aria-label=\"Time in the program, s\""));
  EXPECT_THAT(html, HasSubstr("feed, mm/min"));
  EXPECT_THAT(html, HasSubstr("deviation, µm"));
  EXPECT_THAT(html, HasSubstr("Feed of the tip, mm/min"));
  EXPECT_THAT(html, Not(HasSubstr("Workpiece</label>")));  // there is none
}

TEST(PlayerData, CountsFromTheSmallestOfEachColumn) {
  const auto data = nlohmann::json::parse(player_data(two_moves()))["player"];
  const auto& points = data["points"];
  EXPECT_EQ(points["count"], 3);
  EXPECT_EQ(points["tips"]["origin"], nlohmann::json({0.0, 0.0, 5.0}));
  EXPECT_EQ(points["tips"]["step"], 1e-4);
  EXPECT_EQ(points["deviations"]["origin"], nlohmann::json({0.0, 0.0, -0.002}));
  EXPECT_EQ(points["deviations"]["step"], 1e-6);
  EXPECT_EQ(points["linear"]["stride"], 1);
  EXPECT_EQ(points["rotary"]["origin"], nlohmann::json({-0.2}));
  EXPECT_EQ(points["starts"]["count"], 1);
  EXPECT_EQ(data["blocks"]["feeds"]["count"], 2);
  EXPECT_TRUE(data["steps"].empty());
}

// Times beyond an hour are counted in longer steps; nothing overflows.
TEST(PlayerData, KeepsAWeekWithin32Bits) {
  PlayerPage page = two_moves();
  page.points.back().time = 604800.0;
  const auto times = nlohmann::json::parse(player_data(page))["player"]["points"]["times"];
  EXPECT_LE(604800.0 / times["step"].get<double>(), 4294967295.0);
  EXPECT_LT(times["step"].get<double>(), 2e-4);
}

TEST(PathDrawing, DrawsRapidsApartFromFeeds) {
  const std::string html = path_drawing(two_moves());
  EXPECT_THAT(html, HasSubstr("class=\"wire\""));
  EXPECT_THAT(html, HasSubstr("class=\"wire s1 displaced\""));
  EXPECT_THAT(path_drawing({}), Not(HasSubstr("<path")));
}

}  // namespace
}  // namespace frustum::report
