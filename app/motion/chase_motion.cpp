#include "app/motion/chase_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/motion/motion_dynamics.hpp"
#include "app/motion/setup_found.hpp"
#include "app/motion/test_program.hpp"
#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "instruments/approach.hpp"
#include "instruments/ball_maps.hpp"
#include "instruments/chase_test.hpp"
#include "instruments/readings.hpp"
#include "instruments/traces/pose_trace_file.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

// Rows of a terminal's table; the document has all.
constexpr std::size_t kMostRows = 40;

std::string vectors_text(const std::vector<instruments::TestPose>& poses,
                         const std::vector<Vec3>& vectors, const kinematics::Machine& machine,
                         const report::Wording& words) {
  std::vector<std::string> headings{words("pose")};
  std::vector<kinematics::AxisLetter> rotary;
  for (const auto letter : kinematics::kRotaryAxes) {
    if (machine.joint(letter) == nullptr) continue;
    rotary.push_back(letter);
    headings.push_back(fmt::format("{} deg", to_char(letter)));
  }
  for (const char* axis : {"x ", "y ", "z "}) {
    headings.push_back(axis + std::string(words.unit("um")));
  }
  TextTable table(headings);
  for (std::size_t i = 0; i < std::min(vectors.size(), kMostRows); ++i) {
    std::vector<std::string> cells{fmt::format("{}", i + 1)};
    for (const auto letter : rotary) {
      cells.push_back(words.number(fmt::format("{:.3f}", poses[i].at.q[letter] * kDegPerRad)));
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      cells.push_back(shown_um(vectors[i][k], words));
    }
    table.row(cells);
  }
  const std::size_t left = vectors.size() - std::min(vectors.size(), kMostRows);
  return table.text() + (left > 0 ? words("{0} more poses: --json", left) + "\n" : "");
}

// Arrows at the angle of the axis next to the table, a colour for each position of the other.
void draw_vectors(MotionAnswer& answer, const std::vector<instruments::TestPose>& poses,
                  const std::vector<Vec3>& vectors, const kinematics::Machine& machine) {
  using kinematics::AxisLetter;
  const bool has_c = machine.joint(AxisLetter::C) != nullptr;
  const AxisLetter round = has_c ? AxisLetter::C : AxisLetter::B;
  const AxisLetter tilt = machine.joint(AxisLetter::A) != nullptr ? AxisLetter::A : AxisLetter::B;
  const report::Wording& words = answer.words;
  const std::string um(words.unit("um"));
  report::MotionTable table{.heading = words("Displacements, frame of the table"),
                            .columns = {words("pose"), ">x " + um, ">y " + um, ">z " + um}};
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Vec3& d = vectors[i];
    const auto drawn = [&](double mm) { return words.shown(mm * kUmPerMm, "um"); };
    const auto turned = [&](AxisLetter letter) {
      return fmt::format("{} {}°", to_char(letter),
                         words.general(poses[i].at.q[letter] * kDegPerRad));
    };
    const std::string name = turned(tilt);
    auto series = std::ranges::find(answer.page.arrows, name, &report::ArrowSeries::name);
    if (series == answer.page.arrows.end()) {
      series = answer.page.arrows.insert(series, {name, {}});
    }
    series->arrows.push_back({poses[i].at.q[round], drawn(d.x()), drawn(d.y())});
    table.rows.push_back({name + ", " + turned(round), shown_um(d.x(), words),
                          shown_um(d.y(), words), shown_um(d.z(), words)});
  }
  answer.page.tables.push_back(std::move(table));
}

}  // namespace

Result<instruments::MotionTest> chase_of_words(const ChaseWords& words, const MotionSetup& setup) {
  const auto ball = place_of(words.ball, words.option("ball"));
  if (!ball) return ball.error();
  if (words.at == "maps") {
    const auto plan = instruments::touch_plan(setup.machine);
    if (!plan) return plan.error();
    return instruments::chase_test(setup.machine,
                                   {*ball, instruments::ball_poses(*plan), setup.tool_length});
  }
  const auto poses = pose_list(setup.machine, words.at, words.option("at"));
  if (!poses) return poses.error();
  return instruments::chase_test(setup.machine, {*ball, *poses, setup.tool_length});
}

Result<std::vector<Vec3>> chase_deviations(const ChaseWords& words, const MotionSetup& setup,
                                           const instruments::MotionTest& test,
                                           const std::optional<double>& feed) {
  instruments::MotionTest run = test;
  std::vector<double> ways{0.0};  // rad
  for (std::size_t i = 1; i < run.poses.size(); ++i) {
    double turn = 0.0;
    for (const auto letter : kinematics::kRotaryAxes) {
      turn = std::hypot(turn, run.poses[i].at.q[letter] - run.poses[i - 1].at.q[letter]);
    }
    ways.push_back(ways.back() + turn);
  }
  for (std::size_t i = 0; i < ways.size(); ++i) run.poses[i].parameter = ways[i];
  if (words.dynamics != "off" && !(ways.back() > 0.0)) {
    return error("no-motion"_id,
                 words.option("dynamics") + " needs poses between which a rotary axis turns",
                 "for example \"C=0;C=90\"");
  }
  const auto axes = [&](double way) {
    const auto after = std::ranges::upper_bound(ways, way);
    const std::size_t k =
        std::clamp<std::size_t>(static_cast<std::size_t>(after - ways.begin()), 1, ways.size() - 1);
    const double length = ways[k] - ways[k - 1];
    const double share = length > 0.0 ? std::clamp((way - ways[k - 1]) / length, 0.0, 1.0) : 1.0;
    kinematics::AxisPositions rotary;
    for (const auto letter : kinematics::kRotaryAxes) {
      rotary[letter] = std::lerp(test.poses[k - 1].at.q[letter], test.poses[k].at.q[letter], share);
    }
    return place_tip(setup.machine, test.table_ball, test.tool_length, rotary);
  };
  if (ways.size() > 1) run.motion = {axes, 0.0, ways.back()};
  return deviations_of(words, setup, run, feed, kRadPerDeg, ways);
}

Result<MotionAnswer> chase_answer(const ChaseWords& words) {
  const auto setup = motion_setup(words);
  if (!setup) return setup.error();
  const auto test = chase_of_words(words, *setup);
  if (!test) return test.error();
  const Vec3& ball = test->table_ball;
  const kinematics::ForwardChain actual(setup->machine, setup->errors, setup->tool_length);
  const auto feed = feed_per_second(words);
  if (!feed) return feed.error();
  const auto moved = chase_deviations(words, *setup, *test, *feed);
  if (!moved) return moved.error();
  auto exact = instruments::displacements(
      actual, instruments::with_approach(*test, setup->errors).poses, setup->setup);
  double difference = 0.0;
  if (words.nc.run) {
    const auto rests = rests_of_program(words.nc, *setup, ball, test->poses);
    if (!rests) return rests.error();
    auto seen = instruments::displacements(actual, *rests, setup->setup);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      difference = std::max(difference, (seen[i] - exact[i]).norm());
    }
    exact = std::move(seen);
  }
  for (std::size_t i = 0; i < moved->size(); ++i) exact[i] += (*moved)[i];
  const auto vectors = instruments::shown(setup->instrument, std::move(exact), 0);
  MotionAnswer answer = answer_of("chase", setup->words("R-test"), *setup);
  if (words.nc.run) add_program_run(answer, words.nc, difference);
  if (words.nc.written()) {
    const auto options = program_options(words.nc);
    if (!options) return options.error();
    if (auto problem =
            add_program(answer, programs::chase_program(setup->machine, *test, *options))) {
      return *std::move(problem);
    }
  }
  answer.document["table_ball_mm"] = coordinates(ball);
  if (*feed) answer.document["feed_deg_min"] = *words.feed;
  if (!moved->empty()) answer.document["dynamics"] = words.dynamics;
  Lists list;
  double squares = 0.0;
  for (const Vec3& each : vectors) {
    list.push_back(coordinates(each, kUmPerMm));
    squares += each.squaredNorm();
  }
  const double rms = std::sqrt(squares / static_cast<double>(vectors.size())) * kUmPerMm;
  answer.document["displacement_um"] = list;
  answer.document["axes"] = axes_of(setup->machine, test->poses);
  answer.files["trace.csv"] = instruments::pose_csv(setup->machine, test->poses, vectors);
  answer.document["evaluation"] = Document{{"rms_um", rms}};
  add_setup_found(answer, vectors);
  draw_vectors(answer, test->poses, vectors, setup->machine);
  answer.text += vectors_text(test->poses, vectors, setup->machine, setup->words);
  answer.text += setup->words("root mean square {0} {1}, in the frame of the table",
                              shown_um(rms / kUmPerMm, setup->words), setup->words.unit("um")) +
                 "\n";
  const auto errors = instruments::location_unknowns(setup->machine);
  const std::vector gains{instruments::displacement_gains(
      setup->machine, errors, instruments::thinned(*test, kPosesThatTell))};
  add_told(answer, instruments::told_by(errors, gains, spindle_ball_of(words)));
  return answer;
}

}  // namespace frustum::app
