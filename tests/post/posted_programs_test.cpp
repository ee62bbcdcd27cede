// Programs as people write them, posted for a control that counts tool lengths otherwise: they read
// back and move the tool alike.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parser/writing/motion_spelling.hpp"
#include "parser/writing/motion_writer.hpp"
#include "post/comparing/program_difference.hpp"
#include "post/planning/machine_program.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/parser/writing/read_back.hpp"

namespace frustum::post {
namespace {

using kinematics::Setup;
using kinematics::shipped;
using parser::Dialect;
using parser::first_of;
using parser::Motion;

// Tools of 100 mm and 120 mm.
Setup two_tools() {
  Setup setup;
  setup.work_offsets[1] = Vec3::Zero();
  setup.tools[1] = {100.0, 0.0, 20.0};
  setup.tools[2] = {120.0, 0.0, 20.0};
  return setup;
}

PlanOptions options_of(Dialect dialect) {
  PlanOptions options{.output = OutputForm::axes};
  if (dialect == Dialect::heidenhain) {
    options.arcs = ArcForm::flat;
    options.length = LengthForm::always_by_tool;
  } else if (dialect == Dialect::sinumerik) {
    options.length = LengthForm::by_tool;
  } else if (dialect == Dialect::linuxcnc) {
    options.zero_is_spindle = true;
  }
  return options;
}

// The text, or what is wrong.
std::string posted(const std::vector<Motion>& motions, Dialect to,
                   const Setup& setup = two_tools()) {
  const auto plan = plan_for_machine(shipped("three-axis"), setup, motions, options_of(to));
  if (!plan) return first_of(plan.error());
  const auto written = parser::write_nc(plan->motions, to, {.name = "P"});
  return written ? written->text : first_of(written.error());
}

bool has_line(const std::string& text, const std::string& line) {
  return text.find(" " + line + "\n") != std::string::npos ||
         text.find("\n" + line + "\n") != std::string::npos;
}

void expect_alike(const std::string& program, Dialect from) {
  const auto motions = motions_in(program, from);
  for (const Dialect to : parser::written_dialects()) {
    const std::string text = posted(motions, to);
    SCOPED_TRACE(text);
    const auto found = compare_programs(shipped("three-axis"), {"first", motions, two_tools()},
                                        {"second", motions_in(text, to), two_tools()});
    ASSERT_TRUE(found) << first_of(found.error());
    EXPECT_TRUE(found->same()) << found->first.likely_cause << " " << found->first.tip;
  }
}

// No move in X and Y asks for the length.
TEST(PostedPrograms, MoveInXAndYBeforeTheLengthIsOn) {
  const std::string program =
      "G21 G90 G54\nT1 M6\nS1000 M3\nG0 X10 Y20\nG43 H1 Z5\nG1 Z-1 F100\nX30\nG0 Z50\nM30\n";
  expect_alike(program, Dialect::linuxcnc);
  kinematics::Setup setup = two_tools();
  setup.tools.clear();
  const std::string text =
      posted(motions_in("G21 G90 G54\nT1 M6\nG0 X10 Y20\nM30\n", Dialect::linuxcnc),
             Dialect::heidenhain, setup);
  EXPECT_TRUE(has_line(text, "L X+10 Y+20 R0 FMAX")) << text;
}

// The spindle's end goes to Z50, so that the tip of 100 mm is at -50.
TEST(PostedPrograms, WithoutAnyLengthNameTheTipWhereItIsAlwaysOn) {
  const std::string program =
      "G21 G90 G54\nT1 M6\nS1000 M3\nG0 X10 Y20 Z60\nG1 Z50 F100\nX30\nM30\n";
  expect_alike(program, Dialect::linuxcnc);
  const std::string text = posted(motions_in(program, Dialect::linuxcnc), Dialect::heidenhain);
  EXPECT_TRUE(has_line(text, "L Z-50 F100")) << text;
  const std::string same = posted(motions_in(program, Dialect::linuxcnc), Dialect::sinumerik);
  EXPECT_TRUE(has_line(same, "G1 Z50 F100")) << same;
}

// Z5 with 100 mm counted is Z-15 with the 120 mm of tool 2.
TEST(PostedPrograms, KeepTheLengthOfAnotherToolInTheirPlaces) {
  const std::string program =
      "G21 G90 G54\nT1 M6\nS1000 M3\nG43 H1 G0 X0 Y0 Z5\nG1 Z-1 F100\nG0 Z5\nT2 M6\n"
      "S1000 M3\nG0 X40\nG1 X60\nG43 H2 G0 Z5\nG1 Z-2\nM30\n";
  expect_alike(program, Dialect::linuxcnc);
  for (const Dialect to : {Dialect::sinumerik, Dialect::heidenhain}) {
    const std::string text = posted(motions_in(program, Dialect::linuxcnc), to);
    EXPECT_NE(text.find("Z-15"), std::string::npos) << text;
  }
}

// The old Z would be a rapid askew to a height of the tool before.
TEST(PostedPrograms, StayUpAfterAToolChangeUntilZIsSaid) {
  const std::string head =
      "G21 G90 G54\nT1 M6\nS1000 M3\nG0 X10 Y10\nG43 H1 Z50\nG1 Z-1 F100\nG0 Z50\nT2 M6\n"
      "S1000 M3\nG0 X80 Y80\n";
  const std::string program = head + "G43 H2 Z50\nG1 Z-2\nM30\n";
  expect_alike(program, Dialect::fanuc);
  const auto text_of = [](const std::string& text) {
    return posted(motions_in(text, Dialect::fanuc), Dialect::fanuc);
  };
  EXPECT_NE(text_of(program).find("\nX80. Y80.\nG43 H2\nX80. Y80. Z50.\nG1 Z-2.\n"),
            std::string::npos)
      << text_of(program);
  const std::string said = text_of(head + "G43 H2 X90 Z40\nG1 Z0\nM30\n");
  EXPECT_NE(said.find("\nX80. Y80.\nG43 H2\nX90. Y80. Z40.\n"), std::string::npos) << said;
  // Where the change leaves Z the tool is fed from there.
  expect_alike(head + "G1 Z-2\nM30\n", Dialect::fanuc);
  expect_alike(head + "G43 H2\nG1 Z-2\nM30\n", Dialect::fanuc);
  const std::string fed = text_of(head + "G1 X90\nM30\n");
  EXPECT_NE(fed.find("\nX80. Y80.\nG43 H1\nG1 X90. Y80.\n"), std::string::npos) << fed;
}

// LinuxCNC leaves the axes where they were (NIST 6556, 3.6.3): Z50 with 100 mm is Z30 with 120 mm.
// The posted program comes down to it before the tool is fed, and not askew from Z's home.
TEST(PostedPrograms, ComeDownToWhereTheChangeOfTheOtherControlLeavesZ) {
  const std::string head =
      "G21 G90 G54\nT1 M6\nS1000 M3\nG0 X10 Y10\nG43 H1 Z50\nG1 Z-1 F100\nG0 Z50\nT2 M6\n"
      "S1000 M3\n";
  for (const char* rest : {"G1 X90\n", "G1 Z-1\n", "G0 X80\nG1 X90\n", "G91 G0 Z-20\nG1 X9\n",
                           "G43 H2\nG0 X80\nG1 X90\n", "G53 G1 X90\n"}) {
    expect_alike(head + rest + "M30\n", Dialect::linuxcnc);
  }
  const auto text_of = [&](const std::string& rest, Dialect to) {
    return posted(motions_in(head + rest + "M30\n", Dialect::linuxcnc), to);
  };
  const std::string fed = text_of("G1 X90\n", Dialect::fanuc);
  EXPECT_NE(fed.find("\nG43 H1\nZ50.\nG1 X90. Y10.\n"), std::string::npos) << fed;
  const std::string longer = text_of("G1 X90\n", Dialect::heidenhain);
  EXPECT_NE(longer.find("L Z+30 R0 FMAX\n"), std::string::npos) << longer;
  const std::string stepped = text_of("G91 G0 Z-20\n", Dialect::fanuc);
  EXPECT_NE(stepped.find("\nG43 H1\nX10. Y10. Z30.\n"), std::string::npos) << stepped;
}

// The hole is where it is said; Z is where the change leaves it.
TEST(PostedPrograms, GoToAHoleAtTheHeightOfTheToolChange) {
  const std::string program =
      "G21 G90 G54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z50\nG1 Z-1 F100\nX10\nT2 M6\n"
      "S1000 M3\nG43 H2\nG81 X33 Y30 Z-5 R2 F100\nX44\nG80\nM30\n";
  expect_alike(program, Dialect::fanuc);
  const std::string text = posted(motions_in(program, Dialect::fanuc), Dialect::fanuc);
  EXPECT_NE(text.find("\nX33. Y30.\nG43 H2\nX33. Y30. Z2.\nG1 Z-5.\nG0 Z2.\nX44.\n"),
            std::string::npos)
      << text;
}

// G43.4 and M428 are for programs that turn the tool or the work.
TEST(PostedPrograms, ControlTheTipWhereAnAxisTurns) {
  const auto text_of = [](const std::string& machine, const std::string& words) {
    const auto motions = motions_in(
        "G21 G90 G54\nT1 M6\nS1000 M3\n" + words + "G0 X10 Y20 Z60\nG1 Z50 F100\nX30\nM30\n",
        Dialect::fanuc);
    const auto plan = plan_for_machine(shipped(machine), two_tools(), motions, {});
    if (!plan) return first_of(plan.error());
    return write_nc(plan->motions, Dialect::fanuc)->text;
  };
  const std::string straight = text_of("iwf-bc", "G43 H1\n");
  EXPECT_NE(straight.find("G43 H1\nX10. Y20. Z60.\n"), std::string::npos) << straight;
  EXPECT_NE(text_of("three-axis", "G43.4 H1\n").find("G43 H1\nX10. Y20. Z60.\n"),
            std::string::npos);
  for (const char* words : {"G43.4 H1\n", "G43 H1 B0.\n"}) {
    EXPECT_NE(text_of("iwf-bc", words).find("G43.4 H1\n"), std::string::npos) << words;
  }
}

// A length with nothing in the spindle is in the places: 5 + 100.
TEST(PostedPrograms, HaveNoLengthWithAnEmptySpindle) {
  const std::string program = "G21 G90 G54\nG43 H1 G0 X0 Y0 Z5\nG1 Z-1 F100\nX10\nM30\n";
  expect_alike(program, Dialect::linuxcnc);
  const std::string text = posted(motions_in(program, Dialect::linuxcnc), Dialect::heidenhain);
  EXPECT_NE(text.find("Z+105"), std::string::npos) << text;
}

// Whatever is in the spindle has a length, which no control but LinuxCNC takes without its number.
TEST(PostedPrograms, NameTheToolWhoseLengthIsOn) {
  const auto motions = motions_in(
      "G21 G90 G54\nS1000 M3\nG0 X0 Y0\nG43 Z5\nG1 Z-1 F100\nX10\nM30\n", Dialect::fanuc);
  for (const Dialect to : {Dialect::fanuc, Dialect::sinumerik, Dialect::heidenhain}) {
    const std::string text = posted(motions, to);
    EXPECT_NE(text.find("4:5: error: tool length compensation without an H word"),
              std::string::npos)
        << text;
  }
  EXPECT_NE(posted(motions, Dialect::linuxcnc).find("G43 H0"), std::string::npos);
}

// More than a turn is a full circle and the rest for Fanuc.
TEST(PostedPrograms, TakeTheTimeOfFullCircles) {
  expect_alike(
      "BEGIN PGM C MM\nTOOL CALL 1 Z S1000\nL X+10 Y+0 R0 FMAX M3\nL Z+0 F500\nL X+5 F600\n"
      "CC X+0 Y+0\nCP IPA+380 DR+\nL X+10\nEND PGM C MM\n",
      Dialect::heidenhain);
}

// The second hole begins and ends at one place, nearer to the end by what was rounded off.
TEST(PostedPrograms, DrillEachHoleAfterALongWay) {
  expect_alike(
      "G21 G90 G54\nT1 M6\nS1000 M3\nG43 H1 G0 X0 Y0 Z2\nG1 Z-1 F100\nZ2\nG0 X50.0000004\nG1 Z-1\n"
      "Z2\nG0 X60\nG1 Z-1\nZ2\nM30\n",
      Dialect::linuxcnc);
}

// The retract for a tool change is left to it in one, written in the other.
TEST(PostedPrograms, RetractForAToolChange) {
  expect_alike(
      "BEGIN PGM C MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 R0 FMAX M3\nL Z+5 FMAX\nL Z-1 F100\n"
      "TOOL CALL 2 Z S1000\nL X+10 R0 FMAX M3\nL Z+3 F100\nEND PGM C MM\n",
      Dialect::heidenhain);
}

TEST(PostedPrograms, HaveAFeed) {
  for (const char* move : {"G1 X10\n", "G53 G1 X10\n"}) {
    const auto motions =
        motions_in(std::string("G21 G90 G54\nT1 M6\nG0 X0 Y0\n") + move + "M30\n", Dialect::fanuc);
    for (const Dialect to : parser::written_dialects()) {
      EXPECT_NE(posted(motions, to).find("before the first F"), std::string::npos)
          << posted(motions, to);
    }
  }
}

// The tool stands still, and the control waits for ever.
TEST(PostedPrograms, TurnTheSpindleThatTheirFeedCountsBy) {
  const auto motions = motions_in(
      "G21 G90 G54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z5\nG95 G1 Z-1 F0.2\nM5\nX10\nM30\n",
      Dialect::fanuc);
  for (const Dialect to : parser::written_dialects()) {
    EXPECT_NE(posted(motions, to).find("8:1: error: feed per revolution with the spindle at rest"),
              std::string::npos)
        << posted(motions, to);
  }
}

// LinuxCNC takes 0.1 % of the radius.
TEST(PostedPrograms, CutArcsThatOthersRefuseIntoChords) {
  expect_alike(
      "G21 G90 G54\nT1 M6\nG43 H1 G0 X0 Y0 Z0\nG1 X100 F500\nG3 X-99.95 Y0 I-100 J0\nM30\n",
      Dialect::linuxcnc);
}

// Both tools are at one place when the second begins.
TEST(PostedPrograms, MayBeginWithAToolWhereTheLastOneEnded) {
  expect_alike(
      "G21 G90 G54\nT1 M6\nG43 H1 G0 X0 Y0 Z2\nG1 Z-5 F500\nX50\nX0\nZ2\nG49 T2 M6\n"
      "G0 X0 Y0\nG43 H2 Z2\nG1 Z-5\nX-50\nM30\n",
      Dialect::linuxcnc);
}

}  // namespace
}  // namespace frustum::post
