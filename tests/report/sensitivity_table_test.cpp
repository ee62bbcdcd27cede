#include "report/page/sensitivity_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

// Three characteristics of two patterns; the third error moves nothing, the fourth only ever
// removes.
SensitivityTable small_table() {
  SensitivityTable table;
  table.title = "Step patterns 1-a 2-a";
  table.machine = "zx-yac";
  table.method = "analytic gains";
  table.characteristics = {{"1-a.dL", "um"}, {"1-a.phi", "urad"}, {"2-a.dL", "um"}};
  table.parameters = {
      {"dy_AY", "um"}, {"alpha_AY", "urad"}, {"gamma_AY", "urad"}, {"beta_ZX", "urad"}};
  table.odd.resize(3, 4);
  table.odd << 2.0, -0.355812, 0.0, 0.0,  //
      0.0, -2.0, 1e-9, 0.0,               //
      0.00788223, 2e-6, 0.0, 0.0;
  table.even = Eigen::MatrixXd::Zero(3, 4);
  table.even(2, 3) = -0.0121;
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(SensitivityJson, HasItsKeysInOrderAndOneRowACharacteristic) {
  const auto json = nlohmann::ordered_json::parse(sensitivity_json(small_table()));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"schema", "version", "title", "machine", "method",
                                            "characteristics", "errors", "units",
                                            "characteristic_units", "matrix", "even"}));
  EXPECT_EQ(json["errors"].size(), 4U);
  EXPECT_EQ(json["units"][1], "urad");
  EXPECT_EQ(json["characteristic_units"][1], "urad");
  for (const char* matrix : {"matrix", "even"}) {
    ASSERT_EQ(json[matrix].size(), json["characteristics"].size()) << matrix;
    for (const auto& row : json[matrix]) EXPECT_EQ(row.size(), json["errors"].size()) << matrix;
  }
  EXPECT_EQ(json["matrix"][0][1], -0.355812);
  EXPECT_EQ(json["even"][2][3], -0.0121);
}

TEST(SensitivityCsv, HeadsItsColumnsWithUnitsAndQuotesNamesThatNeedIt) {
  SensitivityTable table = small_table();
  table.characteristics[1].name = "bore, \"left\"";
  table.parameters[0].name = "a,b";
  const auto lines = lines_of(sensitivity_csv(table));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            "characteristic,unit,\"a,b [per um]\",alpha_AY [per urad],gamma_AY [per urad],"
            "beta_ZX [per urad]");
  EXPECT_EQ(lines[1], "1-a.dL,um,2,-0.355812,0,0");
  EXPECT_EQ(lines[2], "\"bore, \"\"left\"\"\",urad,0,-2,1e-09,0");
}

TEST(SensitivityText, NamesTheErrorsThatNothingAnswersBelow) {
  const std::string text = sensitivity_text(small_table(), 100);
  EXPECT_THAT(text, HasSubstr("\nNo characteristic answers: gamma_AY\n"));
  EXPECT_EQ(occurrences(text, "gamma_AY"), 1U);
  EXPECT_THAT(text, HasSubstr("-0.3558"));
  EXPECT_THAT(text, HasSubstr("beta_ZX"));  // answers by its even part
  for (const std::string& line : lines_of(sensitivity_text(small_table(), 40))) {
    EXPECT_LE(line.size(), 40U + 3U) << line;  // a dot takes two bytes
  }
}

TEST(SensitivityPage, LeavesOutColumnsWithoutAnAnswerAndNamesThemBelow) {
  const std::string page = sensitivity_html(small_table());
  EXPECT_THAT(page, HasSubstr("No characteristic answers: gamma_AY."));
  EXPECT_EQ(occurrences(page, "gamma"), 1U);
  // One column by derivative twice, one by the even part.
  EXPECT_EQ(occurrences(page, "<th scope=\"col\""), 3U);
  EXPECT_THAT(page, HasSubstr("alpha<br>_AY"));
  EXPECT_THAT(page, HasSubstr("beta<br>_ZX"));
  SensitivityTable full = small_table();
  full.odd(0, 2) = full.odd(0, 3) = 1.0;
  EXPECT_THAT(sensitivity_html(full), Not(HasSubstr("No characteristic answers")));
}

TEST(SensitivityPage, ShowsThreeDigitsNothingForZeroAndARuleBetweenPatterns) {
  const std::string page = sensitivity_html(small_table());
  EXPECT_THAT(page, HasSubstr(">\u22120.356</td>"));
  EXPECT_THAT(page, Not(HasSubstr("0.3558")));
  EXPECT_THAT(page, HasSubstr(">0.0079</td>"));
  EXPECT_THAT(page, HasSubstr(">2e-06</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"n\"></td>"));
  EXPECT_THAT(page, HasSubstr("<tr class=\"begins\"><th scope=\"row\">2-a.dL"));
  EXPECT_THAT(page, HasSubstr("<tr><th scope=\"row\">1-a.phi"));
  EXPECT_EQ(occurrences(page, "class=\"begins\""), 2U);  // in both tables
}

TEST(SensitivityPage, EscapesNamesAndLoadsNothing) {
  SensitivityTable table = small_table();
  const std::string hostile = "<script>alert(1)</script>&\"";
  table.title = table.machine = table.method = hostile;
  table.characteristics[0].name = table.parameters[0].name = table.parameters[2].name = hostile;
  const std::string page = sensitivity_html(table);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(page, HasSubstr("No characteristic answers: &lt;script"));
  EXPECT_THAT(page, Not(HasSubstr("http")));
}

TEST(SensitivityTable, WhatIsNoNumberIsNullOrADashAndNeverSilent) {
  SensitivityTable table = small_table();
  table.odd(0, 0) = kNotANumber;
  table.odd.col(2).setConstant(std::numeric_limits<double>::infinity());
  const auto json = nlohmann::json::parse(sensitivity_json(table));
  EXPECT_TRUE(json["matrix"][0][0].is_null());
  EXPECT_TRUE(json["matrix"][1][2].is_null());
  EXPECT_EQ(json["matrix"][1][1], -2.0);
  const std::string text = sensitivity_text(table, 100);
  EXPECT_THAT(text, HasSubstr("         -"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("No characteristic answers")));
  const std::string page = sensitivity_html(table);
  const std::string body = page.substr(page.find("<body"));
  EXPECT_EQ(occurrences(body, ">-</td>"), 4U);
  EXPECT_THAT(body, Not(HasSubstr("nan")));
  EXPECT_THAT(body, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace frustum::report
