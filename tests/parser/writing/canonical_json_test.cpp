#include "parser/writing/canonical_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

std::vector<std::string> json_of(std::string_view text) {
  std::vector<std::string> lines;
  for (const Motion& motion : motions(text)) lines.push_back(to_json_line(motion));
  return lines;
}

// The contract of `frustum parse --canon`: other people's scripts read these very keys.
TEST(CanonicalJson, SpellsEveryCommandAsPublished) {
  EXPECT_THAT(
      json_of(
          "(hi \"there\")\nT3 M6\nS100 M3\nM8\nG55\nG43.4 H1\nG0 X1 Y2 Z3 A-30 C90\n"
          "G1 X1.5 F200\nG2 X3.5 I1 P2\nG4 P500\nG43.5 H1 G1 X0 Y0 I0 J0 K2\nG93 G1 X1 F5\nG94\n"
          "G61\nG49\nG53 G0 Z0\nG91 G28 Z0 X0\nM5\nM9\nM1\nM0\nM30\n"),
      testing::ElementsAre(
          R"({"line":1,"type":"event","name":"comment","text":"hi \"there\""})",
          R"({"line":2,"type":"tool_change","tool":3})",
          R"({"line":3,"type":"spindle","direction":"clockwise","speed":100.0})",
          R"({"line":4,"type":"coolant","flood":true})",
          R"({"line":5,"type":"work_offset","number":2})",
          R"({"line":6,"type":"compensation","mode":"tool_centre_point","tool_vectors":false,"offset":1})",
          R"({"line":7,"type":"traverse","end":{"X":1.0,"Y":2.0,"Z":3.0,"A":-30.0,"C":90.0}})",
          R"({"line":8,"type":"feed","end":{"X":1.5,"Y":2.0,"Z":3.0,"A":-30.0,"C":90.0},"feed":200.0})",
          R"({"line":9,"type":"arc","end":{"X":3.5,"Y":2.0,"Z":3.0,"A":-30.0,"C":90.0},)"
          R"("center":[2.5,2.0,3.0],"plane":"XY","turns":-2,"feed":200.0})",
          R"({"line":10,"type":"dwell","seconds":0.5})",
          R"({"line":11,"type":"compensation","mode":"tool_centre_point","tool_vectors":true,"offset":1})",
          R"({"line":11,"type":"feed","end":{"X":0.0,"Y":0.0,"Z":3.0},"tool_axis":[0.0,0.0,1.0],"feed":200.0})",
          R"({"line":12,"type":"feed","end":{"X":1.0,"Y":0.0,"Z":3.0},"tool_axis":[0.0,0.0,1.0],)"
          R"("feed":5.0,"feed_mode":"inverse_time"})",
          R"({"line":14,"type":"event","name":"G61","text":""})",
          R"({"line":15,"type":"compensation","mode":"off","tool_vectors":false,"offset":0})",
          R"({"line":16,"type":"traverse","end":{"Z":0.0},"coordinates":"machine"})",
          R"({"line":17,"type":"home","axes":["X","Z"]})",
          R"({"line":18,"type":"spindle","direction":"off","speed":100.0})",
          R"({"line":19,"type":"coolant","flood":false})",
          R"({"line":20,"type":"stop","kind":"optional_stop"})",
          R"({"line":21,"type":"stop","kind":"program_stop"})",
          R"({"line":22,"type":"stop","kind":"program_end"})"));
}

double value_behind(const std::string& json, const std::string& key) {
  return std::strtod(json.c_str() + json.find(key) + key.size(), nullptr);
}

TEST(CanonicalJsonLaws, NumbersReadBackAsTheSameValue) {
  for (int i = 0; i < 20000; ++i) {
    Traverse traverse;
    const double value = (i - 10000) * 0.0371234567891 / 3.0;
    traverse.end[AxisLetter::X] = value;
    traverse.end[AxisLetter::B] = value;
    const std::string json = to_json_line({{1, 1}, traverse});
    ASSERT_EQ(value_behind(json, "\"X\":"), value) << json;
    // Degrees that are not decimal to 15 digits come back within one rounding.
    ASSERT_NEAR(value_behind(json, "\"B\":") * kRadPerDeg, value, 4e-16 * std::abs(value)) << json;
  }
}

TEST(CanonicalJsonLaws, DegreesOfAProgramReadBackAsWritten) {
  for (int i = -36000; i <= 36000; i += 7) {
    Traverse traverse;
    traverse.end[AxisLetter::C] = i / 100.0 * kRadPerDeg;
    ASSERT_EQ(value_behind(to_json_line({{1, 1}, traverse}), "\"C\":"), i / 100.0);
  }
}

TEST(CanonicalJson, StaysReadableWhateverTheBytesOfAComment) {
  const auto lines = json_of(
      "(M\xFC"
      "ller)\n(\xE4\xB8\x96\xE7\x95\x8C)\n(\xC0\x80 \xFF)\n");
  EXPECT_EQ(lines.at(0),
            "{\"line\":1,\"type\":\"event\",\"name\":\"comment\",\"text\":\"M\xC3\xBCller\"}");
  EXPECT_NE(lines.at(1).find("\xE4\xB8\x96\xE7\x95\x8C"), std::string::npos);
  EXPECT_NE(lines.at(2).find("\xC3\x80\xC2\x80 \xC3\xBF"), std::string::npos);
}

TEST(CanonicalJson, TellsWhatTheProgramItselfPlaces) {
  WorkOffsetSetting setting{2, {1.5, std::nullopt, -3.0}};
  EXPECT_EQ(to_json_line({{7, 1}, setting}),
            R"({"line":7,"type":"work_offset_setting","number":2,"origin":{"X":1.5,"Z":-3.0}})");
  EXPECT_EQ(
      to_json_line({{8, 1}, CompensationChange{LengthCompensation::length, false, 3, 50.25}}),
      R"({"line":8,"type":"compensation","mode":"length","tool_vectors":false,"offset":3,"length":50.25})");
  HomeReturn second{.point = 2};
  second.axes[2] = true;
  EXPECT_EQ(to_json_line({{9, 1}, second}), R"({"line":9,"type":"home","axes":["Z"],"point":2})");
}

TEST(WorkOffsetName, IsTheWordOfTheProgram) {
  EXPECT_EQ(work_offset_name(1), "G54");
  EXPECT_EQ(work_offset_name(6), "G59");
  EXPECT_EQ(work_offset_name(7), "G59.1");
  EXPECT_EQ(work_offset_name(9), "G59.3");
  EXPECT_EQ(work_offset_name(148), "G54.1 P48");
}

}  // namespace
}  // namespace frustum::parser
