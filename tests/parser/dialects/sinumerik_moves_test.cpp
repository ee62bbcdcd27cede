// Moves of Sinumerik beside the plain ones: ends by an angle, taps block by block, axes that go to
// reference points or by themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_moves(std::string_view text) {
  return motions(text, {}, Dialect::sinumerik);
}

std::vector<std::string> ids_of_moves(std::string_view text) {
  return complaint_ids(text, {}, Dialect::sinumerik);
}

ArcFeed arc_from_origin(const std::string& arc) {
  return last_of<ArcFeed>(run_moves("G1 X0 Y0 Z0 F100\n" + arc));
}

TEST(SinumerikAngles, OpenArcsAboutTheirCentre) {
  const ArcFeed arc = arc_from_origin("G3 AR=90 I10 J0 Z-1\n");
  EXPECT_NEAR(*arc.end[X], 10.0, 1e-12);
  EXPECT_NEAR(*arc.end[Y], -10.0, 1e-12);
  EXPECT_EQ(arc.end[Z], -1.0);
  const ArcFeed back = arc_from_origin("G2 AR=270 I=AC(10) J=AC(0) TURN=1\n");
  EXPECT_NEAR(*back.end[X], 10.0, 1e-12);
  EXPECT_NEAR(*back.end[Y], -10.0, 1e-12);
  EXPECT_EQ(back.turns, -2);
}

TEST(SinumerikAngles, ComplaintsNameWhatIsWritten) {
  const auto complaint = [](const std::string& text) {
    const auto lines = complaints("G1 X30 Y0 Z0 F100\n" + text, {}, Dialect::sinumerik);
    return lines.empty() ? "" : lines.front().substr(0, lines.front().find(" (hint"));
  };
  EXPECT_EQ(complaint("G3 X30 AR=90\n"),
            "2:8: error: an arc with AR=90 ends at its start, which leaves its centre open");
  EXPECT_EQ(complaint("G3 X20 CR=0\n"), "2:8: error: CR is zero");
  EXPECT_EQ(complaint("G3 X20 CR=2\n"),
            "2:8: error: CR 2 mm is too small: the end is 10 mm from the start");
}

TEST(SinumerikAngles, OpenArcsToTheirEnd) {
  const ArcFeed half = arc_from_origin("G2 X20 Y0 AR=180\n");
  EXPECT_NEAR(half.center[0], 10.0, 1e-9);
  EXPECT_NEAR(half.center[1], 0.0, 1e-6);
  const ArcFeed wide = arc_from_origin("G3 X10 Y10 AR=270\n");
  EXPECT_NEAR(wide.center[0], 10.0, 1e-9);
  EXPECT_NEAR(wide.center[1], 0.0, 1e-9);
  const ArcFeed narrow = arc_from_origin("G3 X10 Y10 AR=90\n");
  EXPECT_NEAR(narrow.center[0], 0.0, 1e-9);
  EXPECT_NEAR(narrow.center[1], 10.0, 1e-9);
}

TEST(SinumerikAngles, LeadALineToItsCoordinate) {
  const auto end = [](const std::string& line) {
    return last_of<LinearFeed>(run_moves("G1 X1 Y2 Z3 F100\n" + line)).end;
  };
  EXPECT_NEAR(*end("ANG=45 X11\n")[Y], 12.0, 1e-12);
  EXPECT_NEAR(*end("Y-8 ANG=-135\n")[X], -9.0, 1e-12);
  EXPECT_NEAR(*end("Y5 ANG=90\n")[X], 1.0, 1e-12);
  // From Z, the first axis of G18, towards X.
  EXPECT_NEAR(*end("G18 Z13 ANG=45\n")[X], 11.0, 1e-12);
}

TEST(SinumerikAngles, ReportMistakes) {
  const auto ids = [](const std::string& block) {
    return ids_of_moves("G1 X0 Y0 Z0 F100\n" + block + "\n").at(0);
  };
  EXPECT_EQ(ids("G3 AR=90 Z5"), "word-ambiguous");
  EXPECT_EQ(ids("G3 AR=90 X5 Y5 I5 J0"), "word-ambiguous");
  EXPECT_EQ(ids("G3 AR=90 X5 CR=5"), "word-ambiguous");
  EXPECT_EQ(ids("G3 AR=360 I5 J0"), "out-of-range");
  EXPECT_EQ(ids("G1 AR=90 X5"), "word-unused");
  EXPECT_EQ(ids("ANG=30 X5 Y5"), "word-ambiguous");
  EXPECT_EQ(ids("ANG=30 Z5"), "word-ambiguous");
  EXPECT_EQ(ids("ANG=90 X5"), "line-misses");
  EXPECT_EQ(ids("ANG=135 X5"), "line-misses");
  EXPECT_EQ(ids("G2 ANG=30 X5 CR=9"), "word-unused");
}

TEST(SinumerikTaps, GoInAndOutBlockByBlock) {
  const auto taps = run_moves("S500 M3\nG0 X0 Y0 Z5\nSPOS=0\nG331 Z-10 K1.5\nG332 Z5 K1.5\n");
  const auto feeds = all_of<LinearFeed>(taps);
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_EQ(feeds[0].end[Z], -10.0);
  EXPECT_DOUBLE_EQ(feeds[0].feed.value, 1.5);
  EXPECT_EQ(feeds[0].feed.mode, FeedMode::per_revolution);
  EXPECT_TRUE(feeds[0].feed.synchronised);
  EXPECT_EQ(feeds[1].end[Z], 5.0);
  const auto turns = all_of<SpindleChange>(taps);
  ASSERT_EQ(turns.size(), 5U);
  EXPECT_EQ(turns[1].direction, SpindleDirection::clockwise);
  EXPECT_EQ(turns[2].direction, SpindleDirection::off);
  EXPECT_EQ(turns[3].direction, SpindleDirection::counterclockwise);
  EXPECT_EQ(turns[4].direction, SpindleDirection::off);
  const auto left = all_of<SpindleChange>(run_moves("S500\nG0 Z5\nG331 Z-10 K-1.5\n"));
  EXPECT_EQ(left.at(left.size() - 2).direction, SpindleDirection::counterclockwise);
  EXPECT_EQ(ids_of_moves("S500\nG0 Z5\nG331 Z-10\n"), std::vector<std::string>{"thread-lead"});
  EXPECT_EQ(ids_of_moves("G0 Z5\nG331 Z-10 K1\n"), std::vector<std::string>{"cycle-speed-missing"});
}

TEST(SinumerikTaps, OfAFloatingChuckAreLinesOfTheirBlock) {
  const auto moves = run_moves("S200 M3\nG0 X0 Y0 Z5\nG63 Z-10 F300\nG63 Z5 M4\nX9\n");
  const auto feeds = all_of<LinearFeed>(moves);
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_EQ(feeds[0].end[Z], -10.0);
  EXPECT_EQ(feeds[0].feed.value, 300.0);
  EXPECT_EQ(feeds[1].end[Z], 5.0);
  EXPECT_EQ(last_of<Traverse>(moves).end[X], 9.0);
  EXPECT_EQ(ids_of_moves("G63 F300\n"), std::vector<std::string>{"axes-missing"});
}

TEST(SinumerikPoints, AreGoneToStraight) {
  const auto moves = run_moves("G0 X1 Y2 Z3\nG74 X1=0 Z1=0\nG90 G0 X5\nG75 FP=2 Y0\n");
  const auto homes = all_of<HomeReturn>(moves);
  ASSERT_EQ(homes.size(), 2U);
  EXPECT_EQ(homes[0].axes, (std::array{true, false, true, false, false, false}));
  EXPECT_EQ(homes[1].axes, (std::array{false, true, false, false, false, false}));
  // No way over the words.
  EXPECT_EQ(all_of<Traverse>(moves).size(), 2U);
  EXPECT_EQ(ids_of_moves("G74\n"), std::vector<std::string>{"axes-missing"});
  for (const auto& [home, named] :
       {std::pair("G74 X1=0", "G74"), std::pair("G75 X1=0", "G75"),
        std::pair("G0 SUPA X5", "the move in machine coordinates (SUPA)")}) {
    const auto lines =
        complaints("G0 X1\n" + std::string(home) + "\nG91 G0 Y1 X5\n", {}, Dialect::sinumerik);
    ASSERT_EQ(lines.size(), 1U) << home;
    const std::string since = "X is not known since " + std::string(named) + " on line 2";
    EXPECT_NE(lines.front().find(since), std::string::npos) << lines.front();
  }
  EXPECT_EQ(ids_of_moves("G0 X1=5\n"), std::vector<std::string>{"not-supported"});
}

// A step by machine coordinates has no place that it counts from.
TEST(SinumerikPoints, OfTheMachineArePlaces) {
  EXPECT_EQ(ids_of_moves("G0 X5\nG0 SUPA X=IC(10)\n"),
            std::vector<std::string>{"machine-coordinates"});
  EXPECT_EQ(ids_of_moves("G91\nG0 SUPA X10\n"), std::vector<std::string>{"machine-coordinates"});
  const auto absolute = run_moves("G91\nG0 G153 X=AC(10)\n");
  EXPECT_EQ(last_of<Traverse>(absolute).end[X], 10.0);
  EXPECT_EQ(last_of<Traverse>(absolute).coordinates, Coordinates::machine);
  EXPECT_EQ(all_of<Event>(run_moves("SUPA\n")).at(0).name, "SUPA");
}

// Reserved words are no variables of the machine.
TEST(SinumerikWordsOfTheControl, ThatWouldMoveTheToolAreRefused) {
  using Ids = std::vector<std::string>;
  for (const char* text :
       {"PHI=1",      "PSI=1",     "NUT=1",   "XH=1",   "PO[X]=1",       "PL=1",
        "PW=2",       "SD=3",      "SPN=2",   "SPP=2",  "ISD=1",         "DISRP=1",
        "OS[X]=1",    "OSP1[X]=1", "SR[X]=1", "CPON=1", "CPLNUM[X,Y]=1", "FOC[X]=1",
        "MEASA[X]=1", "PTP",       "PTPG0",   "SON",    "TRAILON(X,Y)",  "COUPON(S2,S1)",
        "REPOSA",     "ORIPATH",   "MOVT=5",  "TCOFR",  "TOFRAMEX",      "CUTCONON",
        "OST1[X]=1"}) {
    EXPECT_EQ(ids_of_moves(std::string(text) + "\n"), Ids{"not-supported"}) << text;
  }
  for (const char* text : {"MCALL HOLE", "G41 G147 X5", "G148", "G247", "G248", "G347", "G348",
                           "G340", "G341", "G140", "G143"}) {
    const auto lines = complaints(std::string(text) + "\n", {}, Dialect::sinumerik);
    ASSERT_EQ(lines.size(), 1U) << text;
    EXPECT_NE(lines.front().find(" is not simulated"), std::string::npos) << lines.front();
  }
}

// They were calls of subprograms that there are not.
TEST(SinumerikProcedures, ThatWouldMoveTheToolAreRefusedByName) {
  for (const char* text : {"PRESETON(X,5)", "TOFFON(Z,5)", "EGON(Y,\"FINE\",X,1,1)",
                           "ORIRESET(0,0)", "CONTPRON(TABLE,\"A\",1)", "EXECSTRING(\"G0 X5\")",
                           "TCA(\"DRILL\")", "PUTFTOC(1,5,1,1)", "AXCTSWE(CT1)"}) {
    const std::string name = std::string(text).substr(0, std::string(text).find('('));
    const auto lines = complaints(std::string(text) + "\n", {}, Dialect::sinumerik);
    ASSERT_EQ(lines.size(), 1U) << text;
    EXPECT_NE(lines.front().find(name + " is not simulated"), std::string::npos) << lines.front();
  }
  // No label, and no call.
  EXPECT_EQ(ids_of_moves(":L1\nM17\n"), std::vector<std::string>{"statement-not-alone"});
}

TEST(SinumerikProcedures, ThatMoveNothingAreEvents) {
  for (const char* text :
       {"GET(X)",     "GETD(X)",           "RELEASE(X,Y)", "MASLON(X)",        "MASLOF(X)",
        "WAITP(X)",   "TOFFOF(Z)",         "SOFTA(X,Y)",   "BRISKA(X)",        "DRIVEA(X)",
        "JERKA(X)",   "SPLINEPATH(1,X,Y)", "DRFOF",        "CPROT(1,2,0,0,0)", "COARSEA[X]=1",
        "COARSEA(X)", "CTOLG0=0.1",        "TOWSTD",       "FENDNORM",         "BNAT"}) {
    const auto events = all_of<Event>(run_moves(std::string(text) + "\n"));
    ASSERT_EQ(events.size(), 1U) << text;
    EXPECT_EQ(events.front().grade, EventGrade::known) << text;
  }
}

// The pose of the joints is looked at in PTP alone.
TEST(SinumerikWordsOfTheControl, ThatMoveNothingAreEvents) {
  for (const char* text : {"STAT=1", "TU='B10'", "TU=3", "FA[X]=100", "VELOLIMA[X]=50",
                           "SCPARA[X]=2", "SPN=0", "CP"}) {
    const auto events = all_of<Event>(run_moves(std::string(text) + "\n"));
    ASSERT_EQ(events.size(), 1U) << text;
    EXPECT_EQ(events.front().grade, EventGrade::known) << text;
  }
  for (const char* text : {"POLF[X]=5", "POLFMASK(X,Z)", "POLFA(X,1,5)", "DILF=2", "ALF=1"}) {
    const auto events = all_of<Event>(run_moves(std::string(text) + "\n"));
    ASSERT_EQ(events.size(), 1U) << text;
    EXPECT_EQ(events.front().grade, EventGrade::assumed) << text;
  }
}

TEST(SinumerikAxes, GoByThemselvesByRapid) {
  const auto moves = run_moves("G1 X0 Y0 F100\nPOS[Z]=50 POS[C]=DC(90)\nX7\n");
  const auto rapid = last_of<Traverse>(moves);
  EXPECT_EQ(rapid.end[Z], 50.0);
  EXPECT_NEAR(*rapid.end[C], 90.0 * kRadPerDeg, 1e-12);
  EXPECT_EQ(last_of<LinearFeed>(moves).end[X], 7.0);
  EXPECT_EQ(all_of<Event>(moves).at(0).grade, EventGrade::assumed);
  EXPECT_EQ(ids_of_moves("G1 F100 X5 POS[Z]=5\n"), std::vector<std::string>{"word-ambiguous"});
  EXPECT_EQ(ids_of_moves("POS[Q]=5\n"), std::vector<std::string>{"not-supported"});
}

}  // namespace
}  // namespace frustum::parser
