#include "report/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <thread>

namespace frustum::report {
namespace {

using testing::HasSubstr;

// A clock that the test turns.
struct Turned {
  double seconds = 0.0;
  std::ostringstream out{};
  Progress progress;

  explicit Turned(ProgressStyle style) : progress(out, style, [this] { return seconds; }) {}

  void work(double until, int parts) {
    const double start = seconds;
    progress.begin("cutting");
    for (int k = 1; k <= parts; ++k) {
      seconds = start + until * k / parts;
      progress.at(static_cast<double>(k) / parts);
    }
    progress.end();
  }
};

TEST(Progress, IsSilentUnderASecond) {
  for (const ProgressStyle style : {ProgressStyle::bar, ProgressStyle::log}) {
    Turned turned(style);
    turned.work(0.99, 100);
    turned.work(0.99, 100);
    EXPECT_EQ(turned.out.str(), "");
  }
}

TEST(Progress, IsSilentWhenAsked) {
  Turned turned(ProgressStyle::silent);
  turned.work(60.0, 100);
  EXPECT_EQ(turned.out.str(), "");
}

TEST(Progress, WritesPlainLinesIntoALog) {
  Turned turned(ProgressStyle::log);
  turned.work(10.0, 100);
  EXPECT_EQ(turned.out.str(),
            "cutting: 25 %\ncutting: 50 %\ncutting: 75 %\ncutting: done in 10.0 s\n");
}

TEST(Progress, RedrawsOneLineAndWipesItAtTheEnd) {
  Turned turned(ProgressStyle::bar);
  turned.work(10.0, 10);
  const std::string text = turned.out.str();
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_THAT(text,
              HasSubstr("cutting [####################....................]  50 %, 5 s left"));
  EXPECT_EQ(text.substr(text.size() - 4), "\r\x1b[K");
}

TEST(Progress, NeverRunsBackwards) {
  Turned turned(ProgressStyle::bar);
  turned.progress.begin("cutting");
  turned.seconds = 2.0;
  turned.progress.at(0.8);
  turned.out.str("");
  turned.seconds = 3.0;
  turned.progress.at(0.2);
  EXPECT_THAT(turned.out.str(), HasSubstr(" 80 %"));
}

TEST(Progress, Fault2_41_IsDrawnThoughNobodyTellsAShare) {
  std::ostringstream out;
  {
    Progress progress(out, ProgressStyle::bar);
    progress.begin("cut");
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
  }
  EXPECT_NE(out.str().find("cut: 1 s"), std::string::npos) << out.str();
  EXPECT_TRUE(out.str().ends_with("\r\x1b[K")) << "the line is clean at the end";
}

TEST(Progress, Fault2_41_IsDrawnOnTerminalsThatCanDrawAlone) {
  EXPECT_EQ(style_on({true, "xterm", nullptr}), ProgressStyle::bar);
  EXPECT_EQ(style_on({true, "xterm", ""}), ProgressStyle::bar);
  EXPECT_EQ(style_on({true, "xterm", "1"}), ProgressStyle::log);
  EXPECT_EQ(style_on({true, "dumb", nullptr}), ProgressStyle::log);
  EXPECT_EQ(style_on({true, nullptr, nullptr}), ProgressStyle::log);
  EXPECT_EQ(style_on({false, "xterm", nullptr}), ProgressStyle::log);
}

}  // namespace
}  // namespace frustum::report
