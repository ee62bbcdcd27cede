// Comments that turn checks off, in each dialect's comment.
#include <gtest/gtest.h>

#include "lint/suppressions.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

using parser::Dialect;

std::vector<Suppression> read(const std::string& text, Dialect dialect = Dialect::fanuc) {
  return suppressions_of({"part.nc", dialect, parser::ProgramText(text), nullptr});
}
std::size_t counting(const CheckReport& report) {
  return report.count(Severity::error) + report.count(Severity::warning) +
         report.count(Severity::note);
}

TEST(Suppressions, OnTheLineOrAboveIt) {
  const auto found = read(
      "G1 X1 F2 (frustum: ignore feed-low)\n"
      "(frustum: ignore feed-high, feed-low)\n"
      "\n"
      "(of another kind)\n"
      "G1 X2 F2\n"
      "G1 X3 F2\n");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].line, 1U);
  EXPECT_EQ(found[0].check, Check::feed_low);
  EXPECT_EQ(found[1].line, 5U);
  EXPECT_EQ(found[1].check, Check::feed_high);
  EXPECT_EQ(found[2].line, 5U);
  EXPECT_EQ(found[2].place.line, 2U);
}

TEST(Suppressions, AMessageOfTheControlIsNone) {
  EXPECT_TRUE(read("(MSG, frustum: ignore feed-low)\nG1 X1 F2\n").empty());
  EXPECT_TRUE(read("MSG(\"frustum: ignore feed-low\")\nG1 X1 F2\n", Dialect::sinumerik).empty());
  EXPECT_EQ(read("; frustum: ignore feed-low\nG1 X1 F2\n", Dialect::sinumerik).size(), 1U);
}

TEST(Suppressions, AReasonMayFollowASemicolon) {
  const auto found = read("G1 X1 F2 (frustum: ignore feed-low; because)\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].check, Check::feed_low);
  EXPECT_EQ(found[0].reason, "because");
}

// Each finding looks at the comments of its own line alone: all with all took minutes.
TEST(Suppressions, ManyAreFoundAtOnce) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "G0 X1 (frustum: ignore feed-low)\n";
  Suppressions suppressions({"part.nc", Dialect::fanuc, parser::ProgramText(text), nullptr});
  std::size_t taken = 0;
  for (std::uint32_t line = 1; line <= 100'000; ++line) {
    taken += suppressions.taking(Check::feed_low, {line, 1, nullptr}) != nullptr ? 1 : 0;
  }
  EXPECT_EQ(taken, 100'000U);
}

TEST(Suppressions, OfAFileHaveNoLine) {
  const auto found = read("G0 X1\n(frustum: ignore-file feed-low -- slow on purpose)\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 0U);
  EXPECT_EQ(found[0].reason, "slow on purpose");
}

TEST(Suppressions, InTheCommentsOfEveryDialect) {
  const std::pair<Dialect, const char*> programs[] = {
      {Dialect::fanuc, "N10 G1 X1 F2 (FRUSTUM: IGNORE FEED-LOW)\n"},
      {Dialect::linuxcnc, "G1 X1 F2 ; frustum: ignore feed-low\n"},
      {Dialect::sinumerik, "N20 G1 X1 F2 ; Frustum: ignore feed-low\n"},
      {Dialect::heidenhain, "12 L X+1 F2 ; frustum: ignore feed-low\n"},
      {Dialect::cldata, "$$ frustum: ignore feed-low\nGOTO/1,2,3\n"},
  };
  for (const auto& [dialect, text] : programs) {
    const auto found = read(text, dialect);
    ASSERT_EQ(found.size(), 1U) << text;
    EXPECT_EQ(found[0].check, Check::feed_low) << text;
    EXPECT_EQ(found[0].line, dialect == Dialect::cldata ? 2U : 1U) << text;
  }
}

TEST(Suppressions, HoldWhereTheLineCannotBeRead) {
  const CheckReport report = checked("G0 X1\nG1 X[ (frustum: ignore program-error)\nM30\n");
  EXPECT_EQ(counting(report), 0U) << ids(report);
}

TEST(Suppressions, TakeTheirFindingAndLeaveThoseElsewhere) {
  const std::string head = "T1 M6\nS1000 M3\nG43 H1\nG0 X0 Y0 Z50\n";
  const std::string end = "G0 Z60\nM5\nM30\n";
  const std::string body = "G1 Z-1 F2 (frustum: ignore feed-low)\nG0 Z5\n";
  const CheckReport report = checked(head + body + end);
  EXPECT_EQ(counting(report), 0U) << ids(report);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].suppressed, Suppressed::by_comment);
  // The same feed again, which would have been counted with the first.
  const CheckReport again = checked(head + body + "G1 Z-1 F2\n" + end);
  EXPECT_EQ(counting(again), 1U) << ids(again);
}

TEST(Suppressions, WithoutACheckOrWithAMisspeltWordAreFindings) {
  for (const char* comment :
       {"(frustum: ignore)", "(frustum: ignor feed-low)", "(frustum: ignore-file feed_low)"}) {
    const CheckReport report = checked(std::string(comment) + "\nG0 X1\nM30\n");
    EXPECT_EQ(of(report, "unknown-suppression").size(), 1U) << comment << ids(report);
  }
}

// A check that is off, or has no machine, does not make its comment a useless one.
TEST(Suppressions, AreNotUnusedWhereTheCheckIsLeftOut) {
  EXPECT_EQ(ids(checked("G0 X1 (frustum: ignore over-travel)\nM30\n")), "");
  CheckOptions options;
  options.disabled = {Check::feed_low};
  EXPECT_EQ(ids(checked("G0 X1 (frustum: ignore feed-low)\nM30\n", options)), "");
}

}  // namespace
}  // namespace frustum::lint
