// Klartext: feeds of inch programs and of tool calls, M words that count when the move of their
// block is done (and those of Fanuc and Sinumerik), arcs without an end.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_modes(const std::string& text, Dialect dialect = Dialect::heidenhain) {
  return motions(text, {}, dialect);
}
std::string mode_complaint(const std::string& text) {
  const auto lines = complaints(text, {}, Dialect::heidenhain);
  return lines.empty() ? std::string() : lines.front();
}

std::vector<double> feeds(const std::string& text) {
  std::vector<double> found;
  for (const LinearFeed& feed : all_of<LinearFeed>(run_modes(text)))
    found.push_back(feed.feed.value);
  return found;
}

// One letter a command: what is moved, and what is switched before and after it.
std::string order(const std::string& text, Dialect dialect = Dialect::heidenhain) {
  std::string letters;
  for (const Motion& motion : run_modes(text, dialect)) {
    const Command& command = motion.command;
    if (std::holds_alternative<Traverse>(command)) letters += 'r';
    if (std::holds_alternative<HomeReturn>(command)) letters += 'h';
    if (std::holds_alternative<LinearFeed>(command)) letters += 'f';
    if (std::holds_alternative<Dwell>(command)) letters += 'd';
    if (std::holds_alternative<ToolChange>(command)) letters += 'T';
    if (const auto* event = std::get_if<Event>(&command))
      letters += event->name == "M6" ? '6' : 'e';
    if (const auto* spindle = std::get_if<SpindleChange>(&command)) {
      letters += spindle->direction == SpindleDirection::off ? 's' : 'S';
    }
    if (const auto* coolant = std::get_if<CoolantChange>(&command)) {
      letters += coolant->flood ? 'C' : 'c';
    }
    if (const auto* change = std::get_if<CompensationChange>(&command)) {
      letters += change->mode == LengthCompensation::tool_centre_point ? 'G' : 'g';
    }
    if (const auto* path = std::get_if<RotaryPathChange>(&command)) {
      letters += path->path == RotaryPath::shortest ? 'P' : 'p';
    }
    if (const auto* stop = std::get_if<Stop>(&command)) {
      letters += stop->kind == StopKind::program_end ? '.' : '!';
    }
  }
  return letters;
}

TEST(KlartextFeeds, OfInchProgramsAreTenthsOfAnInch) {
  const std::string head = "BEGIN PGM T INCH\nTOOL CALL 1 Z S1000 F20\nL X+1 Y+2 Z+3 FMAX M3\n";
  const auto found = feeds(head + "L X+2\nL X+3 F10\nL Z+1 F AUTO\n");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_DOUBLE_EQ(found[0], 20 * 2.54);
  EXPECT_DOUBLE_EQ(found[1], 25.4);
  EXPECT_DOUBLE_EQ(found[2], 20 * 2.54);
  // Rotary axes alone in degrees a minute; M136 in inches a revolution; FT is a time.
  EXPECT_DOUBLE_EQ(feeds(head + "L C+2 F10\n").back(), 10.0);
  EXPECT_DOUBLE_EQ(feeds(head + "M136\nL X+2 F0.01\n").back(), 0.254);
  EXPECT_DOUBLE_EQ(feeds(head + "L X+2 FT2\n").back(), 30.0);
  EXPECT_DOUBLE_EQ(feeds("BEGIN PGM T MM\nL X+1 F10\n").back(), 10.0);
  // Of cycles: the feeds of drilling in tenths of an inch, the pitch in inches.
  const auto drilled = feeds(
      head + "CYCL DEF 201 Q200=0.1 Q201=-1 Q206=10 Q211=0 Q208=30 Q203=0 Q204=2\nCYCL CALL\n");
  ASSERT_EQ(drilled.size(), 2U);
  EXPECT_DOUBLE_EQ(drilled[0], 25.4);
  EXPECT_DOUBLE_EQ(drilled[1], 76.2);
  EXPECT_DOUBLE_EQ(
      feeds(head + "CYCL DEF 207 Q200=0.1 Q201=-1 Q239=0.05 Q203=0 Q204=2\nCYCL CALL\n").front(),
      1.27);
}

TEST(KlartextFeeds, OfToolCallsAreInForce) {
  EXPECT_EQ(feeds("TOOL CALL 1 Z S100 F50\nL X+0 Y+0 Z+0 FMAX M3\nL X+1\nL X+2 F70\nL X+3\n"
                  "L X+4 F AUTO\nTOOL CALL 2 Z S100\nL X+5 M3\nTOOL CALL 2 Z F90\nL X+6\n"),
            (std::vector<double>{50, 70, 70, 50, 50, 90}));
  EXPECT_EQ(mode_complaint("TOOL CALL 1 Z S100 F50\nL X+1\nL X+2 F0\n"),
            "3:1: error: a cutting move without a feed rate (hint: give F on this block or before, "
            "above zero)");
}

TEST(KlartextOrder, StopsCountWhenTheMoveIsDone) {
  EXPECT_EQ(order("L X+1 FMAX M3\nL X+2 F10 M8\nL X+3 M5 M9\n"), "SrCffsc");
  EXPECT_EQ(order("L X+1 FMAX M13\nL X+3 F10 M9\nL X+1 FMAX M5\n"), "SCrfcrs");
  EXPECT_EQ(order("L X+1 FMAX M3\nM5\nL Z+1 FMAX M6\nL X+2 FMAX M5 M30\n"), "Srsr6rs.");
  EXPECT_EQ(order("L X+1 FMAX M3\nL Z+1 FMAX M91 M5\nSTOP M5\n"), "Srrss!");
}

TEST(KlartextOrder, TipControlAndTheShorterWayBeginBeforeTheMoveAndEndBehindIt) {
  EXPECT_EQ(order("TOOL CALL 1 Z S100\nL X+0 Y+0 Z+10 R0 FMAX M3\nM128\n"
                  "L X+10 Y+0 Z+10 B+10 C+20 F100\nL B+0 C+0 F500 M129\nL X+0 Y+0 Z+10\n"),
            "TgSrGffgf");
  EXPECT_EQ(order("TOOL CALL 1 Z S100\nL X+0 Y+0 Z+10 B+1 FMAX M128\n"), "TgGr");
  EXPECT_EQ(order("L C+10 FMAX M126\nL C+350 FMAX M127\nL C+10 FMAX\n"), "Prerpr");
  // A vector in the block that ends the control is one still.
  EXPECT_EQ(order("TOOL CALL 1 Z S100\nM128\nLN X+1 Y+0 Z+0 TX+0 TY+0.6 TZ+0.8 F10 M129\n"),
            "TgGfg");
}

TEST(KlartextOrder, FeedsByTheRevolutionEndBehindTheMove) {
  const auto all = all_of<LinearFeed>(
      run_modes("TOOL CALL 1 Z S100\nM136\nL X+1 F0.2\nL X+2 M137\nL X+3 F100\nL X+4 F0.1 M136\n"));
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[1].feed.mode, FeedMode::per_revolution);
  EXPECT_EQ(all[1].feed.value, 0.2);
  EXPECT_EQ(all[2].feed.mode, FeedMode::per_minute);
  EXPECT_EQ(all[3].feed.mode, FeedMode::per_revolution);
  EXPECT_EQ(mode_complaint("M136\nL X+1 F100 M137\n"),
            "2:7: error: F100 beside M137, which counts when the move is done (hint: write M137 "
            "before, in a block of its own)");
  EXPECT_EQ(mode_complaint("M136\nL X+1 F0.1\nL X+2 M137\nL X+3\n"),
            "4:1: error: a cutting move without a feed rate (hint: give F on this block or before, "
            "above zero)");
}

TEST(OrderOfWords, StopsBesideAMoveAreTheDialects) {
  const std::string program = "S100 M3\nG1 X1 F10 M8\nG1 X2 M5 M9\n";
  for (const Dialect dialect : {Dialect::fanuc, Dialect::sinumerik}) {
    EXPECT_EQ(order(program, dialect), "SCffsc");
    EXPECT_EQ(order("S100 M3\nG0 Z5 M5\nM3\nM5\nM30\n", dialect), "SrsSs.");
  }
  EXPECT_EQ(order("S100 M3\nG28 Z0 M5 M9\nG4 P100 M5\n", Dialect::fanuc), "Srhscsd");
  // LinuxCNC has an order of its own: spindle and coolant before the move.
  EXPECT_EQ(order(program, Dialect::linuxcnc), "SCfscf");
}

TEST(KlartextForms, RepeatsMayFollowWithoutABlank) {
  for (const char* repeats : {"REP2", "REP 2", "REPQ106", "REP Q106", "rep2"}) {
    EXPECT_EQ(order(std::string("Q106 = 2\nLBL 1\nL X+1 FMAX\nCALL LBL 1 ") + repeats + "\n"),
              "rrr")
        << repeats;
  }
}

TEST(KlartextForms, LettersMayBeSmall) {
  EXPECT_EQ(feeds("begin pgm a mm\nl x+1 f10\nend pgm A mm\n"), std::vector<double>{10});
  EXPECT_DOUBLE_EQ(feeds("begin pgm a inch\nl x+1 f10\n").front(), 25.4);
  EXPECT_EQ(mode_complaint("begin pgm a cm\n").substr(0, 37),
            "1:11: error: BEGIN PGM has no unit (h");
}

TEST(KlartextForms, NumbersMayHaveCommas) {
  const auto move = last_of<Traverse>(run_modes("Q1 = 0,25 * 4\nL X+1,5 Y-0,125 Z+Q1 FMAX\n"));
  EXPECT_EQ(move.end[X], 1.5);
  EXPECT_EQ(move.end[Y], -0.125);
  EXPECT_EQ(move.end[Z], 1.0);
  EXPECT_EQ(mode_complaint("L X+1, Y+2 FMAX\n").substr(0, 26), "1:6: error: unexpected ','");
}

TEST(KlartextForms, FormulasHaveSquaresNegationsAndPi) {
  const auto value = [](const std::string& formula) {
    return *last_of<Traverse>(run_modes("Q2 = 3\nQ1 = " + formula + "\nL X+Q1 FMAX\n")).end[X];
  };
  EXPECT_DOUBLE_EQ(value("SQ 10 - 3^3"), 73.0);
  EXPECT_DOUBLE_EQ(value("SQ (Q2 + 1) * 2"), 32.0);
  EXPECT_DOUBLE_EQ(value("NEG Q2 * 2"), -6.0);
  EXPECT_DOUBLE_EQ(value("2 * PI * SQ NEG Q2"), 18.0 * std::acos(-1.0));
  EXPECT_DOUBLE_EQ(value("INT -2.5"), -2.0);
  EXPECT_DOUBLE_EQ(value("INT 2.5"), 2.0);
  EXPECT_EQ(mode_complaint("Q1 = FOO Q2\n").substr(0, 50),
            "1:6: error: FOO is no parameter and no function (h");
}

TEST(KlartextLabels, MayNotBeThereTwice) {
  EXPECT_EQ(mode_complaint("LBL 1\nLBL 0\nL X+1 FMAX\nLBL 1\nLBL 0\n"),
            "4:1: error: 1 is already on line 1 (hint: give each its own name)");
  EXPECT_EQ(order("LBL 1\nLBL 0\nLBL 2\nL X+1 FMAX\nLBL 0\n"), "r");
}

TEST(KlartextHints, SpeakKlartext) {
  EXPECT_EQ(
      mode_complaint("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+30\nCYCL DEF 8.0 MIRROR IMAGE\n"
                     "CYCL DEF 8.1 X\n"),
      "4:1: error: CYCL DEF 8 within a turned or scaled frame (hint: end them before (CYCL DEF "
      "10.1 ROT+0, 11.1 SCL 1), mirror, and begin them again)");
  EXPECT_EQ(mode_complaint("CYCL DEF 7.1 X+1\nL IX+5 FMAX\n"),
            "2:3: error: IX5 is incremental, but X has not been programmed yet (hint: program X "
            "once without I first)");
}

TEST(KlartextArcs, WithoutAnEndGoOnceRound) {
  const std::string head = "L X+10 Y+0 Z+2 FMAX\nCC X+0 Y+0\n";
  const auto circle = last_of<ArcFeed>(run_modes(head + "C DR+ F100\n"));
  EXPECT_EQ(circle.turns, 1);
  EXPECT_EQ(circle.end[X], 10.0);
  EXPECT_EQ(circle.end[Y], 0.0);
  EXPECT_EQ(circle.center[0], 0.0);
  EXPECT_EQ(circle.feed.value, 100.0);
  EXPECT_EQ(last_of<ArcFeed>(run_modes(head + "C DR- F100\n")).turns, -1);
  EXPECT_EQ(mode_complaint(head + "CP DR- F100\n"),
            "3:1: error: CP has no angle (hint: give PA or IPA; a full turn is IPA+360 DR+)");
  EXPECT_EQ(mode_complaint(head + "CT F100\n"),
            "3:1: error: the arc leads on from no move (hint: move along a contour in the plane "
            "before it)");
  EXPECT_EQ(mode_complaint("CC X+0 Y+0\nC DR+ F100\n").substr(0, 44),
            "2:1: error: the start of the arc is not know");
  EXPECT_EQ(last_of<ArcFeed>(run_modes(head + "CP IPA-360 DR- F100\n")).turns, -1);
}

// 538 degrees would be 178 from there on, and C+180 two degrees more.
TEST(KlartextModes, M94IsRefusedWhereItTakesTurnsOff) {
  EXPECT_EQ(mode_complaint("L C+538 FMAX\nL X+10 C+180 F500 M94\n"),
            "2:19: error: M94 takes full turns off C = 538 deg, which is not simulated (hint: turn "
            "by M126, or back to less than a full turn before)");
  EXPECT_EQ(mode_complaint("L C-359 FMAX M94\nL C+180 F500\n"), "");
  EXPECT_EQ(mode_complaint("M94 C\nL C+180 F500\n"), "");
}

TEST(KlartextModes, ScalingOfZIsTheControls) {
  const auto assumed = [](const std::string& text) {
    std::vector<std::string> names;
    for (const Event& event : all_of<Event>(run_modes("L X+1 Y+1 Z+1 FMAX\n" + text))) {
      if (event.grade == EventGrade::assumed) names.push_back(event.name);
    }
    return names;
  };
  EXPECT_EQ(assumed("CYCL DEF 11.0\nCYCL DEF 11.1 SCL 2\nL X+10 Z+5 F100\n"),
            std::vector<std::string>{"CYCL DEF 11"});
  EXPECT_EQ(assumed("CYCL DEF 11.0\nCYCL DEF 11.1 SCL 1\nL X+10 Z+5 F100\n"),
            std::vector<std::string>{});
}

// A program that goes on after the complaint, as a check does, would run a hundred million pecks.
TEST(KlartextModes, ACycleThatIsRefusedIsNotCalled) {
  const auto lines = complaints(
      "TOOL CALL 1 Z S1\nL X+0 Y+0 Z+5 FMAX M3\nCYCL DEF 200 Q200=2 Q201=-1000 Q206=1 Q202=.00001 "
      "Q210=0 Q203=0 Q204=5 Q211=0\nCYCL CALL\n",
      {}, Dialect::heidenhain);
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(lines.front().starts_with("3:39: error: the cycle makes more than 10000 pecks"))
      << lines.front();
}

TEST(KlartextModes, ThePartOfACycleIsOneThatThereIs) {
  EXPECT_FALSE(mode_complaint("CYCL DEF 9 .8660254037844387\n").empty());
}

}  // namespace
}  // namespace frustum::parser
