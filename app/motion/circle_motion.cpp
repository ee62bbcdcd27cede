#include "app/motion/circle_motion.hpp"

#include <fmt/format.h>

#include <array>

#include "app/motion/circle_dynamics.hpp"
#include "app/motion/circle_report.hpp"
#include "app/motion/motion_dynamics.hpp"
#include "app/motion/setup_found.hpp"
#include "app/motion/setup_sheet.hpp"
#include "app/motion/test_program.hpp"
#include "core/constants.hpp"
#include "instruments/approach.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/reach.hpp"
#include "instruments/readings.hpp"
#include "instruments/sample_angles.hpp"

namespace frustum::app {
namespace {

using instruments::CircleTest;
using instruments::CircleTrace;
using instruments::MotionTest;
using instruments::Sense;

// Both senses in place of the analytic samples.
Result<double> take_program_readings(const CircleWords& words, const MotionSetup& setup,
                                     const CircleTest& circle, std::vector<CircleTrace>& traces) {
  CircleTest commanded = circle;
  commanded.feed.reset();
  const auto test = circle_test(setup.machine, commanded);
  if (!test) return test.error();
  BarOfProgram bar{.test = *test,
                   .parameter = circle_parameter(setup.machine, circle),
                   .name = "phi",
                   .origin = programs::circle_origin(setup.machine, circle),
                   .stroke = words.stroke,
                   .servo_lag = words.feed.has_value()};
  for (const CircleTrace& trace : traces) bar.expected.push_back(trace.deviation);
  auto found = readings_by_program(words.nc, setup, bar, instruments::kSenses);
  if (!found) return found.error();
  for (std::size_t k = 0; k < traces.size(); ++k) traces[k].deviation = found->shown[k];
  return found->largest_difference;
}

// To be written, where that is asked for.
std::optional<Diagnostics> add_circle_program(MotionAnswer& answer, const CircleWords& words,
                                              const MotionSetup& setup, const CircleTest& circle,
                                              const MotionTest& test,
                                              const std::vector<CircleTrace>& traces) {
  if (!words.nc.written()) return std::nullopt;
  auto options = program_options(words.nc);
  if (!options) return options.error();
  if (words.feed) options->feed = *words.feed;
  const auto program = programs::circle_program(setup.machine, circle, *options);
  if (auto problem = add_program(answer, program)) return problem;
  std::vector<double> readings = traces[0].deviation;
  readings.insert(readings.end(), traces[1].deviation.begin(), traces[1].deviation.end());
  return add_setup_sheet(answer,
                         {setup.machine, test, *program, "phi", words.stroke, std::move(readings)});
}

}  // namespace

Result<CircleTest> circle_of_words(const CircleWords& words, const MotionSetup& setup) {
  const auto plane = instruments::plane_named(words.plane);
  if (!plane) return unknown_word(words.option("plane"), words.plane, {"XY", "YZ", "ZX"});
  const auto centre = place_of(words.centre, words.option("center"));
  if (!centre) return centre.error();
  const auto angles = angle_list(words.angles, words.option("angles"));
  if (!angles) return angles.error();
  const auto held = held_axes(setup.machine, words.at, words.option("at"), kinematics::kLinearAxes);
  if (!held) return held.error();
  CircleTest circle{.plane = *plane,
                    .length = words.length,
                    .centre = *centre,
                    .held = *held,
                    .tool_length = setup.tool_length};
  circle.angles =
      *angles ? **angles : instruments::midpoints(0.0, kTurn, instruments::kSamplesOfATurn);
  const auto feed = feed_per_second(words);
  if (!feed) return feed.error();
  circle.feed = *feed;
  return circle;
}

Result<MotionAnswer> circle_answer(const CircleWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  auto circle = circle_of_words(words, *setup);
  if (!circle) return circle.error();
  const std::optional<double> feed = circle->feed;
  const auto moved = motion_dynamics(words, *setup, feed, circle->held);
  if (!moved) return moved.error();
  // The lag by servo gains is another model of the same drives.
  if (moved->is_on()) circle->feed.reset();
  const kinematics::ForwardChain actual(setup->machine, setup->errors, setup->tool_length);
  // Of a program's run the analytic samples are what it is compared with.
  const auto instrument = words.nc.run ? instruments::Instrument{} : setup->instrument;
  std::vector<CircleTrace> traces;
  MotionTest ccw, cw;
  for (const Sense sense : instruments::kSenses) {
    circle->sense = sense;
    auto test = circle_test(setup->machine, *circle);
    if (!test) return test.error();
    const MotionTest run = instruments::with_approach(*test, setup->errors);
    std::vector<Vec3> deviations;
    if (moved->is_on()) {
      deviations = circle_deviations(*moved->model, moved->method, *circle, *test, *feed);
    }
    auto readings = instruments::shown(
        instrument, instruments::bar_readings(actual, run, setup->setup, deviations),
        static_cast<std::uint32_t>(sense));
    if (auto problem = instruments::beyond_stroke(run, readings, words.stroke, "phi")) {
      return *std::move(problem);
    }
    traces.push_back({sense, circle->angles, std::move(readings)});
    (sense == Sense::ccw ? ccw : cw) = *std::move(test);
  }
  double difference = 0.0;
  if (words.nc.run) {
    const auto taken = take_program_readings(words, *setup, *circle, traces);
    if (!taken) return taken.error();
    difference = *taken;
  }
  MotionAnswer answer = answer_of("circle", setup->words("Circle in {0}", words.plane), *setup);
  if (words.nc.run) add_program_run(answer, words.nc, difference);
  if (auto problem = add_circle_program(answer, words, *setup, *circle, ccw, traces))
    return *std::move(problem);
  answer.document["plane"] = words.plane;
  answer.document["length_mm"] = circle->length;
  answer.document["center_mm"] = coordinates(circle->centre);
  if (words.feed) answer.document["feed_mm_min"] = *words.feed;
  if (moved->is_on()) answer.document["dynamics"] = words.dynamics;
  answer.document["angles_deg"] = in_degrees(circle->angles);
  answer.document["ccw_um"] = in_um(traces[0].deviation);
  answer.document["cw_um"] = in_um(traces[1].deviation);
  answer.document["axes"] = axes_of(setup->machine, ccw.poses);
  answer.files["trace.csv"] = circle_csv(traces, circle->plane, circle->length);
  add_circle_evaluation(answer, traces, circle->length, circle->plane);
  const std::array runs{BarReadings{ccw, traces[0].deviation},
                        BarReadings{cw, traces[1].deviation}};
  add_setup_found(answer, runs);
  const auto errors = instruments::location_unknowns(setup->machine);
  const std::vector gains{
      instruments::bar_gains(setup->machine, errors, instruments::thinned(ccw, kPosesThatTell))};
  add_told(answer, instruments::told_by(errors, gains, spindle_ball_of(words)));
  return answer;
}

}  // namespace frustum::app
