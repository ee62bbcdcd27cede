#include "app/motion/touch_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/motion/residual_report.hpp"
#include "app/motion/touch_report.hpp"
#include "instruments/touch_program.hpp"
#include "instruments/touch_test.hpp"

namespace frustum::app {
namespace {

using instruments::ErrorVector;
using instruments::TableMaps;
using instruments::TouchPlan;

std::optional<Diagnostic> unfit_words(const TouchWords& words, const MotionSetup& setup) {
  if (!words.at.empty()) {
    return at_option(error("axis-moved"_id, "the calibration moves all axes: 'at' holds none"),
                     words.option("at"));
  }
  if (setup.setup.length != 0.0) {
    const std::string option = words.in_file ? "setup.length_um" : "--setup length";
    return at_option(error("setup-without-effect"_id, option + ": a probe has no bar",
                           "a longer stylus is a ball off the tip: ball=0,0,-5"),
                     option);
  }
  return std::nullopt;
}

// Does `change(value, other)` for every value of the maps.
template <typename Change>
void for_all(TableMaps& maps, const TableMaps& others, Change change) {
  for (std::size_t i = 0; i < maps.tilt.size(); ++i) {
    change(maps.tilt[i], others.tilt[i]);
    for (std::size_t j = 0; j < maps.turn[i].size(); ++j) {
      change(maps.turn[i][j], others.turn[i][j]);
      change(maps.poses[i][j], others.poses[i][j]);
    }
  }
}

// Standard deviation of the maps of as many calibrations, about those of the first.
TableMaps scatter_of(const TouchPlan& plan, const MotionSetup& setup,
                     const std::vector<double>& readings, int runs, const TableMaps& first) {
  TableMaps sum = first, squares = first;
  for (TableMaps* each : {&sum, &squares}) {
    for_all(*each, first, [](ErrorVector& v, const ErrorVector&) { v.setZero(); });
  }
  for (int run = 1; run < runs; ++run) {
    TableMaps off = identified_maps(
        plan, instruments::shown(setup.instrument, readings, static_cast<std::uint32_t>(run)));
    for_all(off, first, [](ErrorVector& v, const ErrorVector& at) { v -= at; });
    for_all(sum, off, [](ErrorVector& v, const ErrorVector& d) { v += d; });
    for_all(squares, off, [](ErrorVector& v, const ErrorVector& d) { v += d.cwiseAbs2(); });
  }
  for_all(squares, sum, [runs](ErrorVector& v, const ErrorVector& s) {
    const ErrorVector variance = (v - s.cwiseAbs2() / runs) / (runs - 1.0);
    v = variance.cwiseMax(0.0).cwiseSqrt();
  });
  return squares;
}

// A probe has a ball and an artefact, and no bar.
void name_facts(report::MotionPage& page, const MotionSetup& setup) {
  const report::Wording& words = setup.words;
  std::erase_if(page.facts, [&](const auto& fact) { return fact[0] == words("Bar longer by"); });
  for (auto& [name, value] : page.facts) {
    if (name == words("Spindle ball off")) name = words("Ball of the probe off");
    if (name == words("Table ball off")) name = words("Artefact off");
  }
  if (setup.instrument.noise > 0.0) {
    page.facts.push_back({words("Bands"), words("two standard deviations")});
  }
}

}  // namespace

Result<MotionAnswer> touch_answer(const TouchWords& words) {
  auto setup = motion_setup(words);
  if (!setup) return setup.error();
  setup->instrument.noise /= 2.0;
  if (auto problem = unfit_words(words, *setup)) return *std::move(problem);
  const auto plan = instruments::touch_plan(setup->machine);
  if (!plan) return plan.error();
  const auto lobes = lobes_of(words.lobes, words.in_file);
  if (!lobes) return lobes.error();
  const instruments::TouchProbe probe{.tool_length = setup->tool_length, .lobes = *lobes};
  const auto poses = touch_poses(setup->machine, setup->errors, *plan, probe);
  if (!poses) return poses.error();
  const auto exact = touch_readings(setup->machine, setup->errors, *plan, *poses, probe,
                                    {.ball = setup->setup.ball, .shift = setup->setup.table_ball});
  if (!exact) return exact.error();
  const auto readings = instruments::shown(setup->instrument, *exact, 0);

  TouchFindings found{
      .readings = readings,
      .identified = identified_maps(*plan, readings),
      .sd = standard_deviations(*plan, setup->instrument.noise),
      .visible = visible_maps(setup->machine, setup->errors, *plan, *poses),
  };
  if (words.repeat > 1) {
    found.runs = words.repeat;
    found.scatter = scatter_of(*plan, *setup, *exact, words.repeat, found.identified);
  }
  MotionAnswer answer =
      answer_of("touch", setup->words("Touch-trigger calibration of A and C"), *setup);
  answer.document["axes"] = axes_of(setup->machine, *poses);
  add_lobes(answer, *lobes);
  name_facts(answer.page, *setup);
  add_touch_findings(answer, setup->machine, *plan, found);
  add_touch_residuals(answer, *plan, readings, setup->instrument.noise);
  add_probing_programs(answer, touch_program(*plan, probe));
  return answer;
}

}  // namespace frustum::app
