#include "app/motion/measured_motion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/motion/test_file.hpp"
#include "calibration/identify/measured_tests.hpp"
#include "instruments/circle_trace_file.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/pose_trace_file.hpp"
#include "instruments/touch_trace_file.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using calibration::MeasuredMotion;

// What the table says besides the test.
struct MotionEntry {
  std::string name{};
  std::vector<fs::path> traces{};
  double noise = 0.0;  // 0: not said
  std::string ball{};
};

Diagnostic file_count(const MotionEntry& entry, const char* what) {
  return error("file-count"_id,
               fmt::format("{} is in one file, given are {}", what, entry.traces.size()));
}

class TestReader {
 public:
  TestReader(const MotionEntry& entry, const MotionSetup& setup) : entry_(entry), setup_(setup) {}

  Result<MeasuredMotion> operator()(const CircleWords& words) const {
    auto circle = circle_of_words(words, setup_);
    if (!circle) return circle.error();
    circle->feed.reset();  // lags are terms of the trace
    const auto all = traces_of(circle->length, words.stroke, circle->plane);
    if (!all) return all.error();
    calibration::BarRuns runs;
    for (const auto& trace : all->traces) {
      circle->sense = trace.sense;
      circle->angles = trace.angle;
      auto test = circle_test(setup_.machine, *circle);
      if (!test) return test.error();
      runs.push_back({trace.sense, *std::move(test), trace.deviation});
    }
    return measured_circle(setup_.machine, head(bar_ball()), runs);
  }

  Result<MeasuredMotion> operator()(const RotaryWords& words) const {
    const auto rotary = rotary_of_words(words, setup_);
    if (!rotary) return rotary.error();
    return turn(rotary->length, words.stroke, [&](const std::vector<double>& angles) {
      instruments::RotaryTest test = *rotary;
      test.angles = angles;
      return rotary_test(setup_.machine, test);
    });
  }

  Result<MeasuredMotion> operator()(const ConeMotionWords& words) const {
    const auto cone = cone_of_words(words, setup_);
    if (!cone) return cone.error();
    const bool normal = cone->sense == instruments::ConeSense::normal;
    return turn(normal ? cone->radius / std::cos(cone->cone_angle) : cone->radius, words.stroke,
                [&](const std::vector<double>& angles) {
                  instruments::ConeTest test = *cone;
                  test.angles = angles;
                  return cone_test(setup_.machine, test);
                });
  }

  Result<MeasuredMotion> operator()(const ChaseWords& words) const {
    if (entry_.traces.size() != 1) return file_count(entry_, "an R-test");
    const auto test = chase_of_words(words, setup_);
    if (!test) return test.error();
    const auto readings = read_pose_trace(entry_.traces.front(), setup_.machine, test->poses);
    if (!readings) return readings.error();
    return measured_chase(setup_.machine, head(ball_or("R-test ball")), *test, *readings);
  }

  Result<MeasuredMotion> operator()(const LineWords& /*words*/) const {
    return error(
        "line-in-study"_id,
        fmt::format("test '{}': a line along one axis reads its scale and its straightness, "
                    "which no constant error makes",
                    entry_.name),
        "diagonals read squareness; frustum motion trace evaluates a line");
  }

  Result<MeasuredMotion> operator()(const DiagonalWords& words) const {
    if (entry_.traces.size() != 1) return file_count(entry_, "a set of diagonals");
    const auto lines = diagonals_of_words(words, setup_);
    if (!lines) return lines.error();
    const auto readings = read_diagonal_trace(entry_.traces.front(), *lines);
    if (!readings) return readings.error();
    std::vector<instruments::LineTest> runs;
    std::vector<std::string> names;
    for (const auto& [signs, line] : *lines) {
      runs.push_back(line);
      names.push_back(signs);
    }
    return measured_diagonals(setup_.machine, head(""), names, runs, *readings);
  }

  Result<MeasuredMotion> operator()(const TouchWords& /*words*/) const {
    if (entry_.traces.size() != 1) return file_count(entry_, "a touch-trigger calibration");
    const auto plan = instruments::touch_plan(setup_.machine);
    if (!plan) return plan.error();
    const instruments::TouchProbe probe{.tool_length = setup_.tool_length};
    const auto readings = read_touches(entry_.traces.front(), *plan, probe.ball_radius);
    if (!readings) return readings.error();
    return measured_touches(setup_.machine, head(ball_or("probe ball")), *plan, probe, *readings);
  }

 private:
  [[nodiscard]] std::string ball_or(const std::string& usual) const {
    return entry_.ball.empty() ? usual : entry_.ball == "exact" ? "" : entry_.ball;
  }
  [[nodiscard]] std::string bar_ball() const { return ball_or("bar ball"); }
  [[nodiscard]] calibration::TestHead head(const std::string& ball) const {
    return {entry_.name, ball, setup_.tool_length,
            entry_.noise > 0.0 ? entry_.noise : setup_.instrument.noise};
  }
  [[nodiscard]] Result<instruments::CircleTraces> traces_of(
      double length, double stroke, std::optional<instruments::Plane> plane) const {
    instruments::CircleTraceWords reading{.plane = plane, .length = length, .stroke = stroke};
    if (!plane) reading.sense_may_be_missing = true;
    return read_circle_traces(entry_.traces, reading);
  }
  template <typename Make>
  [[nodiscard]] Result<MeasuredMotion> turn(double length, double stroke, const Make& make) const {
    const auto all = traces_of(length, stroke, std::nullopt);
    if (!all) return all.error();
    calibration::BarRuns runs;
    for (const auto& trace : all->traces) {
      auto test = make(trace.angle);
      if (!test) return test.error();
      runs.push_back({trace.sense, *std::move(test), trace.deviation});
    }
    return measured_turn(setup_.machine, head(bar_ball()), runs);
  }

  const MotionEntry& entry_;
  const MotionSetup& setup_;
};

}  // namespace

Result<StudyMotion> read_measured_motion(const TomlTable& table) {
  const fs::path file = table.file_path("test");
  MotionEntry entry{.name = table.text_or("name", file.stem().string())};
  for (const std::string& trace : table.texts_or("traces", {})) {
    entry.traces.push_back(table.folder() / trace);
  }
  if (entry.traces.empty()) {
    table.fail("traces", "nothing-measured"_id, "no measured readings",
               "traces = [\"trace.csv\"]: what frustum motion trace reads");
    return Diagnostics{};
  }
  entry.noise = table.length_or("noise", {0.0}, Bound::non_negative).value;
  entry.ball = table.text_or("ball", "");
  auto test = read_test_file(file);
  if (!test) return test.error();
  // Those of the virtual machine; what is looked for here is what was measured.
  MotionWords& words = common_words(*test);
  words.of_file = {};
  words.setup.clear();
  auto setup = motion_setup(words);
  if (!setup) return setup.error();
  if (std::holds_alternative<TouchWords>(*test)) setup->instrument.noise /= 2.0;  // two sd
  auto motion = std::visit(TestReader(entry, *setup), *test);
  if (!motion) return motion.error();
  return StudyMotion{std::move(setup->machine), *std::move(motion)};
}

}  // namespace frustum::app
