// Words as mills in the manner of Fanuc are programmed in the world: what stands alone, what is
// idle, what only the builder of the machine knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "parser/writing/block_text.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

// The names of events of one grade, in order.
std::vector<std::string> graded(const std::vector<Motion>& all, EventGrade grade) {
  std::vector<std::string> names;
  for (const Event& event : all_of<Event>(all)) {
    if (event.grade == grade) names.push_back(event.name + "|" + event.text);
  }
  return names;
}
std::vector<std::string> assumed(const std::vector<Motion>& all) {
  std::vector<std::string> names;
  for (const std::string& text : graded(all, EventGrade::assumed)) {
    names.push_back(text.substr(0, text.find('|')));
  }
  return names;
}
using Names = std::vector<std::string>;

TEST(FanucWords, Fault2_06_LengthNumberZeroIsNoLength) {
  const auto change = last_of<CompensationChange>(motions("G0 Z50\nG43 Z10 H0\n"));
  EXPECT_EQ(change.mode, LengthCompensation::length);
  EXPECT_EQ(change.length, 0.0);
  EXPECT_EQ(last_of<Traverse>(motions("G0 Z50\nG43 Z10 H0\nG91 Z1\n")).end[Z], 11.0);
}

TEST(FanucWords, Fault2_06_LengthNumberStandsAloneWhileTheLengthIsOn) {
  const auto all = motions("G0 G43 Z10 H1\nZ20 H2\nH00\nZ5\n");
  const auto changes = all_of<CompensationChange>(all);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[1].offset_number, 2);
  EXPECT_FALSE(changes[1].length);
  EXPECT_EQ(changes[2].offset_number, 0);
  EXPECT_EQ(changes[2].length, 0.0);
  // Without G43 it waits for the next one.
  const auto later = all_of<CompensationChange>(motions("G0 Z0\nH7\nG43 Z10\n"));
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later[0].offset_number, 7);
}

TEST(FanucWords, Fault2_06_HomeMayHaveALengthNumberBesideIt) {
  const auto all = motions("G0 G43 Z10 H1\nG91 G28 Z0 H0\n");
  EXPECT_EQ(last_of<CompensationChange>(all).offset_number, 0);
  EXPECT_EQ(all_of<HomeReturn>(all).size(), 1U);
}

TEST(FanucWords, Fault2_06_RadiusNumberStandsAlone) {
  InterpreterOptions options;
  options.tools[3].diameter = 10.0;
  const auto all = motions("G0 X0 Y0\nD3\nG41 G1 X10 F100\nY20\nG40 X0\n", options);
  const auto events = all_of<Event>(all);
  EXPECT_TRUE(std::ranges::any_of(
      events, [](const Event& event) { return event.text == "left of the contour, radius 5 mm"; }));
}

TEST(FanucWords, Fault2_06_MachineCoordinatesWithoutAxesMoveNothing) {
  const auto all = motions("G0 X5\nG53\nX6\n");
  ASSERT_EQ(all_of<Traverse>(all).size(), 2U);
  EXPECT_EQ(last_of<Traverse>(all).end[X], 6.0);
}

TEST(FanucWords, Fault2_06_LastMotionWordOfABlockCounts) {
  EXPECT_TRUE(all_of<Traverse>(motions("G0 G1 X10 F100\n")).empty());
  EXPECT_EQ(all_of<LinearFeed>(motions("G0 G1 X10 F100\n")).size(), 1U);
  EXPECT_EQ(complaint_ids("G0 G1 X10 F100\n", {}, Dialect::linuxcnc), Names{"word-twice"});
}

TEST(FanucWords, Fault2_06_RadiusGoesBeforeTheCentre) {
  const auto arc = last_of<ArcFeed>(motions("G0 X0 Y0\nG2 X10 Y0 R5 I77 J3 F100\n"));
  EXPECT_NEAR(arc.center.x(), 5.0, 1e-12);
}

TEST(FanucWords, Fault2_06_ReturnOfTheMainProgramEndsIt) {
  const auto all = motions("G0 X5\nM99\n");
  EXPECT_EQ(last_of<Stop>(all).kind, StopKind::program_end);
  EXPECT_EQ(last_of<Event>(all).name, "M99");
}

TEST(FanucWords, Fault2_06_ArcWithoutCentreIsAStraightMove) {
  const auto all = motions("G0 X0 Y0\nG2 X10 F100\n");
  EXPECT_EQ(last_of<LinearFeed>(all).end[X], 10.0);
  EXPECT_EQ(assumed(all), Names{"arc without centre"});
}

TEST(FanucWords, Fault2_06_MovesBeforeTheFirstMotionWordAreRapid) {
  const auto all = motions("G90 G54 X1 Y2\nG43 Z10 H1\nG1 Z5 F100\n");
  EXPECT_EQ(all_of<Traverse>(all).size(), 2U);
  EXPECT_EQ(assumed(all), Names{"first motion"});
  EXPECT_TRUE(assumed(motions("G90 G54\nG43 H1\nG0 X1\n")).empty());
}

TEST(FanucWords, Fault2_07_LocalShiftIsApartFromThatOfG92) {
  const auto x = [](const char* text) {
    InterpreterOptions options;
    options.work_offsets[1].origin[X] = 0.0;
    const auto rapids = all_of<Traverse>(motions(text, options));
    return rapids.empty() ? -1.0 : rapids.back().end[X].value_or(-1.0);
  };
  EXPECT_EQ(x("G0 X0\nG92 X10\nG52 X5\nX0\n"), -5.0);
  EXPECT_EQ(x("G0 X0\nG92 X10\nG52 X5\nG52 X0\nX0\n"), -10.0);
  EXPECT_EQ(x("G0 X0\nG52 X5\nG52 X7\nX0\n"), 7.0);
  // G92 takes the local shift of its axes into its own.
  EXPECT_EQ(x("G52 X5\nG0 X0\nG92 X1\nG52 X0\nX0\n"), 4.0);
  // LinuxCNC has one shift for both.
  const auto rapids =
      all_of<Traverse>(motions("G0 X0\nG92 X10\nG52 X5\nX0\n", {}, Dialect::linuxcnc));
  EXPECT_EQ(rapids.back().end[X], 5.0);
}

TEST(FanucWords, Fault2_07_PresetEndsTheShiftOfItsAxes) {
  const auto rapids =
      all_of<Traverse>(motions("G0 X0 Y0\nG92 X10 Y20\nG92.1 X0\nX1 Y1\nG92.1\nX1 Y1\n"));
  ASSERT_EQ(rapids.size(), 3U);
  EXPECT_EQ(rapids[1].end[X], 1.0);
  EXPECT_EQ(rapids[1].end[Y], -19.0);
  EXPECT_EQ(rapids[2].end[Y], 1.0);
  EXPECT_EQ(complaint_ids("G0 X0\nG92.1 X5\n"), Names{"out-of-range"});
}

TEST(FanucWords, Fault2_08_NumbersWithoutAPointCountAsTheControlIsSet) {
  const char* text = "G20 G0 X0019685 Y1. C0\nG21 G1 X1500 Y2.5 C90000 F200\nG4 X1500\nG4 P500\n";
  InterpreterOptions options;
  options.control.decimal_point = DecimalPoint::increment;
  const auto all = motions(text, options);
  const Traverse rapid = last_of<Traverse>(all);
  EXPECT_NEAR(*rapid.end[X], 1.9685 * 25.4, 1e-9);
  EXPECT_NEAR(*rapid.end[Y], 25.4, 1e-12);
  const LinearFeed feed = last_of<LinearFeed>(all);
  EXPECT_NEAR(*feed.end[X], 1.5, 1e-12);
  EXPECT_NEAR(*feed.end[C], 1.5707963267948966, 1e-12);
  EXPECT_EQ(feed.feed.value, 200.0);
  EXPECT_EQ(all_of<Dwell>(all).at(0).seconds, 1.5);
  EXPECT_EQ(all_of<Dwell>(all).at(1).seconds, 0.5);
  EXPECT_TRUE(assumed(all).empty());
}

TEST(FanucWords, Fault2_08_NumbersWithoutAPointAreToldWhereTheyMatter) {
  EXPECT_EQ(assumed(motions("G20 G0 X1.5 Y0\nX2\nY3\n")), Names{"decimal point"});
  EXPECT_EQ(assumed(motions("G21 G0 X20000\n")), Names{"decimal point"});
  EXPECT_TRUE(assumed(motions("G21 G0 X200\n")).empty());
  EXPECT_TRUE(assumed(motions("G20 G0 X1.5 Y0\n#1=5\nX#1\n")).empty());
}

TEST(FanucWords, Fault2_12_WordsOfTheBuilderBecomeEvents) {
  const auto all = motions("G0 X1\nM31\nM250 P3 Q1\nM202\nG1 X2 M81 F100\nG187 P1 E0.02\n");
  EXPECT_EQ(graded(all, EventGrade::builder), (Names{"M31|", "M250|P3 Q1", "M202|", "M81|"}));
  EXPECT_EQ(graded(all, EventGrade::known), Names{"G187|E0.02 P1"});
  // One that would move an axis stays an error, as does an unknown G word.
  EXPECT_EQ(complaint_ids("M31 X5\nG188\n").at(0), "unknown-word");
  EXPECT_EQ(complaint_ids("G188\n"), Names{"unknown-word"});
  EXPECT_EQ(complaint_ids("M198 P1\n"), Names{"not-simulated"});
}

TEST(FanucWords, Fault2_12_WordsThatTheMachineFileNamesAreKnown) {
  InterpreterOptions options;
  for (const char* word : {"M31", "g188", "M5.1"}) {
    const auto read = control_word(word);
    ASSERT_TRUE(read) << word;
    options.control.words.push_back(*read);
  }
  const auto all = motions("M31\nG188 P2\nM5.1\nM32\n", options);
  EXPECT_EQ(graded(all, EventGrade::known), (Names{"M31|", "G188|P2", "M5.1|"}));
  EXPECT_EQ(graded(all, EventGrade::builder), Names{"M32|"});
  for (const char* wrong : {"", "M", "X5", "M-3", "M3x", "M1e9"}) {
    EXPECT_FALSE(control_word(wrong)) << wrong;
  }
}

TEST(FanucWords, Fault2_13_TurnAboutZNeedsNoZ) {
  const auto all = motions("G0 X10 Y0\nG68 X0 Y0 R90\nX10 Y0\nG3 X0 Y10 R10 F100\n");
  const Traverse turned = last_of<Traverse>(all);
  EXPECT_NEAR(*turned.end[X], 0.0, 1e-12);
  EXPECT_NEAR(*turned.end[Y], 10.0, 1e-12);
  EXPECT_FALSE(turned.end[Z]);
  EXPECT_NEAR(*last_of<ArcFeed>(all).end[X], -10.0, 1e-9);
  EXPECT_EQ(complaint_ids("G0 X10\nG68 X0 Y0 R90\nX10\n"), Names{"position-unknown"});
}

TEST(FanucWords, Fault2_13_StepsGoOnFromMachineCoordinates) {
  const auto rapids =
      all_of<Traverse>(motions("G53 G0 X0 Y0 Z-5\nG91\nG0 X10\nG51.1 X0\nX1 Z2\nG90 X3\n"));
  ASSERT_EQ(rapids.size(), 4U);
  EXPECT_EQ(rapids[1].coordinates, Coordinates::machine);
  EXPECT_EQ(rapids[1].end[X], 10.0);
  EXPECT_FALSE(rapids[1].end[Y]);
  EXPECT_EQ(rapids[2].end[X], 9.0);
  EXPECT_EQ(rapids[2].end[Z], -3.0);
  EXPECT_EQ(rapids[3].coordinates, Coordinates::program);
}

TEST(FanucWords, Fault2_13_StepsBehindALengthGoOnFromTheLastWord) {
  const auto feeds = all_of<LinearFeed>(motions("G0 Z5\nG43 H1\nG91 G1 Z0.1 F100\nZ-1\n"));
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_NEAR(*feeds[0].end[Z], 5.1, 1e-12);
  EXPECT_NEAR(*feeds[1].end[Z], 4.1, 1e-12);
  // So they do where the length is known.
  InterpreterOptions options;
  options.tools[1].offset[2] = 50.0;
  options.tools[1].has_length = true;
  EXPECT_NEAR(*last_of<LinearFeed>(motions("G0 Z5\nG43 H1\nG91 G1 Z0.1 F100\n", options)).end[Z],
              5.1, 1e-12);
}

TEST(FanucWords, Fault2_13_StepsFromTheStartCountFromWhereItIsSaidToBe) {
  const auto all = motions("G91 G0 X10\nX5\n");
  EXPECT_EQ(last_of<Traverse>(all).end[X], 15.0);
  EXPECT_EQ(assumed(all), Names{"start"});
  InterpreterOptions options;
  options.start[X] = 100.0;
  const auto started = motions("G91 G0 X10\nX5\n", options);
  EXPECT_EQ(last_of<Traverse>(started).end[X], 115.0);
  EXPECT_TRUE(assumed(started).empty());
  const auto preset = motions("G92 X7\nG0 X9\n");
  EXPECT_EQ(last_of<Traverse>(preset).end[X], 9.0);
  EXPECT_EQ(assumed(preset), Names{"start"});
}

TEST(FanucWords, Fault2_15_FeedOfAMoveOfNoLengthIsConverted) {
  const auto feeds = all_of<LinearFeed>(motions("G20 G0 X1. Y0\nG1 X1. F24\n"));
  ASSERT_EQ(feeds.size(), 1U);
  EXPECT_NEAR(feeds[0].feed.value, 609.6, 1e-9);
  // A turn alone counts degrees.
  EXPECT_EQ(last_of<LinearFeed>(motions("G20 G0 X1. C0\nG1 C90 F24\n")).feed.value, 24.0);
}

TEST(FanucWords, CuttingMoveBeforeTheFirstFeedHasNone) {
  const auto all = motions("G0 X0\nG1 X5\nX6 F100\n");
  EXPECT_EQ(all_of<LinearFeed>(all).at(0).feed.value, 0.0);
  EXPECT_EQ(all_of<LinearFeed>(all).at(1).feed.value, 100.0);
  EXPECT_EQ(assumed(all), Names{"feed"});
  EXPECT_EQ(complaint_ids("G1 X5 F0\n"), Names{"feed-missing"});
  InterpreterOptions strict;
  strict.control.feed_before_first_word = false;
  EXPECT_EQ(complaint_ids("G1 X5\n", strict), Names{"feed-missing"});
  EXPECT_EQ(complaint_ids("G1 X5 F100\nG95 X6\n"), Names{"feed-missing"});
}

TEST(FanucWords, ZerosWithoutAMeaningAreIdle) {
  const auto all = motions("G0 X0 Y0 Z0\nG3 X10 Y0 I5 J0 K0 F100\nG1 X0 K0 R0\n");
  EXPECT_EQ(all_of<ArcFeed>(all).size(), 1U);
  EXPECT_EQ(assumed(all), Names{"idle words"});
  // A direction of the tool is not.
  EXPECT_EQ(complaint_ids("G0 X0 Y0 I0.5 K0.8\n"), Names{"word-unused"});
}

TEST(FanucWords, HomeWithoutAxesSendsAll) {
  const auto all = motions("G0 X5\nG28\nG30 P2\n");
  const auto homes = all_of<HomeReturn>(all);
  ASSERT_EQ(homes.size(), 2U);
  EXPECT_TRUE(std::ranges::all_of(homes[0].axes, [](bool goes) { return goes; }));
  EXPECT_EQ(assumed(all), Names{"home without axes"});
}

TEST(FanucWords, CycleWithoutRFeedsFromWhereTheToolIs) {
  const auto all = motions("G0 X0 Y0 Z5\nG81 X1 Z-3 F100\n");
  EXPECT_EQ(assumed(all), Names{"cycle without R"});
  EXPECT_EQ(last_of<Traverse>(all).end[Z], 5.0);
  EXPECT_EQ(last_of<LinearFeed>(all).end[Z], -3.0);
}

TEST(FanucWords, ContourWithARadiusOfTheSetupIsKeptAsItIs) {
  const auto all = motions("G0 X0 Y0\nG41 D2 G1 X10 F100\nY20\nG40 X0\n");
  EXPECT_EQ(assumed(all), Names{"cutter radius"});
  EXPECT_EQ(all_of<LinearFeed>(all).at(1).end[X], 10.0);
  // Where there are tools, one that is missing is a mistake.
  InterpreterOptions options;
  options.tools[3].diameter = 10.0;
  EXPECT_EQ(complaint_ids("G0 X0 Y0\nG41 D2 G1 X10 F100\n", options), Names{"radius-compensation"});
}

TEST(FanucWords, SignalsOfTheMachineAreOff) {
  const auto all = motions("IF [#1005 EQ 1] GOTO 9\n#1=#1032\nG0 X[5+#1]\nN9 M30\n");
  EXPECT_EQ(last_of<Traverse>(all).end[X], 5.0);
  EXPECT_EQ(assumed(all), Names{"signals"});
}

// What only the machine knows may be kept and passed on, as long as no move depends on it.
TEST(FanucWords, ValuesOfTheMachineAreKept) {
  const auto all = motions("#3001=0\n#500=#5021\n#1=#500+1\nG65 P9 A#3011\nM30\nO9\nG0 X1\nM99\n");
  EXPECT_EQ(last_of<Traverse>(all).end[X], 1.0);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "#3001");
}

TEST(FanucWords, LimitsOfTheMachineRaiseNoAlarm) {
  const auto all = motions("IF [#5405 GE 6000] THEN #3000=15 (TOOL LIFE EXPIRED)\nG0 X1\n");
  EXPECT_EQ(last_of<Traverse>(all).end[X], 1.0);
  EXPECT_EQ(assumed(all), Names{"alarm"});
}

TEST(FanucWords, ModesAreRead) {
  const auto x_of = [](std::string_view text) { return *last_of<Traverse>(motions(text)).end[X]; };
  EXPECT_EQ(x_of("G55\nG0 X#4012\n"), 55.0);
  EXPECT_EQ(assumed(motions("G55\nG0 X#4012\n")), Names{"#4012"});
  EXPECT_EQ(x_of("G55\nG0 X#4014\n"), 55.0);
  EXPECT_EQ(x_of("G54.1 P3\nG0 X#4130\n"), 3.0);
  EXPECT_EQ(x_of("#1=#4001\nG0 X[#1+1]\n"), 1.0);
  EXPECT_EQ(x_of("G1 F9 X0 Y0 Z9\nG81 Z1 R2\n#1=#4001\nG0 X#1\n"), 1.0);
  EXPECT_EQ(x_of("#1=#4007\nG0 X#1\n"), 40.0);
}

TEST(FanucWords, RadiusMayHaveItsNumberInH) {
  const auto all = motions("G21 T1 M6\nG0 X0 Y0\nG43 H3 Z9\nG1 G42 H19 Y10 F9\nX9\nG40 X20\n");
  EXPECT_EQ(all_of<CompensationChange>(all).size(), 1U);
  EXPECT_EQ(last_of<CompensationChange>(all).offset_number, 3);
  EXPECT_EQ(last_of<LinearFeed>(all).end[Z], 9.0);
}

TEST(FanucWords, StoredVariablesAreVacant) {
  EXPECT_EQ(assumed(motions("#1=#600\nG0 X[1+#1]\n")), Names{"stored variables"});
  EXPECT_TRUE(assumed(motions("#600=2\n#1=#600+#101\nG0 X#1\n")).empty());
  EXPECT_EQ(last_of<Traverse>(motions("#901001=2\nG0 X#901001\n")).end[X], 2.0);
}

// The block of a call that is read as the program runs goes when the call begins.
TEST(FanucWords, SignalsThatACallReadsAreToldBeforeIt) {
  const Program program{"part.nc", Dialect::fanuc,
                        ProgramText("G21 G0 X0\nG65 P9000 A#1000\nM30\nO9000\nG0 X[5+#1]\nM99\n")};
  const auto all = motions_of(program);
  ASSERT_TRUE(all);
  EXPECT_EQ(last_of<Traverse>(*all).end[X], 5.0);
  EXPECT_EQ(assumed(*all), Names{"signals"});
  ASSERT_EQ(all->size(), 4U);
  EXPECT_EQ(all->at(1).place.line, 2U);
}

TEST(FanucWords, ToolMayNameItsOffset) {
  const auto all = motions("T1.1 M6\n");
  EXPECT_EQ(last_of<ToolChange>(all).tool, 1);
  EXPECT_EQ(assumed(all), Names{"tool with offset"});
  EXPECT_EQ(complaint_ids("T1701.1302 M6\n"), Names{"not-whole"});
}

TEST(FanucWords, OffsetBehindTheToolIsInForce) {
  const auto offset_of = [](std::string_view text) {
    return last_of<CompensationChange>(motions(text)).offset_number;
  };
  EXPECT_EQ(offset_of("T3.3 M6\nG43 G0 Z10\n"), 3);
  EXPECT_EQ(offset_of("T5.2 M6\nG43 G0 Z10\n"), 2);
  EXPECT_EQ(offset_of("T10.10 M6\nG43 G0 Z10\n"), 10);
  EXPECT_EQ(offset_of("T11.11 M6\nG43 G0 Z10\n"), 11);
  EXPECT_EQ(last_of<ToolChange>(motions("T11.11 M6\n")).tool, 11);
  EXPECT_EQ(complaint_ids("T5.12 M6\n"), Names{"not-whole"});
}

TEST(FanucWords, BlockNumberWithoutDigitsIsPassedOver) {
  const auto all = motions("N G0 X5\nN X6\nNX7\n");
  EXPECT_EQ(*last_of<Traverse>(all).end[X], 7.0);
  EXPECT_EQ(all_of<Traverse>(all).size(), 3U);
  EXPECT_EQ(assumed(all), Names{"N"});
  EXPECT_EQ(complaint_ids("N-1 X5\n"), Names{"value-missing"});
  EXPECT_EQ(complaint_ids("N\n"), Names{"value-missing"});
}

TEST(FanucWords, UnitsByG70AndG71) {
  EXPECT_NEAR(*last_of<Traverse>(motions("G70 G0 X1.\n")).end[X], 25.4, 1e-12);
  EXPECT_EQ(*last_of<Traverse>(motions("G20\nG71\nG0 X1.\n")).end[X], 1.0);
}

TEST(FanucWords, CornersAreRoundedAndBroken) {
  const auto all = motions("G0 X0 Y0 Z0\nG1 X10 ,R2 F100\nY10 ,C3\nX0\nG0 Z5\nX1\n");
  const ArcFeed rounding = last_of<ArcFeed>(all);
  EXPECT_NEAR(rounding.center.x(), 8.0, 1e-9);
  EXPECT_NEAR(rounding.center.y(), 2.0, 1e-9);
  const auto cuts = all_of<LinearFeed>(all);
  ASSERT_EQ(cuts.size(), 4U);
  EXPECT_NEAR(*cuts[0].end[X], 8.0, 1e-9);
  EXPECT_NEAR(*cuts[1].end[Y], 7.0, 1e-9);
  EXPECT_NEAR(*cuts[2].end[X], 7.0, 1e-9);
  EXPECT_NEAR(*cuts[2].end[Y], 10.0, 1e-9);
  EXPECT_EQ(cuts[3].end[X], 0.0);
  EXPECT_EQ(last_of<Traverse>(all).end[X], 1.0);
  EXPECT_EQ(complaint_ids("G0 X0 Y0\nG1 X10 ,R2 F100\nM30\n"), Names{"corner-interrupted"});
  EXPECT_EQ(complaint_ids("G0 X0 Y0\nG1 X10 ,A2 F100\n"), Names{"unexpected-character"});
  EXPECT_EQ(complaint_ids("G0 X0 ,R2\n"), Names{"word-unused"});
}

TEST(FanucWords, CommentsMayHoldBracketsInPairs) {
  const auto events = all_of<Event>(motions("( HOLE AT (1.5, 2) ) G0 X1\n(OPEN ( ONE)\n"));
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, " HOLE AT (1.5, 2) ");
  EXPECT_EQ(events[1].text, "OPEN ( ONE");
}

TEST(FanucWords, TapeMarkMayNameTheProgram) {
  const auto all = motions("%00214\nG0 X1\n%\n");
  EXPECT_EQ(all_of<Event>(all).at(0).text, "00214");
  EXPECT_EQ(all_of<Traverse>(all).size(), 1U);
}

TEST(FanucWords, OutputMayHoldBrackets) {
  const auto events = all_of<Event>(motions("DPRNT[DATE*(AAMMDD):*#3011[60]]\n"));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "DATE*(AAMMDD):*#3011[60]");
}

TEST(FanucWords, ArePrintedAsTheyAreRead) {
  for (const char* line :
       {"G1 X10 ,R2", "Y5 ,C1.5", "%214", "(A (B) C)", "DPRNT[A(B)#1[53]]", "M250 P3", "H0"}) {
    const auto program = parse_program(std::string(line) + "\n", "part.nc");
    ASSERT_TRUE(program) << line;
    EXPECT_EQ(to_text(blocks_of(*program), Dialect::fanuc), std::string(line) + "\n");
  }
}

TEST(NotMilling, LatheProgramsAreRefusedWithOneSentence) {
  for (const char* text : {"G50 S2000\nG96 S200 M3\nT0101\nG0 X50. Z5.\n",
                           "T0101\nG0 X50 Z2\nG71 U2. R1.\nG71 P10 Q20 U0.5 W0.1 F0.3\n",
                           "T0202 M3 S500\nG0 X40 Z1\nG1 Z-20 F0.2\n"}) {
    EXPECT_EQ(complaint_ids(text), Names{"not-milling"}) << text;
  }
}

TEST(NotMilling, MillProgramsAreNot) {
  for (const char* text :
       {"G50\nS2000 M3\nG0 X1 Y1 Z1\n", "T0101 M6\nG0 X1 Z2\n", "T0101\nM6\nG0 X1 Y1 Z2\n",
        "G71\nG0 X1 Y1\n", "(G50 S2000)\nG0 X1\n", "G73 X1 Y1 Z-5 R2 Q1 F100\n"}) {
    const auto ids = complaint_ids(text);
    EXPECT_EQ(std::ranges::count(ids, "not-milling"), 0) << text;
  }
}

}  // namespace
}  // namespace frustum::parser
