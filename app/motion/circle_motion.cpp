#include "app/motion/circle_motion.hpp"

#include <fmt/format.h>

#include "app/motion/circle_dynamics.hpp"
#include "app/motion/circle_report.hpp"
#include "app/motion/motion_dynamics.hpp"
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

Result<CircleTest> circle_of(const CircleWords& words, const MotionSetup& setup) {
  const auto plane = instruments::plane_named(words.plane);
  if (!plane) return unknown_word("--plane", words.plane, {"XY", "YZ", "ZX"});
  const auto centre = place_of(words.centre, "--center");
  if (!centre) return centre.error();
  const auto angles = angle_list(words.angles);
  if (!angles) return angles.error();
  const auto held = held_axes(setup.machine, words.at, LinearAxes::moved);
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

}  // namespace

Result<MotionAnswer> circle_answer(const CircleWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  auto circle = circle_of(words, *setup);
  if (!circle) return circle.error();
  const std::optional<double> feed = circle->feed;
  const auto moved = motion_dynamics(words, *setup, feed, circle->held);
  if (!moved) return moved.error();
  // The lag by servo gains is another model of the same drives.
  if (moved->is_on()) circle->feed.reset();
  const kinematics::ForwardChain actual(setup->machine, setup->errors, setup->tool_length);
  std::vector<CircleTrace> traces;
  MotionTest ccw;
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
        setup->instrument, instruments::bar_readings(actual, run, setup->setup, deviations),
        static_cast<std::uint32_t>(sense));
    if (auto problem = instruments::beyond_stroke(run, readings, words.stroke, "phi")) {
      return *std::move(problem);
    }
    traces.push_back({sense, circle->angles, std::move(readings)});
    if (sense == Sense::ccw) ccw = *std::move(test);
  }
  MotionAnswer answer = answer_of("circle", "Circle in " + words.plane, *setup);
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
  const auto errors = instruments::location_unknowns(setup->machine);
  const std::vector gains{
      instruments::bar_gains(setup->machine, errors, instruments::thinned(ccw, kPosesThatTell))};
  add_told(answer, instruments::told_by(errors, gains, spindle_ball_of(words)));
  return answer;
}

}  // namespace frustum::app
