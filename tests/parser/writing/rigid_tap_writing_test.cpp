// Rigid taps of all controls in the words of another one, or why there are none.
#include <gtest/gtest.h>

#include <string>
#include <utility>

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

}  // namespace
}  // namespace frustum::parser
