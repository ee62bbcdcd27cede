// Rigid taps of all controls: the axis follows the spindle, which turns by the hand of the thread,
// and back at the bottom.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

// Along Z: R and F to a height, with the feed (s: synchronised), and how the spindle turns.
std::string taps(const std::string& text, Dialect dialect) {
  std::string told;
  double at = 999.0;
  for (const Motion& motion : motions(text, {}, dialect)) {
    std::string step;
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      at = rapid->end[AxisLetter::Z].value_or(at);
      step = fmt::format("R{:g}", at);
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      at = feed->end[AxisLetter::Z].value_or(at);
      step = fmt::format("F{:g}@{:g}{}", at, feed->feed.value, feed->feed.synchronised ? "s" : "");
    } else if (const auto* spindle = std::get_if<SpindleChange>(&motion.command)) {
      constexpr std::array kWords{"M5", "M3", "M4"};
      step = fmt::format("{}/{:g}", kWords.at(static_cast<std::size_t>(spindle->direction)),
                         spindle->speed);
    } else if (const auto* dwell = std::get_if<Dwell>(&motion.command)) {
      step = fmt::format("D{:g}", dwell->seconds);
    }
    if (!step.empty()) told += (told.empty() ? "" : " ") + step;
  }
  return told;
}
std::string taps_of_klartext(const std::string& text) { return taps(text, Dialect::heidenhain); }

const std::string kOver = "TOOL CALL 1 Z S500 F300\nL X+1 Y+2 Z+50 FMAX M3\n";
const std::string kAt0 = "Q200=2 Q201=-10 Q203=+0 Q204=20 ";

TEST(RigidTap, OfKlartextFollowsTheSpindle) {
  EXPECT_EQ(taps_of_klartext(kOver + "CYCL DEF 207 " + kAt0 + "Q239=+1.5\nCYCL CALL\n"),
            "M3/500 R50 R2 F-10@1.5s M4/500 F2@1.5s R20 M3/500");
  // 6 deep, back by one pitch, the rest.
  EXPECT_EQ(
      taps_of_klartext(kOver + "CYCL DEF 209 " + kAt0 + "Q239=+1.5 Q257=6 Q256=1\nCYCL CALL\n"),
      "M3/500 R50 R2 F-6@1.5s M4/500 F-4.5@1.5s M3/500 F-10@1.5s M4/500 F2@1.5s R20 M3/500");
  const std::string old = "CYCL DEF 17.1 SET UP 2\nCYCL DEF 17.2 DEPTH -10\nCYCL DEF 17.3 PITCH ";
  EXPECT_EQ(taps_of_klartext(kOver + "L Z+2 FMAX\n" + old + "+1\nCYCL CALL\n"),
            "M3/500 R50 R2 F-10@1s M4/500 F2@1s M3/500");
  EXPECT_EQ(taps_of_klartext(kOver + "L Z+2 FMAX\n" + old + "-1\nCYCL CALL\nL Z+9\n"),
            "M3/500 R50 R2 M4/500 F-10@1s M3/500 F2@1s F9@300");
}

// -1 has been taken for the feed of the tool call.
TEST(RigidTap, OfKlartextIsLeftHandedBelowZero) {
  EXPECT_EQ(taps_of_klartext(kOver + "CYCL DEF 207 " + kAt0 + "Q239=-1\nCYCL CALL\n"),
            "M3/500 R50 R2 M4/500 F-10@1s M3/500 F2@1s R20");
  EXPECT_EQ(taps_of_klartext(kOver + "CYCL DEF 209 " + kAt0 + "Q239=-2 Q257=6 Q256=1\nCYCL CALL\n"),
            "M3/500 R50 R2 M4/500 F-6@2s M3/500 F-4@2s M4/500 F-10@2s M3/500 F2@2s R20");
}

TEST(RigidTap, OfKlartextStartsTheSpindleAndLeavesItAsItWas) {
  EXPECT_EQ(taps_of_klartext("TOOL CALL 1 Z S500\nL X+1 Y+2 Z+50 FMAX\nCYCL DEF 207 " + kAt0 +
                             "Q239=+1\nCYCL CALL\n"),
            "R50 R2 M3/500 F-10@1s M4/500 F2@1s R20 M5/500");
}

TEST(RigidTap, OfKlartextTellsHowItLeavesTheSpindle) {
  for (const std::string cycle : {"207", "209"}) {
    const auto told =
        all_of<Event>(motions(kOver + "CYCL DEF " + cycle + " " + kAt0 + "Q239=+1\nCYCL CALL\n", {},
                              Dialect::heidenhain));
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].grade, EventGrade::assumed);
    EXPECT_NE(told[0].text.find("the spindle turns afterwards"), std::string::npos);
  }
}

TEST(RigidTap, OfFanucIsG84AfterM29) {
  const std::string go = "G21 G90 G94\nG0 X0 Y0 Z50\nM29 S800\n";
  EXPECT_EQ(taps(go + "G98 G84 Z-10 R2 F1000\nG80\n", Dialect::fanuc),
            "R50 R50 R2 M3/800 F-10@1.25s M4/800 F2@1.25s R50 M5/800");
  EXPECT_EQ(taps(go + "G99 G74 Z-10 R2 P500 F1000\nG80\n", Dialect::fanuc),
            "R50 R50 R2 M4/800 F-10@1.25s D0.5 M3/800 F2@1.25s M5/800");
  EXPECT_EQ(taps(go + "G95 G99 G84 Z-10 R2 F1.5\nG80\n", Dialect::fanuc),
            "R50 R50 R2 M3/800 F-10@1.5s M4/800 F2@1.5s M5/800");
  // It ends with the cycle.
  EXPECT_EQ(taps(go + "G99 G84 Z-10 R2 F1000\nG80\nM3\nG84 Z-10 R2 F1000\n", Dialect::fanuc),
            "R50 R50 R2 M3/800 F-10@1.25s M4/800 F2@1.25s M5/800 M3/800 R2 F-10@1000 M5/800 M4/800 "
            "D0 F2@1000 M5/800 M3/800");
  EXPECT_EQ(complaint_ids("G21 G90 G94\nG0 X0 Y0 Z50\nM29\nG84 Z-10 R2 F1000\n"),
            std::vector<std::string>{"cycle-speed-missing"});
}

// Fanuc's alarms PS0203, PS0204 and PS0206.
TEST(RigidTap, OfFanucFollowsM29AtOnce) {
  using Ids = std::vector<std::string>;
  const Ids stops{"rigid-tap-interrupted"};
  const std::string head = "G21 G90 G94 G99\nG0 X0 Y0 Z50\n";
  const std::string tap = "G84 X1 Z-10 R2 F800\n";
  for (const char* between : {"X5\n", "G0 X5\n", "G81 Z-1 R2 F100\n", "G28 Z0\n", "G53 Z0\n",
                              "S900\n", "G4 P10\nX5\nG4 P10\n"}) {
    EXPECT_EQ(complaint_ids(head + "M29 S800\n" + between + tap), stops) << between;
    EXPECT_TRUE(complaint_ids(head + "M29 S700\n" + between + "M29 S800\n" + tap).empty())
        << between;
  }
  EXPECT_EQ(complaint_ids(head + "M29 S800\n" + tap + "G18\n"), stops);
  for (const char* between : {"", "G4 P10\n", "(M29)\n", "M8\n", "G17\n", "#1=5\n"}) {
    const std::string hole = " M3/800 F-10@1s M4/800 F2@1s M5/800";
    const std::string dwell = between[1] == '4' ? " D0.01" : "";
    EXPECT_EQ(taps(head + "M29 S800\n" + between + tap + "X2\nG80\n", Dialect::fanuc),
              "R50" + dwell + " R50 R2" + hole + " R2" + hole)
        << between;
  }
}

// What the builder has it ended by is told, with the tap that is made then.
TEST(RigidTap, OfFanucEndsWithItsCycle) {
  const auto told = [](const std::string& text) {
    std::string names;
    for (const Event& event : all_of<Event>(motions(text))) {
      if (event.grade == EventGrade::assumed) names += event.name + ": " + event.text + "; ";
    }
    return names;
  };
  const std::string head = "G21 G90 G94 G99\nG0 X0 Y0 Z50\n";
  const std::string tap = "G84 X1 Z-10 R2 F800\n";
  const std::string rigid = "rigid tap: the spindle is at rest when the hole is done; ";
  EXPECT_EQ(told(head + "M29 S800\n" + tap + "G80\nM5\nT2 M6\n"), rigid);
  EXPECT_EQ(told(head + "M29 S800\n" + tap + "G0 Z50\nM3\n"), rigid);
  EXPECT_EQ(told(head + "M29 S800\nM3\n" + tap),
            "M29: M3 ends the rigid mode of M29 before any hole; ");
  EXPECT_EQ(taps(head + "M29 S800\nM3\n" + tap, Dialect::fanuc),
            "R50 M3/800 R50 R2 F-10@800 M5/800 M4/800 D0 F2@800 M5/800 M3/800");
  EXPECT_EQ(told(head + "M29 S800\nT2 M6\n" + tap),
            "M29: M6 ends the rigid mode of M29 before any hole; tap with the spindle at rest: the "
            "control turns the spindle itself, in and out: a rigid tap; " +
                rigid);
  EXPECT_EQ(told(head + "M29 S800\nG80\n"),
            "M29: G80 ends the rigid mode of M29 before any hole; ");
  EXPECT_EQ(told(head + "M29 S800\nG1\n"), "M29: G1 ends the rigid mode of M29 before any hole; ");
  EXPECT_EQ(told(head + "M29 S800\n" + tap + "M3\nX5\n"),
            rigid + "M29: M3 ends the rigid mode of M29; ");
}

TEST(RigidTap, OfSinumerikIsLeftHandedBelowZero) {
  const std::string go = "G0 X3 Y4 Z50 S1000 M3 F200\n";
  EXPECT_EQ(taps(go + "CYCLE84(40,10,2,-15,,,4,-6,,0,300)\n", Dialect::sinumerik),
            "M3/1000 R50 R12 M4/300 F-15@1s M3/300 F12@1s R40 M4/1000");
  EXPECT_EQ(taps(go + "CYCLE84(40,10,2,-15,,,4,,-1.5,0,300)\n", Dialect::sinumerik),
            "M3/1000 R50 R12 M4/300 F-15@1.5s M3/300 F12@1.5s R40 M4/1000");
  EXPECT_EQ(complaint_ids(go + "CYCLE84(40,10,2,-15,,,4,6,1.25,0,300)\n", {}, Dialect::sinumerik),
            std::vector<std::string>{"cycle-lead"});
}

std::vector<std::string> ids_in_klartext(const std::string& text) {
  return complaint_ids(text, {}, Dialect::heidenhain);
}
using Ids = std::vector<std::string>;

TEST(FloatingTap, OfKlartextNeedsASpindleThatTurns) {
  const std::string tap = "CYCL DEF 206 " + kAt0 + "Q206=750 Q211=0.5\nCYCL CALL\n";
  EXPECT_EQ(ids_in_klartext("TOOL CALL 1 Z S500\nL X+1 Y+2 Z+50 FMAX\n" + tap),
            Ids{"thread-spindle-off"});
  EXPECT_EQ(ids_in_klartext("TOOL CALL 1 Z\nL X+1 Y+2 Z+50 FMAX M3\n" + tap),
            Ids{"cycle-speed-missing"});
  EXPECT_EQ(taps_of_klartext(kOver + tap),
            "M3/500 R50 R2 F-10@750 M5/500 M4/500 D0.5 F2@750 M5/500 M3/500 R20");
}

TEST(KlartextCycleFeed, OfTheToolCallIsNoNumber) {
  const std::string drill = "CYCL DEF 201 " + kAt0;
  EXPECT_EQ(taps_of_klartext(kOver + drill + "Q206=AUTO Q208=MAX\nCYCL CALL\n"),
            "M3/500 R50 R2 F-10@300 R2 R20");
  EXPECT_EQ(ids_in_klartext(kOver + drill + "Q206=-1\nCYCL CALL\n"), Ids{"feed-not-positive"});
  EXPECT_EQ(ids_in_klartext(kOver + drill + "Q206=100 Q208=-5\nCYCL CALL\n"),
            Ids{"feed-not-positive"});
  EXPECT_EQ(ids_in_klartext("TOOL CALL 1 Z S500\nL X+1 Y+2 Z+50 FMAX\n" + drill +
                            "Q206=AUTO\nCYCL CALL\n"),
            Ids{"tool-feed-missing"});
  // Only feeds are AUTO.
  EXPECT_FALSE(ids_in_klartext(kOver + "CYCL DEF 207 " + kAt0 + "Q239=AUTO\n").empty());
}

TEST(KlartextCycle, HasNoStepsBelowZero) {
  for (const std::string wrong : {"Q202=-5", "Q210=-1", "Q211=-1"}) {
    EXPECT_EQ(ids_in_klartext(kOver + "CYCL DEF 200 " + kAt0 + "Q206=100 " + wrong + "\n"),
              Ids{"value-negative"})
        << wrong;
  }
  EXPECT_EQ(ids_in_klartext(kOver + "CYCL DEF 200 Q200=2 Q201=-5 Q206=9 Q203=+0 Q204=-50\n"),
            Ids{"value-negative"});
  EXPECT_EQ(ids_in_klartext(kOver + "CYCL DEF 207 " + kAt0 + "Q239=0\n"), Ids{"cycle-lead"});
  const std::string drill = kOver + "CYCL DEF 200 " + kAt0 + "Q206=100\n";
  EXPECT_EQ(ids_in_klartext(drill + "CYCL DEF 220 Q216=0 Q217=0 Q244=-20 Q241=2\n"),
            Ids{"value-negative"});
  EXPECT_EQ(ids_in_klartext(drill + "CYCL DEF 220 Q216=0 Q217=0 Q244=20 Q241=2 Q301=5\n"),
            Ids{"out-of-range"});
  EXPECT_EQ(ids_in_klartext(kOver + "CYCL DEF 1.1 SET UP 2\nCYCL DEF 1.4 DWELL -1\n"),
            Ids{"value-negative"});
}

// F100 has been taken for CYCL DEF 100, whose parameters come in the lines after.
TEST(KlartextCycle, CallWithAFeedHasNoParameters) {
  EXPECT_EQ(taps_of_klartext(kOver + "CYCL DEF 200 " + kAt0 +
                             "Q206=100\nPATTERN DEF POS1 (X+1 Y+2 Z+0)\n" +
                             "CYCL CALL PAT F100 M3\nQ203 = 5\nL Z+Q203 FMAX\n"),
            "M3/500 R50 M3/500 R2 F-10@100 R20 R5");
}

TEST(KlartextTool, NameOfDigitsIsNoNumber) {
  InterpreterOptions options;
  Tool tool;
  tool.remark = "5";
  options.tools.emplace(12, tool);
  const auto changes = [&](const InterpreterOptions& given) {
    return all_of<ToolChange>(
        motions("TOOL CALL \"5\" Z S1\nTOOL CALL 5 Z S1\n", given, Dialect::heidenhain));
  };
  const auto unknown = changes({});
  ASSERT_EQ(unknown.size(), 2U);
  EXPECT_EQ(unknown[0].tool, 1001);
  EXPECT_EQ(unknown[1].tool, 5);
  options.tools.emplace(5, Tool{});
  EXPECT_EQ(changes(options).at(0).tool, 12);
}

// A lead has been taken for a feed per revolution, which no tap can go by.
TEST(RigidTap, OfCldataFollowsTheSpindleByALead) {
  const std::string start = "UNITS/MM\nLOADTL/1\nSPINDL/500,RPM,CLW\nRAPID\nGOTO/0,0,50\n";
  const std::string hole = ",CLEAR,2\nGOTO/0,0,0\n";
  for (const std::string lead : {"MMPR,1.25", "LEAD,1.25", "PITCH,1.25", "PERREV,1.25"}) {
    EXPECT_EQ(taps(start + "CYCLE/TAP,DEPTH,8," + lead + hole, Dialect::cldata),
              "M3/500 R50 R2 F-8@1.25s M4/500 F2@1.25s M3/500")
        << lead;
  }
  EXPECT_EQ(taps(start + "CYCLE/TAP,DEPTH,8,TPI,20" + hole, Dialect::cldata),
            "M3/500 R50 R2 F-8@1.27s M4/500 F2@1.27s M3/500");
  EXPECT_EQ(taps(start + "SPINDL/400,RPM,CCLW\nCYCLE/TAP,DEPTH,8,MMPR,1" + hole, Dialect::cldata),
            "M3/500 R50 M4/400 R2 F-8@1s M3/400 F2@1s M4/400");
  // In a floating chuck, or by a feed per minute, it is fed.
  EXPECT_EQ(taps(start + "CYCLE/TAP,DEPTH,8,MMPR,1.25,FLOAT" + hole, Dialect::cldata),
            "M3/500 R50 R2 F-8@1.25 M5/500 M4/500 D0 F2@1.25 M5/500 M3/500");
  EXPECT_EQ(taps(start + "CYCLE/TAP,DEPTH,8,MMPM,625" + hole, Dialect::cldata),
            "M3/500 R50 R2 F-8@625 M5/500 M4/500 D0 F2@625 M5/500 M3/500");
  // A spindle that has a speed alone turns for a right-handed thread, which is told.
  const std::string at_rest = "UNITS/MM\nLOADTL/1\nSPINDL/500,RPM,CLW\nSPINDL/OFF\nRAPID\n";
  const std::string tap = "GOTO/0,0,50\nCYCLE/TAP,DEPTH,8,MMPR,1" + hole;
  EXPECT_EQ(taps(at_rest + tap, Dialect::cldata),
            "M3/500 M5/500 R50 R2 M3/500 F-8@1s M4/500 F2@1s M5/500");
  EXPECT_EQ(all_of<Event>(motions(at_rest + tap, {}, Dialect::cldata)).back().name, "CYCLE/TAP");
  EXPECT_EQ(complaint_ids("UNITS/MM\nLOADTL/1\n" + tap, {}, Dialect::cldata),
            std::vector<std::string>{"cycle-speed-missing"});
}

// Controls that turn the spindle themselves (no M29, no M3): in and out, never out as it went in.
TEST(RigidTap, OfFanucTurnsASpindleThatIsAtRest) {
  const std::string head = "G21 G90 G54 G98\nT1 M6\nS300\nG0 X0 Y0 Z20\n";
  EXPECT_EQ(taps(head + "G84 X20 Y0 Z-10 R5 F300\n", Dialect::fanuc),
            "R20 R20 R5 M3/300 F-10@1s M4/300 F5@1s R20 M5/300");
  EXPECT_EQ(complaint_ids(head + "M29\nG84 X20 Y0 Z-10 R5\n"),
            std::vector<std::string>{"feed-missing"});
}

}  // namespace
}  // namespace frustum::parser
