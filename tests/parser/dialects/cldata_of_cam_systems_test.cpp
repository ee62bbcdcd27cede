// APT CLDATA in the forms that CAM systems write: SolidWorks CAM, NX, CATIA, Creo, Fusion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "parser/writing/block_text.hpp"
#include "tests/parser/running.hpp"
#include "tests/parser/same_block.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_cl(const std::string& text) { return motions(text, {}, Dialect::cldata); }

Vec3 place_of(const AxisTarget& end) {
  return {end[X].value_or(NAN), end[Y].value_or(NAN), end[Z].value_or(NAN)};
}

// Names of the events of a grade, with their texts.
std::vector<std::string> events_of(const std::string& text, EventGrade grade) {
  std::vector<std::string> seen;
  for (const Event& event : all_of<Event>(run_cl(text))) {
    if (event.grade == grade) seen.push_back(event.name + "|" + event.text);
  }
  return seen;
}
std::vector<std::string> names_assumed(const std::string& text) {
  std::vector<std::string> names = events_of(text, EventGrade::assumed);
  for (std::string& name : names) name = name.substr(0, name.find('|'));
  return names;
}

std::vector<std::string> ids_of(const std::string& text) {
  return complaint_ids(text, {}, Dialect::cldata);
}
using Ids = std::vector<std::string>;

constexpr const char* kTilted =
    "UNIT/MM\nCUTTER/8.,0,4.,0,0,0,64.\nLOAD/TOOL,17\nCSI_SET_FLUTE_LENGTH/20.\n"
    "TRNTYP/WORLD,0,0,0\nCSYS/0,0,1.,0,1.,0,0,0,0,1.,0,0\nRAPID/\n"
    "GOTO/120.,5.,-3.,1.,0,0\nFEDRAT/288.6,MMPM\nGOTO/100.,5.,-3.,1.,0,0\n";

TEST(CldataOfCam, Fault2_11_SolidWorksReadsFromUnitToFini) {
  const auto all = run_cl(
      "PARTNO/1\nUNIT/MM\nINSERT/[HOLDER=ER] 6.0mm DRILL\nCUTTER/6.,0,3.,1.8,31.,0,91.\n"
      "LOAD/TOOL,16\nCSI_SET_FLUTE_LENGTH/60.\nCSI_SET_EXTENSION_LENGTH/70.\nSELECT/TOOL,17\n"
      "COOLNT/FLOOD\nSPINDL/1691,RPM,CLW\nTRNTYP/WORLD,0,0,0\nSETUP/START,1\n"
      "CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0\nRAPID/\nGOTO/10.,10.,25.\nCYCLE/INIT\n"
      "CYCLE/DEEP2,FEDTO,9.,1STPECK,5.,SUBPECK,2.,MMPM,154.,RAPTO,3.,RTRCTO,25.\n"
      "GOTO/10.,10.,0\nCYCLE/OFF\nFEDRAT/288.6,MMPM\nGOTO/5.,0,-2.\nCUTCOM/LEFT\n"
      "CIRCLE/0,0,-2.,0,0,1.\nGOTO/5.,0,-2.\nGOTO/8.,0,-2.\nCIRCLE/0,0,-2.,0,0,-1.\n"
      "GOTO/0,8.,-2.\nCUTCOM/OFF\nRAPID/\nGOTO/0,8.,25.\nSETUP/END,1\nFINI\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_EQ(arcs.size(), 2U);
  // The first one is a full turn, the line behind it is none.
  EXPECT_EQ(place_of(arcs[0].end), Vec3(5, 0, -2));
  EXPECT_EQ(arcs[0].turns, 1);
  EXPECT_EQ(arcs[1].turns, -1);
  EXPECT_EQ(place_of(arcs[1].end), Vec3(0, 8, -2));
  EXPECT_EQ(place_of(last_of<Traverse>(all).end), Vec3(0, 8, 25));
}

TEST(CldataOfCam, Fault2_11_PecksAfterTheFirstHaveTheirOwnDepth) {
  const auto depths = [](const std::string& cycle) {
    std::vector<double> bottoms;
    for (const LinearFeed& feed :
         all_of<LinearFeed>(run_cl("LOADTL/1\nRAPID\nGOTO/0,0,50\n" + cycle + "\nGOTO/0,0,0\n"))) {
      bottoms.push_back(*feed.end[Z]);
    }
    return bottoms;
  };
  using Depths = std::vector<double>;
  EXPECT_EQ(depths("CYCLE/DEEP2,FEDTO,9,1STPECK,5,SUBPECK,2,MMPM,154,RAPTO,3,RTRCTO,25"),
            (Depths{-5, -7, -9}));
  EXPECT_EQ(depths("CYCLE/DEEP2,FEDTO,9,1STPECK,1,SUBPECK,6,MMPM,154,RAPTO,3,RTRCTO,25"),
            (Depths{-1, -7, -9}));
  EXPECT_EQ(depths("CYCLE/DEEP,FEDTO,4,INCR,3,MMPM,154,RAPTO,1,RTRCTO,25"), (Depths{-2, -4}));
}

TEST(CldataOfCam, Fault2_11_AVectorTiltsTheToolWithoutMultax) {
  const auto all = run_cl(std::string(kTilted) + "GOTO/90,5,-3\n");
  const auto change = last_of<CompensationChange>(all);
  EXPECT_TRUE(change.tool_vectors);
  ASSERT_EQ(all_of<LinearFeed>(all).size(), 2U);
  for (const LinearFeed& feed : all_of<LinearFeed>(all)) {
    ASSERT_TRUE(feed.tool_axis);
    EXPECT_EQ(feed.tool_axis->vec(), Vec3(1, 0, 0));
  }
  // An upright vector says nothing.
  EXPECT_TRUE(std::ranges::none_of(
      all_of<CompensationChange>(run_cl("LOADTL/1\nRAPID\nGOTO/1,2,3,0,0,1\n")),
      [](const CompensationChange& c) { return c.tool_vectors; }));
}

TEST(CldataOfCam, Fault2_11_TheFrameOfAnOperationPointsTheToolAndMovesNothing) {
  // Upright again by CSYS alone.
  const auto all = run_cl(std::string(kTilted) +
                          "CSYS/1.,0,0,-59.5,0,1.,0,-59.5,0,0,1.,19.\nRAPID/\nGOTO/1,2,3\n");
  const auto last = last_of<Traverse>(all);
  EXPECT_EQ(place_of(last.end), Vec3(1, 2, 3));
  EXPECT_EQ(last.tool_axis->vec(), Vec3(0, 0, 1));
  EXPECT_EQ(ids_of("CSYS/1.,0,0,0,0,1.,0,0,0,0,1.,0\n"), Ids{"not-supported"});
  EXPECT_EQ(ids_of("TRNTYP/LOCAL,0,0,0\n"), Ids{"not-supported"});
}

TEST(CldataOfCam, Fault2_11_ArcsOfATiltedToolAreLinesOnTheCircle) {
  const std::string start = "LOADTL/1\nFEDRAT/100,MMPM\nRAPID\nGOTO/5,0,0,0,-.6,.8\n";
  const auto all = run_cl(start + "CIRCLE/0,0,0,0,-.6,.8\nGOTO/0,4,3,0,-.6,.8\n");
  const auto lines = all_of<LinearFeed>(all);
  ASSERT_GT(lines.size(), 20U);
  const Vec3 axis(0, -0.6, 0.8);
  for (const LinearFeed& line : lines) {
    EXPECT_NEAR(place_of(line.end).norm(), 5.0, 1e-9);
    EXPECT_NEAR(place_of(line.end).dot(axis), 0.0, 1e-9);
    EXPECT_GE(*line.end[X], -1e-9);  // a quarter, counterclockwise
  }
  EXPECT_EQ(place_of(lines.back().end), Vec3(0, 4, 3));
  // A full turn, and one that climbs along the axis.
  const auto turn =
      all_of<LinearFeed>(run_cl(start + "CIRCLE/0,0,0,0,-.6,.8\nGOTO/5,0,0,0,-.6,.8\n"));
  EXPECT_GT(turn.size(), 4 * lines.size() - 8);
  const auto helix =
      all_of<LinearFeed>(run_cl(start + "CIRCLE/0,0,0,0,-.6,.8\nGOTO/5,-6,8,0,-.6,.8\n"));
  EXPECT_NEAR(place_of(helix[helix.size() / 2 - 1].end).dot(axis), 5.0, 0.02);
  EXPECT_EQ(ids_of(start + "CIRCLE/0,0,0,0,-.6,.8\nGOTO/0,4.1,3,0,-.6,.8\n"), Ids{"arc-radius"});
}

TEST(CldataOfCam, Fault2_11_CutterCompensationIsAnAssumption) {
  const std::string path = "LOADTL/1\nFEDRAT/100\nGOTO/0,0,0\n";
  for (const char* record : {"CUTCOM/LEFT", "CUTCOM/RIGHT,XYPLAN", "CUTCOM/ON,LEFT,3"}) {
    EXPECT_EQ(names_assumed(path + record + "\nGOTO/1,0,0\nCUTCOM/OFF\n" + record + "\n"),
              std::vector<std::string>{"CUTCOM"});
  }
  EXPECT_TRUE(names_assumed(path + "CUTCOM/OFF\n").empty());
  EXPECT_EQ(names_assumed("ORIGIN/1,2,3\n"), std::vector<std::string>{"ORIGIN"});
  EXPECT_TRUE(names_assumed("MSYS/0,0,5,1,0,0,0,1,0\nMSYS/0,0,5,1,0,0,0,1,0\n").empty());
  EXPECT_EQ(names_assumed("MSYS/0,0,5,1,0,0,0,1,0\nMSYS/0,0,6,1,0,0,0,1,0\n"),
            std::vector<std::string>{"MSYS"});
}

TEST(CldataOfCam, ATiltedToolWithoutACallIsTheJobs) {
  EXPECT_EQ(names_assumed("RAPID\nGOTO/149.94,11,.22,0,1,0\nRAPID\nGOTO/1,2,3\n"),
            std::vector<std::string>{"LOADTL"});
  EXPECT_TRUE(names_assumed("RAPID\nGOTO/149.94,11,.22,0,0,1\n").empty());
}

TEST(CldataOfCam, NxCountsTheTurnsThatAHelixStarts) {
  const std::string helix =
      "LOADTL/1\nFEDRAT/5\nGOTO/5,0,0\n"
      "CIRCLE/0,0,-6,0,0,-1,5,.06,.5,12,1,TIMES,3\nGOTO/0,5,-6\n";
  EXPECT_EQ(last_of<ArcFeed>(run_cl(helix)).turns, 3);
  EXPECT_EQ(names_assumed(helix), std::vector<std::string>{"CIRCLE TIMES"});
}

// A lead-in as NX writes it: from the left down to the line along +X, the short way.
TEST(CldataOfCam, NxTurnsClockwiseAboutTheAxis) {
  const auto turns = [](const std::string& circle) {
    return last_of<ArcFeed>(
               run_cl("LOADTL/1\nFEDRAT/5\nGOTO/-7.5,23,70\n" + circle + "\nGOTO/5,10.5,70\n"))
        .turns;
  };
  EXPECT_EQ(turns("CIRCLE/5,23,70,0,0,-1,12.5,.06,.5,25,0"), 1);
  EXPECT_EQ(turns("CIRCLE/5,23,70,0,0,1,12.5,.06,.5,25,0"), -1);
  EXPECT_EQ(turns("CIRCLE/5,23,70,0,0,1,12.5"), 1);  // Creo
  EXPECT_EQ(turns("CIRCLE/5,23,70,0,0,1"), 1);       // SolidWorks CAM
}

// With four decimals a short arc of a large radius may end beside its start.
TEST(CldataOfCam, AnArcThatEndsJustAheadOfItsStartIsAStep) {
  const auto arc = [](const std::string& radius, const std::string& end) {
    return "LOADTL/1\nFEDRAT/5\nGOTO/0,-" + radius + ",0\nCIRCLE/0,0,0,0,0,1," + radius +
           ",.06,.5,30,0\nGOTO/" + end + ",-" + radius + ",0\n";
  };
  const auto path = run_cl(arc("100", "-.0001"));
  EXPECT_TRUE(all_of<ArcFeed>(path).empty());
  EXPECT_EQ(place_of(last_of<LinearFeed>(path).end), Vec3(-.0001, -100, 0));
  EXPECT_EQ(names_assumed(arc("100", "-.0001")), std::vector<std::string>{"CIRCLE step"});
  // Back to the start, or just behind it: nearly a full turn, or none.
  EXPECT_EQ(ids_of(arc("100", "0")), Ids{"arc-turns"});
  EXPECT_EQ(ids_of(arc("100", ".0001")), Ids{"arc-turns"});
  EXPECT_EQ(ids_of(arc("1", ".0001")), Ids{"arc-turns"});
}

// One part between knots is the curve of its four points: at the middle (0 + 3*2 + 3*4 + 6)/8 = 3
// along X, 3*(8 + 8)/8 = 6 along Y, 3*(4 + 0)/8 = 1.5 along Z.
TEST(CldataOfCam, NxSplinesAreCubicsFromWhereTheToolIs) {
  const std::string start = "LOADTL/1\nFEDRAT/5\nGOTO/0,0,0\nNURBS/\n";
  const auto path = run_cl(start + "KNOT/1.0\nCNTRL/2,8,4\nCNTRL/4,8,0\nCNTRL/6,0,0\nGOTO/9,0,0\n");
  const auto lines = all_of<LinearFeed>(path);
  ASSERT_GT(lines.size(), 100U);
  double nearest = 1.0;
  for (const LinearFeed& line : lines) {
    nearest = std::min(nearest, (place_of(line.end) - Vec3(3, 6, 1.5)).norm());
  }
  EXPECT_LT(nearest, 0.05);
  EXPECT_EQ(place_of(lines[lines.size() - 2].end), Vec3(6, 0, 0));
  EXPECT_EQ(place_of(lines.back().end), Vec3(9, 0, 0));
  EXPECT_EQ(names_assumed(start + "KNOT/1\nCNTRL/2,8,4\nCNTRL/4,8,0\nCNTRL/6,0,0\n"),
            std::vector<std::string>{"NURBS"});
}

// x = u^3 + 6u on knots 0 0 0 0 1 3 3 3 3 has the points f(0,0,1), f(0,1,3), f(1,3,3), f(3,3,3) of
// f(a,b,c) = abc + 2(a + b + c): 2, 8, 23, 45. Its part up to the knot 1 ends at 7.
TEST(CldataOfCam, KnotsOfNxSplinesDivideThem) {
  const auto lines = all_of<LinearFeed>(
      run_cl("LOADTL/1\nFEDRAT/5\nGOTO/0,0,0\nNURBS/\nKNOT/1,3\nCNTRL/2,0,0\nCNTRL/8,0,0\n"
             "PAINT/COLOR,3\nCNTRL/23,0,0\n$$ remark\nCNTRL/45,0,0\n"));
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const LinearFeed& line) {
    return (place_of(line.end) - Vec3(7, 0, 0)).norm() < 1e-12;
  }));
  EXPECT_EQ(place_of(lines.back().end), Vec3(45, 0, 0));
  // An even parameter: half of the way from the knot 1 to 3 is u = 2, x = 20.
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const LinearFeed& line) {
    return (place_of(line.end) - Vec3(20, 0, 0)).norm() < 0.2;
  }));
}

TEST(CldataOfCam, SplinesThatAreNotWholeAreRefused) {
  const std::string start = "LOADTL/1\nFEDRAT/5\nGOTO/0,0,0\nNURBS/\n";
  const std::string points = "CNTRL/1,0,0\nCNTRL/2,1,0\n";
  EXPECT_EQ(ids_of(start + "KNOT/1\n" + points + "GOTO/9,0,0\n"), Ids{"spline-open"});
  EXPECT_EQ(ids_of(start + "KNOT/1\n" + points + "FINI\n"), Ids{"spline-open"});
  EXPECT_EQ(ids_of(start + "KNOT/1\n" + points + "CNTRL/3,0,0\nCNTRL/4,0,0\n"),
            Ids{"spline-not-begun"});
  EXPECT_EQ(ids_of("KNOT/1\n"), Ids{"spline-not-begun"});
  EXPECT_EQ(ids_of("NURBS/\n"), Ids{"position-unknown"});
  for (const char* knots : {"KNOT/.5,.5\n", "KNOT/0,1\n", "KNOT/1,.5\n"}) {
    EXPECT_EQ(ids_of(start + knots), Ids{"spline-knots"}) << knots;
  }
  EXPECT_EQ(ids_of(start + "CNTRL/1,2,3\n"), Ids{"spline-knots"});
}

TEST(CldataOfCam, AMissingFeedIsAnAssumption) {
  const std::string path = "LOADTL/1\nRAPID\nGOTO/0,0,0\nGOTO/1,0,0\nGOTO/2,0,0\n";
  EXPECT_EQ(names_assumed(path), std::vector<std::string>{"FEDRAT"});
  EXPECT_EQ(last_of<LinearFeed>(run_cl(path)).feed.value, 1000.0);
  EXPECT_EQ(last_of<LinearFeed>(run_cl("UNITS/INCHES\n" + path)).feed.value, 1000.0);
  EXPECT_TRUE(names_assumed("FEDRAT/90\n" + path).empty());
}

TEST(CldataOfCam, CyclesHaveTheFeedInForce) {
  const std::string cycle = "CYCLE/TAP,   50.5,    1.0\nGOTO/0,0,0\n";
  const std::string start = "SPINDL/300,RPM,CLW\nLOADTL/1,1\nRAPID\nGOTO/0,0,1\n";
  const auto feed = [&](const std::string& before) {
    return all_of<LinearFeed>(run_cl(before + start + cycle)).front();
  };
  EXPECT_EQ(feed("FEDRAT/1.5,MMPR\n").feed.value, 1.5);
  EXPECT_EQ(feed("FEDRAT/1.5,MMPR\n").feed.mode, FeedMode::per_revolution);
  EXPECT_EQ(feed("").feed.value, 1000.0);
  EXPECT_EQ(*feed("").end[Z], -50.5);
  EXPECT_EQ(names_assumed(start + cycle), (std::vector<std::string>{"CYCLE", "CYCLE numbers"}));
  // NX: the hole ends at its place.
  EXPECT_EQ(*all_of<LinearFeed>(run_cl("CYCLE/DRILL,RAPTO,3.0000,FEDTO,0.0000,MMPM,250.0000\n"
                                       "GOTO/66,0,240,0,0,1\n"))
                 .front()
                 .end[Z],
            240.0);
  const auto taps = [&](const std::string& lead) {
    return all_of<LinearFeed>(
               run_cl(start + "CYCLE/TAP,DEPTH,9," + lead + ",CLEAR,2\nGOTO/0,0,0\n"))
        .front()
        .feed;
  };
  EXPECT_DOUBLE_EQ(taps("TPI,20").value, 1.27);
  EXPECT_EQ(taps("PITCH,1.25").mode, FeedMode::per_revolution);
}

TEST(CldataOfCam, DeepHolesWithoutAStepAreOnePeck) {
  const std::string hole =
      "LOADTL/1\nRAPID\nGOTO/0,0,9\n"
      "CYCLE/DRILL,DEEP,RAPTO,3.0,FEDTO,-10,MMPM,250\nGOTO/0,0,0\n";
  EXPECT_EQ(all_of<LinearFeed>(run_cl(hole)).size(), 1U);
  EXPECT_EQ(names_assumed(hole), std::vector<std::string>{"CYCLE STEP"});
}

TEST(CldataOfCam, OptionsOfCyclesAreEventsAndDwellsMayBeTurns) {
  EXPECT_EQ(ids_of("LOADTL/1\nCYCLE/BORE,NODRAG,ORIENT,45.0,RAPTO,3,FEDTO,-12,MMPM,100\n"), Ids{});
  const std::string start = "SPINDL/300,RPM,CLW\nLOADTL/1\nRAPID\nGOTO/0,0,9\n";
  const auto events = events_of(
      start + "CYCLE/DRILL,DEPTH,5,CAM,2,MMPM,9,CLEAR,3,DWELL,REV,10,ORIENT,90\nGOTO/0,0,0\n",
      EventGrade::known);
  EXPECT_NE(std::ranges::find(events, "CYCLE option|CAM,2,ORIENT,90"), events.end());
  EXPECT_DOUBLE_EQ(
      last_of<Dwell>(
          run_cl(start + "CYCLE/DRILL,DEPTH,5,MMPM,9,CLEAR,3,DWELL,REV,10\nGOTO/0,0,0\n"))
          .seconds,
      2.0);
  EXPECT_EQ(ids_of("CYCLE/DRILL,DEPTH,5,MMPM,9,CLEAR,3,DWELL,REV,10\n"),
            Ids{"dwell-without-speed"});
}

TEST(CldataOfCam, WordsOfPostProcessorsAreTheBuilders) {
  EXPECT_EQ(events_of("CSI_SET_FLUTE_LENGTH/20.\nSYSTEM/HIGH,ON,3\nWARMUP\n", EventGrade::builder),
            (std::vector<std::string>{"post word|CSI_SET_FLUTE_LENGTH/20.",
                                      "post word|SYSTEM/HIGH,ON,3", "post word|WARMUP"}));
  // What could move the tool, or is near a known word, is a mistake.
  for (const char* record :
       {"GOAROUND/1", "ROTPOS/5", "ANYWHERE/1,2,3", "SPINDLE/ON", "FEDRTA/5"}) {
    EXPECT_EQ(ids_of(std::string(record) + "\n"), Ids{"unknown-word"}) << record;
  }
}

TEST(CldataOfCam, BlocksThatAreInsertedAreRefused) {
  for (const char* text :
       {"/G0 Z-50", " G0Z-50", "/N10 G91 G28 Z0", "/X5.", "/M6", "/M8 Z5", "/T3", "/#100=5", "/M3",
        "/G1 Z[#5]", "/(UP) g53 z0", "/L Z+50 R0 FMAX", "/TRANS X5", "/CYCL DEF 7.0"}) {
    EXPECT_EQ(ids_of("INSERT" + std::string(text) + "\n"), Ids{"not-supported"}) << text;
  }
  for (const char* text : {"STOCK SIZE X40. Y20. Z4.", "[HOLDER=G40] 4MM MILL", "20MM X 60DEG",
                           "(G0 Z-50)", "; G0 Z-50", "GRIND 5", "M6X1 TAP"}) {
    EXPECT_EQ(events_of("INSERT/" + std::string(text) + "\n", EventGrade::known),
              std::vector<std::string>{"INSERT|" + std::string(text)});
  }
  EXPECT_EQ(events_of("INSERT/N5 M108\n", EventGrade::builder),
            std::vector<std::string>{"INSERT|N5 M108"});
}

TEST(CldataOfCam, SetModeIsMode) {
  EXPECT_EQ(ids_of("SET/MODE,INCR\n"), ids_of("MODE/INCR\n"));
  EXPECT_EQ(ids_of("SET/MODE,INCR\n"), Ids{"not-supported"});
  EXPECT_EQ(events_of("SET/MODE,ABSOL\nSET/OFSETL,3\n", EventGrade::known),
            (std::vector<std::string>{"MODE|ABSOL", "SET|OFSETL,3"}));
}

TEST(CldataOfCam, TurnsByNothingAreEvents) {
  EXPECT_EQ(events_of("ROTABL/    0.000000,,TABLE,CLW\n", EventGrade::known),
            std::vector<std::string>{"ROTABL|0.000000,,TABLE,CLW"});
  EXPECT_EQ(ids_of("ROTABL/30.0,AAXIS\n"), Ids{"not-supported"});
}

TEST(CldataOfCam, LathesErosionAndAptSourcesAreRefusedOnce) {
  for (const char* record : {"TOOLNO/1,TURN,1,0,3,0.4", "TURRET/1,OSETNO,1", "TLDATA/TURN,STANDARD",
                             "MODE/TURN", "CYCLE/TURN,DEPTH,3"}) {
    EXPECT_EQ(ids_of(std::string(record) + "\nGOTO/1,2\nSPINDL/500,SFM,CLW\n" + record + "\n"),
              Ids{"not-milling"})
        << record;
  }
  EXPECT_EQ(ids_of("P1 = POINT/1,2,3\nL1 = LINE/P1,P2\nGO/TO,L1\n"), Ids{"not-supported"});
  EXPECT_EQ(ids_of("M1=MACRO/A\nTERMAC\n"), Ids{"not-supported"});
  EXPECT_TRUE(ids_of("TOOLNO/1,MILL,1\nMODE/MILL\nPPRINT TURN THE PART\n").empty());
}

TEST(CldataOfCam, DelaysAndCoolantsInOtherForms) {
  EXPECT_DOUBLE_EQ(last_of<Dwell>(run_cl("SPINDL/60,CLW\nDELAY/REV,3\n")).seconds, 3.0);
  EXPECT_DOUBLE_EQ(last_of<Dwell>(run_cl("DELAY/SEC,4\n")).seconds, 4.0);
  EXPECT_TRUE(ids_of("COOLNT/\nCOOLNT/THROUGH\nRAPID/\n").empty());
  EXPECT_EQ(ids_of("DELAY/3,4\n"), Ids{"value-missing"});
  EXPECT_EQ(events_of("COOLNT/OIL,HIGH\nLOAD/HEAD,1\n", EventGrade::builder),
            (std::vector<std::string>{"COOLNT|OIL,HIGH", "post word|LOAD/HEAD,1"}));
}

TEST(CldataOfCam, SpindlesAndFeedsInOtherForms) {
  const auto spindle = [](const std::string& record) {
    return last_of<SpindleChange>(run_cl("SPINDL/100,CLW\n" + record + "\n"));
  };
  EXPECT_EQ(spindle("SPINDL/CCW,500,HIGH").direction, SpindleDirection::counterclockwise);
  EXPECT_EQ(spindle("SPINDL/CCW,500,HIGH").speed, 500.0);
  EXPECT_EQ(spindle("SPINDL/STOP").direction, SpindleDirection::off);
  EXPECT_EQ(spindle("SPINDL/ORIENT,90").direction, SpindleDirection::off);
  EXPECT_DOUBLE_EQ(
      last_of<LinearFeed>(run_cl("FEDRAT/2,FPM\nFEDRAT/INVERS,AUTO\nGOTO/1,2,3\n")).feed.value,
      609.6);
}

TEST(CldataOfCam, WhatRunsElsewhereIsRefused) {
  for (const char* record : {"DEFSUB/1", "IF/1", "JUMPTO/2", "READ/2,X", "DNTCUT", "TOOL/5"}) {
    EXPECT_EQ(ids_of(std::string(record) + "\n"), Ids{"not-supported"}) << record;
  }
  EXPECT_EQ(ids_of("RETRACT/10\n"), Ids{"unknown-word"});
}

// What the reader adds is not written, and is added again.
// The frame of a sequence, as a remark over three lines.
TEST(CldataOfCam, RemarksOfCreoGoOnWithNumbers) {
  const std::string remark =
      "$$-> CSYS / 1.0000000000, 0.0000000000, 0.0000000000, 0.0000000000,  $\n"
      "            0.0000000000, 1.0000000000, 0.0000000000, 0.0000000000,  $\n"
      "            0.0000000000, 0.0000000000, 1.0000000000, 0.0000000000\n";
  const auto all = run_cl("UNITS / MM\nLOADTL / 1\n" + remark +
                          "RAPID\nGOTO / 1.0, 2.0, 3.0\n$$-> SETSTART / 0.0, $\n 0.0\n"
                          "RAPID\nGOTO / 4.0, 5.0, 6.0\n");
  const auto moves = all_of<Traverse>(all);
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(place_of(moves[0].end), Vec3(1, 2, 3));
  EXPECT_EQ(place_of(moves[1].end), Vec3(4, 5, 6));
  // Further places of Creo are no remarks.
  const auto places = all_of<LinearFeed>(run_cl("FEDRAT/100,MMPM\nGOTO/1,2,3\n4,5,6\n"));
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(place_of(places[1].end), Vec3(4, 5, 6));
  EXPECT_FALSE(ids_of("$$ REMARK\n1.0, 2.0\n").empty());
}

TEST(CldataOfCam, StepsThatDifferFromPeckToPeckAreRefused) {
  const auto bottoms = [](const std::string& cycle) {
    std::vector<double> depths;
    for (const LinearFeed& feed :
         all_of<LinearFeed>(run_cl("LOADTL/1\nRAPID\nGOTO/0,0,50\n" + cycle + "\nGOTO/0,0,0\n"))) {
      depths.push_back(*feed.end[Z]);
    }
    return depths;
  };
  using Depths = std::vector<double>;
  // From the clearance of 3 down.
  EXPECT_EQ(bottoms("CYCLE/DRILL,DEEP,STEP,5,5,RAPTO,3,FEDTO,-9,MMPM,100"), (Depths{-2, -7, -9}));
  EXPECT_EQ(bottoms("CYCLE/DEEP,9,INCR,5,100,MMPM,3"), (Depths{-2, -7, -9}));
  for (const char* cycle : {"CYCLE/DRILL,DEEP,STEP,5,2,1,RAPTO,3,FEDTO,-9,MMPM,100",
                            "CYCLE/BRKCHP,DEPTH,9,STEP,5,2,MMPM,100,CLEAR,3"}) {
    EXPECT_EQ(ids_of(std::string("LOADTL/1\n") + cycle + "\nGOTO/0,0,0\n"), Ids{"not-supported"})
        << cycle;
  }
}

TEST(CldataOfCam, TheFrameOfAMachiningSetupIsThatOfThePart) {
  EXPECT_EQ(ids_of("MCS/1, 0, 0, $\n0, 1, 0, $\n0, 0, 1, $\n0, 0, 0\n"), Ids{});
  EXPECT_EQ(ids_of("MCS/0,1,0,-1,0,0,0,0,1,0,0,0\n"), Ids{"not-supported"});
  EXPECT_EQ(ids_of("MCS/1,0,0,0,1,0,0,0,1,0,0,5\n"), Ids{"not-supported"});
}

TEST(CldataOfCam, IsReadBackAsItWasRead) {
  const std::string text =
      "CYCLE/TAP,5,1\nCYCLE/DEEP,DEPTH,5,CLEAR,1\nCYCLE/OFF\nGOTO/1,2,3\n" + std::string(kTilted) +
      "CIRCLE/100,0,-3,1,0,0\nGOTO/100,-5,-3,1,0,0\nCIRCLE/100,-5,0,0,-.6,.8\nGOTO/103,-5,0\n"
      "CIRCLE/98,-5,0,0,0,-1,5,.06,.5,12,1,TIMES,2\nGOTO/98,0,-1\n"
      "NURBS/\nKNOT/.25,1\nCNTRL/98,1,0\nCNTRL/97,2.5,.3\nCNTRL/90,2,1\nCNTRL/85,.7,2\n"
      "CYCLE/INIT\nCYCLE/DEEP2,FEDTO,9,1STPECK,5,SUBPECK,2,MMPM,154,RAPTO,3,RTRCTO,25\n"
      "CYCLE/TAP,5,CAM,2,1\nCUTCOM/LEFT\nORIGIN/1,2,3\nWARMUP/7\nCYCLE/OFF\n";
  const auto program = parse_program(text, "part.apt", Dialect::cldata);
  ASSERT_TRUE(program);
  const auto before = blocks_of(*program);
  const std::string written = to_text(before, Dialect::cldata);
  const auto again = parse_program(written, "part.apt", Dialect::cldata);
  ASSERT_TRUE(again) << written;
  const auto after = blocks_of(*again);
  ASSERT_EQ(before.size(), after.size()) << written;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(same_block(before[i], after[i])) << i << "\n" << written;
  }
}

}  // namespace
}  // namespace frustum::parser
