// Traces as measuring programs export them: every variant reads the same, every fault has its line.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/random.hpp"
#include "instruments/instrument.hpp"
#include "instruments/traces/circle_trace_file.hpp"
#include "instruments/traces/line_trace_file.hpp"

namespace frustum::instruments {
namespace {

namespace fs = std::filesystem;

class TraceFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        ("traces_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  Result<CircleTraces> read(const std::string& text, const CircleTraceWords& words = kWords) const {
    const std::vector<fs::path> files{file("t.csv", text)};
    return read_circle_traces(files, words);
  }
  // The id of the first fault and its line.
  std::string fault(const std::string& text, const CircleTraceWords& words = kWords) const {
    const auto traces = read(text, words);
    if (traces) return "accepted";
    const Diagnostic& d = traces.error().front();
    EXPECT_FALSE(d.file.empty()) << to_string(d);
    return std::string(d.id.text()) + ":" + std::to_string(d.line);
  }

  static inline const CircleTraceWords kWords{.plane = Plane::XY, .length = 150.0};
  fs::path folder_;
};

double deviation_um(double degrees) { return 3.0 * std::sin(2.0 * degrees * kRadPerDeg); }

std::string with_commas(std::string number) {
  const auto point = number.find('.');
  if (point != std::string::npos) number[point] = ',';
  return number;
}

TEST_F(TraceFiles, VariantsReadTheSame) {
  std::string point = "run,angle_deg,radial_um\n", comma = "angle_deg;radial_um;run\r\n";
  std::string tabs = "# run cw\nangle_deg\tradial_um\n";
  std::string timed = "# run ccw\n# radius 150\ntime_s,length_mm\n";
  std::string timed_cw = "# run cw\n# radius 150\n# plane XY\n# feed 1000\ntime_s,length_mm\n";
  for (int i = 0; i <= 360; ++i) {
    point += fmt::format("ccw,{},{:.12g}\n", i, deviation_um(i));
    comma += fmt::format("{};{};CCW\r\n", i, with_commas(fmt::format("{:.12g}", deviation_um(i))));
    timed += fmt::format("{},{:.15g}\n", 0.1 * i, 150.0 + deviation_um(i) / 1e3);
  }
  for (int i = 360; i >= 0; --i) {
    point += fmt::format("cw,{},{:.12g}\n", i, deviation_um(i));
    comma += fmt::format("{};{};cw\r\n", i, with_commas(fmt::format("{:.12g}", deviation_um(i))));
    tabs += fmt::format("{}\t{}\n", i, with_commas(fmt::format("{:.12g}", deviation_um(i))));
    timed_cw += fmt::format("{},{:.15g}\n", 36.0 - 0.1 * i, 150.0 + deviation_um(i) / 1e3);
  }
  const auto plain = read(point);
  ASSERT_TRUE(plain) << to_string(plain.error().front());
  const auto european = read(comma);
  ASSERT_TRUE(european) << to_string(european.error().front());
  const std::vector<fs::path> two{file("cw.csv", timed_cw), file("ccw.csv", timed)};
  const auto by_time = read_circle_traces(two, {});
  ASSERT_TRUE(by_time) << to_string(by_time.error().front());
  EXPECT_EQ(by_time->plane, Plane::XY);
  EXPECT_EQ(by_time->length, 150.0);
  EXPECT_EQ(by_time->feed, 1000.0);
  const auto one = read(tabs);
  ASSERT_TRUE(one) << to_string(one.error().front());
  ASSERT_EQ(one->traces.size(), 1U);
  EXPECT_EQ(one->traces[0].sense, Sense::cw);
  for (const auto* all : {&*plain, &*european, &*by_time}) {
    ASSERT_EQ(all->traces.size(), 2U);
    EXPECT_EQ(all->traces[0].sense, Sense::ccw);
    for (const CircleTrace& trace : all->traces) {
      ASSERT_EQ(trace.angle.size(), 361U);
      for (std::size_t i = 0; i < 361; ++i) {
        const double degrees =
            trace.sense == Sense::ccw ? static_cast<double>(i) : 360.0 - static_cast<double>(i);
        EXPECT_NEAR(trace.angle[i] * kDegPerRad, degrees, 1e-9);
        EXPECT_NEAR(trace.deviation[i] * 1e3, deviation_um(degrees), 1e-9);
      }
    }
  }
}

TEST_F(TraceFiles, FaultsHaveTheirLine) {
  const std::string head = "run,angle_deg,radial_um\n";
  EXPECT_EQ(fault(head + "ccw,0,0\nccw,1,0\nccw,2,0\nccw,1.5,0\n"), "angles-fall-back:5");
  EXPECT_EQ(fault(head + "cw,0,0\ncw,1,0\ncw,2,0\n"), "angles-fall-back:3");
  EXPECT_EQ(fault(head + "ccw,0,0\nccw,1,0\nccw,2,0\nccw,30,0\nccw,31,0\n"), "trace-gap:5");
  EXPECT_EQ(fault("angle_deg,radial_um\n0,0\n1,0\n"), "run-unknown:1");
  EXPECT_EQ(fault("# run up\nangle_deg,radial_um\n0,0\n1,0\n"), "unknown-choice:1");
  EXPECT_EQ(fault(head + "left,0,0\n"), "unknown-choice:2");
  EXPECT_EQ(fault("run,angle_rad,radial_um\nccw,0,0\n"), "unknown-column:1");
  EXPECT_EQ(fault("run,angle_deg,radial_nm\nccw,0,0\n"), "unknown-column:1");
  EXPECT_EQ(fault(head + "ccw,0,150000\n"), "stroke-exceeded:2");
  EXPECT_EQ(fault(head + "ccw,0\n"), "number-count:2");
  EXPECT_EQ(fault(head + "ccw,0,x\n"), "not-a-number:2");
  EXPECT_EQ(fault(head + "ccw,0,nan\n"), "not-a-number:2");
  EXPECT_EQ(fault(head), "no-samples:1");
  EXPECT_EQ(fault(""), "no-samples:0");
  EXPECT_EQ(fault("run,run,radial_um\nccw,0,0\n"), "given-twice:1");
  EXPECT_EQ(fault("run,angle_deg,time_s,radial_um\nccw,0,0,0\n"), "missing-column:1");
  EXPECT_EQ(fault("# radius 100\n" + head + "ccw,0,0\nccw,1,0\nccw,2,0\n"), "contradiction:1");
  EXPECT_EQ(fault("# plane YZ\n" + head + "ccw,0,0\nccw,1,0\nccw,2,0\n"), "contradiction:1");
  EXPECT_EQ(fault("# plane XQ\n" + head + "ccw,0,0\nccw,1,0\nccw,2,0\n"), "unknown-choice:1");
  EXPECT_EQ(fault("# radius big\n" + head + "ccw,0,0\nccw,1,0\nccw,2,0\n"), "not-a-number:1");
  EXPECT_EQ(fault("run,time_s,radial_um\nccw,0,0\nccw,1,0\nccw,0.5,0\nccw,2,0\n"), "times-fall:4");
  EXPECT_EQ(fault("run,angle_deg,length_mm\nccw,0,150\n", {}), "length-unknown:1");
  EXPECT_EQ(fault(head + "ccw,0,0\nccw,1,0\n"), "too-few-samples:2");
  const std::vector<fs::path> twice{file("a.csv", head + "ccw,0,0\nccw,1,0\nccw,2,0\n"),
                                    file("b.csv", head + "ccw,0,0\nccw,1,0\nccw,2,0\n")};
  const auto both = read_circle_traces(twice, kWords);
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().front().id.text(), "given-twice");
  const std::vector<fs::path> none{folder_ / "none.csv"};
  EXPECT_FALSE(read_circle_traces(none, kWords));
}

// Bytes of good files exchanged at random: what is accepted is finite, what is refused names its
// file.
TEST_F(TraceFiles, DamagedFilesDoNoHarm) {
  const std::vector<std::string> good{
      "# plane "
      "XY\nrun,angle_deg,radial_um\nccw,0,1.5\nccw,1,-2\nccw,2,0.25\ncw,2,1\ncw,1,0\ncw,0,0\n",
      "# radius 150\nrun;time_s;length_mm\nccw;0,1;150,001\nccw;0,2;150,002\nccw;0,3;149,9\n",
      "run,direction,target_mm,deviation_um\n1,up,0,1\n1,up,5,2\n1,down,5,0\n1,down,0,1\n"};
  const std::string bytes = "0123456789.,;-+e#\n\r\t \"ccwupdown\xff\xfenaninf";
  const RandomKey key{.seed = 31};
  int accepted = 0;
  for (std::uint64_t n = 0; n < 500; ++n) {
    std::string text = good[n % good.size()];
    for (std::uint64_t k = 0; k <= n % 2; ++k) {
      const auto draw = [&](std::uint64_t what, std::size_t count) {
        return static_cast<std::size_t>(uniform(key, 20 * n + 4 * k + what) *
                                        static_cast<double>(count));
      };
      text[draw(0, text.size())] = bytes[draw(1, bytes.size())];
    }
    const fs::path damaged = file("d.csv", text);
    const std::vector<fs::path> files{damaged};
    const auto circle = read_circle_traces(files, kWords);
    const auto line = read_line_trace(damaged);
    for (const Diagnostics* problems :
         {circle ? nullptr : &circle.error(), line ? nullptr : &line.error()}) {
      if (problems == nullptr) continue;
      EXPECT_FALSE(problems->front().file.empty()) << text;
    }
    if (!circle) continue;
    ++accepted;
    for (const CircleTrace& trace : circle->traces) {
      ASSERT_EQ(trace.angle.size(), trace.deviation.size());
      for (const double angle : trace.angle) EXPECT_TRUE(std::isfinite(angle)) << text;
      for (const double d : trace.deviation) EXPECT_LE(std::abs(d), 1.0) << text;
    }
  }
  EXPECT_GT(accepted, 10);
}

TEST_F(TraceFiles, LinesAreSortedByTargetAndRun) {
  const auto trace = read_line_trace(
      file("l.csv",
           "direction;target_mm;run;deviation_um\nup;37;1;1,5\nup;0;1;0,5\nup;0;2;0,7\n"
           "down;0;2;-0,5\ndown;0;1;-0,25\ndown;37;1;-1\nup;37;2;2\ndown;37;2;-2\n"));
  ASSERT_TRUE(trace) << to_string(trace.error().front());
  EXPECT_EQ(trace->targets, (std::vector<double>{0.0, 37.0}));
  EXPECT_NEAR(trace->up[0][1] * 1e3, 0.7, 1e-12);
  EXPECT_NEAR(trace->down[0][0] * 1e3, -0.25, 1e-12);
  EXPECT_NEAR(trace->down[1][1] * 1e3, -2.0, 1e-12);
}

TEST_F(TraceFiles, FaultsOfLinesHaveTheirLine) {
  const std::string head = "run,direction,target_mm,deviation_um\n";
  const auto line_fault = [&](const std::string& text) {
    const auto trace = read_line_trace(file("l.csv", text));
    if (trace) return std::string("accepted");
    const Diagnostic& d = trace.error().front();
    return std::string(d.id.text()) + ":" + std::to_string(d.line);
  };
  EXPECT_EQ(line_fault(head + "1,up,0,0\n"), "direction-missing:1");
  EXPECT_EQ(line_fault(head + "1,left,0,0\n"), "unknown-choice:2");
  EXPECT_EQ(line_fault(head + "1,up,0,0\n1,up,0,1\n"), "given-twice:3");
  EXPECT_EQ(line_fault(head + "1,up,0,0\n1,down,0,0\n1,up,5,0\n"), "target-missing:1");
  EXPECT_EQ(line_fault(head + "1,up,0,0\n1,down,0,0\n2,down,0,0\n"), "too-few-runs:1");
  EXPECT_EQ(line_fault("run,direction,target_mm\n1,up,0\n"), "missing-column:1");
}

// A machine that the evaluation does not know, a noisy bar, three ways to write its trace:
// squareness and backlash are within their stated intervals as often as they should be.
TEST_F(TraceFiles, BlindTracesAreWithinTheirIntervals) {
  const RandomKey key{.seed = 2024};
  constexpr int kMachines = 300;
  std::array<int, 3> held{};
  for (int n = 0; n < kMachines; ++n) {
    const auto draw = static_cast<std::uint64_t>(n) * 10;
    const double square = 30.0 * normal(key, draw), first = 5.0 * normal(key, draw + 1),
                 noise = 0.1 + 0.4 * uniform(key, draw + 2);
    const auto reading = [&](double degrees, double w) {
      const double phi = degrees * kRadPerDeg, c = std::cos(phi), s = std::sin(phi);
      const double head = s > 0.0 ? -w : w;
      return -0.075 * square * std::sin(2.0 * phi) - 0.5 * first * head * c + 2.0 * c;
    };
    const Instrument bar{.noise = noise, .seed = static_cast<std::uint64_t>(n)};
    std::string text = n % 3 == 0   ? "run,angle_deg,radial_um\n"
                       : n % 3 == 1 ? "angle_deg;run;radial_um\n"
                                    : "# radius 150\nrun\ttime_s\tlength_mm\n";
    for (const double w : {1.0, -1.0}) {
      std::vector<double> um;
      for (int i = 0; i <= 360; ++i) um.push_back(reading(w > 0.0 ? i : 360 - i, w));
      um = shown(bar, um, w > 0.0 ? 0 : 1);
      for (int i = 0; i <= 360; ++i) {
        const double r = um[static_cast<std::size_t>(i)];
        const int degrees = w > 0.0 ? i : 360 - i;
        const char* run = w > 0.0 ? "ccw" : "cw";
        text += n % 3 == 0   ? fmt::format("{},{},{:.6f}\n", run, degrees, r)
                : n % 3 == 1 ? with_commas(fmt::format("{};{};{:.6f}\n", degrees, run, r))
                             : fmt::format("{}\t{}\t{:.9f}\n", run, 0.1 * i, 150.0 + r / 1e3);
      }
    }
    const auto traces = read(text);
    ASSERT_TRUE(traces) << to_string(traces.error().front());
    const auto found = signature(traces->traces, traces->length);
    ASSERT_TRUE(found);
    const auto within = [&](SignatureTerm term, double truth, double unit) {
      const auto k = static_cast<std::size_t>(term);
      return std::abs(found->value[k] * unit - truth) <= 1.96 * found->sd[k] * unit;
    };
    held[0] += within(SignatureTerm::square, square, 1e6) ? 1 : 0;
    held[1] += within(SignatureTerm::backlash_1, first, 1e3) ? 1 : 0;
    held[2] += within(SignatureTerm::backlash_2, 0.0, 1e3) ? 1 : 0;
  }
  for (const int each : held) {  // 95 % of 300 is 285, with a standard deviation of 4
    EXPECT_GE(each, 273);
    EXPECT_LE(each, 297);
  }
}

// A recording by time: 1.5 mm outside, in, half a turn, a turn that counts, half a turn, out.
std::string recording(const std::string& run, double squareness_um) {
  constexpr double kRate = 50.0, kFeed = 1000.0 / 60.0, kBar = 150.0;  // 1/s, mm/s, mm
  const double in = 1.5 / kFeed, turn = 4.0 * 180.0 * kRadPerDeg * kBar / kFeed;
  const double w = run == "ccw" ? 1.0 : -1.0;
  std::string text;
  for (int i = 0;; ++i) {
    const double t = i / kRate - 1.0 - in;  // 0: where the bar has come in
    if (t > turn + in + 1.0) return text;
    double r = 1.5;
    if (t > -in && t < 0.0) r = -t * kFeed;
    if (t >= 0.0 && t <= turn) {
      const double phi = -180.0 * kRadPerDeg + 4.0 * 180.0 * kRadPerDeg * t / turn;
      r = -squareness_um * 1e-3 * std::sin(2.0 * w * phi);
    }
    if (t > turn && t < turn + in) r = (t - turn) * kFeed;
    text += fmt::format("{},{:.4f},{:.7f}\n", run, t + 100.0, kBar + r);
  }
}

// A bar measures no angle: the way between feed-in and feed-out is divided evenly.
TEST_F(TraceFiles, TimesBetweenTheMarksOfFeedInAndFeedOut) {
  CircleTraceWords words = kWords;
  words.marks = true;
  const std::string text = "run,time_s,length_mm\n" + recording("ccw", 5.0) + recording("cw", 5.0);
  const auto all = read(text, words);
  ASSERT_TRUE(all.has_value()) << to_string(all.error().front());
  ASSERT_EQ(all->traces.size(), 2U);
  for (const CircleTrace& trace : all->traces) {
    EXPECT_NEAR(static_cast<double>(trace.angle.size()), 2827.0, 2.0);  // of 56.5 s
    for (std::size_t i = 0; i < trace.angle.size(); ++i) {
      EXPECT_GE(trace.angle[i], 0.0);
      EXPECT_LE(trace.angle[i], 360.0 * kRadPerDeg);
      // 0.003 deg: what samples each 20 ms say of the marks.
      EXPECT_NEAR(trace.deviation[i], -5e-3 * std::sin(2.0 * trace.angle[i]), 1e-6);
    }
  }
  const auto found = signature(all->traces, 150.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((*found)[SignatureTerm::square], 2.0 * 5e-3 / 150.0, 1e-8);
  // Without the option the ramps are beyond the stroke.
  EXPECT_TRUE(fault(text).starts_with("stroke-exceeded:"));
  // A recording that begins on the circle has no mark.
  std::string cut = "run,time_s,length_mm\n";
  for (int i = 0; i < 2000; ++i) cut += fmt::format("ccw,{},{}\n", 0.02 * i, 150.001);
  EXPECT_TRUE(fault(cut, words).starts_with("marks-missing:"));
  // Another bar, a pause between feed-in and circle, marks that nobody said are there.
  words.length = 149.75;
  std::string other = "run,time_s,length_mm\n";
  for (int i = 0; i < 2000; ++i) other += fmt::format("ccw,{},{}\n", 0.02 * i, 150.001);
  EXPECT_TRUE(fault(other, words).starts_with("stroke-exceeded:"));
  words.length = 150.0;
  EXPECT_TRUE(read("# feed 1000 mm/min\n" + text, words).has_value());
  EXPECT_TRUE(fault("# feed 1200\n" + text, words).starts_with("time-mismatch:"));
  words.marks = false;
  words.stroke = 2.0;
  EXPECT_TRUE(fault(text, words).starts_with("marks-in-recording:"));
}

TEST_F(TraceFiles, OptionsOfTimesAreNotOfAngles) {
  const std::string text = "run,angle_deg,radial_um\nccw,0,1\nccw,120,2\nccw,240,3\n";
  CircleTraceWords words = kWords;
  words.marks = true;
  EXPECT_TRUE(fault(text, words).starts_with("angles-stated:"));
  words = kWords;
  words.capture = {0.0, 1.0};
  EXPECT_TRUE(fault(text, words).starts_with("angles-stated:"));
}

TEST_F(TraceFiles, NumbersOfCommentsHaveTheirUnit) {
  const std::string rows = "run,angle_deg,radial_um\nccw,0,1\nccw,120,2\nccw,240,3\n";
  CircleTraceWords words = kWords;
  words.length.reset();
  for (const char* radius : {"15 cm", "6 inch", "0.15 m", "15cm"}) {
    EXPECT_TRUE(
        fault(std::string("# radius ") + radius + "\n" + rows, words).starts_with("wrong-unit:"))
        << radius;
  }
  for (const char* radius : {"150 mm", "150mm", "150", "1.5e2"}) {
    const auto all = read(std::string("# radius ") + radius + "\n" + rows, words);
    ASSERT_TRUE(all.has_value()) << radius;
    EXPECT_EQ(all->length, 150.0);
  }
  // A plane where a rotary axis turns.
  words.length = 150.0;
  words.plane.reset();
  words.of_rotary_axis = true;
  EXPECT_TRUE(fault("# plane XY\n" + rows, words).starts_with("contradiction:"));
}

}  // namespace
}  // namespace frustum::instruments
