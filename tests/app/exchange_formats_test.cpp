// Results and points from one program to another and back, tools as drawings, the language of a
// result: by the commands.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class ExchangeFormatsSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }

  // A bore of three lobes, 1 um, and its plan.
  void write_bore() const {
    write("bore.plan.toml", R"(title = "Bore"
alignment = "plan"
[probe]
ball_diameter = 2
clearance = 1
reach = 1
[[feature]]
name = "bore"
kind = "cylinder"
point = [1, 2, 0]
axis = [0, 0, 1]
radius = 20
side = "inside"
strategy = { sections = [0, 10], points_per_section = 24 }
[[characteristic]]
name = "bore.form"
kind = "cylindricity"
feature = "bore"
tolerance = "5 um"
[[characteristic]]
name = "bore.diameter"
kind = "diameter"
feature = "bore"
tolerance = "10 um"
)");
    std::string points = "feature,section,x,y,z\n";
    for (int i = 0; i < 48; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / 24.0;
      const double radius = 20.0 + 1e-3 * std::cos(3.0 * turn);
      points += fmt::format("bore,{},{:.17g},{:.17g},{}\n", i / 24, 1.0 + radius * std::cos(turn),
                            2.0 + radius * std::sin(turn), 10 * (i / 24));
    }
    write("p.csv", points);
  }
};

TEST_F(ExchangeFormatsSystem, QifGoesBothWays) {
  write_bore();
  const Outcome first = run(
      "measure --plan bore.plan.toml --points p.csv --export r.qif --export r.dmo --export r.dxf "
      "--json");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const Outcome second = run("measure --plan bore.plan.toml --points r.qif --json");
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const json one = json::parse(first.out)["characteristics"];
  const json two = json::parse(second.out)["characteristics"];
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i]["name"], two[i]["name"]);
    EXPECT_NEAR(one[i]["value"].get<double>(), two[i]["value"].get<double>(), 1e-9);
  }
  // 2 um of three lobes, as was put in.
  EXPECT_NEAR(two[0]["value"].get<double>(), 2.0, 0.02);
  const std::string dmis = read(folder_ / "r.dmo");
  EXPECT_NE(dmis.find("TA(BORE_FORM)=TOL/CYLCTY,0.00"), std::string::npos) << dmis;
  EXPECT_NE(dmis.find("FA(BORE_P48)=FEAT/POINT,CART,"), std::string::npos);
  EXPECT_NE(read(folder_ / "r.dxf").find("AC1009"), std::string::npos);
  const Outcome unit = run("fit cylinder r.qif --unit inch");
  EXPECT_EQ(unit.exit_code, 2);
  EXPECT_NE(unit.err.find("states the unit 1 mm, --unit says"), std::string::npos) << unit.err;
  EXPECT_EQ(run("fit cylinder r.qif --feature bore").exit_code, 0);
}

// The plan as QIF, the results as a plan, and back to TOML: the same values to the last bit.
TEST_F(ExchangeFormatsSystem, QifPlansGoBothWays) {
  ASSERT_EQ(run("program cone --machine iwf-bc --out piece").exit_code, 0);
  ASSERT_LE(run("run piece/job.toml --out out --quiet --error EXX=\"linear 5um\"").exit_code, 1);
  const std::string plan = "measure --plan piece/cone.plan.toml --points out/points.csv ";
  const Outcome first = run(plan + "--json --export r.qif --export-plan made/p.qif");
  ASSERT_LE(first.exit_code, 1) << first.err;
  ASSERT_EQ(run("measure --plan made/p.qif --export-plan back.toml").exit_code, 0);
  const json expected = json::parse(first.out)["characteristics"];
  ASSERT_GT(expected.size(), 5U);
  for (const char* file : {"made/p.qif", "r.qif", "back.toml"}) {
    const Outcome again =
        run(std::string("measure --plan ") + file + " --points out/points.csv --json");
    ASSERT_EQ(again.exit_code, first.exit_code) << again.err;
    EXPECT_EQ(json::parse(again.out)["characteristics"], expected) << file;
  }
  ASSERT_EQ(run("measure --plan piece/cone.plan.toml --export-plan same.toml").exit_code, 0);
  EXPECT_EQ(read(folder_ / "back.toml"), read(folder_ / "same.toml"));
  expect_refusal("measure --plan piece/cone.plan.toml --export-plan p.xml",
                 {"p.xml", "known: .qif .toml"});
  expect_refusal("measure --plan piece/cone.plan.toml --export-plan p.qif --json", {"--points"});
  expect_refusal(plan + "--export-plan made/../made/p.qif --export made/p.qif",
                 {"--export-plan and --export write made/p.qif"});
  expect_refusal(plan + "--export-plan ./new.qif --export new.qif",
                 {"--export-plan and --export write new.qif"});
  expect_refusal("measure piece/job.toml --export-plan p.qif", {"--export-plan goes with --plan"});
  std::string cut = read(folder_ / "made/p.qif");
  write("cut.qif", cut.substr(0, cut.size() / 2));
  expect_refusal("measure --plan cut.qif --points out/points.csv", {"cut.qif:", "no XML"});
}

// A document without keys of plans evaluates points, says what it does not state, cannot probe.
TEST_F(ExchangeFormatsSystem, QifPlansOfOthersEvaluatePointsOnly) {
  write_bore();
  ASSERT_EQ(run("measure --plan bore.plan.toml --export-plan p.qif").exit_code, 0);
  std::string text = read(folder_ / "p.qif");
  for (std::size_t at = 0; (at = text.find("name=\"plan.", at)) != std::string::npos;) {
    text.replace(at, 11, "name=\"mine.");
  }
  write("others.qif", text);
  const Outcome measured = run("measure --plan others.qif --points p.csv --json");
  ASSERT_LE(measured.exit_code, 1) << measured.err;
  EXPECT_NE(measured.out.find("does not say where to touch bore"), std::string::npos);
  expect_refusal("measure --plan others.qif --points p.csv --ball-centres",
                 {"others.qif:", "does not say where to touch bore"});
}

// The file of the points is named where they lack those of a feature.
TEST_F(ExchangeFormatsSystem, MissingPointsNameTheirFile) {
  write_bore();
  write("two.plan.toml", read(folder_ / "bore.plan.toml") + R"([[feature]]
name = "top"
kind = "plane"
point = [0, 0, 12]
axis = [0, 0, 1]
strategy = { rings = [25], points_per_ring = 8 }
[[characteristic]]
name = "top.flatness"
kind = "flatness"
feature = "top"
tolerance = "5 um"
)");
  const Outcome few = run("measure --plan two.plan.toml --points p.csv");
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_EQ(few.err.find("p.csv: error:"), 0U) << few.err;
  EXPECT_NE(few.err.find("feature 'top' has no points"), std::string::npos) << few.err;
}

TEST_F(ExchangeFormatsSystem, ToolsAreDrawn) {
  ASSERT_EQ(run("program cone --machine iwf-bc --out piece").exit_code, 0);
  const Outcome listed = run("tools piece/job.toml --drawing t.dxf --json");
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const json doc = json::parse(listed.out);
  EXPECT_EQ(doc["schema"], "frustum/tools/1");
  ASSERT_EQ(doc["tools"].size(), 1U);
  EXPECT_NE(read(folder_ / "t.dxf").find("CUTTER"), std::string::npos);
  EXPECT_EQ(run("tools piece/job.toml --drawing t.svg").exit_code, 0);
  EXPECT_NE(read(folder_ / "t.svg").find("<svg xmlns"), std::string::npos);
  EXPECT_EQ(run("tools piece/job.toml --drawing t.png").exit_code, 2);
  EXPECT_EQ(run("tools piece/job.toml --drawing t.dxf --number 77").exit_code, 2);
}

TEST_F(ExchangeFormatsSystem, AResultSpeaksGermanAndInches) {
  EXPECT_EQ(run("run piece/job.toml --language fr").exit_code, 2);
  EXPECT_EQ(run("run piece/job.toml --units m").exit_code, 2);
  ASSERT_EQ(run("program cone --machine iwf-bc --chord-tolerance 1 --out piece").exit_code, 0);
  const Outcome german = run("run piece/job.toml --out de --language de --units inch");
  ASSERT_LE(german.exit_code, 1) << german.err;
  EXPECT_NE(german.out.find("Merkmal"), std::string::npos) << german.out;
  EXPECT_NE(german.out.find(" uin"), std::string::npos) << german.out;
  const std::string page = read(folder_ / "de/report.html");
  for (const char* part : {"<html lang=\"de\">", "Messunsicherheit", "µin", "Messbedingungen"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  const json doc = json::parse(read(folder_ / "de/result.json"));
  EXPECT_EQ(doc["characteristics"][0]["unit"], "um") << "documents stay in mm and English";
  EXPECT_EQ(doc["evidence"]["measuring"]["source"].get<std::string>().find("Koordinaten"),
            std::string::npos);
}

}  // namespace
}  // namespace frustum
