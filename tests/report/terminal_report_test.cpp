#include "report/terminal_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "sample_report.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(TerminalReportGolden, ReadsLikeThis) {
  EXPECT_EQ(terminal_report(small_report()),
            R"(Small part                                                                  FAIL
Machine    iwf-bc [t-(C)-Z-Y-b-X-B-C-w]
Program    part.nc

Errors injected
  EB0C  30 urad  tilt of axis C about Y

Characteristic          Value   Nominal  Tolerance  U (95%)   Used  Verdict
---------------------------------------------------------------------------
cone.form           12.346 um               10.000     0.40  123 %  FAIL
cone.half_angle  45.00123 deg  45.00000  +-0.01718  0.00069    7 %  PASS

Collisions (1)
  line 17: rapid move through material, 0.8 mm deep

Time     cut 1.50 s, measure 0.25 s, together 1.75 s
Written  out/report.html
         out/report.json
)");
}

TEST(TerminalReportGolden, ShowsDeviationsWithSignAndBothLimits) {
  RunReport report = step_report(1);
  report.measurement.characteristics.resize(3);
  auto& all = report.measurement.characteristics;
  all[0].value = 9.94321;
  all[1].value = -51.2;
  all[1].pass = false;
  all[2].value = 0.0;
  EXPECT_THAT(terminal_report(report), HasSubstr(R"(
Characteristic       Value  Tolerance  U (95%)   Used  Verdict
--------------------------------------------------------------
1-a.dL           +9.943 um   +-40.000      1.6   25 %  PASS
1-a.dH          -51.200 um   +-40.000      1.6  128 %  FAIL
1-a.theta        0.00 urad   +-400.00       16    0 %  PASS
)"));
}

TEST(TerminalReport, StaysWithinItsWidth) {
  RunReport report = sample_report();
  report.errors[0].meaning =
      "a meaning that is much too long for one line of a terminal and goes on and on and on";
  report.title += " and a part of the title that makes it long";
  for (const int width : {80, 100}) {
    TerminalOptions options;
    options.width = width;
    std::istringstream lines(terminal_report(report, options));
    std::string line;
    std::getline(lines, line);  // the title is never broken
    while (std::getline(lines, line))
      EXPECT_LE(line.size(), static_cast<std::size_t>(width)) << line;
  }
}

TEST(TerminalReport, UsesColourOnlyWhenAsked) {
  EXPECT_THAT(terminal_report(small_report()), Not(HasSubstr("\x1b")));
  TerminalOptions options;
  options.colour = true;
  EXPECT_THAT(terminal_report(small_report(), options), HasSubstr("\x1b[1;31mFAIL\x1b[0m"));
}

TEST(TerminalReport, DoesNotLetTextsSteerTheTerminal) {
  RunReport report = small_report();
  report.title = "evil\x1b[2Jtitle\nsecond line";
  report.measurement.characteristics[0].name = "a\x1b]0;b\x07";
  EXPECT_THAT(terminal_report(report), Not(HasSubstr("\x1b")));
}

TEST(TerminalReport, CountsWhatItDoesNotShow) {
  RunReport report = small_report();
  report.collisions.assign(25, {3, "rapid move through material"});
  EXPECT_THAT(terminal_report(report), HasSubstr("and 15 more"));
}

TEST(TerminalReport, AnEmptyRunIsStillAPage) {
  EXPECT_THAT(terminal_report(RunReport{}), HasSubstr("Untitled run"));
}

}  // namespace
}  // namespace frustum::report
