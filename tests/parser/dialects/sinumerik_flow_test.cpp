// Loops, branches and jumps of Sinumerik programs.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of_sinumerik(std::string_view text) {
  std::vector<double> places;
  for (const Traverse& move : all_of<Traverse>(motions(text, {}, Dialect::sinumerik))) {
    places.push_back(*move.end[X]);
  }
  return places;
}

TEST(SinumerikFlow, OfLabelsThatAreThereTwiceTheNearestOneCounts) {
  const std::string twice =
      "IF R1==1 GOTOF AA\nG0 X1\nAA: G0 X2\nIF R1==0 GOTOF AA\nG0 X3\nAA: G0 X4\n"
      "R2=R2+1\nIF R2==1 GOTOB AA\n";
  EXPECT_EQ(x_of_sinumerik(twice), (std::vector<double>{1, 2, 4, 4}));
  EXPECT_EQ(x_of_sinumerik("R1=1\n" + twice), (std::vector<double>{2, 3, 4, 4}));
  const auto told = all_of<Event>(motions(twice, {}, Dialect::sinumerik));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].name, "label");
  EXPECT_EQ(told[0].grade, EventGrade::assumed);
}

TEST(SinumerikFlow, EndifOfAJumpClosesNothing) {
  const auto x_of = [](std::string_view text) {
    return *last_of<Traverse>(motions(text, {}, Dialect::sinumerik)).end[AxisLetter::X];
  };
  EXPECT_EQ(x_of("IF R1>0 GOTOF THERE\n;no work\nENDIF\nG0 X1\nTHERE: M30\n"), 1.0);
  EXPECT_EQ(x_of("R1=1\nG0 X5\nIF R1>0 GOTOF THERE\nENDIF\nG0 X1\nTHERE: M30\n"), 5.0);
  const std::string nested = "IF R2==0\nIF R1>0 GOTOF THERE\nENDIF\nENDIF\nG0 X1\nTHERE: M30\n";
  EXPECT_EQ(x_of(nested), 1.0);
  EXPECT_EQ(x_of("R2=1\n" + nested), 1.0);
  const auto told = all_of<Event>(motions(nested, {}, Dialect::sinumerik));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].grade, EventGrade::assumed);
  // With work between it would matter what it closes.
  EXPECT_EQ(
      complaint_ids("IF R1>0 GOTOF THERE\nG0 X1\nENDIF\nTHERE: M30\n", {}, Dialect::sinumerik),
      std::vector<std::string>{"flow-unpaired"});
  EXPECT_EQ(complaint_ids("IF R1>0\nG0 X1\nENDIF\nENDIF\n", {}, Dialect::sinumerik),
            std::vector<std::string>{"flow-unpaired"});
}

TEST(SinumerikFlow, Branches) {
  const char* text = "IF (R1>1) AND NOT (R1==3)\nG0 X1\nELSE\nG0 X2\nENDIF\nG0 X9\n";
  EXPECT_EQ(x_of_sinumerik(std::string("R1=2\n") + text), (std::vector<double>{1, 9}));
  EXPECT_EQ(x_of_sinumerik(std::string("R1=3\n") + text), (std::vector<double>{2, 9}));
  EXPECT_EQ(x_of_sinumerik(std::string("R1=1\n") + text), (std::vector<double>{2, 9}));
}

TEST(SinumerikFlow, BranchesWithinEachOther) {
  EXPECT_EQ(
      x_of_sinumerik("R1=1\nIF R1<>1\nIF R1==2\nG0 X1\nENDIF\nELSE\nIF R1<=1\nG0 X2\nELSE\nG0 "
                     "X3\nENDIF\nENDIF\n"),
      (std::vector<double>{2}));
}

TEST(SinumerikFlow, Loops) {
  EXPECT_EQ(x_of_sinumerik("R1=0\nWHILE R1<3\nG0 X=R1\nR1=R1+1\nENDWHILE\n"),
            (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(x_of_sinumerik("FOR R5=2 TO 4\nG0 X=R5\nENDFOR\nG0 X=R5\n"),
            (std::vector<double>{2, 3, 4, 5}));
  EXPECT_EQ(x_of_sinumerik("FOR R5=2 TO 1\nG0 X=R5\nENDFOR\nG0 X9\n"), (std::vector<double>{9}));
  EXPECT_EQ(x_of_sinumerik("R1=0\nREPEAT\nR1=R1+1\nG0 X=R1\nUNTIL R1>=2\n"),
            (std::vector<double>{1, 2}));
  EXPECT_EQ(
      x_of_sinumerik("R1=0\nLOOP\nR1=R1+1\nG0 X=R1\nIF R1==3 GOTOF OUT\nENDLOOP\nOUT: G0 X9\n"),
      (std::vector<double>{1, 2, 3, 9}));
}

TEST(SinumerikFlow, LoopsWithinEachOther) {
  EXPECT_EQ(x_of_sinumerik("FOR R1=1 TO 2\nFOR R2=1 TO 2\nG0 X=10*R1+R2\nENDFOR\nENDFOR\n"),
            (std::vector<double>{11, 12, 21, 22}));
}

TEST(SinumerikFlow, JumpsToLabelsAndBlockNumbers) {
  EXPECT_EQ(x_of_sinumerik("GOTOF PART2\nG0 X1\nPART2: G0 X2\n"), (std::vector<double>{2}));
  EXPECT_EQ(
      x_of_sinumerik(
          "R1=0\nAGAIN:\nR1=R1+1\nG0 X=R1\nIF R1<2 GOTOB AGAIN\nGOTO N90\nG0 X7\nN90 G0 X8\n"),
      (std::vector<double>{1, 2, 8}));
}

}  // namespace
}  // namespace frustum::parser
