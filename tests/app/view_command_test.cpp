// frustum view as users and scripts see it: what is played, what the page holds, what is refused.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// A slot in two passes on a small machine with bodies, cut by a subprogram in a file of its own.
class ViewCommandSystem : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::ofstream(folder_ / "plate.nc") << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\n"
                                           "(first pass)\nG0 X-60 Y0 Z-5\nM98 P7\nG0 X-60\nG0 Z-8\n"
                                           "M98 P7\nM30\n";
    std::ofstream(folder_ / "O7.nc") << "O7\nG1 X0 F600\nX60\nG0 Z10\nM99\n";
    std::ofstream(folder_ / "plate.toml")
        << "title = \"Plate <1>\"\nmachine = \"three-axis\"\n"
           "program = { file = \"plate.nc\", dialect = \"fanuc\" }\n"
           "blank = { shape = \"box\", size = [80, 60, 20] }\n"
           "tool.1 = { type = \"flat\", diameter = 10, length = 100, flute_length = 30 }\n";
  }
  // The document of a run that succeeds.
  json view(const std::string& arguments) const {
    const Outcome outcome = run("view " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }
  // What the page's script reads.
  json data_of(const fs::path& page) const {
    const std::string html = read(folder_ / page);
    const std::string open = "id=\"chart-data\">";
    const auto begin = html.find(open) + open.size();
    return json::parse(html.substr(begin, html.find("</script>", begin) - begin), nullptr, false);
  }
};

TEST_F(ViewCommandSystem, PlaysAJobWithItsWorkpieceInSteps) {
  const json doc = view("plate.toml --out out --snapshots 4 --pitch 2 --error EXX=\"linear 10um\"");
  EXPECT_EQ(doc["schema"], "frustum/view/1");
  EXPECT_EQ(doc["title"], "Plate <1>");
  EXPECT_EQ(doc["blocks"], 9);  // four by the program, three by each call
  EXPECT_EQ(json::parse(read(folder_ / "out/view.json")), doc);
  EXPECT_EQ(doc["page_bytes"], fs::file_size(folder_ / "out/view.html"));
  // 10 um over the 800 mm of X, zero in the middle.
  EXPECT_NEAR(doc["largest_deviation_um"].get<double>(), 0.75, 1e-3);
  const json& steps = doc["steps"];
  ASSERT_GE(steps.size(), 3U);
  EXPECT_NEAR(steps.front()["volume_mm3"].get<double>(), 96000.0, 1e-3);  // the blank
  EXPECT_NEAR(steps.back()["volume_mm3"].get<double>(), 96000.0 - 6400.0, 1.0);
  const std::string html = read(folder_ / "out/view.html");
  EXPECT_THAT(html, HasSubstr("Plate &lt;1&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
  const json player = data_of("out/view.html")["player"];
  EXPECT_EQ(player["points"]["count"], doc["points"]);
  EXPECT_EQ(player["steps"].size(), steps.size());
  ASSERT_EQ(player["texts"].size(), 2U);
  EXPECT_EQ(player["texts"][0]["name"], "plate.nc");
  EXPECT_EQ(player["texts"][1]["name"], "O7.nc");
  EXPECT_FALSE(player["machine"]["bodies"].empty());
  EXPECT_EQ(player["tools"][0]["bodies"].size(), 2U);  // cutter and shank
}

TEST_F(ViewCommandSystem, PlaysAProgramOnAMachine) {
  const json doc = view("plate.nc --machine three-axis --tool-length 1=100 --tool-diameter 1=10");
  EXPECT_EQ(doc["title"], "plate.nc");
  EXPECT_EQ(doc["blocks"], 9);
  EXPECT_EQ(doc["largest_deviation_um"], 0.0);
  EXPECT_TRUE(doc["steps"].empty());
  EXPECT_TRUE(fs::exists(folder_ / "out/view.html"));  // beside the program
  EXPECT_EQ(run("view plate.nc --machine three-axis --snapshots 0").exit_code, 0);
  const Outcome assumed = run("view plate.nc --machine three-axis");
  EXPECT_EQ(assumed.exit_code, 0);
  EXPECT_THAT(assumed.err, HasSubstr("tool 1 counts as 100 mm long"));
  EXPECT_THAT(assumed.err, HasSubstr("tool 1 is drawn 10 mm thick"));
  // With a job, another program is cut from its blank.
  std::ofstream(folder_ / "short.nc") << "G21 G90\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X-60 Y0 Z-5\n"
                                         "G1 X60 F600\nM30\n";
  const json other = view("short.nc --job plate.toml --snapshots 1 --pitch 2");
  EXPECT_NEAR(other["steps"].back()["volume_mm3"].get<double>(), 96000.0 - 4000.0, 1.0);
}

// With servo lag the tool is late, which is no deviation; that it cuts corners is.
TEST_F(ViewCommandSystem, DeviationsOfALaggingMachineAreFromThePath) {
  std::ofstream(folder_ / "plate.nc") << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\n"
                                         "G0 X-60 Y0 Z-5\nG1 X0 F3000\nY20\nM30\n";
  std::ofstream(folder_ / "plate.toml", std::ios::app) << "[controller]\nservo_lag = true\n";
  const double largest = view("plate.toml --snapshots 0")["largest_deviation_um"].get<double>();
  EXPECT_GT(largest, 50.0);    // corners are rounded
  EXPECT_LT(largest, 1000.0);  // but nowhere near 1.67 mm, v / Kv of the feed
}

TEST_F(ViewCommandSystem, RefusesWithPlaceAndRemedy) {
  const auto refused = [&](const std::string& arguments, const std::string& what,
                           const std::string& remedy) {
    const Outcome outcome = run("view " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(what)) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(remedy)) << arguments;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << arguments;
  };
  refused("plate.nc", "no machine to play the program on", "--machine");
  refused("plate.toml --machine iwf-bc", "--machine: the job says that itself",
          "frustum view PROGRAM --job JOB");
  refused("plate.toml --offset G54=0,0,0", "--offset: the job says that itself", "change the job");
  refused("plate.toml --snapshots 0 --pitch 2", "--pitch is of the workpiece", "--snapshots 1");
  refused("plate.toml --snapshots 1 --pitch 9", "a pitch of 9 mm is too coarse", "quarter");
  refused("plate.nc --machine three-axis --tool-radius-error 2um", "no workpiece is cut", "--job");
  refused("plate.nc --machine three-axis --snapshots 5", "a program alone has no blank", "--job");
  refused("plate.nc --machine three-axis --pitch 2", "a program alone has no blank", "--job");
  refused("none.nc --machine three-axis", "none.nc", "");
  refused("plate.nc --machine three-axis --error EB0C=10urad", "EB0C", "");
  std::ofstream(folder_ / "idle.nc") << "G21 G90\nM30\n";
  refused("idle.nc --machine three-axis", "idle.nc: error: the program moves no tool",
          "check that it is the right file");
  std::ofstream(folder_ / "bad.nc") << "G21 G90\nT1 M6\nG54 G43 H1\nG1 X10 Q\nM30\n";
  refused("bad.nc --machine three-axis", "bad.nc:4", "");
}

}  // namespace
}  // namespace frustum
