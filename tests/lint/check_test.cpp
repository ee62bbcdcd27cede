// Every check has a program that raises it and the same program mended, which raises nothing.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string_view>

#include "lint/check_help.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

using parser::Dialect;

// A head and an end with which nothing is wrong.
constexpr const char* kHead = "T1 M6\nS1000 M3\nG43 H1\nG0 X0 Y0 Z50\n";
constexpr const char* kEnd = "G0 Z60\nM5\nM30\n";

std::string whole(const std::string& body) { return kHead + body + kEnd; }

struct Case {
  const char* id;
  std::string wrong;
  std::uint32_t line;  // where it is reported
  const char* says;
  std::string right;
  Dialect dialect = Dialect::fanuc;
  bool point_is_open = false;  // nothing says how numbers without a point are read
};

// Tool 1 of the job, for those that follow contours: 10 mm across.
CheckOptions options_of(const Case& one) {
  CheckOptions options;
  if (!std::string_view(one.id).starts_with("radius-")) return options;
  parser::Tool& tool = parser::entry_of(options.run.tools, 1);
  tool.diameter = 10.0;
  tool.has_diameter = true;
  return options;
}

class EachCheck : public testing::TestWithParam<Case> {};

TEST_P(EachCheck, IsRaisedOnceAndOnlyIt) {
  const CheckReport report = checked(GetParam().wrong, options_of(GetParam()), GetParam().dialect,
                                     GetParam().point_is_open);
  const auto found = of(report, GetParam().id);
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_EQ(report.findings.size(), 1U) << ids(report);
  EXPECT_EQ(found[0].line, GetParam().line) << found[0].message;
  EXPECT_NE(found[0].message.find(GetParam().says), std::string::npos) << found[0].message;
}

TEST_P(EachCheck, IsSilentWhereTheProgramIsRight) {
  EXPECT_EQ(ids(checked(GetParam().right, options_of(GetParam()), GetParam().dialect,
                        GetParam().point_is_open)),
            "")
      << GetParam().right;
}

TEST_P(EachCheck, CanBeLeftOut) {
  CheckOptions options = options_of(GetParam());
  options.disabled = {*check_named(GetParam().id)};
  EXPECT_EQ(ids(checked(GetParam().wrong, options, GetParam().dialect, GetParam().point_is_open)),
            "");
}

const std::string kCut = "G1 Z-1 F200\n";
// Along X with a tool of 5 mm radius on its left.
const std::string kSide = "(D 10)\nG41 D1\nG1 X20 F100\nX40\n";

INSTANTIATE_TEST_SUITE_P(
    Checks, EachCheck,
    testing::Values(
        Case{"program-error", whole("G999\n"), 5, "G999", whole("G90\n")},
        Case{"missing-subprogram", whole("M98 P7\n"), 5, "O7",
             whole("M98 P7\n") + "O7\nG0 X1\nM99\n"},
        Case{"missing-label", whole("GOTO 70\n"), 5, "N70", whole("GOTO 70\nN70 G0 X1\n")},
        Case{"recursion", whole("M98 P7\n") + "O7\nM98 P7\nM99\n", 10, "within each other",
             whole("M98 P7\n") + "O7\nG0 X1\nM99\n"},
        Case{"endless-loop", whole("N5 G0 X1\nGOTO 5\n"), 6, "does this loop end",
             whole("#1=0\nN5 #1=#1+1\nIF [#1 LT 9] GOTO 5\n")},
        Case{"unused-subprogram", whole("") + "O7\nG0 X1\nM99\n", 8, "O7 is not used",
             whole("M98 P7\n") + "O7\nG0 X1\nM99\n"},
        Case{"unused-label", "AGAIN: G0 X1\nM30\n", 1, "AGAIN is not used",
             "GOTOF AGAIN\nAGAIN: G0 X1\nM30\n", Dialect::sinumerik},
        Case{"unreachable-code", whole("") + "G0 X5\nG0 X6\n", 8, "2 blocks after M30 on line 7",
             whole("G0 X5\n")},
        Case{"duplicate-number", whole("GOTO 5\nN5 G0 X1\nN5 G0 X2\n"), 7, "N5 is jumped to",
             whole("GOTO 5\nN5 G0 X1\nN6 G0 X2\n")},
        Case{"no-program-end", "G0 X1\nG0 Z9\n", 2, "without M30", "G0 X1\nG0 Z9\nM30\n"},
        Case{"parameter-unset", whole("G0 X[#101+1]\n"), 5, "#101 is read",
             whole("#101=1\nG0 X[#101+1]\n")},
        Case{"vacant-word", whole("IF [#101 EQ #0] THEN #102=#0\nG0 X1 Y#102\n"), 6,
             "parameter of Y is vacant", whole("IF [#101 EQ #0] THEN #102=1\nG0 X1 Y#102\n")},
        Case{"not-simulated", whole("G61\nG61\n"), 5, "G61 is known", whole("")},
        Case{"builder-word", whole("M250\nM250\n"), 5, "M250 is a word of", whole("M1\n")},
        Case{"assumed", "X0 Y0 Z50\nM30\n", 1, "G0 is in force", "G0 X0 Y0 Z50\nM30\n"},
        Case{"decimal-point", "G0 X1. Z9.\nG0 X2. Y5\nG0 Y7\nM30\n", 2, "Y5 has no decimal point",
             "G0 X1. Z9.\nG0 X2. Y5.\nG0 Y0\nM30\n", Dialect::fanuc, true},
        Case{"unknown-suppression", whole("G0 X1 (frustum: ignore feed-slow)\n"), 5, "feed-slow",
             whole("G1 Z-1 F2 (frustum: ignore feed-low)\n")},
        Case{"unused-suppression", whole("(frustum: ignore feed-low)\nG1 Z-1 F200\n"), 5,
             "no feed-low", whole("(frustum: ignore feed-low)\nG1 Z-1 F2\n")},
        Case{"feed-missing", whole("G1 Z-1\n"), 5, "without a feed", whole(kCut)},
        Case{"feed-high", whole("G1 Z-1 F90000\n"), 5, "90000 mm/min", whole(kCut)},
        Case{"feed-low", whole("G1 Z-1 F2\n"), 5, "2 mm/min", whole(kCut)},
        Case{"inverse-time-speed", whole("G93 G1 Z-50 F500\nG94\n"), 5, "50000 mm/min",
             whole("G93 G1 Z-50 F5\nG94\n")},
        Case{"spindle-off", whole("M5\n" + kCut), 6, "spindle off", whole("M5\nM3\n" + kCut)},
        Case{"tool-missing", "S1000 M3\nG0 X0 Y0 Z50\n" + kCut + kEnd, 3, "before any tool",
             whole(kCut)},
        Case{"length-missing", whole("G49\nG0 Z50\n" + kCut), 7, "tool 1 cuts", whole(kCut)},
        Case{"length-of-other-tool", whole("G43 H2\n"), 5, "length of tool 2", whole("G43 H1\n")},
        Case{"arc-radii", whole("G2 X20.008 Y0 I10 J0 F200\n"), 5, "0.0080 mm apart",
             whole("G2 X20.003 Y0 I10 J0 F200\n")},
        Case{"arc-full-by-radius", whole("G2 X0 Y0 R10 F200\n"), 5, "ends at its start",
             whole("G2 X0 Y0 I10 J0 F200\n")},
        Case{"arc-nearly-full", whole("G3 X0 Y-0.01 I-10 J0 F200\n"), 5, "359.94 deg",
             whole("G2 X0 Y-0.01 I-10 J0 F200\nG0 Z50\n")},
        Case{"arc-tiny", whole("G2 X0.01 Y0 I0.005 J0 F200\n"), 5, "0.005 mm",
             whole("G2 X1 Y0 I0.5 J0 F200\n")},
        Case{"arc-huge", whole("G2 X1 Y0 R20000 F200\n"), 5, "20 m", whole("G2 X1 Y0 R200 F200\n")},
        Case{"radius-gouge", whole(kSide + "G3 X42 Y0 I1\nG1 X60\nG40 X80\n"), 9, "of radius 5",
             whole(kSide + "G3 X40 Y20 J10\nG1 X20\nG40 X0\n")},
        Case{"radius-compensation", whole("(D 10)\nG41 D7\nG1 X20 F100\nG40 X30\n"), 6,
             "diameter of tool 7", whole(kSide + "G40 X60\n")},
        Case{"short-segments", whole(kCut + "X0.001\nX0.002\nX1\n"), 6,
             "2 cutting moves are shorter", whole(kCut + "X0.1\n")},
        Case{"tip-control-off", whole("G0 C0\nG1 X10 C90 F200\n"), 6, "X and C cut together",
             whole("G0 C0\nG49\nG43.4 H1\nG0 X0 Y0 Z50\nG1 X10 C90 F200\nG49\n")},
        Case{"rotary-with-length", whole("G0 C0\nG0 C90\n"), 6, "C turns",
             whole("G0 C0\nG49\nG43.4 H1\nG0 X0 Y0 Z50\nG0 C90\nG49\n")},
        Case{"end-tip-control", whole("G49\nG43.4 H1\nG0 X1 Y0 Z50\n"), 10, "control on",
             whole("G49\nG43.4 H1\nG0 X1 Y0 Z50\nG49\n")},
        Case{"end-incremental", whole("G91\n"), 8, "in G91", whole("G91\nG90\n")},
        Case{"end-inverse-time", whole("G93\n"), 8, "in G93", whole("G93\nG94\n")},
        Case{"end-tilted-plane", whole("G68.2 X0 Y0 Z0 I0 J10 K0\n"), 8, "tilted plane",
             whole("G68.2 X0 Y0 Z0 I0 J10 K0\nG69\n")},
        Case{"end-shifted-frame", whole("G52 X5\n"), 8, "shift or turn", whole("G52 X5\nG52 X0\n")},
        Case{"end-spindle", "T1 M6\nS1000 M3\nG43 H1\nG0 X0 Y0 Z50\nM30\n", 5, "spindle on",
             whole("")},
        Case{"end-coolant", whole("M8\n"), 8, "coolant on", whole("M8\nM9\n")},
        Case{"end-no-retract", std::string(kHead) + kCut + "M5\nM30\n", 5, "no retract",
             whole(kCut)}),
    [](const testing::TestParamInfo<Case>& each) {
      std::string name = each.param.id;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(Checks, AllHaveACaseHereOrOnAMachine) {
  std::set<std::string> cased;
  const auto* suite = testing::UnitTest::GetInstance();
  for (int i = 0; i < suite->total_test_suite_count(); ++i) {
    const auto* tests = suite->GetTestSuite(i);
    if (std::string(tests->name()) != "Checks/EachCheck") continue;
    for (int k = 0; k < tests->total_test_count(); ++k) {
      std::string name = tests->GetTestInfo(k)->name();
      name = name.substr(name.find('/') + 1);
      std::replace(name.begin(), name.end(), '_', '-');
      cased.insert(name);
    }
  }
  for (const CheckInfo& info : all_checks()) {
    // That has a test of its own, for it comes after a thousand others.
    if (info.check == Check::too_many_errors) continue;
    EXPECT_TRUE(info.needs != Needs::nothing || cased.contains(std::string(info.id))) << info.id;
  }
}

TEST(Checks, NamesAreFoundAndUnlike) {
  std::set<std::string_view> names;
  for (const CheckInfo& info : all_checks()) {
    EXPECT_EQ(check_named(info.id), info.check);
    EXPECT_TRUE(names.insert(info.id).second) << info.id;
  }
  EXPECT_EQ(check_named("no-such-check"), std::nullopt);
}

TEST(Checks, StandInTheDocument) {
  std::ifstream file(std::string(FRUSTUM_SOURCE_DIR) + "/docs/check.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const CheckInfo& info : all_checks()) {
    const std::string row = "| `" + std::string(info.id) + "`" +
                            (info.needs == Needs::machine ? " M"
                             : info.needs == Needs::job   ? " J"
                                                          : "") +
                            " | " + to_string(info.severity) + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

TEST(Checks, RepeatsInALoopAreOneFindingWithACount) {
  const CheckReport report = checked(
      whole("#1=0\nWHILE [#1 LT 50] DO1\nG2 X20.008 Y0 I10 J0 F200\nG0 X0\n#1=#1+1\nEND1\n"));
  const auto found = of(report, "arc-radii");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].count, 50U);
}

TEST(Checks, AFloodIsCutShort) {
  std::string body = "F200\n";
  for (int i = 0; i < 500; ++i) body += "G2 X20.008 Y0 I10 J0\nG0 X0\n";
  const CheckReport report = checked(whole(body));
  EXPECT_EQ(of(report, "arc-radii").size(), kMostPlaces);
  EXPECT_EQ(report.left_out.at(Check::arc_radii), 400U);
}

TEST(Checks, EndWithAWordWhereTooManyBlocksCannotBeRun) {
  std::string text = "G0 X1\n";
  for (int i = 0; i < 1200; ++i) text += "G999\n";
  const CheckReport report = checked(text + "G1 X2\nM30\n");
  const auto found = of(report, "too-many-errors");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 1001U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_NE(found[0].message.find("1000 blocks"), std::string::npos) << found[0].message;
  EXPECT_TRUE(of(checked("G0 X1\nG999\nM30\n"), "too-many-errors").empty());
}

TEST(Checks, AnErrorIsListedBehindAFloodOfWarnings) {
  std::string body = "F200\n";
  for (int i = 0; i < 150; ++i) body += "G2 X20.008 Y0 I10 J0\nG0 X0\n";
  bool error = false;
  for (const Finding& finding : of(checked(whole(body + "G2 X20.5 Y0 I10 J0\n")), "arc-radii")) {
    error = error || finding.severity == Severity::error;
  }
  EXPECT_TRUE(error);
}

TEST(Checks, AWordWithoutAPointIsOneFindingOnce) {
  // Both the interpreter and the check of the text have something to say of it.
  const auto found =
      of(checked("G0 X0019685 Y1. Z9.\nM30\n", {}, Dialect::fanuc, true), "decimal-point");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].count, 1U);
}

TEST(Checks, AFurtherEdgeIsThatOfItsTool) {
  const auto program = [](const std::string& body) {
    return "S1000 M3\nG0 Z50\n" + body + "G0 Z60\nM5\nM30\n";
  };
  EXPECT_TRUE(
      of(checked(program("T1 D2 M6\n"), {}, Dialect::sinumerik), "length-of-other-tool").empty());
  const kinematics::Machine machine = shipped("iwf-bc");
  CheckOptions options;
  options.machine = &machine;
  const auto assumed =
      of(checked(program("T1 D2 M6\n"), options, Dialect::sinumerik), "setup-assumed");
  ASSERT_FALSE(assumed.empty());
  EXPECT_NE(assumed[0].message.find("edge 2 of tool 1"), std::string::npos) << assumed[0].message;
}

TEST(Checks, OfASubprogramAloneAreThoseThatNeedNoCaller) {
  const std::string text = "O7\nG1 X5\nG999 Y#1\nM250\nM99\nG0 X1\n";
  CheckOptions options;
  options.subprogram = true;
  EXPECT_EQ(ids(checked(text, options)), "3:program-error 4:builder-word 6:unreachable-code ");
  options.subprogram = false;
  EXPECT_NE(ids(checked(text, options)), "3:program-error 4:builder-word 6:unreachable-code ");
}

TEST(Checks, TellWhatTheyMeanAndWhatToDo) {
  for (const CheckInfo& info : all_checks()) {
    const CheckHelp help = help_of(info.check);
    EXPECT_GT(help.meaning.size(), info.title.size()) << info.id;
    EXPECT_TRUE(help.meaning.ends_with('.') && help.remedy.ends_with('.')) << info.id;
  }
}

TEST(Checks, TellAllSyntaxErrorsOfTheTextOnce) {
  const CheckReport report = checked(whole("G0 X(\nG0 Y(\n") + "O7\nG0 Z(\nM99\n");
  std::set<std::uint32_t> lines;
  std::uint64_t count = 0;
  for (const Finding& finding : of(report, "program-error")) {
    lines.insert(finding.line);
    count += finding.count;
  }
  EXPECT_EQ(count, 3U) << ids(report);
}

TEST(Checks, SayNothingOfPlacesThatAnErrorHasMadeUnknown) {
  EXPECT_EQ(ids(checked(whole("G1 X#777 G999\nG2 X20 Y0 I10 J0 F200\n"))),
            "5:assumed 5:program-error ");
}

TEST(Checks, AreMilderOnAxisMovesInInverseTime) {
  const auto found = of(checked(whole("G0 C0\nG93 G1 X10 C90 F20\nG94\n")), "tip-control-off");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::note);
}

TEST(Checks, TellTheSpindleOnceUntilItChanges) {
  const auto found =
      of(checked(whole("M5\n" + kCut + "X1\nX2\nX3\nM3\nX4\nM5\nX5\n")), "spindle-off");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].count, 4U);
  EXPECT_EQ(found[1].count, 1U);
}

TEST(Checks, SayNothingOfWhatM30OfTheControlPutsRight) {
  const std::string program = "S1000 M3\nM8\nG91\nG93\n";
  EXPECT_EQ(ids(checked(program + "M30\n", {}, Dialect::linuxcnc)), "");
  EXPECT_EQ(of(checked(program + "M30\n"), "end-spindle").size(), 1U);
  EXPECT_EQ(ids(checked("BEGIN PGM P MM\nTOOL CALL 1 Z S1000\nL M3\nL M8\nL M30\nEND PGM P MM\n",
                        {}, Dialect::heidenhain)),
            "");
}

TEST(Checks, SayNothingOfCuttingMovesThatStand) {
  EXPECT_EQ(ids(checked(whole(kCut + "X0 Y0\nX0\nX1\n"))), "");
}

TEST(Checks, LocalParametersOfASubprogramMayComeFromItsCall) {
  EXPECT_EQ(ids(checked(whole("G65 P7 A5\n") + "O7\nG0 X#1\nM99\n")), "");
  EXPECT_EQ(of(checked(whole("G0 X[#1+1]\n")), "parameter-unset").size(), 1U);
}

TEST(CheckOfAnAlarm, IsToldByItsIdWhateverItsCommentSays) {
  for (const char* comment : {"great circle over-travel", "no subprogram has no value"}) {
    const auto report = checked(whole(std::string("#3000=1 (") + comment + ")\n"));
    const auto found = of(report, "program-error");
    ASSERT_EQ(found.size(), 1U) << ids(report);
    EXPECT_NE(found[0].message.find(comment), std::string::npos) << found[0].message;
    EXPECT_TRUE(of(report, "unreachable-orientation").empty());
    EXPECT_TRUE(of(report, "missing-subprogram").empty());
  }
}

}  // namespace
}  // namespace frustum::lint
