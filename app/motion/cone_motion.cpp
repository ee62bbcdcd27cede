#include "app/motion/cone_motion.hpp"

#include <fmt/format.h>

#include "app/motion/motion_dynamics.hpp"
#include "app/motion/setup_found.hpp"
#include "app/motion/test_program.hpp"
#include "app/motion/turn_report.hpp"
#include "core/constants.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/sample_angles.hpp"

namespace frustum::app {
namespace {

using instruments::ConeSense;
using instruments::ConeTest;

}  // namespace

Result<ConeTest> cone_of_words(const ConeMotionWords& words, const MotionSetup& setup) {
  if (words.sense != "normal" && words.sense != "radial") {
    return unknown_word(words.option("sense"), words.sense, {"normal", "radial"});
  }
  if (!words.at.empty()) {
    return at_option(
        error("axis-moved"_id, "the cone moves all axes: 'at' holds none", "leave it out"), "at");
  }
  const auto centre = place_of(words.centre, words.option("center"));
  if (!centre) return centre.error();
  const auto angles = angle_list(words.angles, words.option("angles"));
  if (!angles) return angles.error();
  return ConeTest{.cone_angle = words.cone_angle * kRadPerDeg,
                  .inclination = words.inclination * kRadPerDeg,
                  .radius = words.radius,
                  .centre = *centre,
                  .sense = words.sense == "normal" ? ConeSense::normal : ConeSense::radial,
                  .angles = *angles
                                ? **angles
                                : instruments::midpoints(0.0, kTurn, instruments::kSamplesOfATurn),
                  .tool_length = setup.tool_length};
}

Result<MotionAnswer> cone_answer(const ConeMotionWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  const auto cone = cone_of_words(words, *setup);
  if (!cone) return cone.error();
  const auto test = cone_test(setup->machine, *cone);
  if (!test) return test.error();
  const auto feed = feed_per_second(words);
  if (!feed) return feed.error();
  const auto moved = deviations_of(words, *setup, *test, *feed, 1.0 / cone->radius);
  if (!moved) return moved.error();
  const std::string title = fmt::format("BALL BAR CONE {} {:g} MM", words.sense, test->bar);
  const auto bar = bar_of_words(words, *setup,
                                {.test = *test,
                                 .name = "cone",
                                 .title = title,
                                 .parameter = instruments::cone_parameter(setup->machine, *cone),
                                 .parameter_name = "phi",
                                 .moved = *moved});
  if (!bar) return bar.error();
  const std::vector<double>& readings = bar->readings;
  MotionAnswer answer =
      answer_of("cone", setup->words("Cone path, bar {0}", setup->words.word(words.sense)), *setup);
  if (auto problem = add_bar(answer, words, *setup, *test, "phi", *bar)) return *std::move(problem);
  answer.document["sense"] = words.sense;
  answer.document["cone_angle_deg"] = words.cone_angle;
  answer.document["inclination_deg"] = words.inclination;
  answer.document["radius_mm"] = words.radius;
  answer.document["center_mm"] = coordinates(cone->centre);
  answer.document["table_ball_mm"] = coordinates(test->table_ball);
  answer.document["length_mm"] = test->bar;
  if (*feed) answer.document["feed_mm_min"] = *words.feed;
  if (!moved->empty()) answer.document["dynamics"] = words.dynamics;
  answer.document["angles_deg"] = in_degrees(cone->angles);
  answer.document["reading_um"] = in_um(readings);
  answer.document["axes"] = axes_of(setup->machine, test->poses);
  add_turn_evaluation(answer, "phi", cone->angles, readings);
  const BarReadings seen{*test, bar->readings};
  add_setup_found(answer, std::span(&seen, 1));
  const auto errors = instruments::location_unknowns(setup->machine);
  const std::vector gains{
      instruments::bar_gains(setup->machine, errors, instruments::thinned(*test, kPosesThatTell))};
  add_told(answer, instruments::told_by(errors, gains, spindle_ball_of(words)));
  return answer;
}

}  // namespace frustum::app
