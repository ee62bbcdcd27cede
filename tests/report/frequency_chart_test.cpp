#include "report/chart/frequency_chart.hpp"

#include <gmock/gmock.h>

#include <regex>

#include "report/chart/heat_map.hpp"
#include "report/chart/mode_drawing.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::ptrdiff_t matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), regex),
                       std::sregex_iterator());
}

TEST(FrequencyChart, BreaksAPhaseWhereItGoesOverAndShadesWhatAHammerDoesNotTell) {
  FrequencyChart chart{"Force along x", "um/N", {}, {}};
  chart.lines = {{"x", {1, 2, 3, 4}, {1.0, 0.5, 0.2, 0.1}, {170, 179, -179, -170}, false}};
  chart.floor = {0.02, 0.01, 0.004, 0.002};
  const std::string html = frequency_figure(chart);
  // Of the two lines that of the phase is in two parts.
  EXPECT_EQ(matches(html, "class=\"trace s1\" d=\"M[^M\"]*\""), 1);
  EXPECT_EQ(matches(html, "class=\"trace s1\" d=\"M[^M\"]*M[^M\"]*\""), 1);
  EXPECT_EQ(matches(html, "class=\"below\" d=\"M[^\"]*Z\""), 1);
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(HeatMap, WritesValuesWhereThereIsRoomAndAScaleElse) {
  HeatMap map{"f1 Hz", "Y", "Z", {"0"}, {}, {}, {}};
  for (int k = 0; k < 20; ++k) {
    map.columns.push_back(std::to_string(k));
    map.values.emplace_back(38.25 + k);
  }
  const std::string many = heat_map_figure(map);
  EXPECT_EQ(matches(many, "class=\"cell\""), 20);
  EXPECT_THAT(many, Not(HasSubstr("on-dark")));
  EXPECT_THAT(many, HasSubstr("38.25 <i"));
  EXPECT_THAT(many, HasSubstr("57.25</span>"));
  map.columns.resize(5);
  map.values.resize(5);
  EXPECT_THAT(heat_map_figure(map), HasSubstr("on-dark"));
}

TEST(ModeDrawing, DrawsTheBedApartFromWhatMovesOnIt) {
  ModeDrawing mode{"Mode 1", {}};
  for (const char* name : {"bed", "X", "Y", "Z", "B", "C"}) {
    SwingingBody body{name, {}, {}};
    for (std::size_t i = 0; i < 8; ++i) {
      body.corners[i] = Vec3(double(i & 1U), double((i >> 1U) & 1U), double(i >> 2U));
    }
    mode.bodies.push_back(body);
  }
  const std::string html = mode_figure(mode);
  EXPECT_EQ(matches(html, "class=\"bed\""), 1);
  for (const char* series : {"trace s1", "trace s2", "trace s3", "trace s4", "trace s5"}) {
    EXPECT_EQ(matches(html, std::string("path class=\"") + series + "\""), 1) << series;
  }
}

}  // namespace
}  // namespace frustum::report
