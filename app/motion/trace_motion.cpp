#include "app/motion/trace_motion.hpp"

#include <fmt/format.h>

#include <sstream>

#include "app/job/number_list.hpp"
#include "app/motion/circle_report.hpp"
#include "app/motion/line_motion.hpp"
#include "app/motion/residual_report.hpp"
#include "app/motion/setup_found.hpp"
#include "app/motion/touch_report.hpp"
#include "core/counted.hpp"
#include "core/program_version.hpp"
#include "instruments/ball_maps.hpp"
#include "instruments/chase_test.hpp"
#include "instruments/touch_test.hpp"
#include "instruments/traces/circle_trace_file.hpp"
#include "instruments/traces/line_trace_file.hpp"
#include "instruments/traces/pose_trace_file.hpp"
#include "instruments/traces/touch_trace_file.hpp"

namespace frustum::app {
namespace {

using instruments::CircleTraces;
using instruments::CircleTraceWords;
using instruments::kSignatureTerms;
using instruments::SignatureTerm;

Document trace_head(const std::string& test, const TraceWords& words) {
  return {{"schema", "frustum/motion/1"},
          {"version", program_version()},
          {"test", test},
          {"files", words.files}};
}

Result<CircleTraceWords> reading_words(const TraceWords& words) {
  if (auto problem = no_stroke(words.stroke, "--stroke")) return *std::move(problem);
  CircleTraceWords reading{.stroke = words.stroke};
  if (!words.plane.empty()) {
    reading.plane = instruments::plane_named(words.plane);
    if (!reading.plane) return unknown_word("--plane", words.plane, {"XY", "YZ", "ZX"});
  }
  if (words.length) {
    if (!(*words.length > 0.0)) {
      return error("out-of-range"_id,
                   fmt::format("--length {}: expected a length above 0 mm", *words.length));
    }
    reading.length = words.length;
  }
  if (words.angle == "feed") {
    reading.marks = true;
    if (words.overshoot && !(*words.overshoot >= 0.0 && *words.overshoot <= 360.0)) {
      return error("out-of-range"_id,
                   fmt::format("--overshoot {}: expected degrees, 0 to 360", *words.overshoot));
    }
    if (words.overshoot) reading.overshoot = *words.overshoot * kRadPerDeg;
  } else if (words.overshoot) {
    return error("conflicting-options"_id, "--overshoot is of times between marks",
                 "add --angle feed, or leave it out");
  }
  if (words.capture.empty()) return reading;
  const auto arc = numbers_of(words.capture, 2, "--capture");
  if (!arc) return arc.error();
  if (!((*arc)[1] > (*arc)[0])) {
    return error("out-of-range"_id,
                 fmt::format("--capture {}: expected a growing arc", words.capture),
                 "for example --capture=-20,200");
  }
  reading.capture = {(*arc)[0] * kRadPerDeg, (*arc)[1] * kRadPerDeg};
  return reading;
}

// Of measured readings: the first line of the text, and the title of the page.
MotionAnswer trace_answer_of(const char* test, const TraceWords& words, const std::string& line,
                             const std::string& title) {
  MotionAnswer answer{.document = trace_head(test, words),
                      .text = line + "\n",
                      .words = report::Wording(words.style)};
  answer.page.style = words.style;
  answer.page.title = title;
  return answer;
}

// Which terms of the circle the trace tells.
void add_told_terms(MotionAnswer& answer, const CircleTraces& all) {
  std::vector<std::string> told, not_told;
  if (const auto found = instruments::signature(all.traces, all.length)) {
    const auto which = told_terms(all.traces, *found, all.length);
    const auto value = [&](SignatureTerm term) {
      return found->value[static_cast<std::size_t>(term)];
    };
    add_setup_found(answer, value(SignatureTerm::cx), value(SignatureTerm::cy),
                    value(SignatureTerm::r0));
    for (std::size_t k = 0; k < kSignatureTerms; ++k) {
      (which[k] ? told : not_told).emplace_back(text_of(static_cast<SignatureTerm>(k)).name);
    }
  }
  answer.document["told"] = told;
  answer.document["not_told"] = not_told;
  for (auto* names : {&told, &not_told}) {
    for (std::string& each : *names) each = answer.words.word(each);
  }
  answer.page.told = told;
  answer.page.not_told = not_told;
  if (!not_told.empty()) {
    answer.text += answer.words("not identified by these arcs: {0}",
                                fmt::format("{}", fmt::join(not_told, " "))) +
                   "\n";
  }
}

Result<MotionAnswer> circle_trace(const TraceWords& words) {
  const auto reading = reading_words(words);
  if (!reading) return reading.error();
  const std::vector<std::filesystem::path> files(words.files.begin(), words.files.end());
  const auto all = read_circle_traces(files, *reading);
  if (!all) return all.error();
  const report::Wording wording(words.style);
  const std::string bar = wording.amount(all->length, "mm");
  MotionAnswer answer = trace_answer_of(
      "trace", words, wording("Measured circle in {0}, bar of {1}", name_of(all->plane), bar),
      wording("Measured circle in {0}", name_of(all->plane)));
  answer.document["plane"] = name_of(all->plane);
  answer.document["length_mm"] = all->length;
  answer.page.facts = {{wording("Bar"), bar}};
  if (all->feed) answer.document["feed_mm_min"] = *all->feed;
  if (all->temperature) answer.document["temperature_degC"] = *all->temperature;
  for (const auto& trace : all->traces) {
    const std::string sense(name_of(trace.sense));
    answer.document[sense + "_angles_deg"] = in_degrees(trace.angle);
    answer.document[sense + "_um"] = in_um(trace.deviation);
  }
  add_circle_evaluation(answer, all->traces, all->length, all->plane);
  add_told_terms(answer, *all);
  return answer;
}

Result<MotionAnswer> line_trace(const TraceWords& words) {
  if (words.files.size() != 1) {
    return error("file-count"_id,
                 fmt::format("a line is in one file, given are {}", words.files.size()));
  }
  const auto letter = kinematics::axis_named(words.axis);
  if (!letter) return unknown_word("--axis", words.axis, {"X", "Y", "Z", "A", "B", "C"});
  const auto line = instruments::read_line_trace(words.files.front());
  if (!line) return line.error();
  const std::string title = report::Wording(words.style)("Measured line along {0}", words.axis);
  MotionAnswer answer = trace_answer_of("line", words, title, title);
  answer.document["axis"] = words.axis;
  answer.document["targets_mm"] = line->targets;
  if (auto problem = add_positioning(answer, line->targets, line->up, line->down)) {
    for (Diagnostic& each : *problem) each.file = words.files.front();
    return *std::move(problem);
  }
  answer.document["told"] = std::vector{fmt::format("E{0}{0}", words.axis)};
  answer.document["not_told"] = std::vector<std::string>{};
  return answer;
}

// The machine whose axes A and C are calibrated, and where its table stands for that.
struct Calibration {
  MotionSetup setup;
  instruments::TouchPlan plan{};
};
Result<Calibration> calibration_of(const TraceWords& words) {
  MotionWords of_machine;
  of_machine.machine = words.machine;
  of_machine.noise = words.noise;
  auto setup = motion_setup(of_machine);
  if (!setup) return setup.error();
  auto plan = instruments::touch_plan(setup->machine);
  if (!plan) return plan.error();
  return Calibration{*std::move(setup), *std::move(plan)};
}

Result<MotionAnswer> touch_trace(const TraceWords& words) {
  if (words.files.size() != 1) {
    return error("file-count"_id, fmt::format("the touches of a calibration are in one file, given "
                                              "are {}",
                                              words.files.size()));
  }
  const auto calibration = calibration_of(words);
  if (!calibration) return calibration.error();
  const auto& [setup, plan] = *calibration;
  const auto readings =
      instruments::read_touches(words.files.front(), plan, instruments::TouchProbe{}.ball_radius);
  if (!readings) return readings.error();
  const report::Wording wording(words.style);
  MotionAnswer answer =
      trace_answer_of("touch", words, wording("Measured touches on {0}", setup.machine.name()),
                      wording("Measured touch-trigger calibration of A and C"));
  answer.document["machine"] = setup.machine.name();
  answer.page.facts = {{wording("Machine"), setup.machine.title()}};
  const double noise = setup.instrument.noise / 2.0;
  answer.document["noise_um"] = noise * kUmPerMm;
  add_touch_findings(answer, setup.machine, plan,
                     {.readings = *readings,
                      .identified = identified_maps(plan, *readings),
                      .sd = standard_deviations(plan, noise)});
  add_touch_residuals(answer, plan, *readings, noise);
  answer.files.erase("touches.csv");  // is what was given
  return answer;
}

// R-tests with three balls at the positions of the calibration: maps of A and C.
Result<MotionAnswer> ball_trace(const TraceWords& words) {
  const auto calibration = calibration_of(words);
  if (!calibration) return calibration.error();
  const auto& [setup, plan] = *calibration;
  std::vector<Vec3> balls;
  std::istringstream in(words.balls);
  for (std::string part; std::getline(in, part, ';');) {
    const auto ball = place_of(part, "--balls");
    if (!ball) return ball.error();
    balls.push_back(*ball);
  }
  if (balls.size() != words.files.size()) {
    return error("file-count"_id,
                 fmt::format("{} and {}: an R-test each", counted(balls.size(), "ball"),
                             counted(words.files.size(), "file")));
  }
  std::vector<std::vector<Vec3>> readings;
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const auto test = instruments::chase_test(setup.machine, {balls[k], ball_poses(plan), 0.0});
    if (!test) return test.error();
    auto read = instruments::read_pose_trace(words.files[k], setup.machine, test->poses);
    if (!read) return read.error();
    readings.push_back(*std::move(read));
  }
  auto identified = instruments::maps_of_balls(plan, balls, readings);
  if (!identified) return identified.error();
  auto sd = instruments::deviations_of_balls(plan, balls, setup.instrument.noise);
  if (!sd) return sd.error();
  const report::Wording wording(words.style);
  MotionAnswer answer = trace_answer_of(
      "chase", words, wording("R-tests with {0} balls on {1}", balls.size(), setup.machine.name()),
      wording("Errors of A and C from R-tests"));
  answer.document["machine"] = setup.machine.name();
  answer.page.facts = {{wording("Machine"), setup.machine.title()}};
  answer.document["noise_um"] = setup.instrument.noise * kUmPerMm;
  add_touch_findings(answer, setup.machine, plan,
                     {.identified = *std::move(identified), .sd = *std::move(sd)});
  add_ball_residuals(answer, plan, balls, readings, words.files, setup.instrument.noise);
  return answer;
}

}  // namespace

Result<MotionAnswer> trace_answer(const TraceWords& words) {
  if (!words.machine.empty()) {
    if (!words.axis.empty() || !words.plane.empty()) {
      return error("conflicting-options"_id, "--machine is of touches, which have no plane or axis",
                   "--plane for a circle of a ball bar, --axis for a line of a laser");
    }
    return words.balls.empty() ? touch_trace(words) : ball_trace(words);
  }
  if (!words.noise.empty()) {
    return error("conflicting-options"_id, "--noise is that of touches", "give --machine, too");
  }
  if (!words.axis.empty() && !words.plane.empty()) {
    return error("conflicting-options"_id, "give either --plane or --axis",
                 "--plane for a circle of a ball bar, --axis for a line of a laser");
  }
  return words.axis.empty() ? circle_trace(words) : line_trace(words);
}

}  // namespace frustum::app
