#include "app/motion/measured_motion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/motion/test_file.hpp"
#include "calibration/identify/measured_tests.hpp"
#include "core/units.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/traces/circle_trace_file.hpp"
#include "instruments/traces/pose_trace_file.hpp"
#include "instruments/traces/touch_trace_file.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using calibration::MeasuredMotion;

// What the table says besides the test.
struct MotionEntry {
  std::string name{};
  std::vector<fs::path> traces{};
  double noise = 0.0;    // 0: not said
  bool planned = false;  // at the test's own angles, where nothing is off
  std::string ball{};
  std::optional<double> ball_known_to{};
  bool marks = false;                 // as of CircleTraceWords
  std::optional<double> overshoot{};  // rad
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
    const auto all = traces_of(circle->length, words.stroke, circle->plane, circle->angles);
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
    return turn(rotary->length, words.stroke, rotary->angles,
                [&](const std::vector<double>& angles) {
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
                cone->angles, [&](const std::vector<double>& angles) {
                  instruments::ConeTest test = *cone;
                  test.angles = angles;
                  return cone_test(setup_.machine, test);
                });
  }

  Result<MeasuredMotion> operator()(const ChaseWords& words) const {
    const auto test = chase_of_words(words, setup_);
    if (!test) return test.error();
    if (entry_.planned) {
      return measured_chase(setup_.machine, head(ball_or("R-test ball")), *test,
                            std::vector(test->poses.size(), Vec3(Vec3::Zero())));
    }
    if (entry_.traces.size() != 1) return file_count(entry_, "an R-test");
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
    if (!entry_.planned && entry_.traces.size() != 1) {
      return file_count(entry_, "a set of diagonals");
    }
    const auto lines = diagonals_of_words(words, setup_);
    if (!lines) return lines.error();
    std::vector<std::vector<double>> readings;
    for (const auto& [signs, line] : *lines) readings.emplace_back(line.poses.size(), 0.0);
    if (!entry_.planned) {
      auto read = read_diagonal_trace(entry_.traces.front(), *lines);
      if (!read) return read.error();
      readings = *std::move(read);
    }
    std::vector<instruments::LineTest> runs;
    std::vector<std::string> names;
    for (const auto& [signs, line] : *lines) {
      runs.push_back(line);
      names.push_back(signs);
    }
    return measured_diagonals(setup_.machine, head(""), names, runs, readings);
  }

  Result<MeasuredMotion> operator()(const TouchWords& /*words*/) const {
    const auto plan = instruments::touch_plan(setup_.machine);
    if (!plan) return plan.error();
    const instruments::TouchProbe probe{.tool_length = setup_.tool_length};
    if (entry_.planned) {
      const std::vector<double> none(plan->touches.size(), 0.0);
      return measured_touches(setup_.machine, head(ball_or("probe ball")), *plan, probe, none);
    }
    if (entry_.traces.size() != 1) return file_count(entry_, "a touch-trigger calibration");
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
      double length, double stroke, std::optional<instruments::Plane> plane,
      const std::vector<double>& own_angles) const {
    if (entry_.planned) {
      instruments::CircleTraces all{.length = length};
      for (const instruments::Sense sense : instruments::kSenses) {
        if (!plane && sense == instruments::Sense::cw) break;
        all.traces.push_back({sense, own_angles, std::vector<double>(own_angles.size(), 0.0)});
      }
      return all;
    }
    instruments::CircleTraceWords reading{.plane = plane, .length = length, .stroke = stroke};
    reading.of_rotary_axis = !plane;
    reading.marks = entry_.marks;
    reading.overshoot = entry_.overshoot;
    return read_circle_traces(entry_.traces, reading);
  }
  template <typename Make>
  [[nodiscard]] Result<MeasuredMotion> turn(double length, double stroke,
                                            const std::vector<double>& own_angles,
                                            const Make& make) const {
    const auto all = traces_of(length, stroke, std::nullopt, own_angles);
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

// Faults of the test's file where they name a key of it, else of the table that names the test.
Result<std::optional<StudyMotion>> refused(const TomlTable& table, const TestFile& test,
                                           const Diagnostics& problems) {
  Diagnostics of_file;
  for (const Diagnostic& each : problems) {
    if (each.file.empty() && each.key.empty()) {
      table.fail("test", each);
    } else {
      of_file.push_back(each);
    }
  }
  if (of_file.empty()) return std::optional<StudyMotion>{};
  return in_test_file(test, std::move(of_file));
}

// A standard deviation, where the key is there and is one.
std::optional<double> read_deviation(const TomlTable& table, const char* key, const char* hint) {
  const std::string text = table.text_or(key, "");
  if (text.empty()) return std::nullopt;
  const auto quantity = parse_quantity(text);
  if (quantity && quantity->kind == UnitKind::length && quantity->value > 0.0) {
    return quantity->value;
  }
  table.fail(key, "wrong-unit"_id, fmt::format("'{}' is no length above 0 with its unit", text),
             hint);
  return std::nullopt;
}

Result<std::optional<StudyMotion>> read_motion(const TomlTable& table, bool planned) {
  const fs::path file = table.file_path("test");
  if (!table.has("test")) return std::optional<StudyMotion>{};  // which is said
  MotionEntry entry{.name = table.text_or("name", file.stem().string())};
  for (const std::string& trace : table.texts_or("traces", {})) {
    entry.traces.push_back(table.folder() / trace);
  }
  entry.planned = planned;
  if (entry.traces.empty() && !planned) {
    table.fail("traces", "nothing-measured"_id, "no measured readings",
               "traces = [\"trace.csv\"]: what frustum motion trace reads");
    for (const char* key : {"noise", "ball", "ball_uncertainty", "angle", "overshoot"})
      (void)table.has(key);  // known, though not read
    return std::optional<StudyMotion>{};
  }
  entry.noise = read_deviation(table, "noise",
                               "a standard deviation, for example noise = \"0.3um\"; without it "
                               "residuals say it")
                    .value_or(0.0);
  const std::string angle = table.text_or("angle", "commanded");
  if (angle != "commanded" && angle != "feed") {
    table.fail("angle", "unknown-choice"_id, fmt::format("'{}' is not known", angle),
               "feed: times between feed-in and feed-out; commanded: over the capture");
  }
  entry.marks = angle == "feed";
  if (table.has("overshoot")) {
    const double overshoot = table.number("overshoot");
    entry.overshoot = overshoot * kRadPerDeg;
    if (!entry.marks || !(overshoot >= 0.0 && overshoot <= 360.0)) {
      table.fail("overshoot", "out-of-range"_id, fmt::format("{:g}", overshoot),
                 "degrees, 0 to 360, of recordings with angle = \"feed\"");
    }
  }
  entry.ball = table.text_or("ball", "");
  entry.ball_known_to =
      read_deviation(table, "ball_uncertainty",
                     "one standard deviation of X, Y and Z of the ball, for example \"30um\"");
  if (entry.ball_known_to && entry.ball == "exact") {
    table.fail("ball_uncertainty", "contradiction"_id, "an exact ball has no uncertainty",
               "leave out one of ball and ball_uncertainty");
  }
  auto test = read_test_file(file);
  if (!test) return test.error();
  // Those of the virtual machine; what is looked for here is what was measured.
  MotionWords& words = common_words(test->words);
  words.of_file = {};
  words.setup.clear();
  auto setup = motion_setup(words);
  if (!setup) return refused(table, *test, setup.error());
  if (std::holds_alternative<TouchWords>(test->words)) setup->instrument.noise /= 2.0;  // two sd
  auto motion = std::visit(TestReader(entry, *setup), test->words);
  if (!motion) return refused(table, *test, motion.error());
  motion->ball_known_to = entry.ball_known_to;
  return std::optional(StudyMotion{std::move(setup->machine), *std::move(motion)});
}

}  // namespace

Result<std::optional<StudyMotion>> read_measured_motion(const TomlTable& table) {
  return read_motion(table, false);
}

Result<std::optional<StudyMotion>> read_planned_motion(const TomlTable& table) {
  return read_motion(table, true);
}

}  // namespace frustum::app
