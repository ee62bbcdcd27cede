// Rigid taps of all controls in the words of another one, or why there are none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "parser/writing/motion_writer.hpp"
#include "tests/parser/writing/read_back.hpp"

namespace frustum::parser {
namespace {

// The words of LinuxCNC for what a program of another control taps.
std::string tapped(const std::string& text, Dialect dialect) {
  const auto written = write_nc(motions_in(text, dialect), Dialect::linuxcnc);
  return written ? written->text : first_of(written.error());
}

TEST(RigidTapWriting, OfAllControlsIsOneBlockOfLinuxCnc) {
  const std::string sinumerik = "G17 G90 G94 G71\nT1 M6\nD1\nS500 M3\nG0 X1 Y2 Z20\n";
  const auto has = [](const std::string& text, const std::string& block) {
    EXPECT_NE(text.find(block), std::string::npos) << text;
    EXPECT_EQ(text.find("G33 "), std::string::npos) << text;
    EXPECT_EQ(text.find("\nM4\nG1"), std::string::npos) << text;
  };
  has(tapped(sinumerik + "CYCLE84(20,0,2,-10,,0,3,,1.5,0,500,500)\nG0 X9\n", Dialect::sinumerik),
      "Z2.\nG33.1 Z-10. K1.5\nG0 Z20.\nM3\nX9.\n");
  has(tapped(sinumerik + "CYCLE84(20,0,2,-10,,0,3,,-1.5,0,400)\nG0 X9\n", Dialect::sinumerik),
      "Z2.\nS400 M4\nG33.1 Z-10. K1.5\nG0 Z20.\nS500 M3\nX9.\n");
  has(tapped(sinumerik + "CYCLE840(20,0,2,-10,,0,0,,0,,1.5)\nG0 X9\n", Dialect::sinumerik),
      "Z2.\nG33.1 Z-10. K1.5\nG0 Z20.\nM3\nX9.\n");
  has(tapped(sinumerik + "G0 Z2\nSPOS=0\nG331 Z-10 K1.5\nG332 Z2 K1.5\nG0 Z20\n",
             Dialect::sinumerik),
      "M3\nG33.1 Z-10. K1.5\nM5\nG0 Z20.\n");
  has(tapped(
          "TOOL CALL 1 Z S500\nL X+1 Y+2 Z+20 R0 FMAX M3\nCYCL DEF 207 Q200=2 Q201=-10 Q239=-1.5 "
          "Q203=+0 Q204=20\nCYCL CALL\nL X+5 R0 F100\n",
          Dialect::heidenhain),
      "Z2.\nM4\nG33.1 Z-10. K1.5\nM3\nG0 Z20.\nG1 X5. F100\n");
  has(tapped("G21 G90 G94\nT1 M6\nG43 H1 G0 X1 Y2 Z20\nM29 S500\nG98 G84 Z-10 R2 F750\nG80\n",
             Dialect::fanuc),
      "Z2.\nS500 M3\nG33.1 Z-10. K1.5\nG0 Z20.\nM5\n");
}

// Each control has a tap of its own, which is read as the same motions.
TEST(RigidTapWriting, IsTheTapOfTheControl) {
  const std::string head = "G21 G90\nT1 M6\nG43 H1\nS500 M3\nG0 X1 Y2 Z3\n";
  const std::string right = head + "G33.1 Z-10 K1.5\nG0 X4\nG1 Z1 F90\nM2\n";
  const std::string left = head + "M4\nG33.1 Z-10 K1.5\nM5\nG0 X4\nM2\n";
  const auto written = [](const std::string& text, Dialect dialect) {
    const auto nc = write_nc(motions_in(text, Dialect::linuxcnc), dialect);
    return nc ? nc->text : first_of(nc.error());
  };
  const auto expect_in = [](const std::string& text, const std::string& block) {
    EXPECT_NE(text.find(block), std::string::npos) << text;
  };
  expect_in(written(right, Dialect::fanuc),
            "Z3.\nM29 S500\nG99 G84 Z-10. R3. F750\nG80\nM3\nG0 X4.\nG1 Z1. F90\n");
  expect_in(written(left, Dialect::fanuc),
            "M4\nM29 S500\nG99 G74 Z-10. R3. F750\nG80\nM4\nM5\nG0 X4.\n");
  expect_in(written(right, Dialect::sinumerik),
            "Z3\nSPOS=0\nG331 Z-10 K1.5\nG332 Z3 K1.5\nM3\nG0 X4\nG1 Z1 F90\n");
  expect_in(written(left, Dialect::sinumerik),
            "M4\nSPOS=0\nG331 Z-10 K-1.5\nG332 Z3 K-1.5\nM4\nM5\nG0 X4\n");
  expect_in(written(left, Dialect::heidenhain),
            " CYCL DEF 207 RIGID TAPPING Q200=+0 Q201=-13 Q239=-1.5 Q203=+3 Q204=+0\n");
  for (const std::string& text : {right, left}) {
    const auto cuts = [](const std::vector<Motion>& all) {
      std::string told;
      SpindleDirection turns = SpindleDirection::off;
      for (const Motion& motion : all) {
        if (const auto* spindle = std::get_if<SpindleChange>(&motion.command)) {
          turns = spindle->direction;
        }
        const auto* cut = std::get_if<LinearFeed>(&motion.command);
        if (cut == nullptr) continue;
        told += fmt::format("{:g} {:g}{} {}; ", *cut->end[AxisLetter::Z], cut->feed.value,
                            cut->feed.synchronised ? "s" : "", static_cast<int>(turns));
      }
      return told;
    };
    for (const Dialect dialect : written_dialects()) {
      EXPECT_EQ(cuts(motions_in(written(text, dialect), dialect)),
                cuts(motions_in(text, Dialect::linuxcnc)))
          << written(text, dialect);
    }
  }
}

TEST(RigidTapWriting, OfCyclesIsAlongZ) {
  const std::string across = "G21 G90\nT1 M6\nG43 H1\nS500 M3\nG0 X1 Y2 Z3\nG33.1 X-10 K1.5\nM2\n";
  for (const Dialect dialect : {Dialect::fanuc, Dialect::sinumerik, Dialect::heidenhain}) {
    const auto refused = write_nc(motions_in(across, Dialect::linuxcnc), dialect);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().front().message.find("a tap that is not along Z"), std::string::npos);
  }
}

TEST(RigidTapWriting, RefusesWhatIsNotInAndOutAtOnce) {
  const std::string go = "G17 G90 G94 G71\nT1 M6\nD1\nS500 M3\nG0 X1 Y2 Z2\n";
  for (const auto& [tap, why] :
       {std::pair{"CYCLE84(20,0,2,-10,,0.5,3,,1.5,0,500)", "a tap that dwells at the bottom"},
        std::pair{"CYCLE84(20,0,2,-10,,0,3,,1.5,0,500,600)",
                  "a tap that comes back at another speed of the spindle"},
        std::pair{"CYCLE84(20,0,2,-10,,0,3,,1.5,0,500,500,3,0,0,1,5,1)",
                  "a tap that does not come back to where it began"},
        std::pair{"G331 Z-10 K1.5\nG332 Z5 K1.5",
                  "a tap that does not come back to where it began"},
        std::pair{"G331 Z-10 K1.5\nG332 Z2 K1.25", "a tap that does not come back by its lead"}}) {
    EXPECT_NE(tapped(go + tap + "\nG0 X9\n", Dialect::sinumerik).find(why), std::string::npos)
        << tap << "\n"
        << tapped(go + tap + "\nG0 X9\n", Dialect::sinumerik);
  }
}

// Sinumerik says each way in and out for itself: strokes, dwells, speeds, and other ends.
TEST(RigidTapWriting, InStrokesIsWrittenStrokeByStroke) {
  const std::string go = "G17 G90 G94 G71\nT1 M6\nD1\nS500 M3\nG0 X1 Y2 Z2\n";
  const auto cuts = [](const std::vector<Motion>& all) {
    std::string told;
    SpindleChange turns;
    for (const Motion& motion : all) {
      if (const auto* spindle = std::get_if<SpindleChange>(&motion.command)) turns = *spindle;
      if (const auto* wait = std::get_if<Dwell>(&motion.command)) {
        told += fmt::format("D{:g}; ", wait->seconds);
      }
      const auto* cut = std::get_if<LinearFeed>(&motion.command);
      if (cut == nullptr) continue;
      told += fmt::format("{:g} {:g}{} {} {:g}; ", *cut->end[AxisLetter::Z], cut->feed.value,
                          cut->feed.synchronised ? "s" : "", static_cast<int>(turns.direction),
                          turns.speed);
    }
    return told;
  };
  const auto expect_strokes = [&](const std::string& text, Dialect dialect,
                                  const std::string& block) {
    const auto read = motions_in(text, dialect);
    const auto nc = write_nc(read, Dialect::sinumerik);
    ASSERT_TRUE(nc) << first_of(nc.error());
    EXPECT_NE(nc->text.find(block), std::string::npos) << nc->text;
    EXPECT_EQ(cuts(motions_in(nc->text, Dialect::sinumerik)), cuts(read)) << nc->text;
  };
  const std::string back = "\nG0 X9\nG1 Z1 F90\nM30\n";
  // 5 deep, 1 back, the rest.
  expect_strokes(go + "CYCLE84(20,0,2,-10,,0,3,,1.5,0,500,500,3,0,0,1,5,1)" + back,
                 Dialect::sinumerik,
                 "SPOS=0\nG331 Z-5 K1.5\nG332 Z-4 K1.5\nG331 Z-10 K1.5\nG332 Z2 K1.5\nG0 Z20\n");
  expect_strokes(go + "CYCLE84(20,0,2,-10,,0,3,,-1.5,0,500,600)" + back, Dialect::sinumerik,
                 "SPOS=0\nG331 Z-10 K-1.5\nG332 Z2 K-1.5 S600\n");
  expect_strokes(go + "CYCLE84(20,0,2,-10,,0.5,3,,1.5,0,500)" + back, Dialect::sinumerik,
                 "SPOS=0\nG331 Z-10 K1.5\nG4 F0.5\nG332 Z2 K1.5\n");
  expect_strokes(go + "G331 Z-10 K1.5\nG332 Z5 K1.5\nM3" + back, Dialect::sinumerik,
                 "SPOS=0\nG331 Z-10 K1.5\nG332 Z5 K1.5\n");
  expect_strokes(
      "TOOL CALL 1 Z S500\nL X+1 Y+2 Z+20 R0 FMAX M3\nCYCL DEF 209 Q200=2 Q201=-10 Q239=1.5 "
      "Q203=+0 Q204=20 Q257=6 Q256=1\nCYCL CALL\nL X+5 R0 F100\n",
      Dialect::heidenhain,
      "SPOS=0\nG331 Z-6 K1.5\nG332 Z-4.5 K1.5\nG331 Z-10 K1.5\nG332 Z2 K1.5\n");
}

// A height that the length of the tool was added to and taken from is off by its last digit.
TEST(RigidTapWriting, ComesBackWhereRoundingLetsIt) {
  const double off = (5.1 + 146.3) - 146.3;
  ASSERT_NE(off, 5.1);
  auto motions = motions_in(
      "G21 G17 G90 G94\nT1 M6\nS500 M3\nG0 X0 Y0 Z5.1\nG33.1 Z-12 K1.5\n"
      "G0 Z60\nM2\n",
      Dialect::linuxcnc);
  for (Motion& motion : motions) {
    auto* rapid = std::get_if<Traverse>(&motion.command);
    if (rapid != nullptr && rapid->end[AxisLetter::Z] == 5.1) rapid->end[AxisLetter::Z] = off;
  }
  const auto written = write_nc(motions, Dialect::fanuc);
  ASSERT_TRUE(written) << first_of(written.error());
  EXPECT_NE(written->text.find("G84"), std::string::npos) << written->text;
}

}  // namespace
}  // namespace frustum::parser
