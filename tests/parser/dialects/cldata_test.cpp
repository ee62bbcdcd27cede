// APT CLDATA as CAM systems write it: motions derived by hand, and what is wrong with records.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "parser/writing/canonical_json.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

constexpr const char* kStart = "LOADTL/1\nFEDRAT/100,MMPM\nRAPID\nGOTO/0,0,50\n";

std::vector<Motion> run_cldata(const std::string& text) {
  return motions(text, {}, Dialect::cldata);
}
std::vector<Motion> run_behind_start(const std::string& text) { return run_cldata(kStart + text); }

// "rapid 1 2 3", "feed 1 2 3 F100", "dwell 2": mm, mm/min or mm/rev.
std::vector<std::string> path_of(const std::vector<Motion>& motions) {
  std::vector<std::string> path;
  const auto point = [](const AxisTarget& end) {
    std::string text;
    for (const AxisLetter axis : {X, Y, Z}) {
      const double value = std::round(end[axis].value_or(-999.0) * 1e4) / 1e4 + 0.0;
      std::string digits = std::to_string(value);
      digits.erase(digits.find_last_not_of('0') + 1);
      if (digits.ends_with('.')) digits.pop_back();
      text += ' ' + digits;
    }
    return text;
  };
  for (const Motion& motion : motions) {
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      path.push_back("rapid" + point(rapid->end));
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      path.push_back("feed" + point(feed->end));
    } else if (std::holds_alternative<Dwell>(motion.command)) {
      path.emplace_back("dwell");
    } else if (const auto* spindle = std::get_if<SpindleChange>(&motion.command)) {
      path.emplace_back(spindle->direction == SpindleDirection::off         ? "off"
                        : spindle->direction == SpindleDirection::clockwise ? "cw"
                                                                            : "ccw");
    }
  }
  return path;
}

std::vector<std::string> path_behind_start(const std::string& text) {
  auto path = path_of(run_behind_start(text));
  if (!path.empty()) path.erase(path.begin());
  return path;
}
using Path = std::vector<std::string>;

std::string tape_complaint(const std::string& text) {
  const auto lines = complaints(text, {}, Dialect::cldata);
  return lines.empty() ? std::string() : lines.front();
}

// --- words ---------------------------------------------------------------------------------------

TEST(CldataWords, HaveBlanksLowerCaseLabelsAndNumbersOfAllKinds) {
  const auto expected = path_behind_start("GOTO/0.5,-5,1000\n");
  EXPECT_EQ(expected, Path{"feed 0.5 -5 1000"});
  EXPECT_EQ(path_behind_start("  goto /  + .5 , - 5. ,1.0D+03\n"), expected);
  EXPECT_EQ(path_behind_start("A1) GOTO/5E-1,-50.E-1,1E3 $$ there\n"), expected);
  EXPECT_EQ(path_behind_start("10)GOTO/$\n.5$\n,-5,$ rest\n+1000.\n"), expected);
  EXPECT_EQ(path_behind_start("GOTO/-.0,+.0,0.\n"), Path{"feed 0 0 0"});
}

TEST(CldataWords, GoOverAnyNumberOfLines) {
  std::string text = "GOTO/";
  for (int i = 0; i < 2000; ++i) text += "$\n";
  EXPECT_EQ(path_behind_start(text + "1,2,3\n"), Path{"feed 1 2 3"});
  EXPECT_EQ(path_behind_start("GOTO/1,2," + std::string(60'000, ' ') + "3\n"), Path{"feed 1 2 3"});
}

TEST(CldataWords, TellWhatTheyDoNotSimulate) {
  const auto events = all_of<Event>(run_cldata(
      "PARTNO/FLANGE 7\nCUTTER/10.0,5.0,0,5.0,0,0,50\nTOOLNO/1,MILL\nREWIND/0\nSEQNO/10\n"
      "LEADER/200\nMACHIN/SINUMERIK,3\nCUTCOM/OFF\nTLAXIS/0,0,1\nA)REMARK by hand\nMODE/ABSOL\n"
      "INSERT M110\nTOOL PATH/OP1,TOOL,D10\nTLDATA/MILL,10.0,0.0\nEND-OF-PATH\n"
      "LOADTL/3,OSETNO,4,LENGTH,80.5,ADJUST,3\nSPINDL/RPM,500,CLW,RANGE,2\nCOOLNT/MIST\n"
      "COOLNT/ON,HIGH\nFROM/0,0,100\nPPRINT DONE\n"));
  std::vector<std::string> seen;
  for (const Event& event : events) seen.push_back(event.name + "|" + event.text);
  EXPECT_EQ(seen, (std::vector<std::string>{"PARTNO|FLANGE 7",
                                            "CUTTER|10.0,5.0,0,5.0,0,0,50",
                                            "TOOLNO|1,MILL",
                                            "REWIND|0",
                                            "SEQNO|10",
                                            "LEADER|200",
                                            "MACHIN|SINUMERIK,3",
                                            "CUTCOM|OFF",
                                            "TLAXIS|0,0,1",
                                            "label|A",
                                            "REMARK|by hand",
                                            "MODE|ABSOL",
                                            "INSERT|M110",
                                            "TOOL PATH|OP1,TOOL,D10",
                                            "TLDATA|MILL,10.0,0.0",
                                            "END-OF-PATH|-OF-PATH",
                                            "LOADTL|OSETNO,4,LENGTH,80.5,ADJUST,3",
                                            "SPINDL|RANGE,2",
                                            "COOLNT|MIST",
                                            "COOLNT|HIGH",
                                            "FROM|X0 Y0 Z100",
                                            "message|DONE"}));
}

// $ continues any record but those that are text to their end.
TEST(CldataWords, GoOnOnTheNextLineButForTexts) {
  const auto events =
      all_of<Event>(run_cldata("CUTTER/ 10.0,  2.0,$\n 0.0, 50.0 $$ mill\nPPRINT COSTS 5 $\n"));
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].name + "|" + events[0].text, "CUTTER|10.0,  2.0,0.0, 50.0");
  EXPECT_EQ(events[2].name + "|" + events[2].text, "message|COSTS 5 $");
}

TEST(CldataWords, GiveFeedsInEveryOrderAndUnit) {
  const auto feed = [](const std::string& record, const char* unit = "MM") {
    const Feed found = last_of<LinearFeed>(run_cldata(std::string("UNITS/") + unit +
                                                      "\nLOADTL/1\nFEDRAT/1,MMPM\nGOTO/0,0,1\n" +
                                                      record + "\nGOTO/0,0,2\n"))
                           .feed;
    return std::pair(std::round(found.value * 1e9) / 1e9, found.mode);
  };
  const auto minute = [](double value) { return std::pair(value, FeedMode::per_minute); };
  const auto turn = [](double value) { return std::pair(value, FeedMode::per_revolution); };
  EXPECT_EQ(feed("FEDRAT/500,MMPM"), minute(500));
  EXPECT_EQ(feed("FEDRAT/MMPM,500"), minute(500));
  EXPECT_EQ(feed("fedrat / 500."), minute(500));
  EXPECT_EQ(feed("FEDRAT/PERMIN,500"), minute(500));
  EXPECT_EQ(feed("FEDRAT/.25,MMPR"), turn(0.25));
  EXPECT_EQ(feed("FEDRAT/PERREV,.25"), turn(0.25));
  EXPECT_EQ(feed("FEDRAT/10,IPM"), minute(254));
  EXPECT_EQ(feed("FEDRAT/IPR,.01"), turn(0.254));
  EXPECT_EQ(feed("FEDRAT/10,IPM", "INCHES"), minute(254));
  EXPECT_EQ(feed("FEDRAT/254,MMPM", "INCHES"), minute(254));
  // Without a unit the one before goes on.
  EXPECT_EQ(feed("FEDRAT/.1,MMPR\nFEDRAT/.2"), turn(0.2));
}

TEST(CldataWords, TurnTheSpindleOnAgainAsItTurned) {
  EXPECT_EQ(path_of(run_cldata("SPINDL/CCLW,RPM,800\nSPINDL/OFF\nSPINDL/ON\nSPINDL/900,RPM\n"
                               "SPINDL/ON,CLW\n")),
            (Path{"ccw", "off", "ccw", "ccw", "cw"}));
}

TEST(CldataWords, KeepTheToolAxisOfTlaxis) {
  const auto moves = all_of<Traverse>(run_cldata(
      "MULTAX\nLOAD/TOOL,1\nTLAXIS/0,0.6,0.8\nRAPID\nGOTO/1,2,3\nRAPID\nGOTO/4,5,6,1,0,0\n"
      "RAPID\nGOTO/7,8,9\n"));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_LT((moves[0].tool_axis->vec() - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(moves[1].tool_axis->vec(), Vec3(1, 0, 0));
  EXPECT_LT((moves[2].tool_axis->vec() - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
}

TEST(CldataWords, GoHomeByAPlaceOrByTheMachine) {
  EXPECT_EQ(path_behind_start("GOHOME/1,2,90\n"), Path{"rapid 1 2 90"});
  const auto home = last_of<HomeReturn>(run_behind_start("GOHOME\n"));
  EXPECT_TRUE(home.axes[0] && home.axes[2] && home.axes[5]);
}

// --- arcs ----------------------------------------------------------------------------------------

TEST(CldataArcs, GoOnThroughTheGotosOnTheCircle) {
  // Creo: a quarter, another one, then straight to a place off the circle.
  const auto all = run_behind_start(
      "GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\nGOTO/-10,0,0\nGOTO/-20,0,0\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_EQ(arcs.size(), 2U);
  EXPECT_EQ(arcs[0].end[Y], 10.0);
  EXPECT_EQ(arcs[1].end[X], -10.0);
  EXPECT_EQ(arcs[1].center, Vec3(0, 0, 0));
  EXPECT_EQ(arcs[1].turns, 1);
  EXPECT_EQ(last_of<LinearFeed>(all).end[X], -20.0);
  // Its lines without a word are places too.
  const auto same =
      run_behind_start("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n-10,0,0\nGOTO/-20,0,0\n");
  EXPECT_EQ(all_of<ArcFeed>(same).size(), 2U);
}

TEST(CldataArcs, EndWithOtherRecordsAndBeyondAFullTurn) {
  const auto arcs = [](const std::string& text) {
    return all_of<ArcFeed>(run_behind_start("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,-1,10\n" + text)).size();
  };
  EXPECT_EQ(arcs("GOTO/0,-10,0\nFEDRAT/50\nGOTO/-10,0,0\n"), 1U);
  EXPECT_EQ(arcs("GOTO/0,-10,0\n$$ remark\nGOTO/-10,0,0\n"), 2U);
  // Back against the way would be more than a turn: a chord. Up from the end is straight.
  EXPECT_EQ(arcs("GOTO/-10,0,0\nGOTO/0,-10,0\n"), 1U);
  EXPECT_EQ(arcs("GOTO/-10,0,0\nGOTO/-10,0,50\n"), 1U);
  // Full circles, at once and by halves.
  EXPECT_EQ(arcs("GOTO/10,0,0\n"), 1U);
  EXPECT_EQ(arcs("GOTO/-10,0,0\nGOTO/10,0,0\n"), 2U);
  // NX, with the cutter after the radius: one GOTO.
  EXPECT_EQ(all_of<ArcFeed>(run_behind_start("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10,.01,.5,10,0\n"
                                             "GOTO/-10,0,0\nGOTO/10,0,0\n"))
                .size(),
            1U);
}

TEST(CldataArcs, ClimbInHelices) {
  const auto arc = [](const std::string& circle, const std::string& end) {
    return last_of<ArcFeed>(run_behind_start("GOTO/10,0,0\n" + circle + "\nGOTO/" + end + "\n"));
  };
  EXPECT_EQ(arc("CIRCLE/0,0,0,0,0,1,10,TIMES,3", "10,0,-6").turns, 3);
  EXPECT_EQ(arc("CIRCLE/0,0,0,0,0,1,10,.01,.5,8,0,TIMES,2.25", "0,-10,-6").turns, -3);
  EXPECT_EQ(arc("CIRCLE/0,0,0,0,0,1,10,PITCH,2", "0,10,-4.5").turns, 3);
  EXPECT_EQ(arc("MOVARC/0,0,0,0,0,1,10,ANGLE,90", "0,10,0").turns, 1);
  EXPECT_EQ(arc("MOVARC/0,0,0,0,0,1,10,ANGLE,450", "0,10,0").turns, 2);
  const ArcFeed orbit = arc("CIRCLE/0,0,0,0,0,1,10", "10,0,-1.5");
  EXPECT_EQ(orbit.turns, 1);
  EXPECT_EQ(orbit.end[Z], -1.5);
}

TEST(CldataArcs, LeadToALineAsCatiaWritesThem) {
  const auto arc = [](const std::string& records) {
    return last_of<ArcFeed>(run_behind_start("GOTO/10,0,5\nAUTOPS\n" + records));
  };
  // From (10 0) upwards: counterclockwise, to the end of the line from the centre.
  const ArcFeed quarter =
      arc("INDIRV/0,1,0\nTLON,GOFWD/ (CIRCLE/ 0.00000, 0.00000, 5.00000,$\n"
          "  10.00000),ON,(LINE/ 0.00000, 0.00000, 5.00000,$\n  0.00000, 10.00000, 5.00000)\n");
  EXPECT_EQ(quarter.turns, 1);
  EXPECT_EQ(quarter.end[X], 0.0);
  EXPECT_EQ(quarter.end[Y], 10.0);
  EXPECT_EQ(quarter.center, Vec3(0, 0, 5));
  // Downwards: clockwise.
  EXPECT_EQ(arc("INDIRV/0,-1,0\nTLON,GOFWD/(CIRCLE/0,0,5,10),ON,(LINE/0,0,5,0,10,5)\n").turns, -1);
  EXPECT_EQ(arc("INDIRP/10,-3,5\nTLON,GOFWD/(CIRCLE/0,0,5,10),ON,(LINE/0,0,5,0,10,5)\n").turns, -1);
  // A line across: x = 6 is met at y = 8 first, at y = -8 second.
  const std::string across = "(LINE/6,-20,5,6,20,5)\n";
  EXPECT_NEAR(*arc("INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,5,10),ON," + across).end[Y], 8.0, 1e-12);
  EXPECT_NEAR(*arc("INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,5,10),ON,2,INTOF," + across).end[Y], -8.0,
              1e-12);
  EXPECT_NEAR(
      *arc("INDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/CANON,0,0,5,0,0,1,10),ON,(PLANE/2,0,0,12)\n").end[Y],
      8.0, 1e-12);
  // Another plane: Y Z, seen from X.
  const ArcFeed upright =
      arc("GOTO/0,10,0\nINDIRV/0,0,1\nTLON,GOFWD/(CYLNDR/0,0,0,1,0,0,10),ON,(LINE/0,0,0,0,0,10)\n");
  EXPECT_EQ(upright.plane, Plane::yz);
  EXPECT_EQ(upright.turns, 1);
  EXPECT_EQ(upright.end[Z], 10.0);
}

// --- cycles --------------------------------------------------------------------------------------

TEST(CldataCycles, DrillAtEachGotoUntilOff) {
  const Path expected{"rapid 10 0 50", "rapid 10 0 3",  "feed 10 0 -12", "rapid 10 0 3",
                      "rapid 20 0 3",  "feed 20 0 -12", "rapid 20 0 3",  "rapid 0 0 60"};
  const std::string holes = "GOTO/10,0,0\nGOTO/20,0,0\nCYCLE/OFF\nRAPID\nGOTO/0,0,60\n";
  EXPECT_EQ(path_behind_start("CYCLE/DRILL,DEPTH,12,MMPM,80,CLEAR,3\n" + holes), expected);
  EXPECT_EQ(path_behind_start("CYCLE / DRILL, RAPTO, 3.0, FEDTO, -12.0, MMPM, 80.\n" + holes),
            expected);
  EXPECT_EQ(path_behind_start("CYCLE/DRILL,12,80,MMPM,3\n" + holes), expected);
  EXPECT_EQ(path_behind_start("CYCLE/DRILL,12,MMPM,80,3\n" + holes), expected);
  EXPECT_EQ(path_behind_start("CYCLE/REAM,12,MMPM,80,3\nCYCLE/OFF\nCYCLE/DRILL,12,MMPM,80,3\n"
                              "CYCLE/OFF\nCYCLE/ON\n" +
                              holes),
            expected);
}

TEST(CldataCycles, UseTheirOwnFeedAndLeaveTheOther) {
  const auto feeds = all_of<LinearFeed>(
      run_behind_start("CYCLE/DRILL,12,.1,MMPR,3\nGOTO/1,1,0\nCYCLE/OFF\nGOTO/1,1,9\n"));
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_EQ(feeds[0].feed.value, 0.1);
  EXPECT_EQ(feeds[0].feed.mode, FeedMode::per_revolution);
  EXPECT_EQ(feeds[1].feed.value, 100.0);
  EXPECT_EQ(feeds[1].feed.mode, FeedMode::per_minute);
}

TEST(CldataCycles, RetractToWhereTheyAreTold) {
  EXPECT_EQ(path_behind_start("CYCLE/DRILL,RAPTO,2,FEDTO,-5,RTRCTO,AUTO,MMPM,80\nGOTO/1,0,10\n"),
            (Path{"rapid 1 0 50", "rapid 1 0 12", "feed 1 0 5", "rapid 1 0 50"}));
  EXPECT_EQ(path_behind_start("CYCLE/DRILL,RAPTO,2,FEDTO,-5,RTRCTO,20,MANUAL,MMPM,80\n"
                              "GOTO/1,0,10\n"),
            (Path{"rapid 1 0 50", "rapid 1 0 12", "feed 1 0 5", "rapid 1 0 30"}));
  // Creo: by rapid 4 mm further than the clearance of 5; 0 is the retract plane.
  EXPECT_EQ(
      path_behind_start("CYCLE/DRILL,DEPTH,5,MMPM,80,CLEAR,5,RAPTO,4,RETURN,0\nGOTO/1,0,10\n"),
      (Path{"rapid 1 0 50", "rapid 1 0 15", "rapid 1 0 11", "feed 1 0 5", "rapid 1 0 50"}));
}

TEST(CldataCycles, ComeUpBeforeAHigherHole) {
  EXPECT_EQ(path_behind_start("CYCLE/DRILL,5,80,MMPM,2\nGOTO/1,0,0\nGOTO/9,0,10\n"),
            (Path{"rapid 1 0 50", "rapid 1 0 2", "feed 1 0 -5", "rapid 1 0 2", "rapid 1 0 12",
                  "rapid 9 0 12", "feed 9 0 5", "rapid 9 0 12"}));
}

TEST(CldataCycles, PeckTapBoreAndDwell) {
  EXPECT_EQ(path_behind_start("CYCLE/DEEP,DEPTH,10,STEP,6,MMPM,80,CLEAR,2\nGOTO/0,0,0\n"),
            (Path{"rapid 0 0 2", "feed 0 0 -4", "rapid 0 0 2", "rapid 0 0 -3.746", "feed 0 0 -10",
                  "rapid 0 0 2"}));
  EXPECT_EQ(path_behind_start("CYCLE/DEEP,DEPTH,4,STEP,6,MMPM,80,CLEAR,2,DWELL,1\nGOTO/0,0,0\n"),
            (Path{"rapid 0 0 2", "feed 0 0 -4", "dwell", "rapid 0 0 2"}));
  EXPECT_EQ(
      path_behind_start("CYCLE/DRILL,BRKCHP,DEPTH,10,STEP,6,MMPM,80,CLEAR,2\nGOTO/0,0,0\n"),
      (Path{"rapid 0 0 2", "feed 0 0 -4", "rapid 0 0 -3.746", "feed 0 0 -10", "rapid 0 0 2"}));
  EXPECT_EQ(path_behind_start("SPINDL/500,CLW\nCYCLE/TAP,DEPTH,8,MMPR,1.25,CLEAR,2\nGOTO/0,0,0\n"),
            (Path{"cw", "rapid 0 0 2", "feed 0 0 -8", "ccw", "feed 0 0 2", "cw"}));
  EXPECT_EQ(path_behind_start("CYCLE/BORE,DEPTH,8,MMPM,50,CLEAR,2,DWELL,.5\nGOTO/0,0,0\n"),
            (Path{"rapid 0 0 2", "feed 0 0 -8", "dwell", "feed 0 0 2"}));
  EXPECT_EQ(path_behind_start("CYCLE/FACE,DEPTH,8,MMPM,50,CLEAR,2,DWELL,.5\nGOTO/0,0,0\n"),
            (Path{"rapid 0 0 2", "feed 0 0 -8", "dwell", "rapid 0 0 2"}));
}

TEST(CldataCycles, DrillAlongTheToolVector) {
  const auto path =
      path_of(run_cldata("MULTAX/ON\nLOADTL/1\nRAPID\nGOTO/0,0,50,0,0,1\nCYCLE/DRILL,10,80,MMPM,5\n"
                         "GOTO/1,2,3,1,0,0\nGOTO/1,4,3\nGOTO/1,4,3,0,.6,.8\n"));
  EXPECT_EQ(path,
            (Path{"rapid 0 0 50", "rapid 6 2 3", "feed -9 2 3", "rapid 6 2 3", "rapid 6 4 3",
                  "feed -9 4 3", "rapid 6 4 3", "rapid 1 7 7", "feed 1 -2 -5", "rapid 1 7 7"}));
}

TEST(CldataCycles, ScaleInches) {
  EXPECT_EQ(path_of(run_cldata("UNITS/INCHES\nLOADTL/1\nRAPID\nGOTO/0,0,2\n"
                               "CYCLE/DRILL,DEPTH,1,IPM,10,CLEAR,.1\nGOTO/1,0,0\n")),
            (Path{"rapid 0 0 50.8", "rapid 25.4 0 50.8", "rapid 25.4 0 2.54", "feed 25.4 0 -25.4",
                  "rapid 25.4 0 2.54"}));
}

// Drilled or written out: the same.
TEST(CldataLaws, ACycleIsItsMovesWrittenOut) {
  EXPECT_EQ(path_behind_start("CYCLE/BRKCHP,DEPTH,9,STEP,4,MMPM,80,CLEAR,1\nGOTO/5,6,7\n"),
            path_behind_start("FEDRAT/80\nRAPID\nGOTO/5,6,50\nRAPID\nGOTO/5,6,8\nGOTO/5,6,4\n"
                              "RAPID\nGODLTA/0,0,.254\nGOTO/5,6,0\nRAPID\nGODLTA/0,0,.254\n"
                              "GOTO/5,6,-2\nRAPID\nGOTO/5,6,8\n"));
}

// --- what is wrong -------------------------------------------------------------------------------

struct WrongTape {
  const char* text;
  const char* complaint;
};

TEST(CldataErrors, SayWhereWhatAndTheRemedy) {
  const std::vector<WrongTape> mistakes{
      {"GOTTO/1,2,3\n", "1:1: error: unknown record GOTTO (hint: did you mean GOTO?)"},
      {"FEDRATE/100\n", "1:1: error: unknown record FEDRATE (hint: did you mean FEDRAT?)"},
      {"P1 = POINT/1,2,3\n", "1:1: error: P1 is defined in the APT language"},
      {"TRANS/0,0,5\n", "1:1: error: TRANS is not simulated"},
      {"ROTATE/AAXIS,30\n", "1:1: error: ROTATE is not simulated"},
      {"ROTABL/30\n", "1:1: error: ROTABL is not simulated"},
      {"MODE/INCR\n", "1:1: error: MODE is not simulated"},
      {"PREFUN/68\n", "1:1: error: PREFUN is not simulated"},
      {"SPINDL/SFM,300,CLW\n", "1:8: error: SPINDL by cutting speed is not simulated"},
      {"LOADTL/1,$\n2,$\nLENGTH,,\n", "3:8: error: an argument is missing"},
      {"CONT/1,2,3\n", "1:1: error: CONT goes on from no GOTO"},
      {"1,2,3\n", "1:1: error: unexpected '1'"},
      {"GOTO/1,2,3 5\n", "1:12: error: unexpected '5'"},
      {"RAPID\nCIRCLE/0,0,0,0,0,1,5\n", "2:1: error: an arc by rapid"},
      {"CIRCLE/0,0,0,0,0,1,5,6,7,8,9,10\n", "1:1: error: CIRCLE with 12 numbers"},
      {"CIRCLE/0,0,0,0,0,1,5,WIDE,3\n", "1:22: error: WIDE has no meaning in CIRCLE"},
      {"CIRCLE/0,0,0,0,0,1,5,TIMES\n", "1:22: error: TIMES has no number above zero"},
      {"RAPID\nGOTO/5,0,0\nFEDRAT/9\nCIRCLE/0,0,0,0,0,1,5,TIMES,2.5\nGOTO/0,5,-6\n",
       "5:1: error: the arc makes 2.5 turns by TIMES, but its end is 0.25 of a turn away"},
      {"RAPID\nGOTO/5,0,0\nFEDRAT/9\nMOVARC/0,0,0,0,0,1,5,ANGLE,180\nGOTO/0,5,0\n",
       "5:1: error: the arc makes 0.5 turns by ANGLE, but its end is 0.25 of a turn away"},
      {"RAPID\nGOTO/5,0,0\nFEDRAT/9\nCIRCLE/0,0,0,0,0,1,5,.01,.5,10,0\nGOTO/5,0,0\n",
       "5:1: error: the arc ends where it starts: a full turn, or none?"},
      {"MOVARC/0,0,0,0,0,1,5,ANGLE,90\nGOHOME\n", "2:1: error: the CIRCLE on line 1 has no GOTO"},
      {"INDIRV/0,1\n", "1:1: error: INDIRV with 2 numbers"},
      {"TLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/0,0,0,0,5,0)\n",
       "1:1: error: the start of the arc is not known"},
      {"RAPID\nGOTO/5,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/0,0,0,0,5,0)\n",
       "3:1: error: the arc has no direction"},
      {"RAPID\nGOTO/5,0,0\nINDIRV/1,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/0,0,0,0,5,0)\n",
       "4:1: error: the direction does not lead along the circle"},
      {"RAPID\nGOTO/5,0,0\nINDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/9,0,0,9,5,0)\n",
       "4:33: error: LINE does not cross the circle"},
      {"RAPID\nGOTO/5,0,0\nINDIRV/0,1,0\nTLON,GOFWD/(LINE/0,0,0,0,5,0)\n",
       "4:13: error: TLON without a circle"},
      {"TLLFT,GOFWD/C1\n", "1:6: error: unexpected ','"},
      {"CYCLE\n", "1:1: error: CYCLE has no name"},
      {"CYCLE/ON\n", "1:1: error: there is no cycle to switch on"},
      {"CYCLE/THRU,DEPTH,3\n", "1:7: error: CYCLE/THRU is not simulated"},
      {"CYCLE/DRILL,DEPTH\n", "1:13: error: DEPTH has no number"},
      {"CYCLE/DRILL,MMPM,80,CLEAR,3\n", "1:1: error: CYCLE has no depth"},
      {"CYCLE/DRILL,DEPTH,5,MMPM,80\n", "1:1: error: CYCLE has no clearance"},
      {"CYCLE/DEEP,DEPTH,5,STEP,0,MMPM,80,CLEAR,3\n", "1:1: error: CYCLE has no STEP above zero"},
      {"CYCLE/DRILL,126.,85.,1.,MMPR\n", "1:18: error: the 85 in CYCLE could mean many things"},
      {"CYCLE/DRILL,DEPTH,5,MMPM,80,CLEAR,3,RETURN,1\n",
       "1:44: error: RETURN,1 is below where feeding begins"},
      {"CYCLE/DRILL,DEPTH,-5,MMPM,80,CLEAR,3\n",
       "1:19: error: the depth of CYCLE is not above zero"},
      {"CYCLE/DRILL,DEPTH,5,MMPM,0,CLEAR,3\n",
       "1:26: error: the feed of the cycle is not above zero"},
      {"CYCLE/DEEP,DEPTH,5,STEP,1E-9,MMPM,9,CLEAR,3\n",
       "1:25: error: the cycle makes more than 10000 pecks"},
      {"CYCLE/DRILL,5,9,MMPM,3\nGODLTA/1,0,0\n", "2:8: error: a step while a cycle is on"},
      {"RAPID\nGOTO/5,0,0\nFEDRAT/9\nCYCLE/DRILL,5,9,MMPM,3\nCIRCLE/0,0,0,0,0,1,5\nGOTO/0,5,0\n",
       "6:1: error: an arc while a cycle is on"},
  };
  for (const WrongTape& wrong : mistakes) {
    const std::string line = tape_complaint(wrong.text);
    EXPECT_TRUE(line.starts_with(wrong.complaint)) << line << "\n" << wrong.text;
    EXPECT_NE(line.find(" (hint: "), std::string::npos) << line;
  }
}

// Places without a vector are then of the tip of the tool as it is.
TEST(CldataTilt, StaysBehindMultaxOff) {
  const std::string head =
      "UNITS/MM\nLOADTL/1\nFEDRAT/100,MMPM\nGOTO/0,0,100\nMULTAX/ON\nGOTO/10,0,0,0,0.6,0.8\n"
      "MULTAX/OFF\n";
  const auto tilted =
      all_of<LinearFeed>(motions(head + "GOTO/30,20,5\n", {}, Dialect::cldata)).back();
  EXPECT_EQ(tilted.end[AxisLetter::X], 30.0);
  EXPECT_EQ(tilted.end[AxisLetter::Z], 5.0);
  ASSERT_TRUE(tilted.tool_axis);
  EXPECT_LT((tilted.tool_axis->vec() - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
  // Of an upright tool it ends the tilting.
  const auto upright = motions(head + "GOTO/1,2,3,0,0,1\nMULTAX/OFF\n", {}, Dialect::cldata);
  EXPECT_EQ(last_of<CompensationChange>(upright).mode, LengthCompensation::length);
}

// Records of APT that say where the part or the tool is, and are not simulated.
TEST(CldataRefusals, NameRecordsThatMoveThePart) {
  for (const char* record : {"MIRROR/XYPLAN", "REFSYS/MX1", "LOOPST", "INCR", "TABLE/90",
                             "WAXIS/10", "ZAXIS/10", "SET/AXIS,90"}) {
    EXPECT_EQ(complaint_ids(std::string("UNITS/MM\nFEDRAT/9,MMPM\n") + record + "\nGOTO/1,0,0\n",
                            {}, Dialect::cldata),
              std::vector<std::string>{"not-supported"})
        << record;
  }
  for (const char* record : {"MIRROR/NOMORE", "SET/MODE,ABSOL", "HEAD/1"}) {
    EXPECT_TRUE(
        complaint_ids(std::string("UNITS/MM\n") + record + "\nGOTO/1,0,0\n", {}, Dialect::cldata)
            .empty())
        << record;
  }
}

}  // namespace
}  // namespace frustum::parser
