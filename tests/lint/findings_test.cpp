// Findings as text, JSON and SARIF.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "lint/json_findings.hpp"
#include "lint/sarif_findings.hpp"
#include "lint/text_findings.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

using nlohmann::json;

const std::string kProgram = "G0 X1 Z9\n\tG999 (\xC3\xBC) Y1\nM30\n";

CheckedFile written(const std::string& text, const std::string& file = "a b/part.nc") {
  const parser::Program program{file, parser::Dialect::fanuc, parser::ProgramText(text), nullptr};
  CheckOptions options;
  options.run.control.unit = parser::LengthUnit::millimetre;
  CheckedFile checked{file, "fanuc", "", false, check_program(program, options), {}};
  checked.lines = source_lines(program, checked.report.findings);
  return checked;
}

std::string whole_text(const CheckedFile& checked) {
  return text_of(checked) + summary_of({&checked, 1});
}
json sarif(const CheckedFile& checked, const std::string& folder = "/jobs/of today") {
  return json::parse(sarif_of({&checked, 1}, {folder, "0.1.0", "https://docs.test/", {}}));
}

TEST(TextFindings, ShowTheLineAndACaret) {
  const CheckedFile checked = written(kProgram);
  ASSERT_EQ(checked.report.findings.size(), 1U);
  EXPECT_EQ(whole_text(checked),
            "a b/part.nc:2:2: error: unknown word G999 [program-error]\n"
            "     2 | \tG999 (\xC3\xBC) Y1\n"
            "       | \t^\n"
            "       = " +
                checked.report.findings[0].hint +
                "\n"
                "1 error, 0 warnings, 0 notes in 3 blocks that ran\n");
}

TEST(TextFindings, CutLongLinesAroundTheirColumn) {
  const std::string text = text_of(written("G0 X1 (" + std::string(300, 'x') + ") G999\nM30\n"));
  EXPECT_NE(text.find("     1 | ...xxx"), std::string::npos) << text;
  const auto row = text.find("     1 | "), under = text.find("       | ");
  const auto caret = text.find('^');
  EXPECT_EQ(text.substr(row + (caret - under), 4), "G999") << text;
}

TEST(TextFindings, ProgramWithoutFindingsHasOneLine) {
  EXPECT_EQ(whole_text(written("G0 X1\nM30\n")),
            "0 errors, 0 warnings, 0 notes in 2 blocks that ran\n");
}

TEST(JsonFindings, HaveTheKeysOfTheDocument) {
  const json doc = json::parse(json_of(written(kProgram)));
  EXPECT_EQ(doc["status"], "fail");
  EXPECT_EQ(doc["dialect"], "fanuc");
  EXPECT_TRUE(doc["machine"].is_null());
  EXPECT_EQ(doc["counts"], (json{{"error", 1}, {"warning", 0}, {"note", 0}}));
  ASSERT_EQ(doc["findings"].size(), 1U);
  const json& finding = doc["findings"][0];
  EXPECT_EQ(finding["id"], "program-error");
  EXPECT_EQ(finding["severity"], "error");
  EXPECT_EQ(finding["file"], "a b/part.nc");
  EXPECT_EQ(finding["line"], 2);
  EXPECT_EQ(finding["column"], 2);
  EXPECT_EQ(finding["count"], 1);
  EXPECT_TRUE(finding["diagnostic"].is_string());
  EXPECT_EQ(finding["message"], "unknown word G999");
  EXPECT_FALSE(finding["hint"].get<std::string>().empty());
}

TEST(TextFindings, WriteControlCharactersOut) {
  CheckedFile checked{.file = "a\nb.nc"};
  checked.report.findings.push_back({.check = Check::feed_missing,
                                     .file = "a\nb.nc",
                                     .line = 1,
                                     .column = 1,
                                     .message = "id \x1B[2J"});
  EXPECT_EQ(text_of(checked), "a\\x0Ab.nc:1:1: error: id \\x1B[2J [feed-missing]\n");
}

TEST(JsonFindings, TellWhatCouldNotBeRead) {
  const json doc =
      json::parse(json_of(std::span<const CheckedFile>(), {error("no-such"_id, "gone")}));
  EXPECT_EQ(doc["status"], "fail");
  EXPECT_TRUE(doc["files"].empty());
  ASSERT_EQ(doc["troubles"].size(), 1U);
  EXPECT_EQ(doc["troubles"][0]["diagnostic"], "no-such");
  EXPECT_EQ(doc["troubles"][0]["message"], "gone");
  CheckedFile fine = written("G0 X1\nM30\n");
  fine.passed = true;
  EXPECT_EQ(json::parse(json_of(fine, {error("no-such"_id, "gone")}))["status"], "fail");
  EXPECT_FALSE(json::parse(json_of(fine)).contains("troubles"));
}

TEST(JsonFindings, StayJsonWhateverTheBytes) {
  const CheckedFile checked = written("G0 X1\nG0 \xFF\n(\xC0\x80 G999\nM30\n");
  EXPECT_TRUE(json::accept(json_of(checked)));
  EXPECT_TRUE(json::accept(sarif_of({&checked, 1}, {.folder = "/work", .version = "0.1.0"})));
}

// The properties that an object of the format may have, and those that it must.
struct Rule {
  std::set<std::string> required;
  std::set<std::string> allowed;
};
const std::map<std::string, Rule> kRules{
    {"log", {{"version", "runs"}, {"$schema"}}},
    {"run",
     {{"tool"}, {"invocations", "originalUriBaseIds", "artifacts", "columnKind", "results"}}},
    {"driver", {{"name"}, {"version", "semanticVersion", "informationUri", "rules"}}},
    {"rule",
     {{"id"}, {"shortDescription", "fullDescription", "help", "defaultConfiguration", "helpUri"}}},
    {"invocation", {{"executionSuccessful"}, {"workingDirectory", "toolExecutionNotifications"}}},
    {"artifact", {{}, {"location", "roles"}}},
    {"artifactLocation", {{}, {"uri", "uriBaseId", "index"}}},
    {"region", {{}, {"startLine", "startColumn"}}},
    {"suppression", {{"kind"}, {"status", "justification"}}},
    {"result",
     {{"message"},
      {"ruleId", "ruleIndex", "level", "locations", "partialFingerprints", "occurrenceCount",
       "suppressions", "properties"}}},
};

void expect_object(const json& object, const std::string& kind) {
  const Rule& rule = kRules.at(kind);
  ASSERT_TRUE(object.is_object()) << kind;
  for (const std::string& name : rule.required) {
    EXPECT_TRUE(object.contains(name)) << kind << " without " << name;
  }
  for (const auto& [name, value] : object.items()) {
    EXPECT_TRUE(rule.required.contains(name) || rule.allowed.contains(name))
        << kind << ": " << name;
  }
}

TEST(SarifFindings, Fault2_19_HaveWhatTheSchemaRequiresAndNothingElse) {
  const CheckedFile checked = written(
      "G0 X1 Z9\n(\xC3\xBC\xF0\x9F\x94\xA7) G1 X2 F9\nG61 (frustum: ignore not-simulated)\n");
  const json doc = sarif(checked);
  expect_object(doc, "log");
  EXPECT_EQ(doc["version"], "2.1.0");
  EXPECT_NE(doc["$schema"].get<std::string>().find("sarif-schema-2.1.0.json"), std::string::npos);
  ASSERT_EQ(doc["runs"].size(), 1U);
  const json& run = doc["runs"][0];
  expect_object(run, "run");
  expect_object(run["invocations"][0], "invocation");
  EXPECT_EQ(run["invocations"][0]["executionSuccessful"], true);
  EXPECT_EQ(run["originalUriBaseIds"]["WORKING_FOLDER"]["uri"], "file:///jobs/of%20today/");
  const json& driver = run["tool"]["driver"];
  expect_object(driver, "driver");
  EXPECT_EQ(driver["name"], "Frustum");
  EXPECT_EQ(driver["version"], "0.1.0");
  EXPECT_EQ(driver["informationUri"], "https://docs.test/README.md");
  ASSERT_EQ(driver["rules"].size(), all_checks().size());
  for (const json& rule : driver["rules"]) {
    expect_object(rule, "rule");
    EXPECT_EQ(rule["helpUri"], "https://docs.test/check.md#the-checks");
    EXPECT_FALSE(rule["help"]["text"].get<std::string>().empty());
    EXPECT_GT(rule["fullDescription"]["text"].get<std::string>().size(),
              rule["shortDescription"]["text"].get<std::string>().size() + 1);
  }
  ASSERT_EQ(run["artifacts"].size(), 1U);
  expect_object(run["artifacts"][0], "artifact");
  expect_object(run["artifacts"][0]["location"], "artifactLocation");
  ASSERT_EQ(run["results"].size(), checked.report.findings.size());
  ASSERT_GE(run["results"].size(), 3U);
  for (const json& result : run["results"]) {
    expect_object(result, "result");
    const std::string id = result["ruleId"];
    EXPECT_EQ(driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"], id);
    EXPECT_TRUE(result["level"] == "error" || result["level"] == "warning" ||
                result["level"] == "note");
    EXPECT_FALSE(result["message"]["text"].get<std::string>().empty());
    ASSERT_EQ(result["locations"].size(), 1U);
    const json& place = result["locations"][0]["physicalLocation"];
    expect_object(place["artifactLocation"], "artifactLocation");
    EXPECT_EQ(place["artifactLocation"]["uri"], "a%20b/part.nc");
    EXPECT_EQ(place["artifactLocation"]["index"], 0);
    expect_object(place["region"], "region");
    EXPECT_GE(place["region"]["startLine"].get<int>(), 1);
    EXPECT_GE(place["region"]["startColumn"].get<int>(), 1);
    EXPECT_GE(result["occurrenceCount"].get<int>(), 1);
    for (const json& each : result["suppressions"]) expect_object(each, "suppression");
    EXPECT_EQ(result["suppressions"].size(), id == "not-simulated" ? 1U : 0U);
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
  CheckedFile checked{.file = "../up.nc"};
  checked.report.findings.push_back(
      {.check = Check::feed_missing, .file = "../up.nc", .line = 1, .column = 1, .message = "m"});
  const json doc = sarif(checked, "/jobs/today");
  EXPECT_EQ(
      doc["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
      "file:///jobs/up.nc");
}

TEST(SarifFindings, NameTheStandardInputAsSuch) {
  CheckedFile checked{.file = "<stdin>"};
  EXPECT_EQ(sarif(checked)["runs"][0]["artifacts"][0]["location"]["uri"], "stdin:");
}

TEST(SarifFindings, SayWhatCouldNotBeRead) {
  const json doc = json::parse(
      sarif_of({}, {.folder = "/", .version = "0", .troubles = {error("no-such"_id, "gone")}}));
  const json& invocation = doc["runs"][0]["invocations"][0];
  EXPECT_EQ(invocation["executionSuccessful"], false);
  EXPECT_EQ(invocation["toolExecutionNotifications"][0]["level"], "error");
}

TEST(SarifFindings, FingerprintsStayWhenLinesMoveAndBlocksAreRenumbered) {
  const auto mark = [](const std::string& text) {
    return sarif(written(text))["runs"][0]["results"][0]["partialFingerprints"];
  };
  EXPECT_EQ(mark("G0 X1 Z9\nN10 G1 X2\nM30\n"), mark("(more)\nG0 X1 Z9\nN30  G1 X2\nM30\n"));
  EXPECT_NE(mark("G0 X1 Z9\nN10 G1 X2\nM30\n"), mark("G0 X1 Z9\nN10 G1 X3\nM30\n"));
}

}  // namespace
}  // namespace frustum::lint
