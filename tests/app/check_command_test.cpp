// frustum check and what frustum parse says of a program that cannot be run to its end.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class CheckCommandSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
};

const std::string kGood =
    "G21 T1 M6\nS1000 M3\nG54 G43 H1\nG0 X0 Y0 Z50\nG1 Z10 F200\nG0 Z60\nM5\nM30\n";

TEST_F(CheckCommandSystem, PassesAProgramWithNothingWrong) {
  write("part.nc", kGood);
  const Outcome outcome = run("check part.nc --machine iwf-bc --tool-length 1=100");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_EQ(outcome.out, "0 errors, 0 warnings, 0 notes in 8 blocks that ran\n");
  EXPECT_NE(outcome.err.find("note: read as fanuc"), std::string::npos) << outcome.err;
  EXPECT_EQ(run("check part.nc --quiet").err, "");
}

TEST_F(CheckCommandSystem, TellsPlaceMessageAndLineAsACompilerDoes) {
  write("part.nc", "G21 T1 M6\nS1000 M3\nG54 G43 H1\nG0 X412 Y0 Z50\nG0 X0\nM5\nM30\n");
  const Outcome outcome = run("check part.nc --machine iwf-bc --tool-length 1=100");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(
      outcome.out.find("part.nc:4:1: error: X goes to 412.000 mm, 12.000 mm beyond its travel of "
                       "-400 to 400 mm [over-travel]\n     4 | G0 X412 Y0 Z50\n       | ^\n"),
      std::string::npos)
      << outcome.out;
}

TEST_F(CheckCommandSystem, LeavesTheMachineOutWithANote) {
  write("part.nc", "G0 X9999\nM30\n");
  const Outcome outcome = run("check part.nc");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_NE(outcome.err.find("no --machine"), std::string::npos) << outcome.err;
}

TEST_F(CheckCommandSystem, CompensatesRadiiWithTheToolsThatItIsTold) {
  write("part.nc",
        "G21 T1 M6\nS1000 M3\nG54 G43 H1\nG0 X0 Y0 Z50\nG1 Z10 F200\nG41 D1 X20\nX40\nG40 X60\n"
        "G0 Z60\nM5\nM30\n");
  const Outcome without = run("check part.nc");
  EXPECT_NE(without.out.find("part.nc:6:"), std::string::npos) << without.out;
  EXPECT_EQ(run("check part.nc --tool-diameter 1=10").exit_code, 0);
  write("tools.tbl", "T1 P1 D10 Z100\n");
  EXPECT_EQ(run("check part.nc --tools tools.tbl").exit_code, 0);
  EXPECT_EQ(run("check part.nc --tool-diameter 1=-1").exit_code, 2);
}

// What is said of the setup is read with a machine and without.
TEST_F(CheckCommandSystem, RefusesASetupThatIsNone) {
  write("part.nc", kGood);
  for (const char* words : {"--offset foo", "--offset G99=1,2,3", "--offset G54.1P0=1,2,3",
                            "--tool-length 1", "--tool-length a=b", "--search nowhere"}) {
    EXPECT_NE(run(std::string("check part.nc ") + words).exit_code, 0) << words;
  }
  EXPECT_EQ(run("check part.nc --offset G54.1P1=1,2,3 --offset G59.1=0,0,0").exit_code, 0);
}

TEST_F(CheckCommandSystem, FailsOnWarningsWhenTold) {
  write("part.nc", "G21 G0 X1\nG91\nM30\n");
  EXPECT_EQ(run("check part.nc").exit_code, 0);
  EXPECT_EQ(run("check part.nc --fail-on warning").exit_code, 1);
  EXPECT_EQ(run("check part.nc --fail-on warning --disable end-incremental").exit_code, 0);
}

TEST_F(CheckCommandSystem, PrintsOneJsonDocument) {
  write("part.nc", "G21 G0 X1\nG1 X2\nM30\n");
  const Outcome outcome = run("check part.nc --json --machine iwf-bc");
  EXPECT_EQ(outcome.exit_code, 1);
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["status"], "fail");
  EXPECT_EQ(doc["machine"], "iwf-bc");
  EXPECT_EQ(doc["findings"][0]["id"], "feed-missing");
  EXPECT_EQ(doc["findings"][0]["line"], 2);
}

TEST_F(CheckCommandSystem, WritesSarif) {
  write("part.nc", "G21 G0 X1\nG1 X2\nM30\n");
  EXPECT_EQ(run("check part.nc --sarif found.sarif").exit_code, 1);
  const json doc = json::parse(read(folder_ / "found.sarif"));
  EXPECT_EQ(doc["version"], "2.1.0");
  const json& result = doc["runs"][0]["results"][0];
  EXPECT_EQ(result["ruleId"], "feed-missing");
  EXPECT_EQ(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "part.nc");
}

TEST_F(CheckCommandSystem, RefusesWhatIsWrongWithTheCommand) {
  write("part.nc", kGood);
  for (const char* words :
       {"check no-such.nc", "check part.nc --machine no-such", "check",
        "check part.nc --disable spindel-off", "check part.nc --fail-on nothing",
        "check part.nc --start Q1", "check part.nc --start X1,X2", "check part.nc --most-repeats 0",
        "check part.nc --most-repeats .5", "check part.nc --most-repeats 1e6"}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_FALSE(outcome.err.empty()) << words;
    EXPECT_EQ(outcome.out, "") << words;
  }
  EXPECT_NE(run("check part.nc --disable spindel-off").err.find("spindle-off"), std::string::npos);
}

TEST_F(CheckCommandSystem, FindsSubprogramsInTheFoldersThatAreNamed) {
  fs::create_directories(folder_ / "macros");
  write("macros/O9010.nc", "O9010\nG1 X5\nM99\n");
  write("part.nc", "G65 P9010\nM30\n");
  EXPECT_NE(run("check part.nc").out.find("[missing-subprogram]"), std::string::npos);
  const Outcome outcome = run("check part.nc --search macros");
  EXPECT_NE(outcome.out.find("macros/O9010.nc:2:1: error: G1 without a feed rate [feed-missing]\n"
                             "     2 | G1 X5\n"),
            std::string::npos)
      << outcome.out;
}

TEST_F(CheckCommandSystem, Fault2_18_SeesTipControlOffFromTheMachinesHomeOn) {
  write("part.nc", "G21 T1 M6\nS1000 M3\nG43 H1\nG0 Z50\nG1 B30 X40 F500\nG0 Z60\nM5\nM30\n");
  EXPECT_EQ(run("check part.nc").out.find("tip-control-off"), std::string::npos);
  EXPECT_NE(run("check part.nc --machine iwf-bc").out.find("part.nc:5:1: warning: X and B cut"),
            std::string::npos);
}

TEST_F(CheckCommandSystem, Fault2_13_TakesWhereTheAxesStart) {
  write("part.nc", "G91\nG0 X10\nZ0.5\nM30\n");
  const Outcome outcome =
      run("parse part.nc --dialect fanuc --quiet --canon --start X1,Y2,Z=3,B30");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\"X\":11"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\"B\":30"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("\"A\""), std::string::npos) << "A stays unknown";
  const Outcome home =
      run("parse part.nc --dialect fanuc --quiet --canon --machine iwf-bc --offset G54=0,0,100");
  EXPECT_EQ(home.exit_code, 0) << home.err;
  EXPECT_NE(home.out.find("\"Z\":400.5"), std::string::npos) << home.out;
  EXPECT_EQ(run("check part.nc --dialect fanuc --start X1,Y2,Z3").exit_code, 0);
}

TEST_F(CheckCommandSystem, Fault2_12_WordsOfTheBuilderAreTheMachinesOrOfAnOption) {
  write("part.nc", "G21 G0 X1\nM250\nM30\n");
  EXPECT_NE(run("check part.nc").out.find("[builder-word]"), std::string::npos);
  EXPECT_EQ(run("check part.nc --builder-word M250").out.find("builder-word"), std::string::npos);
  EXPECT_EQ(run("check part.nc --builder-word 250M").exit_code, 2);
  write("mill.toml",
        "name = \"mill\"\nstructure = \"t-(C)-Z-b-X-Y-w\"\n[axis.X]\ntravel = [-1, 1]\n"
        "[axis.Y]\ntravel = [-1, 1]\n[axis.Z]\ntravel = [-1, 1]\n"
        "[controller]\nwords = [\"M250\"]\ndecimal_point = \"increment\"\n");
  const Outcome outcome = run("check part.nc --machine mill.toml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_EQ(outcome.out.find("builder-word"), std::string::npos) << outcome.out;
}

TEST_F(CheckCommandSystem, Fault2_08_NumbersWithoutAPointAreReadAsTheOptionSays) {
  write("part.nc", "G20\nG0 X0019685 Y1.\nM30\n");
  EXPECT_NE(run("check part.nc --dialect fanuc").out.find("[decimal-point]"), std::string::npos);
  const Outcome told =
      run("parse part.nc --dialect fanuc --quiet --canon --decimal-point increment");
  EXPECT_NE(told.out.find("\"X\":49.9999"), std::string::npos) << told.out;
  EXPECT_EQ(
      run("check part.nc --dialect fanuc --decimal-point increment").out.find("decimal-point"),
      std::string::npos);
}

TEST_F(CheckCommandSystem, Fault2_17_Ends) {
  write("part.ngc", "o1 do\no1 while [1]\nM2\n");
  const Outcome outcome = run("check part.ngc --machine iwf-bc");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("[endless-loop]"), std::string::npos) << outcome.out;
}

TEST_F(CheckCommandSystem, ListsItsChecks) {
  const Outcome outcome = run("check --list");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("over-travel (error, with a machine): "), std::string::npos);
}

TEST_F(CheckCommandSystem, ParseEndsItsLinesWithTheError) {
  write("part.nc", "G21 G0 X1\nG999\n");
  const Outcome outcome = run("parse part.nc --canon --quiet");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("part.nc:2:1: error: "), std::string::npos);
  std::istringstream lines(outcome.out);
  std::string first, last;
  std::getline(lines, first);
  std::getline(lines, last);
  EXPECT_EQ(json::parse(first)["type"], "traverse");
  EXPECT_EQ(json::parse(last)["type"], "error");
  EXPECT_EQ(json::parse(last)["line"], 2);
}

}  // namespace
}  // namespace frustum
