// frustum history: what documents give, where dates come from, limits, pairs, and what is refused.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class HistorySystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }

  // A result with one characteristic, as run and measure write it.
  void write_result(const std::string& file, double value, const std::string& date = "",
                    double tolerance = 20.0, const std::string& machine = "iwf-bc, C on B",
                    const std::string& unit = "um") const {
    json doc{{"schema", "frustum/result/1"}, {"title", "Cone"}, {"machine", machine}};
    doc["evidence"]["date"] = date.empty() ? json(nullptr) : json(date);
    doc["characteristics"] = {{{"name", "cone.form"},
                               {"kind", "cone_form"},
                               {"value", value},
                               {"unit", unit},
                               {"tolerance", tolerance},
                               {"expanded_uncertainty", 0.5},
                               {"nominal", nullptr},
                               {"verdict", value > tolerance ? "fail" : "pass"}}};
    write(file, doc.dump());
  }
  void write_estimate(const std::string& file, double value) const {
    write(file, json{{"schema", "frustum/identification/1"},
                     {"machine", "iwf-bc"},
                     {"estimates",
                      {{{"name", "EB0C"},
                        {"unit", "urad"},
                        {"value", value},
                        {"lower", value - 2.0},
                        {"upper", value + 2.0}},
                       {{"name", "EA0B"}, {"unit", "urad"}, {"value", nullptr}}}}}
                    .dump());
  }

  json history(const std::string& arguments, int exit_code) const {
    const Outcome outcome = run("history " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }

  static constexpr std::array kDates{"2026-01-01", "2026-01-31", "2026-03-03", "2026-04-02",
                                     "2026-05-01", "2026-06-02", "2026-07-01"};
  static constexpr std::array kValues{10.2, 11.1, 9.7, 10.8, 10.4, 12.9, 10.1};
  void write_half_a_year(double tolerance = 20.0) const {
    for (std::size_t i = 0; i < kDates.size(); ++i) {
      write_result(fmt::format("r/{}/result.json", kDates[i]), kValues[i], "", tolerance);
    }
  }
};

// The numbers are those of tests/calibration/history_test.cpp, which were computed elsewhere.
TEST_F(HistorySystem, DrawsLimitsAndTrendOfDatedResults) {
  write_half_a_year();
  const json doc = history("r --out out", 0);
  EXPECT_EQ(doc["schema"], "frustum/history/1");
  EXPECT_EQ(doc["machine"], "iwf-bc");
  EXPECT_EQ(doc["status"], "pass");
  ASSERT_EQ(doc["results"].size(), 7U);
  EXPECT_EQ(doc["results"][0]["date"], "2026-01-01");
  EXPECT_EQ(doc["results"][0]["date_from"], "folder name");
  ASSERT_EQ(doc["series"].size(), 1U);
  const json& form = doc["series"][0];
  EXPECT_EQ(form["name"], "cone.form");
  EXPECT_NEAR(form["limits"]["lower"].get<double>(), 6.708523809523807, 1e-12);
  EXPECT_NEAR(form["limits"]["upper"].get<double>(), 14.777190476190476, 1e-12);
  EXPECT_NEAR(form["limits"]["upper_moving_range"].get<double>(), 4.95495, 1e-12);
  EXPECT_TRUE(form["limits"]["provisional"].get<bool>());
  EXPECT_NEAR(form["trend"]["per_day"].get<double>(), 0.004799266809728187, 1e-14);
  EXPECT_NEAR(form["trend"]["half_width_95_per_day"].get<double>(), 0.017770454358088043, 1e-9);
  EXPECT_EQ(json::parse(read(folder_ / "out/history.json")), doc);
  const std::string page = read(folder_ / "out/history.html");
  EXPECT_NE(page.find("UCL"), std::string::npos);
  EXPECT_NE(page.find("2026-03-01"), std::string::npos) << "the date axis";
  EXPECT_EQ(
      page.substr(page.find("<body>"), page.find("<script") - page.find("<body>")).find("nan"),
      std::string::npos);
  // Its own document in the folder is none of its results.
  fs::copy_file(folder_ / "out/history.json", folder_ / "r/history.json");
  EXPECT_EQ(history("r", 0)["results"].size(), 7U);
}

TEST_F(HistorySystem, FailsWhereAResultIsOutOfItsTolerance) {
  write_half_a_year(12.0);
  const json doc = history("r", 1);
  ASSERT_EQ(doc["failures"].size(), 1U);
  EXPECT_EQ(doc["failures"][0], "cone.form, 2026-06-02: 12.900 um, out of its tolerance 12.000");
  EXPECT_EQ(doc["series"][0]["points"][5]["beyond"], json({"tolerance"}));
  EXPECT_EQ(run("history r --since 2026-06-03").exit_code, 0) << "that one came before";
  EXPECT_EQ(run("history r --since 2026-06-02").exit_code, 1);
}

// Of the first five: mean 10.44, moving ranges 0.9 1.4 1.1 0.4, mean 0.95, so 12.967 and 3.10365.
TEST_F(HistorySystem, JudgesLaterResultsByTheLimitsOfABaseline) {
  write_half_a_year();
  write_result("r/2026-08-01/result.json", 13.0);
  const json doc = history("r --baseline 5", 1);
  EXPECT_NEAR(doc["series"][0]["limits"]["upper"].get<double>(), 10.44 + 2.66 * 0.95, 1e-12);
  EXPECT_EQ(doc["series"][0]["points"][5]["beyond"], json::array());
  EXPECT_EQ(doc["series"][0]["points"][7]["beyond"], json({"control limits"}));
  EXPECT_EQ(doc["failures"].size(), 1U);
}

TEST_F(HistorySystem, SaysWhatItLacksForLimits) {
  write_result("r/2026-01-01.json", 10.0);
  const json one = history("r", 0);
  EXPECT_TRUE(one["series"][0]["limits"].is_null());
  EXPECT_TRUE(one["series"][0]["trend"].is_null());
  EXPECT_EQ(one["series"][0]["remark"], "1 result: no control limits, they need 5");
  const Outcome text = run("history r");
  EXPECT_NE(text.out.find("Control limits need 5 results as found"), std::string::npos) << text.out;
}

TEST_F(HistorySystem, TakesDatesAndStatesFromAnIndex) {
  write_result("a.json", 14.0);
  write_result("b.json", 10.0);
  write_result("c.json", 11.0, "2026-06-01");
  write_estimate("d.json", 30.0);
  write("history.toml", R"(title = "Machine 7"
[[result]]
date = "2026-01-10"
file = "a.json"
state = "as-found"
[[result]]
date = "2026-01-10"
file = "b.json"
state = "as-left"
[[result]]
file = "c.json"
state = "as-found"
[[result]]
date = "2026-06-01"
file = "d.json"
)");
  const json doc = history(".", 0);
  EXPECT_EQ(doc["title"], "Machine 7");
  EXPECT_EQ(doc["results"][0]["date_from"], "index");
  EXPECT_EQ(doc["results"][0]["state"], "as-found");
  EXPECT_EQ(doc["results"][3]["date_from"], "document") << "those without a state come first";
  const json& form = doc["series"][0];
  EXPECT_EQ(form["counted"], 2) << "what was left is none of what was found";
  EXPECT_EQ(form["adjustments"][0]["change"], -4.0);
  EXPECT_EQ(form["drifts"][0]["change"], 1.0);
  EXPECT_EQ(form["drifts"][0]["days"], 142.0);
  EXPECT_EQ(doc["series"][1]["name"], "EB0C");
  EXPECT_EQ(doc["series"][1]["points"][0]["half_width_95"], 2.0);
  EXPECT_EQ(doc["results"][2]["without_value"], json({"EA0B"}));
  const Outcome text = run("history .");
  EXPECT_NE(text.out.find("adjusted, as found to as left"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("drifted, as left to next found"), std::string::npos) << text.out;
}

// The shipped example: what was found in September is beyond its limits, nothing since.
TEST_F(HistorySystem, BeginsAnewAfterAnAdjustment) {
  fs::create_symlink(fs::path(FRUSTUM_SOURCE_DIR) / "examples", folder_ / "examples");
  const json doc = history("examples/history", 1);
  std::size_t of_form = 0;
  for (const json& failure : doc["failures"]) {
    const std::string text = failure;
    if (!text.starts_with("cone.form")) continue;
    EXPECT_TRUE(text.starts_with("cone.form, 2025-09-18 as-found: 9.842 um, above the upper"))
        << text;
    ++of_form;
  }
  EXPECT_EQ(of_form, 1U);
  const json& form = doc["series"][0];
  EXPECT_EQ(form["trend"]["from"], "2025-09-19");
  EXPECT_TRUE(form["points"][10]["moving_range"].is_null());
  EXPECT_EQ(run("history examples/history --since 2025-10-01").exit_code, 0);
}

TEST_F(HistorySystem, TakesStatesAndTimesFromNames) {
  write_result("r/2026-01-10T0800_as-found.json", 14.0);
  write_result("r/2026-01-10T1715_as-left.json", 10.0);
  write_result("r/as-found/2026-02-10.json", 11.0);
  const json doc = history("r", 0);
  EXPECT_EQ(doc["results"][0]["state"], "as-found");
  EXPECT_EQ(doc["results"][1]["state_from"], "file name");
  EXPECT_EQ(doc["results"][2]["state_from"], "folder name");
  EXPECT_NEAR(doc["series"][0]["adjustments"][0]["days"].get<double>(), 9.25 / 24.0, 1e-9);
}

TEST_F(HistorySystem, ReadsWhatMeasureWrites) {
  write("bore.plan.toml", R"(title = "Bore"
alignment = "plan"
[report]
date = "2026-03-04T10:00:00Z"
[probe]
ball_diameter = 2
clearance = 2
reach = 2
[[feature]]
name = "bore"
kind = "circle"
point = [0, 0, 0]
axis = [0, 0, 1]
radius = 10
side = "inside"
strategy = { sections = [0], points_per_section = 4 }
[[characteristic]]
name = "bore.roundness"
kind = "roundness"
feature = "bore"
tolerance = "5 um"
)");
  write("p.csv", "10.001,0,0\n0,10,0\n-10.001,0,0\n0,-10,0\n0.6e1,8.0e0,0\n-6,-8,0\n");
  ASSERT_EQ(shell("frustum measure --plan bore.plan.toml --points p.csv --json > r.json").exit_code,
            0)
      << read(folder_ / "stderr");
  fs::create_directories(folder_ / "r");
  fs::rename(folder_ / "r.json", folder_ / "r/any.json");
  const json doc = history("r", 0);
  EXPECT_EQ(doc["results"][0]["date"], "2026-03-04T10:00:00Z");
  EXPECT_EQ(doc["results"][0]["date_from"], "document");
  EXPECT_EQ(doc["series"][0]["name"], "bore.roundness");
  EXPECT_EQ(doc["series"][0]["unit"], "um");
}

TEST_F(HistorySystem, RefusesWhatHasNoOrder) {
  write_result("none/result.json", 10.0);
  expect_refusal("history none", {"no date is known of it", "history.toml", "none/result.json"});
  write_result("same/2026-01-01-a.json", 10.0);
  write_result("same/2026-01-01-b.json", 11.0);
  expect_refusal("history same",
                 {"which came first is not known", "time of day", "2026-01-01-b.json"});
  write_result("units/2026-01-01.json", 10.0);
  write_result("units/2026-01-02.json", 0.01, "", 0.02, "iwf-bc", "mm");
  expect_refusal("history units", {"in mm here, in um in", "2026-01-02.json"});
  write_result("mixed/2026-01-01.json", 10.0);
  write_result("mixed/2026-01-02.json", 10.0, "", 20.0, "zx-yac, other");
  expect_refusal("history mixed", {"2 machines: iwf-bc (1), zx-yac (1)", "--machine iwf-bc"});
  expect_refusal("history mixed --machine none", {"no result of 'none'"});
  EXPECT_EQ(run("history mixed --machine zx-yac").exit_code, 0);
  fs::create_directories(folder_ / "empty");
  expect_refusal("history empty", {"holds no result"});
  expect_refusal("history same --since May", {"--since May: no date"});
  expect_refusal("history same --since 2126-01-01",
                 {"--since 2126-01-01: no result is of that day or later"});
  expect_refusal("history same --baseline 3", {"--baseline 3: too few"});
}

// Every number is the same: no limit is narrower than they are wide.
TEST_F(HistorySystem, EqualResultsPass) {
  for (const char* date : kDates) {
    write_result(fmt::format("r/{}.json", date), 45.00016, "", 50.0);
    write_estimate(fmt::format("e/{}.json", date), 45.00016);
  }
  const json doc = history("r", 0);
  EXPECT_EQ(doc["failures"], json::array());
  EXPECT_EQ(doc["series"][0]["limits"]["upper"], 45.00016);
  EXPECT_EQ(history("e", 0)["failures"], json::array());
  // One that differs by a nanometre is beyond them, and the texts tell the two apart.
  write_result("r/2026-08-01.json", 45.00017, "", 50.0);
  const json other = history("r --baseline 7", 1);
  ASSERT_EQ(other["failures"].size(), 1U);
  EXPECT_EQ(other["failures"][0],
            "cone.form, 2026-08-01: 45.00017 um, above the upper control limit 45.00016, "
            "changed by 0.00001, limit 0.00000");
}

TEST_F(HistorySystem, DamagedResultsAreErrors) {
  write_result("r/2026-01-01.json", 10.0);
  const std::string sound = read(folder_ / "r/2026-01-01.json");
  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    write("r/2026-02-01.json", text);
    expect_refusal("history r", words);
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = sound;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  };
  const json pretty = json::parse(sound);
  refused(pretty.dump(2).substr(0, 60), {"2026-02-01.json:", ": error: ends before the document"});
  refused("", {"2026-02-01.json:1:1: error: ends before"});
  refused("{\n  \"schema\": frustum}", {"2026-02-01.json:2:14: error: is no JSON from here on"});
  refused(changed("frustum/result/1", "frustum/result/2"),
          {"schema: 'frustum/result/2' is another form of it", "reads frustum/result/1"});
  refused(changed("frustum/result/1", "frustum/result"), {"is another form"});
  refused(changed("\"value\":10.0", "\"value\":\"abc\""),
          {"characteristics[0].value: expected a number, or null"});
  refused(changed("\"value\":10.0,", ""), {"value: is missing: expected a number, or null"});
  refused(changed(",\"unit\":\"um\"", ""), {"unit: is missing: expected a text"});
  refused(changed("\"unit\":\"um\"", "\"unit\":\"\\u00b5m\""), {"unit: '\u00b5m' is not known"});
  refused(changed("\"verdict\":\"pass\"", "\"verdict\":\"gut\""),
          {"verdict: 'gut' is not known here"});
  refused(changed("\"iwf-bc, C on B\"", "5"), {"machine: expected a text"});
  refused(changed("\"characteristics\"", "\"characterstics\""),
          {"characteristics: is missing: expected a list"});
  refused(changed("\"date\":null", "\"date\":\"1.2.2026\""),
          {"evidence.date: '1.2.2026' is no date"});
  // A sound one may have nothing, which is said.
  json empty = pretty;
  empty["characteristics"] = json::array();
  write("r/2026-02-01.json", empty.dump());
  EXPECT_NE(run("history r").err.find("2026-02-01.json: warning: has no values"),
            std::string::npos);
  // One that says null was not measured, which is said.
  write("r/2026-02-01.json", changed("\"value\":10.0", "\"value\":null"));
  const Outcome without = run("history r");
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.out.find("2026-02-01: no value of cone.form"), std::string::npos)
      << without.out;
}

TEST_F(HistorySystem, NamesWhatNamesSayWrong) {
  write_result("r/2026-01-01T2430.json", 10.0);
  expect_refusal("history r", {"'2026-01-01T2430' has no time of day", "00:00 to 23:59"});
  fs::remove(folder_ / "r/2026-01-01T2430.json");
  write_result("r/2026-01-01T09001.json", 10.0);
  expect_refusal("history r", {"'2026-01-01T09001' has no time of day"});
  fs::remove(folder_ / "r/2026-01-01T09001.json");
  write_result("r/2026-01-02_As-Found.json", 10.0);
  write_result("r/2026-01-03_AS_LEFT.json", 10.0);
  write_result("r/2026-01-04_4711_has-leftovers.json", 10.0);
  const Outcome outcome = run("history r --json");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("'2026-01-04_4711' has no time of day: the day alone counts"),
            std::string::npos)
      << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["results"][0]["state"], "as-found");
  EXPECT_EQ(doc["results"][1]["state"], "as-left");
  EXPECT_TRUE(doc["results"][2]["state"].is_null());
  write_result("r/2026-01-05-as-found-as-left.json", 10.0);
  expect_refusal("history r", {"'2026-01-05-as-found-as-left.json' says as-found and as-left"});
  // Of a file that the index dates, names need say nothing; one result has one date.
  write("r/history.toml",
        "[[result]]\nfile = \"2026-01-02_As-Found.json\"\ndate = \"2026-01-02\"\n"
        "[[result]]\nfile = \"../r/2026-01-02_As-Found.json\"\ndate = \"2026-01-09\"\n");
  expect_refusal("history r", {"history.toml:5", "is listed above already"});
}

TEST_F(HistorySystem, SaysThatABaselineIsNotReached) {
  write_half_a_year();
  const Outcome outcome = run("history r --baseline 30");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("--baseline 30: fewer results as found of cone.form (7)"),
            std::string::npos)
      << outcome.err;
}

TEST_F(HistorySystem, ThePageHasOneSpellingOfAUnit) {
  for (std::size_t i = 0; i < kDates.size(); ++i) {
    write_result(fmt::format("r/{}.json", kDates[i]), kValues[i], "", 12.0);
  }
  EXPECT_EQ(run("history r --out out").exit_code, 1);
  const std::string page = read(folder_ / "out/history.html");
  EXPECT_NE(page.find("12.900 µm, out of its tolerance 12.000"), std::string::npos);
  EXPECT_EQ(page.find(" um,"), std::string::npos);
}

TEST_F(HistorySystem, NamesWhatItLeavesOutAndWhatContradicts) {
  write_result("r/2026-01-01.json", 10.0);
  write("r/2026-01-02.json", R"({"schema": "frustum/study/1"})");
  write("r/2026-01-03.json", "[1, 2]");
  write_result("r/2026-01-09.json", 10.0, "2026-01-08");
  const Outcome outcome = run("history r");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word : {"r/2026-01-02.json: warning: left out: 'frustum/study/1'",
                           "r/2026-01-03.json: warning: left out: is no JSON object",
                           "the document states 2026-01-08, '2026-01-09.json' says 2026-01-09"}) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in " << outcome.err;
  }
  write("r/history.toml",
        "[[result]]\nfile = \"2026-01-09.json\"\ndate = \"2026-01-09\"\n"
        "[[result]]\nfile = \"2026-01-02.json\"\ndate = \"2026-01-02\"\n"
        "[[result]]\nfile = \"2026-01-01.json\"\ndaet = \"2026-13-01\"\n");
  expect_refusal("history r", {"history.toml:3", "states 2026-01-08",
                               "no values that a history follows", "daet"});
}

}  // namespace
}  // namespace frustum
