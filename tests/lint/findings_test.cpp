// Findings as text, JSON and SARIF.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lint/json_findings.hpp"
#include "lint/sarif_findings.hpp"
#include "lint/text_findings.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

using nlohmann::json;

const std::string kProgram = "G0 X1 Z9\n\tG1 X2 (\xC3\xBC) Y1\nM30\n";

struct Written {
  explicit Written(const std::string& text)
      : program{"a b/part.nc", parser::Dialect::fanuc, parser::ProgramText(text)},
        report(check_program(program, {})),
        lines(source_lines(program, report.findings)) {}
  parser::Program program;
  CheckReport report;
  SourceLines lines;
};

TEST(TextFindings, ShowTheLineAndACaret) {
  const Written w(kProgram);
  EXPECT_EQ(text_of(w.report, w.lines),
            "a b/part.nc:2:2: error: G1 without a feed rate [feed-missing]\n"
            "     2 | \tG1 X2 (\xC3\xBC) Y1\n"
            "       | \t^\n"
            "       = give F on this block or before, above zero\n"
            "1 error, 0 warnings, 0 notes in 3 blocks that ran\n");
}

TEST(TextFindings, CutLongLinesAroundTheirColumn) {
  const Written w("G0 X1 (" + std::string(300, 'x') + ") G999\nM30\n");
  const std::string text = text_of(w.report, w.lines);
  EXPECT_NE(text.find("     1 | ...xxx"), std::string::npos) << text;
  const auto row = text.find("     1 | "), under = text.find("       | ");
  const auto caret = text.find('^');
  EXPECT_EQ(text.substr(row + (caret - under), 4), "G999") << text;
}

TEST(TextFindings, ProgramWithoutFindingsHasOneLine) {
  const Written w("G0 X1\nM30\n");
  EXPECT_EQ(text_of(w.report, w.lines), "0 errors, 0 warnings, 0 notes in 2 blocks that ran\n");
}

TEST(JsonFindings, HaveTheKeysOfTheDocument) {
  const Written w(kProgram);
  const json doc = json::parse(json_of(w.report, {"a b/part.nc", "fanuc", "", false}));
  EXPECT_EQ(doc["status"], "fail");
  EXPECT_EQ(doc["dialect"], "fanuc");
  EXPECT_TRUE(doc["machine"].is_null());
  EXPECT_EQ(doc["counts"], (json{{"error", 1}, {"warning", 0}, {"note", 0}}));
  ASSERT_EQ(doc["findings"].size(), 1U);
  const json& finding = doc["findings"][0];
  EXPECT_EQ(finding["id"], "feed-missing");
  EXPECT_EQ(finding["severity"], "error");
  EXPECT_EQ(finding["file"], "a b/part.nc");
  EXPECT_EQ(finding["line"], 2);
  EXPECT_EQ(finding["column"], 2);
  EXPECT_EQ(finding["count"], 1);
  EXPECT_EQ(finding["diagnostic"], "feed-missing");
  EXPECT_EQ(finding["message"], "G1 without a feed rate");
  EXPECT_FALSE(finding["hint"].get<std::string>().empty());
}

TEST(JsonFindings, StayJsonWhateverTheBytes) {
  const Written w("G0 X1\nG0 \xFF\n(\xC0\x80 G999\nM30\n");
  EXPECT_TRUE(json::accept(json_of(w.report, {"p", "fanuc", "iwf-bc", true})));
  EXPECT_TRUE(json::accept(sarif_of(w.report, w.lines, {"/work", "0.1.0"})));
}

TEST(SarifFindings, HaveWhatTheSchemaRequires) {
  const Written w("G0 X1 Z9\n(\xC3\xBC\xF0\x9F\x94\xA7) G1 X2 F9\nG61\n");
  const json doc = json::parse(sarif_of(w.report, w.lines, {"/jobs/of today", "0.1.0"}));
  EXPECT_EQ(doc["version"], "2.1.0");
  EXPECT_NE(doc["$schema"].get<std::string>().find("sarif-schema-2.1.0.json"), std::string::npos);
  ASSERT_TRUE(doc["runs"].is_array());
  ASSERT_EQ(doc["runs"].size(), 1U);
  const json& run = doc["runs"][0];
  const json& driver = run["tool"]["driver"];
  EXPECT_EQ(driver["name"], "Frustum");
  ASSERT_EQ(driver["rules"].size(), all_checks().size());
  ASSERT_EQ(run["results"].size(), w.report.findings.size());
  ASSERT_GE(run["results"].size(), 3U);
  for (const json& result : run["results"]) {
    const std::string id = result["ruleId"];
    EXPECT_EQ(driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"], id);
    EXPECT_TRUE(result["level"] == "error" || result["level"] == "warning" ||
                result["level"] == "note");
    EXPECT_FALSE(result["message"]["text"].get<std::string>().empty());
    ASSERT_EQ(result["locations"].size(), 1U);
    const json& place = result["locations"][0]["physicalLocation"];
    EXPECT_EQ(place["artifactLocation"]["uri"], "a%20b/part.nc");
    EXPECT_GE(place["region"]["startLine"].get<int>(), 1);
    EXPECT_GE(place["region"]["startColumn"].get<int>(), 1);
    EXPECT_GE(result["occurrenceCount"].get<int>(), 1);
  }
  // Line 2 begins with (, a character of two bytes, one of four (two UTF-16 units), ) and a blank:
  // G1 is unit 7.
  for (const json& result : run["results"]) {
    if (result["ruleId"] == "spindle-off") {
      EXPECT_EQ(result["locations"][0]["physicalLocation"]["region"]["startColumn"], 7);
    }
  }
}

TEST(SarifFindings, NameFilesElsewhereByTheirWholePath) {
  CheckReport report;
  report.findings.push_back(
      {.check = Check::feed_missing, .file = "../up.nc", .line = 1, .column = 1, .message = "m"});
  const json doc = json::parse(sarif_of(report, {}, {"/jobs/today", "0.1.0"}));
  EXPECT_EQ(
      doc["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
      "file:///jobs/up.nc");
}

TEST(SarifFindings, FingerprintsStayWhenLinesMove) {
  const Written one(kProgram);
  const Written other("(a line more)\n" + kProgram);
  const auto mark = [](const Written& w) {
    return json::parse(
        sarif_of(w.report, w.lines, {"/", "0"}))["runs"][0]["results"][0]["partialFingerprints"];
  };
  EXPECT_EQ(mark(one), mark(other));
}

}  // namespace
}  // namespace frustum::lint
