#include "app/motion/line_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/job/number_list.hpp"
#include "app/motion/motion_dynamics.hpp"
#include "app/motion/test_program.hpp"
#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "instruments/approach.hpp"
#include "instruments/line_straightness.hpp"
#include "instruments/line_test.hpp"
#include "instruments/readings.hpp"
#include "instruments/traces/line_trace_file.hpp"

namespace frustum::app {
namespace {

using instruments::Deviations;
using instruments::LineTest;
using instruments::Positioning;
using instruments::RunDirection;
using kinematics::AxisLetter;

Document values_of(const Positioning& p) {
  const auto um = [](double mm) { return mm * kUmPerMm; };
  return {{"x_up", in_um(p.up.mean)},
          {"x_down", in_um(p.down.mean)},
          {"B_i", in_um(p.reversal)},
          {"B", um(p.largest_reversal)},
          {"B_mean", um(p.mean_reversal)},
          {"s_up", in_um(p.up.sd)},
          {"s_down", in_um(p.down.sd)},
          {"R_up", um(p.up.repeatability)},
          {"R_down", um(p.down.repeatability)},
          {"R_i", in_um(p.repeatability_at)},
          {"R", um(p.repeatability)},
          {"E_up", um(p.up.systematic)},
          {"E_down", um(p.down.systematic)},
          {"E", um(p.systematic)},
          {"M", um(p.mean_range)},
          {"A_up", um(p.up.accuracy)},
          {"A_down", um(p.down.accuracy)},
          {"A", um(p.accuracy)}};
}

// On the page and in the text.
report::MotionTable values_table(const Positioning& p, const report::Wording& words) {
  const auto number = [&](double mm) { return shown_um(mm, words); };
  return {.heading = words("Values"),
          .columns = {std::string(words.unit("um")), ">" + words("both"), ">" + words("up"),
                      ">" + words("down")},
          .rows = {{words("A accuracy"), number(p.accuracy), number(p.up.accuracy),
                    number(p.down.accuracy)},
                   {words("R repeatability"), number(p.repeatability), number(p.up.repeatability),
                    number(p.down.repeatability)},
                   {words("E systematic deviation"), number(p.systematic), number(p.up.systematic),
                    number(p.down.systematic)},
                   {words("M mean bidirectional"), number(p.mean_range), "", ""},
                   {words("B reversal"), number(p.largest_reversal), "", ""}}};
}

std::string positioning_text(const std::vector<double>& targets, const Positioning& p,
                             const report::Wording& words) {
  const auto number = [&](double mm) { return shown_um(mm, words); };
  const auto um = words.unit("um");
  TextTable table({words("target {0}", words.unit("mm")), words("up {0}", um), "2 s",
                   words("down {0}", um), "2 s", words("reversal")});
  for (std::size_t i = 0; i < targets.size(); ++i) {
    table.row({words.general(words.shown(targets[i], "mm")), number(p.up.mean[i]),
               number(2.0 * p.up.sd[i]), number(p.down.mean[i]), number(2.0 * p.down.sd[i]),
               number(p.reversal[i])});
  }
  const report::MotionTable shown = values_table(p, words);
  TextTable values({shown.columns[0], words("both"), words("up"), words("down")});
  for (const auto& row : shown.rows) values.row(row);
  return table.text() + "\n" + values.text();
}

void draw_positioning(MotionAnswer& answer, const std::vector<double>& targets,
                      const Positioning& p) {
  const report::Wording& words = answer.words;
  report::TraceChart chart{
      .title = words("Means of the runs with bands of two standard deviations"),
      .along_title = words("target, {0}", words.symbol("mm")),
      .value_title = words("deviation, {0}", words.symbol("um"))};
  std::vector<double> places = targets;
  for (double& each : places) each = words.shown(each, "mm");
  for (const auto* side : {&p.up, &p.down}) {
    std::vector<double> band = drawn_um(side->sd, words);
    for (double& each : band) each *= 2.0;
    chart.lines.push_back({.name = side == &p.up ? words("up") : words("down"),
                           .along = places,
                           .value = drawn_um(side->mean, words),
                           .half_width = std::move(band),
                           .dots = true});
  }
  answer.page.charts.push_back(std::move(chart));
  answer.page.tables.push_back(values_table(p, words));
}

// Displacements at the poses of runs, a list a run, before noise, and how far those of a program
// are from analytic ones.
struct RunReadings {
  std::vector<std::vector<Vec3>> runs{};
  double largest_difference = 0.0;  // mm
};

Result<RunReadings> readings_of(const ProgramWords& words, const MotionSetup& setup,
                                std::span<const LineTest> runs) {
  const kinematics::ForwardChain actual(setup.machine, setup.errors, setup.tool_length);
  RunReadings found;
  std::vector<instruments::TestPose> wanted;
  for (const LineTest& run : runs) {
    found.runs.push_back(instruments::displacements(
        actual, instruments::with_approach(run.poses, run.start, setup.errors), setup.setup));
    wanted.insert(wanted.end(), run.poses.begin(), run.poses.end());
  }
  if (words.run) {
    const auto rests = rests_of_program(
        words, setup, programs::line_origin(setup.machine, setup.tool_length), wanted);
    if (!rests) return rests.error();
    auto next = rests->begin();
    for (auto& run : found.runs) {
      for (Vec3& d : run) {
        const Vec3 seen = instruments::displacement(actual, *next++, setup.setup);
        found.largest_difference = std::max(found.largest_difference, (seen - d).norm());
        d = seen;
      }
    }
  }
  return found;
}

// The program that was run, or is to be written.
std::optional<Diagnostics> add_line_program(MotionAnswer& answer, const ProgramWords& words,
                                            const MotionSetup& setup, const std::string& name,
                                            const std::string& title,
                                            std::span<const LineTest> runs, double difference) {
  if (words.run) add_program_run(answer, words, difference);
  if (!words.written()) return std::nullopt;
  const auto options = program_options(words);
  if (!options) return options.error();
  return add_program(answer, programs::line_program(setup.machine, name, title, runs,
                                                    setup.tool_length, *options));
}

// Of the motion of an axis across itself: the ranges of the mean of all runs.
Document straightness_of_axis(const LineRuns& line, const std::vector<Vec3>& means,
                              MotionAnswer& answer) {
  Document doc;
  for (const auto& [across, found] : straightness_across(line, means)) {
    const std::string name(1, to_char(across));
    doc[name] = Document{{"least_squares", found.least_squares * kUmPerMm},
                         {"end_points", found.end_points * kUmPerMm},
                         {"minimum_zone", found.minimum_zone * kUmPerMm}};
    answer.text +=
        answer.words("straightness in {0}: {1} {3} least squares, {2} {3} minimum zone", name,
                     shown_um(found.least_squares, answer.words),
                     shown_um(found.minimum_zone, answer.words), answer.words.unit("um")) +
        "\n";
  }
  return doc;
}

}  // namespace

std::optional<Diagnostics> add_positioning(MotionAnswer& answer, const std::vector<double>& targets,
                                           const Deviations& up, const Deviations& down) {
  const auto found = instruments::positioning(up, down);
  if (!found) return found.error();
  answer.document["evaluation"] = values_of(*found);
  draw_positioning(answer, targets, *found);
  answer.text += positioning_text(targets, *found, answer.words);
  return std::nullopt;
}

Result<LineRuns> line_of_words(const LineWords& words, const MotionSetup& setup) {
  const auto axis = kinematics::axis_named(words.axis);
  if (!axis) return unknown_word(words.option("axis"), words.axis, {"X", "Y", "Z"});
  const auto targets = number_list(words.targets, words.option("targets"));
  if (!targets) return at_option(targets.error(), words.option("targets"));
  const auto held = held_axes(setup.machine, words.at, words.option("at"), std::span(&*axis, 1));
  if (!held) return held.error();
  const instruments::AxisLine line{
      .axis = *axis, .targets = *targets, .held = *held, .tool_length = setup.tool_length};
  auto up = instruments::axis_line(setup.machine, line, RunDirection::up);
  if (!up) return up.error();
  auto down = instruments::axis_line(setup.machine, line, RunDirection::down);
  if (!down) return down.error();
  return LineRuns{*axis, *targets, *std::move(up), *std::move(down)};
}

LineDeviations by_target(const LineRuns& line, const std::vector<std::vector<Vec3>>& shown) {
  const std::size_t targets = line.targets.size();
  LineDeviations found{Deviations(targets), Deviations(targets),
                       std::vector<Vec3>(targets, Vec3::Zero())};
  for (std::size_t run = 0; run < shown.size(); ++run) {
    const bool is_up = run % 2 == 0;
    for (std::size_t k = 0; k < targets; ++k) {
      const Vec3& d = shown[run][k];
      // `down` has the opposite order, not the opposite direction.
      const std::size_t i = is_up ? k : targets - 1 - k;
      (is_up ? found.up : found.down)[i].push_back(d.dot(line.up.direction));
      found.means[i] += d / static_cast<double>(shown.size());
    }
  }
  return found;
}

std::map<AxisLetter, instruments::Straightness> straightness_across(
    const LineRuns& line, const std::vector<Vec3>& means) {
  std::map<AxisLetter, instruments::Straightness> found;
  for (const AxisLetter across : kinematics::kLinearAxes) {
    if (across == line.axis) continue;
    std::vector<double> deviation;
    for (const Vec3& mean : means) deviation.push_back(mean[static_cast<Eigen::Index>(across)]);
    if (const auto of = instruments::straightness_of(line.targets, deviation)) found[across] = *of;
  }
  return found;
}

Result<MotionAnswer> line_answer(const LineWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  const auto line = line_of_words(words, *setup);
  if (!line) return line.error();
  const auto feed = feed_per_second(words);
  if (!feed) return feed.error();
  const auto moved_up = deviations_of(words, *setup, line->up, *feed);
  if (!moved_up) return moved_up.error();
  const auto moved_down = deviations_of(words, *setup, line->down, *feed);
  if (!moved_down) return moved_down.error();
  std::vector<LineTest> runs;
  for (int run = 0; run < words.runs; ++run) runs.insert(runs.end(), {line->up, line->down});
  auto readings = readings_of(words.nc, *setup, runs);
  if (!readings) return readings.error();
  for (std::size_t run = 0; run < runs.size(); ++run) {
    std::vector<Vec3>& seen = readings->runs[run];
    const std::vector<Vec3>& moved = run % 2 == 0 ? *moved_up : *moved_down;
    for (std::size_t i = 0; i < moved.size(); ++i) seen[i] += moved[i];
    seen = instruments::shown(setup->instrument, std::move(seen), static_cast<std::uint32_t>(run));
  }
  const LineDeviations deviations = by_target(*line, readings->runs);
  MotionAnswer answer = answer_of("line", setup->words("Laser along {0}", words.axis), *setup);
  if (auto problem = add_line_program(answer, words.nc, *setup, "line", "LASER " + words.axis, runs,
                                      readings->largest_difference)) {
    return *std::move(problem);
  }
  answer.document["axis"] = words.axis;
  answer.document["runs"] = static_cast<std::uint64_t>(words.runs);
  if (*feed) answer.document["feed_mm_min"] = *words.feed;
  if (!moved_up->empty()) answer.document["dynamics"] = words.dynamics;
  answer.document["targets_mm"] = line->targets;
  const auto rows = [](const Deviations& by_target) {
    Lists list;
    for (const auto& row : by_target) list.push_back(in_um(row));
    return list;
  };
  answer.document["deviations_up_um"] = rows(deviations.up);
  answer.document["deviations_down_um"] = rows(deviations.down);
  answer.files["trace.csv"] = instruments::line_csv(line->targets, deviations.up, deviations.down);
  if (auto problem = add_positioning(answer, line->targets, deviations.up, deviations.down)) {
    return *std::move(problem);
  }
  answer.document["straightness_um"] = straightness_of_axis(*line, deviations.means, answer);
  // What the laser sees along its line, and the tilts that reach it through their levers.
  instruments::Told told;
  told.told = {fmt::format("E{0}{0}", words.axis)};
  const std::vector<std::string> tilts =
      line->axis == AxisLetter::X   ? std::vector<std::string>{"B", "C"}
      : line->axis == AxisLetter::Y ? std::vector<std::string>{"A", "C"}
                                    : std::vector<std::string>{"A", "B"};
  for (const std::string& tilt : tilts) told.not_told.push_back("E" + tilt + words.axis);
  for (const auto& error : instruments::location_unknowns(setup->machine)) {
    told.not_told.push_back(error.name);
  }
  add_told(answer, told);
  return answer;
}

Result<std::map<std::string, LineTest>> diagonals_of_words(const DiagonalWords& words,
                                                           const MotionSetup& setup) {
  const auto box = box_of(words.box, words.option("box"));
  if (!box) return box.error();
  std::vector<AxisLetter> moves;
  for (const auto& [letter, range] : *box) moves.push_back(letter);
  const auto held = held_axes(setup.machine, words.at, words.option("at"), moves);
  if (!held) return held.error();
  return instruments::diagonal_lines(
      setup.machine,
      {.box = *box, .points = words.points, .held = *held, .tool_length = setup.tool_length});
}

Result<MotionAnswer> diagonal_answer(const DiagonalWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  const auto lines = diagonals_of_words(words, *setup);
  if (!lines) return lines.error();
  const auto feed = feed_per_second(words);
  if (!feed) return feed.error();
  std::vector<LineTest> runs;
  for (const auto& [signs, line] : *lines) runs.push_back(line);
  const auto displaced = readings_of(words.nc, *setup, runs);
  if (!displaced) return displaced.error();
  MotionAnswer answer = answer_of("diagonal", setup->words("Diagonals"), *setup);
  const report::Wording& wording = answer.words;
  if (auto problem = add_line_program(answer, words.nc, *setup, "diagonal", "LASER DIAGONALS", runs,
                                      displaced->largest_difference)) {
    return *std::move(problem);
  }
  Document readings, lengths;
  report::TraceChart chart{
      .title = wording("Readings along the diagonals"),
      .along_title = wording("length along the diagonal, {0}", wording.symbol("mm")),
      .value_title = wording("reading, {0}", wording.symbol("um"))};
  TextTable table({wording("diagonal"), wording("length {0}", wording.unit("mm")),
                   wording("middle {0}", wording.unit("um")),
                   wording("end {0}", wording.unit("um"))});
  const auto errors = instruments::location_unknowns(setup->machine);
  std::vector<instruments::ReadingGains> gains;
  std::uint32_t number = 0;
  std::string csv = "diagonal,length_mm,reading_um\n";
  for (const auto& [signs, line] : *lines) {
    const auto moved = deviations_of(words, *setup, line, *feed);
    if (!moved) return moved.error();
    std::vector<double> along;
    for (const Vec3& d : displaced->runs[number]) along.push_back(d.dot(line.direction));
    for (std::size_t i = 0; i < moved->size(); ++i) along[i] += (*moved)[i].dot(line.direction);
    const auto seen =
        instruments::from_first(instruments::shown(setup->instrument, std::move(along), number++));
    readings[signs] = in_um(seen);
    chart.lines.push_back(
        {.name = signs, .along = {}, .value = drawn_um(seen, wording), .dots = true});
    for (std::size_t i = 0; i < line.poses.size(); ++i) {
      chart.lines.back().along.push_back(wording.shown(line.poses[i].parameter, "mm"));
      csv += fmt::format("{},{},{}\n", signs, shortest_decimal(line.poses[i].parameter),
                         shortest_decimal(seen[i] * kUmPerMm));
    }
    lengths[signs] = line.poses.back().parameter;
    const double length = wording.shown(line.poses.back().parameter, "mm");
    table.row({signs, wording.number(fmt::format("{:.3f}", length)),
               shown_um(seen[seen.size() / 2], wording), shown_um(seen.back(), wording)});
    gains.push_back(instruments::line_gains(setup->machine, errors, line, setup->tool_length));
  }
  answer.document["points"] = static_cast<std::uint64_t>(words.points);
  if (*feed) answer.document["feed_mm_min"] = *words.feed;
  if (words.dynamics != "off") answer.document["dynamics"] = words.dynamics;
  answer.document["lengths_mm"] = lengths;
  answer.document["diagonals"] = readings;
  answer.files["trace.csv"] = std::move(csv);
  answer.document["evaluation"] = {};
  answer.page.charts.push_back(std::move(chart));
  answer.text += table.text();
  answer.text += wording("Equal diagonals prove nothing: errors may cancel on all of them.") + "\n";
  add_told(answer, instruments::told_by(errors, gains, spindle_ball_of(words)));
  return answer;
}

}  // namespace frustum::app
