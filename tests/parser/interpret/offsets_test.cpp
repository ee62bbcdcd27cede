// Work offsets, lengths and reference points that a program sets: what becomes known by them.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_linuxcnc(std::string_view text) {
  return motions(text, {}, Dialect::linuxcnc);
}

AxisTarget end_of_last(const std::vector<Motion>& all) { return last_of<Traverse>(all).end; }

TEST(WorkOffsets, PlacedByTheProgramAreCommands) {
  const auto settings =
      all_of<WorkOffsetSetting>(run_linuxcnc("G10 L2 P2 X1 Z-3\nG10 L2 P1 X5 Y6 Z7\n"));
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(settings[0].number, 2);
  EXPECT_EQ(settings[0].origin, (std::array<std::optional<double>, 3>{1.0, std::nullopt, -3.0}));
  EXPECT_EQ(settings[1].number, 1);
  EXPECT_EQ(settings[1].origin, (std::array<std::optional<double>, 3>{5.0, 6.0, 7.0}));
}

TEST(WorkOffsets, AreOfMillimetresInAnInchProgramToo) {
  EXPECT_NEAR(*last_of<WorkOffsetSetting>(run_linuxcnc("G20\nG10 L2 P1 X1\n")).origin[0], 25.4,
              1e-12);
}

TEST(WorkOffsets, ThatAreKnownKeepThePositionKnown) {
  const auto all = run_linuxcnc(
      "G10 L2 P1 X10 Y20 Z30\nG10 L2 P2 X1 Y2 Z3\nG0 X5 Y6 Z7\nG55\nG91\nG0 X1\nG0 Y1 Z1\n");
  const AxisTarget end = end_of_last(all);
  EXPECT_NEAR(*end[X], 15.0, 1e-12);
  EXPECT_NEAR(*end[Y], 25.0, 1e-12);
  EXPECT_NEAR(*end[Z], 35.0, 1e-12);
}

TEST(WorkOffsets, ThatOnlyTheSetupKnowsDoNot) {
  EXPECT_EQ(complaints("G10 L2 P2 X1 Y2 Z3\nG0 X5\nG55\nG91 G0 X1\n", {}, Dialect::linuxcnc),
            (std::vector<std::string>{
                "4:8: error: X1 is incremental, but X is not known since the change of work offset "
                "on line 3 (hint: program X once in absolute coordinates (G90) first)"}));
}

TEST(WorkOffsets, TurnTheMotionsAndNotTheSetup) {
  const auto all = run_linuxcnc("G10 L2 P1 X10 R90\nG0 X5 Y0 Z1\n");
  EXPECT_EQ(last_of<WorkOffsetSetting>(all).origin[0], 10.0);
  const AxisTarget end = end_of_last(all);
  EXPECT_NEAR(*end[X], 0.0, 1e-12);
  EXPECT_NEAR(*end[Y], 5.0, 1e-12);
}

TEST(WorkOffsets, OfRotaryAxesAreInTheMotions) {
  const auto all = run_linuxcnc("G10 L2 P1 X10 A30\nG0 A5\n");
  EXPECT_NEAR(*end_of_last(all)[A], 35.0 * kRadPerDeg, 1e-12);
}

TEST(WorkOffsets, OfTheStartAreToldByTheOptions) {
  InterpreterOptions options;
  options.work_offsets[1].origin[X] = 100.0;
  options.work_offsets[2].origin[X] = 40.0;
  const auto all = motions("G0 X1\nG55\nG91 G0 X1\n", options, Dialect::linuxcnc);
  EXPECT_NEAR(*end_of_last(all)[X], 62.0, 1e-12);
  EXPECT_TRUE(all_of<WorkOffsetSetting>(all).empty());  // the setup has them
}

TEST(WorkOffsets, WrittenAsParametersCountWhenTheyAreSelected) {
  const auto all = run_linuxcnc("#5241=7\nG0 X1\nG55\nG0 X2\n");
  ASSERT_EQ(all_of<WorkOffsetSetting>(all).size(), 1U);
  EXPECT_EQ(all[1].place.line, 3U);
  EXPECT_TRUE(std::holds_alternative<WorkOffsetSetting>(all[1].command));
  EXPECT_TRUE(std::holds_alternative<WorkOffsetChange>(all[2].command));
}

TEST(WorkOffsets, OfFanucCountAtOnceHoweverTheyAreSet) {
  const auto all =
      motions("#5221=5\nG90 G10 L2 P1 Y6\nG91 G10 L2 P1 X1\nG90\nG54.1 P3\nG10 L20 P3 Z9\n");
  const auto settings = all_of<WorkOffsetSetting>(all);
  ASSERT_EQ(settings.size(), 4U);
  EXPECT_EQ(settings[0].origin[0], 5.0);
  EXPECT_EQ(settings[1].origin[1], 6.0);
  EXPECT_EQ(settings[2].origin[0], 6.0);
  EXPECT_EQ(settings[3].number, 103);
  EXPECT_EQ(settings[3].origin[2], 9.0);
  EXPECT_EQ(last_of<WorkOffsetChange>(all).number, 103);
}

TEST(WorkOffsets, OfFanucHaveTheExternalOneAdded) {
  const auto all = motions(
      "G10 L2 P1 X1 Y1 Z1\nG10 L2 P2 X2 Y2 Z2\nG0 X0 Y0 Z0\n#5201=10\nG91 G0 X0\nG90 G55\n");
  const auto settings = all_of<WorkOffsetSetting>(all);
  ASSERT_EQ(settings.size(), 4U);
  EXPECT_EQ(settings[2].number, 1);
  EXPECT_EQ(settings[2].origin[0], 11.0);
  EXPECT_EQ(settings[3].number, 2);
  EXPECT_EQ(settings[3].origin[0], 12.0);
  EXPECT_NEAR(*end_of_last(all)[X], -10.0, 1e-12);  // the tool stays where it is
}

TEST(ToolLengths, OfFanucComeFromG10AndFromTheirParameters) {
  const auto all = motions(
      "G10 L10 P3 R50\nG10 L11 P3 R0.5\nG43 H3\n#2003=60\nG43 H3\n#11003=0\nG43.4 H3\nG91 G10 L10 "
      "P3 R1\nG43 H3\nG20 G90 G10 L10 P3 R1\nG43 H3\n");
  const auto changes = all_of<CompensationChange>(all);
  ASSERT_EQ(changes.size(), 5U);
  EXPECT_EQ(changes[0].length, 50.5);
  EXPECT_EQ(changes[1].length, 60.5);
  EXPECT_EQ(changes[2].length, 60.0);
  EXPECT_EQ(changes[2].mode, LengthCompensation::tool_centre_point);
  EXPECT_EQ(changes[3].length, 61.0);
  EXPECT_NEAR(*changes[4].length, 25.4, 1e-12);
}

// By a parameter the control moves by it at once, or with the next G43.
TEST(ToolLengths, ThatChangeWhileTheyAreInForceAreTold) {
  const auto told = [](const std::string& text) {
    std::string lines;
    for (const Motion& motion : motions(text)) {
      const auto* event = std::get_if<Event>(&motion.command);
      if (event == nullptr || event->name != "length in force") continue;
      EXPECT_EQ(event->grade, EventGrade::assumed);
      lines += std::to_string(motion.place.line) + ":" + std::to_string(motion.place.column) + " ";
    }
    return lines;
  };
  const std::string head = "G90 G10 L10 P1 R50\nG0 G43 H1 Z10\n";
  for (const char* change :
       {"G10 L10 P1 R51\n", "G10 L11 P1 R1\n", "G91 G10 L10 P1 R1\n", "G10 L1 P1 R51\n"}) {
    EXPECT_EQ(told(head + change + "G90 X0 Z5\n").substr(0, 2), "3:") << change;
  }
  for (const char* change : {"#2001=51\n", "#10001=51\n", "#11001=1\n"}) {
    EXPECT_EQ(told(head + change + "#11001=2\n"), "3:1 ") << change;
  }
  EXPECT_EQ(told("G0 G43 H1 Z10\nG10 L10 P1 R51\n"), "2:12 ");
  for (const char* other : {"G10 L10 P2 R51\n", "G10 L10 P1 R50\n", "#11001=0\n", "#12001=5\n",
                            "G10 L12 P1 R5\n", "G49\n#2001=51\n", "G10 L2 P1 X5\n"}) {
    EXPECT_EQ(told(head + other), "") << other;
  }
  // It waits: Z5 is at 55 mm, and with G43 at 57.
  const auto all = motions(head + "G10 L11 P1 R2\nZ5\nG43 Z5\n");
  const auto changes = all_of<CompensationChange>(all);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].length, 50.0);
  EXPECT_EQ(changes[1].length, 52.0);
}

TEST(ToolLengths, OfG44AreSubtracted) {
  const auto all = motions(
      "G10 L10 P1 R50\nG10 L11 P1 R0.5\nG10 L10 P2 R30\nG0 G44 H1 Z10\nH2\nG91 Z1\nG90\nG0 "
      "X#4008\nG43 H1\nG49\n");
  const auto changes = all_of<CompensationChange>(all);
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ(changes[0].length, -50.5);
  EXPECT_TRUE(changes[0].negative);
  EXPECT_EQ(changes[1].length, -30.0);
  EXPECT_TRUE(changes[1].negative);
  EXPECT_EQ(changes[2].length, 50.5);
  EXPECT_FALSE(changes[2].negative);
  EXPECT_FALSE(changes[3].negative);
  EXPECT_EQ(end_of_last(all)[X], 44.0);
  EXPECT_EQ(end_of_last(all)[Z], 11.0);
  EXPECT_TRUE(all_of<Event>(all).empty());
  EXPECT_FALSE(std::signbit(*last_of<CompensationChange>(motions("G44 H0\n")).length));
}

TEST(ToolLengths, OfTheSetupAreTakenForPositiveByG44) {
  const auto all = motions("G0 G44 H1 Z10\nG0 X1\nG43 H1\nG0 X2\n");
  const auto changes = all_of<CompensationChange>(all);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_TRUE(changes[0].negative);
  EXPECT_FALSE(changes[0].length);
  ASSERT_EQ(all_of<Event>(all).size(), 1U);
  EXPECT_EQ(last_of<Event>(all).name, "G44");
  EXPECT_EQ(last_of<Event>(all).grade, EventGrade::assumed);
  // Between the two Z is by twice a length elsewhere that only the setup knows.
  EXPECT_EQ(all_of<Traverse>(all)[1].end[Z], 10.0);
  EXPECT_FALSE(end_of_last(all)[Z]);
}

TEST(ToolLengths, OfTheSetupStayItsOwnBesideARadius) {
  EXPECT_EQ(last_of<CompensationChange>(motions("G10 L12 P3 R5\nG43 H3\n")).length, std::nullopt);
}

TEST(ToolLengths, OfTheSetupTakeNoWearFromTheProgram) {
  EXPECT_EQ(complaint_ids("G10 L11 P3 R-0.5\nG0 G43 H3 Z5\n"),
            std::vector<std::string>{"unknown-tool-length"});
  EXPECT_TRUE(complaint_ids("G10 L11 P3 R0\nG0 G43 H3 Z5\n").empty());
}

TEST(ToolLengths, ThatAreKnownKeepZKnown) {
  const auto all = run_linuxcnc("G0 Z10\nG43.1 Z4\nG91 G0 Z1\nG43.2 Z2\nG0 Z1\nG49\nG0 Z1\n");
  EXPECT_EQ(all_of<CompensationChange>(all)[1].length, 6.0);
  EXPECT_NEAR(*end_of_last(all)[Z], 13.0, 1e-12);
}

TEST(ToolLengths, GuideTheTipWithTheLengthOfG431) {
  const auto change = last_of<CompensationChange>(run_linuxcnc("G43.1 Z40\nM428\n"));
  EXPECT_EQ(change.mode, LengthCompensation::tool_centre_point);
  EXPECT_EQ(change.length, 40.0);
}

TEST(ReferencePoints, OfTheMachineAreHomeReturns) {
  const auto home = last_of<HomeReturn>(motions("G91 G30 Z0\n"));
  EXPECT_EQ(home.point, 2);
  EXPECT_TRUE(home.axes[2]);
  EXPECT_FALSE(home.axes[0]);
  EXPECT_EQ(last_of<HomeReturn>(motions("G91 G30 P4 X0 Z0\n")).point, 4);
  EXPECT_EQ(last_of<HomeReturn>(motions("G91 G28 Z0\n")).point, 1);
}

TEST(ReferencePoints, ThatTheProgramStoresAreMoves) {
  const auto all =
      run_linuxcnc("G10 L2 P1 X1 Y2 Z3\nG0 X10 Y20 Z30\nG28.1\nG0 X0 Y0 Z50\nG28 Z60\n");
  EXPECT_TRUE(all_of<HomeReturn>(all).empty());
  const auto moves = all_of<Traverse>(all);
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[2].end[Z], 60.0);
  EXPECT_NEAR(*moves[3].end[Z], 30.0, 1e-12);
  EXPECT_NEAR(*moves[3].end[X], 0.0, 1e-12);
}

TEST(ReferencePoints, KeepTheMachinesForAxesThatNeverMoved) {
  const auto all = run_linuxcnc("G53 G0 X1 Z3\nG28.1\nG28 X0 B0 Z0\n");
  const auto home = last_of<HomeReturn>(all);
  EXPECT_TRUE(home.axes[4]);
  EXPECT_FALSE(home.axes[0]);
  const auto last = last_of<Traverse>(all);
  EXPECT_EQ(last.coordinates, Coordinates::machine);
  EXPECT_EQ(last.end[X], 1.0);
  EXPECT_EQ(last.end[Z], 3.0);
}

TEST(MachineCoordinates, AreKnownWordsWhereTheOffsetIs) {
  const auto all = run_linuxcnc("G10 L2 P1 X10 Y20 Z30\nG53 G0 X1 Z2\nG91 G0 X1\nG0 Z1\n");
  EXPECT_NEAR(*end_of_last(all)[X], -8.0, 1e-12);
  EXPECT_NEAR(*end_of_last(all)[Z], -27.0, 1e-12);
}

TEST(UserWords, AreEventsWithTheirArguments) {
  const auto events = all_of<Event>(run_linuxcnc("M101\nM100 P1.5 Q-2\nM199 Q3\n"));
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].name, "M101");
  EXPECT_EQ(events[1].name + "|" + events[1].text, "M100|P1.5 Q-2");
  EXPECT_EQ(events[2].name + "|" + events[2].text, "M199|Q3");
}

TEST(SpokenComments, HaveTheirParametersFilledIn) {
  const auto events = all_of<Event>(run_linuxcnc(
      "#1=2.5\n#<width>=-3\n(PRINT,%d #1 %.3f #< Width > %f #1)\n(DEBUG, at #5221x)\n(LOG,#9)\n"
      "(LOGOPEN,file.txt)\n(LOGCLOSE)\n(print, #<nothing> # 100%)\n"));
  std::vector<std::string> seen;
  for (const Event& event : events) seen.push_back(event.name + "|" + event.text);
  EXPECT_EQ(seen,
            (std::vector<std::string>{"print|2  -3.000  2.5000", "debug|at ######x", "log|0.000000",
                                      "logopen|file.txt", "logclose|", "print|###### # 100%"}));
}

TEST(SpokenComments, AreCommentsInOtherDialects) {
  const auto events = all_of<Event>(motions("(DEBUG,#1)\n"));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].name + "|" + events[0].text, "comment|DEBUG,#1");
}

}  // namespace
}  // namespace frustum::parser
