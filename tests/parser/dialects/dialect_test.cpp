// Each dialect's sample program, what it becomes, and what else the dialects must agree on.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/units.hpp"
#include "parser/writing/canonical_json.hpp"
#include "tests/law_count.hpp"
#include "tests/parser/random_program.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;
namespace fs = std::filesystem;

const fs::path kDialectFolder =
    fs::path(FRUSTUM_SOURCE_DIR) / "tests" / "parser" / "data" / "dialects";

std::string text_of_file(const fs::path& file) {
  std::ifstream in(kDialectFolder / file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Sample {
  const char* file;
  Dialect dialect;
  const char* reason;
};
constexpr std::array kSamples{
    Sample{"tilted.nc", Dialect::fanuc, "line 9: G68.2"},
    Sample{"five_axis.ngc", Dialect::linuxcnc, "line 8: M428"},
    Sample{"five_axis.mpf", Dialect::sinumerik, "line 1: %_N_"},
    Sample{"five_axis.h", Dialect::heidenhain, "line 1: BEGIN PGM"},
    Sample{"five_axis.apt", Dialect::cldata, "line 1: PARTNO"},
};

std::string json_of(const std::string& text, Dialect dialect) {
  std::string json;
  for (const Motion& motion : motions(text, {}, dialect)) json += to_json_line(motion) + '\n';
  return json;
}

std::vector<Motion> run_dialect(Dialect dialect, std::string_view text) {
  return motions(text, {}, dialect);
}

// The files beside the samples: changed only on purpose, by
// frustum parse FILE --canon --quiet > FILE.jsonl.
TEST(DialectGolden, SamplesGiveTheirCanonicalMotions) {
  for (const Sample& sample : kSamples) {
    EXPECT_EQ(json_of(text_of_file(sample.file), sample.dialect),
              text_of_file(std::string(sample.file) + ".jsonl"))
        << sample.file;
  }
}

TEST(Dialect, IsRecognisedByContentWithTheReason) {
  for (const Sample& sample : kSamples) {
    const auto found = recognise_dialect(text_of_file(sample.file), "program.txt");
    EXPECT_EQ(found.dialect, sample.dialect) << sample.file;
    EXPECT_EQ(found.reason, sample.reason);
  }
}

TEST(Dialect, IsRecognisedByTheNameWhenTheContentIsSilent) {
  const std::string text = "G0 X0\nG1 X1 F100\nM30\n";
  const auto found = [&](const char* file) { return recognise_dialect(text, file); };
  EXPECT_EQ(found("a.mpf").dialect, Dialect::sinumerik);
  EXPECT_EQ(found("a.SPF").dialect, Dialect::sinumerik);
  EXPECT_EQ(found("a.ngc").dialect, Dialect::linuxcnc);
  EXPECT_EQ(found("a.H").reason, "the name ends in .h");
  EXPECT_EQ(found("a.cls").dialect, Dialect::cldata);
  EXPECT_EQ(found("a.clsf").dialect, Dialect::cldata);
  EXPECT_EQ(found("a.ncl").dialect, Dialect::cldata);
  EXPECT_EQ(found("a.nc").dialect, Dialect::fanuc);
  EXPECT_EQ(found("a.nc").reason, "nothing says otherwise");
}

TEST(Dialect, IsRecognisedBehindAByteOrderMarkAndByWordsWithNumbers) {
  const auto reason = [](std::string_view text) { return recognise_dialect(text, "a.txt").reason; };
  EXPECT_EQ(reason("\xEF\xBB\xBF\x30 BEGIN PGM A MM\n"), "line 1: BEGIN PGM");
  EXPECT_EQ(reason("G0 X0\no100 sub\n"), "line 2: O100 SUB");
  EXPECT_EQ(reason("G0 X0\nG17 G64 P0.01\n"), "line 2: G64 P");
  EXPECT_EQ(reason("G64 (P0.01)\nG0 X0\n"), "nothing says otherwise");
  EXPECT_EQ(reason("N5 R12=5.5\n"), "line 1: R12=");
  EXPECT_EQ(reason("G2 X10 Y0 CR = 10\n"), "line 1: CR =");
  EXPECT_EQ(reason("T=\"MILL\" M6\n"), "line 1: T=\"");
  EXPECT_EQ(reason("CYCLE82(5,0)\n"), "line 1: CYCLE82");
  EXPECT_EQ(reason("MCALL CYCLE81(5,0)\n"), "line 1: CYCLE81");
  EXPECT_EQ(reason("12 Q5 = +60\n"), "line 1: Q5 =");
  EXPECT_EQ(reason("PPRINT/X=5\n"), "line 1: PPRINT");
  EXPECT_EQ(reason("; X=5\n#<x>=5\n"), "nothing says otherwise");
}

TEST(Dialect, IsNotRecognisedByWordsOfComments) {
  EXPECT_EQ(recognise_dialect("(TRAORI, GOTO/1,2,3)\nG0 X0 ; TRAORI\n", "a.nc").reason,
            "nothing says otherwise");
}

TEST(Dialect, Fault2_14_RemappedWordsOfLinuxcncAreNotFanucs) {
  const std::string text = "G21\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.1\nM2\n";
  EXPECT_EQ(recognise_dialect(text, "five_axis.ngc").dialect, Dialect::linuxcnc);
  EXPECT_EQ(recognise_dialect(text, "five_axis.nc").reason, "line 2: G68.2");
  EXPECT_EQ(recognise_dialect("TRAORI\n" + text, "five_axis.ngc").dialect, Dialect::sinumerik);
}

TEST(Dialect, Fault2_19_ProseIsNoProgram) {
  const std::string page =
      "# How to position\n\nUse an assignment such as X=5 to move the axis there.\n\n"
      "- a second hint for people who read this\n\n```\nG1 X=R1+5 F=100\n```\n";
  EXPECT_EQ(recognise_dialect(page, "README.md").reason, "nothing says otherwise");
  EXPECT_EQ(recognise_dialect("Function of the plane is to be set here\nG0 X1\n", "a.txt").reason,
            "nothing says otherwise");
  // A remark that is marked as none in many lines of a program; programs in small letters.
  EXPECT_EQ(
      recognise_dialect("a remark that nobody marked\nG0 X0\nG1 X=5 F1\nX6\nX7\nX8\n", "a.txt")
          .reason,
      "line 3: X=");
  EXPECT_EQ(recognise_dialect("g1 x=r1 f100\nif r1==5 gotof ende\n", "a.txt").reason, "line 1: X=");
  EXPECT_EQ(recognise_dialect("PARTNO a flange for the pump\nGOTO/1,2,3\n", "a.txt").dialect,
            Dialect::cldata);
  EXPECT_EQ(recognise_dialect("N10 MSG(\"now the first side is cut\")\nG0 X1\n", "a.txt").dialect,
            Dialect::sinumerik);
}

TEST(Dialect, NamesReadBack) {
  for (const Dialect dialect : kDialects) EXPECT_EQ(dialect_named(name_of(dialect)), dialect);
  EXPECT_EQ(dialect_named("iso"), Dialect::fanuc);
  EXPECT_FALSE(dialect_named("klingon").has_value());
}

// One path, five spellings: the same motions but for what their lines are called.
TEST(DialectLaws, OnePathIsTheSameInAllOfThem) {
  struct Spelling {
    Dialect dialect;
    const char* text;
  };
  const std::array spellings{
      Spelling{Dialect::fanuc,
               "G21 T2 M6\nS500 M3\nG43.4 H2\nG0 X1 Y2 Z30\nG1 Z3 F250\nX4 Y2.5\nG2 X8 I2 "
               "J0\nM5\nM30\n"},
      Spelling{Dialect::linuxcnc,
               "G21 T2 M6\nS500 M3\nG43 H2 M428\nG0 X1 Y2 Z30\nG1 Z3 F250\nX4 Y2.5\nG2 X8 I2 "
               "J0\nM5\nM2\n"},
      Spelling{Dialect::sinumerik,
               "G710 T2 D1 M6\nS500 M3\nTRAORI\nG0 X1 Y2 Z30\nG1 Z=3 F=250\nX4 Y2.5\nG2 X8 "
               "CR=2\nM5\nM30\n"},
      Spelling{Dialect::heidenhain,
               "0 BEGIN PGM A MM\n1 TOOL CALL 2 Z S500\n2 M3\n3 M128\n4 L X+1 Y+2 Z+30 FMAX\n5 L "
               "Z+3 F250\n6 L X+4 Y+2.5\n7 CC X+6 Y+2.5\n8 C X+8 Y+2.5 DR-\n9 M5\n10 M30\n"},
      Spelling{Dialect::cldata,
               "UNITS/MM\nMULTAX/ON\nLOADTL/2\nSPINDL/500,CLW\nRAPID\nGOTO/1,2,30\nFEDRAT/"
               "250\nGOTO/1,2,3\nGOTO/4,2.5,3\nCIRCLE/6,2.5,3,0,0,-1,2\nGOTO/8,2.5,3\nSPINDL/"
               "OFF\nFINI\n"},
  };
  const auto path_of = [](const Spelling& spelling) {
    std::string path;
    for (const Motion& motion : run_dialect(spelling.dialect, spelling.text)) {
      if (std::holds_alternative<Event>(motion.command)) continue;
      // How the tip's control was switched on may differ.
      if (std::holds_alternative<CompensationChange>(motion.command)) continue;
      Motion placed = motion;
      placed.place = {1, 1};
      path += to_json_line(placed) + '\n';
    }
    return path;
  };
  const std::string expected = path_of(spellings[0]);
  EXPECT_NE(expected.find("\"arc\""), std::string::npos);
  for (const Spelling& spelling : spellings) {
    EXPECT_EQ(path_of(spelling), expected) << name_of(spelling.dialect);
    const auto change = last_of<CompensationChange>(run_dialect(spelling.dialect, spelling.text));
    EXPECT_EQ(change.mode, LengthCompensation::tool_centre_point) << name_of(spelling.dialect);
    EXPECT_EQ(change.offset_number, 2) << name_of(spelling.dialect);
  }
}

// --- LinuxCNC ------------------------------------------------------------------------------------

TEST(Linuxcnc, DwellsInSecondsWithOrWithoutAPoint) {
  const auto dwells = all_of<Dwell>(run_dialect(Dialect::linuxcnc, "G4 P2\nG4 P2.\n"));
  EXPECT_EQ(dwells.at(0).seconds, 2.0);
  EXPECT_EQ(dwells.at(1).seconds, 2.0);
}

TEST(Linuxcnc, KeepsTheTipSwitchOverLengthWords) {
  const auto changes = all_of<CompensationChange>(
      run_dialect(Dialect::linuxcnc, "M428\nT4 M6\nG43\nG43 H5\nG49\nM429\n"));
  ASSERT_EQ(changes.size(), 5U);
  EXPECT_EQ(changes[0].mode, LengthCompensation::tool_centre_point);
  EXPECT_EQ(changes[0].length, 0.0);
  EXPECT_EQ(changes[1].mode, LengthCompensation::tool_centre_point);
  EXPECT_EQ(changes[1].offset_number, 4);
  EXPECT_EQ(changes[2].offset_number, 5);
  EXPECT_EQ(changes[3].length, 0.0);
  EXPECT_EQ(changes[4].mode, LengthCompensation::off);
}

// --- Sinumerik -----------------------------------------------------------------------------------

TEST(Sinumerik, ReadsWordsWithoutBlanksInAnyCase) {
  const auto moves =
      all_of<LinearFeed>(run_dialect(Dialect::sinumerik, "n10g1x1.y-.5f100\nX=-(2+3)Z5\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].end[Y], -0.5);
  EXPECT_EQ(moves[1].end[X], -5.0);
  EXPECT_EQ(moves[1].end[Z], 5.0);
}

TEST(Sinumerik, ComputesWithItsParametersAndFunctions) {
  const auto move = last_of<Traverse>(run_dialect(
      Dialect::sinumerik,
      "R1=2 R22=3\nG0 X=R1*(R22+1)-4/2 Y=SQRT(16)+7 MOD 4 Z=ATAN2(1,1)+ABS(-R1) A=SIN(90)\n"));
  EXPECT_EQ(move.end[X], 6.0);
  EXPECT_EQ(move.end[Y], 7.0);
  EXPECT_NEAR(*move.end[Z], 47.0, 1e-12);
  EXPECT_NEAR(*move.end[A], kRadPerDeg, 1e-15);
}

TEST(Sinumerik, LeavesAxesThatWentTheShorterWayWhereTheyAre) {
  const auto all = run_dialect(Dialect::sinumerik, "G0 A0 C=DC(350)\nX1\nA5\nC=IC(10)\nC0\n");
  const auto moves = all_of<Traverse>(all);
  ASSERT_EQ(moves.size(), 5U);
  EXPECT_TRUE(moves[0].end[C].has_value());
  EXPECT_FALSE(moves[1].end[C].has_value());
  EXPECT_FALSE(moves[2].end[C].has_value());
  EXPECT_EQ(moves[3].end[C], 360 * kRadPerDeg);
  EXPECT_EQ(moves[4].end[C], 0.0);
  // A goes to its values all the time.
  std::vector<RotaryPath> paths;
  for (const auto& change : all_of<RotaryPathChange>(all)) {
    paths.push_back(change.path);
    EXPECT_EQ(change.axes, (std::array{false, false, true}));
  }
  EXPECT_EQ(paths, (std::vector{RotaryPath::shortest, RotaryPath::as_programmed}));
}

TEST(Sinumerik, SwivelsAboutTheAxesInTheOrderOfTheMode) {
  const auto plane = [](const char* call) {
    return *last_of<TiltedPlaneChange>(run_dialect(Dialect::sinumerik, call)).program_from_plane;
  };
  // X Y Z: Rx Ry Rz; then Z Y X.
  const Pose forward = plane("CYCLE800(0,\"\",0,57,0,0,0,10,20,30,0,0,0,0)\n");
  EXPECT_LT((forward.rotation - rotation_x(10 * kRadPerDeg) * rotation_y(20 * kRadPerDeg) *
                                    rotation_z(30 * kRadPerDeg))
                .norm(),
            1e-15);
  const Pose backward = plane("CYCLE800(0,\"\",0,27,1,2,3,10,20,30,4,5,6,0)\n");
  const Mat3 turned =
      rotation_z(10 * kRadPerDeg) * rotation_y(20 * kRadPerDeg) * rotation_x(30 * kRadPerDeg);
  EXPECT_LT((backward.rotation - turned).norm(), 1e-15);
  EXPECT_LT((backward.translation - (Vec3(1, 2, 3) + turned * Vec3(4, 5, 6))).norm(), 1e-14);
}

TEST(Sinumerik, AlignsTheToolOnlyWithADirection) {
  EXPECT_TRUE(all_of<AlignToPlane>(
                  run_dialect(Dialect::sinumerik, "CYCLE800(0,\"\",0,57,0,0,0,10,20,30,0,0,0,0)\n"))
                  .empty());
  EXPECT_EQ(all_of<AlignToPlane>(
                run_dialect(Dialect::sinumerik, "CYCLE800(0,\"\",0,57,0,0,0,10,20,30,0,0,0,-1)\n"))
                .size(),
            1U);
  // "0" deselects the data record.
  const auto off = last_of<TiltedPlaneChange>(
      run_dialect(Dialect::sinumerik, "CYCLE800(0,\"0\",0,57,0,0,0,0,0,0,0,0,0,1)\n"));
  EXPECT_FALSE(off.program_from_plane.has_value());
}

// --- Heidenhain ----------------------------------------------------------------------------------

TEST(Heidenhain, TurnsSpatialAnglesAboutTheUntiltedAxes) {
  const auto plane = last_of<TiltedPlaneChange>(
      run_dialect(Dialect::heidenhain, "1 PLANE SPATIAL SPA+45 SPB+0 SPC+90 STAY\n"));
  const Mat3 expected = rotation_z(90 * kRadPerDeg) * rotation_x(45 * kRadPerDeg);
  EXPECT_LT((plane.program_from_plane->rotation - expected).norm(), 1e-15);
}

TEST(Heidenhain, KnowsNoModalRapidOrDirection) {
  const auto all = run_dialect(Dialect::heidenhain,
                               "1 L X+1 Y+1 Z+1 FMAX\n2 L X+2 F100\n3 L X+3 FMAX\n4 L X+4\n");
  EXPECT_EQ(all_of<Traverse>(all).size(), 2U);
  EXPECT_EQ(all_of<LinearFeed>(all).at(1).feed.value, 100.0);
}

TEST(Heidenhain, ScalesInchPrograms) {
  const auto move = last_of<LinearFeed>(
      run_dialect(Dialect::heidenhain, "0 BEGIN PGM A INCH\n1 L X+1 C+90 F10\n"));
  EXPECT_EQ(move.end[X], 25.4);
  EXPECT_EQ(move.end[C], 90 * kRadPerDeg);
  EXPECT_EQ(move.feed.value, 25.4);
}

TEST(Heidenhain, CountsLinesOverContinuations) {
  const auto lines =
      complaints("1 L X+1 FMAX\n2 CYCL DEF 247 DATUM SETTING ~\n   Q339=+1.5\n3 L A\n", {},
                 Dialect::heidenhain);
  EXPECT_EQ(lines,
            (std::vector<std::string>{"4:5: error: A has no number (hint: write A and a number)"}));
  const auto running =
      complaints("2 CYCL DEF 247 DATUM SETTING ~\n   Q339=+1.5\n", {}, Dialect::heidenhain);
  EXPECT_EQ(running.at(0).substr(0, 12), "2:4: error: ");
}

// --- CLDATA --------------------------------------------------------------------------------------

TEST(Cldata, RapidIsForOneMoveOnly) {
  const auto all =
      run_dialect(Dialect::cldata, "LOADTL/1\nFEDRAT/5\nRAPID\nGOTO/1,2,3\nGOTO/4,5,6\n");
  EXPECT_EQ(all_of<Traverse>(all).size(), 1U);
  EXPECT_EQ(all_of<LinearFeed>(all).size(), 1U);
}

TEST(Cldata, ReadsExponentsContinuationsAndComments) {
  const auto move = last_of<Traverse>(run_dialect(
      Dialect::cldata, "MULTAX\nLOADTL/1\nRAPID\nGOTO/1.5E+01,-2.E-1,$ more\n3,0,$\n0,1 $$ end\n"));
  EXPECT_EQ(move.end[X], 15.0);
  EXPECT_EQ(move.end[Y], -0.2);
  EXPECT_EQ(move.tool_axis->vec(), Vec3(0, 0, 1));
}

TEST(Cldata, ScalesInches) {
  const auto move = last_of<LinearFeed>(
      run_dialect(Dialect::cldata, "UNITS/INCHES\nLOADTL/1\nFEDRAT/10,IPM\nGOTO/1,2,3\n"));
  EXPECT_NEAR(*move.end[Z], 76.2, 1e-12);
  EXPECT_EQ(move.feed.value, 254.0);
}

// --- Robustness ----------------------------------------------------------------------------------

void survive(const std::string& text, Dialect dialect) {
  const InterpreterOptions options{.block_delete = false, .max_call_depth = 8, .max_blocks = 500};
  auto outcome = parse_program(text, "fuzz", dialect).and_then([&](const Program& program) {
    return motions_of(program, options);
  });
  if (outcome) {
    for (const Motion& motion : *outcome) ASSERT_FALSE(to_json_line(motion).empty());
    return;
  }
  for (const Diagnostic& diagnostic : outcome.error()) {
    ASSERT_FALSE(diagnostic.message.empty()) << text;
    ASSERT_FALSE(diagnostic.hint.empty()) << diagnostic.message << '\n' << text;
    ASSERT_GT(diagnostic.line, 0) << diagnostic.message << '\n' << text;
    ASSERT_GT(diagnostic.column, 0) << diagnostic.message << '\n' << text;
  }
}

TEST(DialectLaws, MutatedSamplesDoNoHarm) {
  for (const Sample& sample : kSamples) {
    const std::string good = text_of_file(sample.file);
    for (std::uint64_t seed = 1; seed <= proof::law_count(3000U, 400U); ++seed) {
      Dice dice(seed);
      std::string text = good;
      for (std::size_t i = dice.below(4) + 1; i > 0; --i) {
        const std::size_t place = dice.below(text.size());
        switch (dice.below(4)) {
          case 0:
            text[place] = static_cast<char>(dice.below(256));
            break;
          case 1:
            text.erase(place, 1 + dice.below(3));
            break;
          case 2:
            text.insert(place, text.substr(dice.below(text.size()), dice.below(12)));
            break;
          default:
            text.erase(0, place / 4);
            break;
        }
      }
      survive(text, sample.dialect);
      // Read as something else, a program may fail but must not crash.
      survive(text, kDialects.at(seed % kDialects.size()));
      if (HasFatalFailure()) FAIL() << sample.file << " seed " << seed;
    }
  }
}

TEST(DialectLaws, LongRunsOfOneCharacterDoNoHarm) {
  for (const Dialect dialect : kDialects) {
    for (int c = 1; c < 256; ++c) {
      const std::string run(3000, static_cast<char>(c));
      for (const char* before : {"", "G1 X=", "CYCLE800(", "1 L X", "GOTO/", "MSG("}) {
        survive(before + run, dialect);
      }
    }
  }
}

}  // namespace
}  // namespace frustum::parser
