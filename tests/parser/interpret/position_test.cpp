// What the program may rely on after moves and frame changes whose result it cannot know.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::string axes_in(const AxisTarget& target) {
  std::string names;
  for (const AxisLetter axis : kAxisLetters) {
    if (target[axis]) names += to_char(axis);
  }
  return names;
}

struct Case {
  const char* change;
  const char* known;  // axes that a move of X then carries
};

TEST(Position, IsKnownOnlyAsFarAsTheProgramCanKnowIt) {
  for (const Case& c : {
           Case{"G28 Z5", "XYABC"},
           Case{"G28 Y0 A0", "XZBC"},
           Case{"G91 G28 Z0\nG90 G0", "XYABC"},
           Case{"G53 G0 Z0", "XYABC"},
           Case{"G53 Y0 C0", "XZAB"},
           Case{"G54", "XYZABC"},
           Case{"G55", "X"},
           Case{"G43 H1", "XYABC"},
           Case{"G43.4 H1", "XABC"},
           Case{"G43.5 H1", "XABC"},
           Case{"G49", "XYZABC"},
           Case{"G40 G80 G17 G0", "XYZABC"},
           Case{"T1 M6", "XYABC"},
           Case{"G20", "XYZABC"},
       }) {
    const std::string text = std::string("G0 X1 Y2 Z3 A4 B5 C6\n") + c.change + "\n";
    // A move of X shows what the program carries besides X.
    EXPECT_EQ(axes_in(last_of<Traverse>(motions(text + "X9\n")).end), c.known) << c.change;
  }
}

// Where a machine changes its tools only its builder knows; LinuxCNC comes back (NIST 6556, 3.6.3).
TEST(Position, OfZIsLostInAToolChangeThatTheControlDoesNotDescribe) {
  const std::string head = "G21 G90 G54\nT1 M6\nG0 X1 Y2 Z50\nT2 M6\n";
  const auto step = complaints(head + "G91 G0 Z-20\n");
  ASSERT_EQ(step.size(), 1U);
  EXPECT_NE(step.front().find("5:8: error: Z-20 is incremental, but Z is not known since the tool "
                              "change on line 4"),
            std::string::npos)
      << step.front();
  const auto kept = motions(head + "G91 G0 Z-20\n", {}, Dialect::linuxcnc);
  EXPECT_EQ(last_of<Traverse>(kept).end[Z], 30.0);
  EXPECT_TRUE(last_of<ToolChange>(kept).axes_stay);
}

// Nothing says where Z is after the first tool change either, or at home.
TEST(Position, OfZIsNotZeroAfterTheFirstToolChangeNorAtHome) {
  using Lines = std::vector<std::string>;
  const auto first = [](const std::string& text, Dialect dialect = Dialect::fanuc) {
    const Lines lines = complaints(text, in_millimetres({}), dialect);
    return lines.empty() ? "" : lines.front().substr(0, lines.front().find(" (hint: "));
  };
  EXPECT_EQ(first("G90 G54\nT1 M6\nG91 G0 Z-5\n"),
            "3:8: error: Z-5 is incremental, but Z is not known since the tool change on line 2");
  EXPECT_EQ(first("T1 M6\nG43 H1\nG91 G1 Z-5 F100\n"),
            "3:8: error: Z-5 is incremental, but Z is not known since the tool change on line 1");
  EXPECT_EQ(first("T1 M6\nG43.4 H1\nG55\nG91 G0 Z-5\n"),
            "4:8: error: Z-5 is incremental, but Z is not known since the tool change on line 1");
  EXPECT_EQ(first("TOOL CALL 1 Z S500\nL IZ-5 FMAX\n", Dialect::heidenhain),
            "2:3: error: IZ-5 is incremental, but Z is not known since the tool change on line 1");
  EXPECT_EQ(first("G91 G28 Z0\nG0 Z-5\n"),
            "2:4: error: Z-5 is incremental, but Z is not known since G28 on line 1");
  // X and Y stay, and so does all that says where Z is.
  EXPECT_EQ(last_of<Traverse>(motions("T1 M6\nG91 G0 X-5\n")).end[X], -5.0);
  EXPECT_EQ(last_of<Traverse>(motions("T1 M6\nG90 G0 G43 H1 Z50\nG91 Z-5\n")).end[Z], 45.0);
  EXPECT_EQ(last_of<Traverse>(motions("T1 M6\nG92 Z50\nG91 G0 Z-5\n")).end[Z], 45.0);
  EXPECT_EQ(last_of<Traverse>(motions("G53 G0 Z0\nT1 M6\nG91 G0 Z-5\n")).end[Z], -5.0);
  InterpreterOptions at_home;
  at_home.reference_points[0][Z] = 400.0;
  EXPECT_EQ(last_of<Traverse>(motions("G91 G28 Z0\nT1 M6\nG0 Z-5\n", at_home)).end[Z], 395.0);
  InterpreterOptions started;
  started.start[Z] = 100.0;
  EXPECT_EQ(last_of<Traverse>(motions("G91 G0 Z-5\nT1 M6\n", started)).end[Z], 95.0);
  const auto kept = motions("T1 M6\nG90 G0 Z9\nT2 M6\nG91 Z-5\n", {}, Dialect::linuxcnc);
  EXPECT_EQ(last_of<Traverse>(kept).end[Z], 4.0);
}

// Where the height is the machine's, the tool comes over the hole before it goes down.
TEST(Position, OfZAfterAToolChangeIsKeptOnTheWayToAHole) {
  const std::string klartext =
      "TOOL CALL 1 Z S500\nL X+10 Y+10 FMAX M3\nL Z+50 FMAX\nTOOL CALL 2 Z S1000\n"
      "L X+100 Y+5 FMAX M3\nCYCL DEF 200 DRILLING Q200=2 Q201=-15 Q206=250 Q202=15 Q210=0 "
      "Q203=+0 Q204=50 Q211=0\nCYCL CALL POS X+7 Y+7 Z+0 FMAX\n";
  const std::string cldata =
      "UNITS/MM\nLOADTL/1\nRAPID\nGOTO/100,100,50\nLOADTL/2\nSPINDL/RPM,500,CLW\n"
      "CYCLE/DRILL,DEPTH,15,MMPM,100,CLEAR,2\nGOTO/7,7,0\n";
  for (const auto& [text, dialect] :
       {std::pair(klartext, Dialect::heidenhain), {cldata, Dialect::cldata}}) {
    const auto rapids = all_of<Traverse>(motions(text, {}, dialect));
    bool is_over = false;
    for (const Traverse& rapid : rapids) {
      if (rapid.end[X] != 7.0) continue;
      EXPECT_TRUE(is_over || !rapid.end[Z]) << name_of(dialect);
      is_over = true;
      EXPECT_EQ(rapid.end[AxisLetter::Y], 7.0) << name_of(dialect);
    }
    EXPECT_TRUE(is_over) << name_of(dialect);
  }
}

// R and the bottom of G90 do not ask where the cycle begins, the level of G98 does; steps do.
TEST(Position, OfZAfterAToolChangeIsTheMachinesInACycle) {
  const std::string head = "G21 G90 G54\nT1 M6\nG0 X1 Y2 Z50\nT2 M6\nM3 S100\n";
  const std::string cycle = "G81 X33 Y30 Z-5 R2 F100\n";
  const std::vector<std::string> unknown{"position-unknown"};
  EXPECT_EQ(complaint_ids(head + "G91 " + cycle), unknown);
  EXPECT_EQ(complaint_ids(head + "G87 X33 Y30 Z-5 R-9 Q1 F100\n"), unknown);
  for (const auto& [length, level] : {std::pair("", 50.0), {"G43 H2\n", 50.0}}) {
    const auto drilled = motions(head + length + cycle);
    std::vector<std::optional<double>> heights;
    for (const Traverse& rapid : all_of<Traverse>(drilled)) heights.push_back(rapid.end[Z]);
    EXPECT_EQ(heights, (std::vector<std::optional<double>>{50.0, std::nullopt, 2.0, level}));
    EXPECT_EQ(last_of<Event>(drilled).text,
              "Z is not known since the tool change on line 4: the initial level is where it was "
              "before, or R where that is higher");
  }
}

std::vector<std::string> levels_told(const std::vector<Motion>& all) {
  std::vector<std::string> told;
  for (const Motion& motion : all) {
    const auto* event = std::get_if<Event>(&motion.command);
    if (event == nullptr || event->name != "initial level") continue;
    EXPECT_EQ(event->grade, EventGrade::assumed);
    told.push_back(std::to_string(motion.place.line) + ": " + event->text);
  }
  return told;
}

TEST(Position, OfZAfterTheFirstToolChangeIsTheMachinesInACycle) {
  const std::string head = "G21 G90 G54\nT1 M6\nM3 S100\nG43 H1\n";
  const auto heights = [](const std::vector<Motion>& all) {
    std::vector<std::optional<double>> found;
    for (const Traverse& rapid : all_of<Traverse>(all)) found.push_back(rapid.end[Z]);
    return found;
  };
  using Heights = std::vector<std::optional<double>>;
  const std::string cycle = "X33 Y30 Z-5 R2 F100\n";
  const auto to_level = motions(head + "G99 G81 " + cycle);
  EXPECT_EQ(heights(to_level), (Heights{std::nullopt, 2.0, 2.0}));
  EXPECT_TRUE(levels_told(to_level).empty());
  const auto to_initial = motions(head + "G98 G81 " + cycle);
  EXPECT_EQ(heights(to_initial), (Heights{std::nullopt, 2.0, 2.0}));
  EXPECT_EQ(levels_told(to_initial),
            std::vector<std::string>{
                "5: Z is not known since the tool change on line 2: the initial level is R"});
  // With no tool change at all R is as good, and G98 asks where the tool is.
  EXPECT_EQ(heights(motions("G99 G81 " + cycle)), (Heights{std::nullopt, 2.0, 2.0}));
  const std::vector<std::string> unknown{"position-unknown"};
  EXPECT_EQ(complaint_ids("G98 G81 " + cycle), unknown);
  EXPECT_EQ(complaint_ids("G99 G81 " + cycle + "G98 X5\n"), unknown);
  EXPECT_EQ(complaint_ids(head + "G99 G91 G81 " + cycle), unknown);
}

TEST(Position, OfTheInitialLevelIsToldAfterEachToolChangeThatItComesFrom) {
  const auto all = motions(
      "G21 G90 G0 X0 Y0 Z50\nM3 S100\nG98 G81 X1 Z-5 R2 F100\nT2 M6\nX2\nT3 M6\nG99 X3\nG98 "
      "X4\nG80\nT4 M6\nG98 G81 X5 Z-5 R2\nT5 M6\nG99 X6\nG80\nG0 Z9\nG98 G81 X7 Z-5 R2\n");
  EXPECT_EQ(levels_told(all),
            (std::vector<std::string>{"5: Z is not known since the tool change on line 4: the "
                                      "initial level is that of the cycle before it",
                                      "8: Z is not known since the tool change on line 6: the "
                                      "initial level is that of the cycle before it",
                                      "11: Z is not known since the tool change on line 10: the "
                                      "initial level is where it was before, or R where that is "
                                      "higher"}));
  std::vector<double> last;
  for (const Traverse& rapid : all_of<Traverse>(all)) last.push_back(rapid.end[Z].value_or(-1.0));
  EXPECT_EQ(last, (std::vector<double>{50, 50, 2, 50, -1, 2, 50, -1, 2, 2, 2,
                                       50, -1, 2, 50, -1, 2, 2,  9,  9, 2, 9}));
}

TEST(Position, SurvivesARepeatedOffsetOrCompensation) {
  const auto move =
      last_of<Traverse>(motions("G55 G43 H2\nG0 X1 Y2 Z3\nG55\nG43 H2\nG91 X1 Y1 Z1\n"));
  EXPECT_EQ(axes_in(move.end), "XYZ");
  EXPECT_EQ(move.end[Z], 4.0);
}

TEST(Position, ChangesItsHeightWithTheOffsetNumber) {
  const auto move = last_of<Traverse>(motions("G43 H1\nG0 X1 Z3\nG43 H2\nX2\n"));
  EXPECT_EQ(axes_in(move.end), "X");
}

TEST(Position, StaysBetweenTheTwoFormsOfToolCentrePointControl) {
  const auto move = last_of<Traverse>(motions("G43.4 H1\nG0 X1 Y2 Z3 A5\nG43.5 H1\nX2 K1\n"));
  EXPECT_EQ(axes_in(move.end), "XYZ");
}

TEST(Position, IsLostWhenToolCentrePointControlEnds) {
  const auto move = last_of<Traverse>(motions("G43.4 H1\nG0 X1 Y2 Z3 A5\nG49\nX2\n"));
  EXPECT_EQ(axes_in(move.end), "XA");
}

TEST(Position, OfTheTipIsLostByAnyMoveInMachineCoordinates) {
  const auto move = last_of<Traverse>(motions("G43.4 H1\nG0 X1 Y2 Z3 A5 C6\nG53 C0\nG0 X9\n"));
  EXPECT_EQ(axes_in(move.end), "XA");
}

TEST(Home, GoesThroughTheIntermediatePoint) {
  const auto all = motions("G0 X1 Y2 Z3\nG28 Z50\n");
  ASSERT_EQ(all.size(), 3U);
  const auto through = std::get<Traverse>(all[1].command);
  EXPECT_EQ(through.end[Z], 50.0);
  EXPECT_EQ(through.end[X], 1.0);
  const auto home = std::get<HomeReturn>(all[2].command);
  EXPECT_EQ(home.axes, (std::array<bool, 6>{false, false, true, false, false, false}));
}

TEST(Home, GoesStraightFromWhereItIsWithAZeroIncrement) {
  const auto from_nowhere = motions("G91 G28 Z0\n");
  ASSERT_EQ(from_nowhere.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<HomeReturn>(from_nowhere[0].command));
  const auto all = motions("G0 Z5\nG91 G28 Z0\n");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<HomeReturn>(all[1].command));
}

TEST(Home, LeavesTheMotionModeAsItWas) {
  EXPECT_EQ(all_of<LinearFeed>(motions("G1 X1 F100\nG28 Z5\nX2\n")).size(), 2U);
}

TEST(MachineCoordinates, NameOnlyTheAxesOfTheBlock) {
  const auto move = last_of<LinearFeed>(motions("G0 X1 Y2 A5\nG20 G53 G1 Z-1 C90 F10\n"));
  EXPECT_EQ(move.coordinates, Coordinates::machine);
  EXPECT_EQ(axes_in(move.end), "ZC");
  EXPECT_EQ(move.end[Z], -25.4);
  EXPECT_EQ(move.end[C], 90 * kRadPerDeg);
  EXPECT_EQ(move.feed.value, 254.0);
}

TEST(MachineCoordinates, LastForOneBlock) {
  const auto moves = all_of<Traverse>(motions("G53 G0 Z0\nX5\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[1].coordinates, Coordinates::program);
}

// What a block that was passed over makes unknown is no mistake of its own.
TEST(Position, LostByABlockThatWasPassedOverHasAnIdOfItsOwn) {
  std::vector<std::string> ids;
  InterpreterOptions options;
  options.go_on = [&](Diagnostic&& problem) {
    ids.emplace_back(problem.id.text());
    return true;
  };
  const auto program =
      parse_program("G0 X0 Y0\nX[1/0] Y[2/0]\nG91 X1\nZ1\nM2\n", "part.nc", Dialect::linuxcnc);
  ASSERT_TRUE(program);
  ASSERT_TRUE(motions_of(*program, options));
  ASSERT_EQ(ids.size(), 3U);
  EXPECT_EQ(ids[1], "follows-mistake");
  EXPECT_EQ(ids[2], "position-unknown");
}

}  // namespace
}  // namespace frustum::parser
