#include "app/motion/rotary_motion.hpp"

#include <fmt/format.h>

#include "app/motion/motion_dynamics.hpp"
#include "app/motion/setup_found.hpp"
#include "app/motion/test_program.hpp"
#include "app/motion/turn_report.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/sample_angles.hpp"

namespace frustum::app {
namespace {

using instruments::BarHold;
using instruments::RotaryTest;

}  // namespace

Result<RotaryTest> rotary_of_words(const RotaryWords& words, const MotionSetup& setup) {
  const std::vector<std::string> directions{"axial", "radial", "tangential"};
  if (words.direction.empty()) {
    return error("direction-missing"_id, "the direction of the bar is not said",
                 fmt::format("{}: {}", words.option("direction"), fmt::join(directions, ", ")));
  }
  const auto direction = instruments::bar_direction_named(words.direction);
  if (!direction) return unknown_word(words.option("direction"), words.direction, directions);
  if (!words.hold.empty() && words.hold != "rotor" && words.hold != "bed") {
    return unknown_word(words.option("hold"), words.hold, {"rotor", "bed"});
  }
  const auto axis = kinematics::axis_named(words.axis);
  const kinematics::Joint* joint = axis ? setup.machine.joint(*axis) : nullptr;
  if (joint == nullptr || !joint->rotary()) {
    std::vector<std::string> rotary;
    for (const auto& each : setup.machine.joints()) {
      if (each.rotary()) rotary.emplace_back(1, to_char(each.letter));
    }
    const std::string option = words.option("axis");
    return at_option(
        error("unknown-axis"_id,
              fmt::format("{} {} is no rotary axis of machine {}", option, words.axis,
                          setup.machine.name()),
              rotary.empty() ? "the machine has none"
                             : fmt::format("rotary axes: {}", fmt::join(rotary, ", "))),
        option);
  }
  const auto ball = place_of(words.ball, words.option("ball"));
  if (!ball) return ball.error();
  const auto angles = angle_list(words.angles, words.option("angles"));
  if (!angles) return angles.error();
  std::vector<kinematics::AxisLetter> moves(kinematics::kLinearAxes.begin(),
                                            kinematics::kLinearAxes.end());
  moves.push_back(*axis);
  const auto held = held_axes(setup.machine, words.at, words.option("at"), moves);
  if (!held) return held.error();
  const kinematics::AxisRange arc = instruments::capture_of(*joint);
  return RotaryTest{
      .axis = *axis,
      .direction = *direction,
      .hold = words.hold.empty()    ? instruments::standing_hold(*joint)
              : words.hold == "bed" ? BarHold::bed
                                    : BarHold::rotor,
      .table_ball = *ball,
      .length = words.length,
      .angles =
          *angles ? **angles : instruments::midpoints(arc.lo, arc.hi, instruments::kSamplesOfATurn),
      .held = *held,
      .tool_length = setup.tool_length};
}

Result<MotionAnswer> rotary_answer(const RotaryWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  const auto rotary = rotary_of_words(words, *setup);
  if (!rotary) return rotary.error();
  const auto test = rotary_test(setup->machine, *rotary);
  if (!test) return test.error();
  const auto feed = feed_per_second(words);
  if (!feed) return feed.error();
  const auto moved = deviations_of(words, *setup, *test, *feed, kRadPerDeg);
  if (!moved) return moved.error();
  const std::string title =
      fmt::format("BALL BAR {} {} {} MM", words.axis, words.direction, rotary->length);
  const auto bar = bar_of_words(words, *setup,
                                {.test = *test,
                                 .name = "rotary",
                                 .title = title,
                                 .parameter = instruments::rotary_parameter(rotary->axis),
                                 .parameter_name = words.axis,
                                 .moved = *moved});
  if (!bar) return bar.error();
  const std::vector<double>& readings = bar->readings;
  MotionAnswer answer = answer_of(
      "rotary",
      setup->words("Axis {0}, {1} bar held on the {2}", words.axis,
                   setup->words.word(words.direction), setup->words.word(name_of(rotary->hold))),
      *setup);
  if (auto problem = add_bar(answer, words, *setup, *test, words.axis, *bar))
    return *std::move(problem);
  answer.document["axis"] = words.axis;
  answer.document["direction"] = words.direction;
  answer.document["hold"] = name_of(rotary->hold);
  answer.document["table_ball_mm"] = coordinates(rotary->table_ball);
  answer.document["length_mm"] = rotary->length;
  if (*feed) answer.document["feed_deg_min"] = *words.feed;
  if (!moved->empty()) answer.document["dynamics"] = words.dynamics;
  answer.document["angles_deg"] = in_degrees(rotary->angles);
  answer.document["reading_um"] = in_um(readings);
  answer.document["axes"] = axes_of(setup->machine, test->poses);
  add_turn_evaluation(answer, words.axis, rotary->angles, readings);
  const BarReadings seen{*test, bar->readings};
  add_setup_found(answer, std::span(&seen, 1));
  const auto errors = instruments::location_unknowns(setup->machine);
  const std::vector gains{
      instruments::bar_gains(setup->machine, errors, instruments::thinned(*test, kPosesThatTell))};
  add_told(answer, instruments::told_by(errors, gains, spindle_ball_of(words)));
  return answer;
}

}  // namespace frustum::app
