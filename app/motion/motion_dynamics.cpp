#include "app/motion/motion_dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/job/machine_files.hpp"
#include "dynamics/model_file.hpp"
#include "dynamics/servo.hpp"

namespace frustum::app {
namespace {

using dynamics::PathMethod;
using kinematics::AxisPositions;

constexpr double kSampleStep = 5e-4;   // s: chords of 1 um at 60 Hz are within 0.01 um
constexpr double kSegmentTime = 1e-3;  // s, at the feed
constexpr double kMmPerMetre = 1e3;

// Places of the parameter that the time law looks at, in the order of the run.
std::vector<double> places_of(const TimedWay& way) {
  constexpr double kFewest = 200.0, kMost = 200'000.0;
  const double seconds = std::abs(way.to - way.from) / way.speed;
  const double count = std::clamp(std::ceil(seconds / kSegmentTime), kFewest, kMost);
  std::vector<double> places = way.corners;
  for (double i = 0.0; i <= count; i += 1.0) {
    places.push_back(std::lerp(way.from, way.to, i / count));
  }
  std::ranges::sort(places);
  const auto first = std::unique(places.begin(), places.end()), last = places.end();
  places.erase(first, last);
  if (way.to < way.from) std::ranges::reverse(places);
  return places;
}

// When the parameter is where.
class TimedRun {
 public:
  TimedRun(const kinematics::Machine& machine, const TimedWay& way,
           const kinematics::TimeLawOptions& options)
      : way_(way) {
    kinematics::TimeLaw law(machine, options);
    const std::vector<double> places = places_of(way);
    AxisPositions from = way.axes(places.front());
    ends_.push_back(places.front());
    for (std::size_t i = 1; i < places.size(); ++i) {
      const AxisPositions to = way.axes(places[i]);
      AxisPositions step;
      for (const auto letter : kinematics::kAxisLetters) step[letter] = to[letter] - from[letter];
      const double seconds = std::abs(places[i] - ends_.back()) / way.speed;
      const bool corner = std::ranges::find(way.corners, places[i - 1]) != way.corners.end();
      if (!law.add(step, {}, seconds, corner || ends_.size() == 1)) continue;
      ends_.push_back(places[i]);
      from = to;
    }
    law.rest(0.0);
    while (auto segment = law.next()) segments_.push_back(*std::move(segment));
  }

  [[nodiscard]] double duration() const {
    return segments_.empty() ? 0.0 : segments_.back().start + segments_.back().duration;
  }
  [[nodiscard]] AxisPositions axes_at(double time) const {
    if (segments_.empty()) return way_.axes(way_.from);
    const auto after =
        std::ranges::upper_bound(segments_, time, {}, &kinematics::TimedSegment::start);
    const std::size_t k =
        after == segments_.begin() ? 0 : static_cast<std::size_t>(after - segments_.begin()) - 1;
    const kinematics::TimedSegment& segment = segments_[k];
    const double end = segment.start + segment.duration;
    const double share = time >= end ? 1.0 : segment.share_at(std::max(time, segment.start));
    return way_.axes(std::lerp(ends_[k], ends_[k + 1], share));
  }
  [[nodiscard]] double time_at(double parameter) const {
    const bool rises = way_.to >= way_.from;
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      const double a = ends_[k], b = ends_[k + 1];
      if (rises ? parameter > b : parameter < b) continue;
      return segments_[k].time_at(std::clamp((parameter - a) / (b - a), 0.0, 1.0));
    }
    return duration();
  }

 private:
  const TimedWay& way_;
  std::vector<double> ends_{};  // one more than segments
  std::vector<kinematics::TimedSegment> segments_{};
};

std::optional<Diagnostic> without_use(const MotionWords& words, const std::optional<double>& feed) {
  if (words.dynamics != "off") return std::nullopt;
  if (!feed && !words.jerk) return std::nullopt;
  const std::string option = words.option(feed ? "feed" : "jerk"),
                    dynamics = words.option("dynamics");
  return at_option(
      error("missing-option"_id,
            fmt::format("{} is for {}: without it the test is read at rest", option, dynamics),
            fmt::format("add {}, or leave it out",
                        words.in_file ? "dynamics = \"linear\"" : "--dynamics linear")),
      option);
}

}  // namespace

Result<MotionDynamics> motion_dynamics(const MotionWords& words, const MotionSetup& setup,
                                       const std::optional<double>& feed, const AxisPositions& at) {
  const std::vector<std::string> known{"off", "quasi_static", "linear"};
  const auto found = std::ranges::find(known, words.dynamics);
  if (found == known.end()) return unknown_word(words.option("dynamics"), words.dynamics, known);
  MotionDynamics moved{static_cast<PathMethod>(found - known.begin()), std::nullopt, {}};
  moved.law.jerk = words.jerk;
  if (moved.method == PathMethod::off) return moved;
  if (words.nc.run) {
    return error("conflicting-options"_id, "masses and springs do not move the axes of a program",
                 "leave out dynamics, or program");
  }
  if (!feed) {
    const std::string option = words.option("dynamics");
    return at_option(error("missing-option"_id,
                           fmt::format("{} needs {}: at rest nothing moves the tip", option,
                                       words.option("feed")),
                           words.in_file ? "for example feed = 10000" : "for example --feed 10000"),
                     option);
  }
  const auto file = find_machine(words.machine, ".");
  if (!file) return file.error();
  auto model = dynamics::load_model(*file, setup.machine);
  if (!model) return model.error();
  if (!*model) return dynamics::no_dynamics(setup.machine, *file);
  if (moved.method == PathMethod::linear) {
    const auto servo = servo_system(**model, at, setup.tool_length);
    if (auto unstable = instability(**model, servo)) return *std::move(unstable);
  }
  moved.model = **std::move(model);
  return moved;
}

TimedWay way_of(const instruments::LineTest& line, double speed) {
  const AxisPositions start = line.start;
  const AxisPositions first = line.poses.front().at.q, last = line.poses.back().at.q;
  AxisPositions direction;
  double length = 0.0, overrun = 0.0;
  for (const auto letter : kinematics::kLinearAxes) {
    direction[letter] = last[letter] - first[letter];
    length = std::hypot(length, direction[letter]);
    overrun = std::hypot(overrun, first[letter] - start[letter]);
  }
  for (const auto letter : kinematics::kLinearAxes) direction[letter] /= length;
  return {.axes =
              [start, direction](double way) {
                AxisPositions q = start;
                for (const auto letter : kinematics::kLinearAxes) {
                  q[letter] += way * direction[letter];
                }
                return q;
              },
          .from = 0.0,
          .to = length + 2.0 * overrun,
          .speed = speed};
}

std::vector<double> parameters_on(const instruments::LineTest& line) {
  std::vector<double> parameters;
  for (const instruments::TestPose& pose : line.poses) {
    double way = 0.0;
    for (const auto letter : kinematics::kLinearAxes) {
      way = std::hypot(way, pose.at.q[letter] - line.start[letter]);
    }
    parameters.push_back(way);
  }
  return parameters;
}

std::vector<Vec3> deviations_on(const MotionDynamics& moved, const kinematics::Machine& machine,
                                const TimedWay& way, double tool_length,
                                std::span<const double> parameters) {
  const TimedRun run(machine, way, moved.law);
  const auto count = static_cast<std::size_t>(std::ceil(run.duration() / kSampleStep)) + 2;
  std::vector<AxisPositions> positions;
  for (std::size_t i = 0; i < count; ++i) {
    // One sample more before it, at rest.
    const double time = (static_cast<double>(i) - 1.0) * kSampleStep;
    positions.push_back(run.axes_at(std::max(time, 0.0)));
  }
  const auto samples = dynamics::with_rates(positions, kSampleStep);
  const auto found = moved.method == PathMethod::linear
                         ? linear_deviations(*moved.model, samples, kSampleStep, tool_length)
                         : quasi_static_deviations(*moved.model, samples, tool_length);
  std::vector<Vec3> deviations;
  for (const double parameter : parameters) {
    const double place = std::clamp(run.time_at(parameter) / kSampleStep + 1.0, 0.0,
                                    static_cast<double>(found.size() - 1));
    const auto below = std::min(static_cast<std::size_t>(place), found.size() - 2);
    const double share = place - static_cast<double>(below);
    deviations.emplace_back(kMmPerMetre *
                            (found[below].tip + share * (found[below + 1].tip - found[below].tip)));
  }
  return deviations;
}

namespace {

// Refused: a run of so many samples that nobody waits for it. Said: how long it takes.
std::optional<Diagnostic> too_long(const MotionWords& words, const TimedWay& way) {
  constexpr double kMostSamples = 2e6;
  const double seconds = std::abs(way.to - way.from) / way.speed;
  const double samples = seconds / kSampleStep;
  if (words.progress != nullptr) {
    words.progress->rename(fmt::format("motion of {:.4g} s in {:.2g} samples", seconds, samples));
  }
  if (samples <= kMostSamples) return std::nullopt;
  const std::string option = words.option("feed");
  return at_option(
      error("run-too-long"_id,
            fmt::format("{} {}: the run takes {:.4g} s, which are {:.2g} samples of {:g} ms; at "
                        "most {:.2g} are computed",
                        option, *words.feed, seconds, samples, 1e3 * kSampleStep, kMostSamples),
            fmt::format("{} of {:.3g} or more: so slowly masses and springs move nothing",
                        words.in_file ? "feed" : "--feed", *words.feed * samples / kMostSamples)),
      option);
}

}  // namespace

Result<std::vector<Vec3>> deviations_of(const MotionWords& words, const MotionSetup& setup,
                                        const instruments::MotionTest& test,
                                        const std::optional<double>& feed, double per_feed,
                                        const std::vector<double>& corners) {
  if (auto problem = without_use(words, feed)) return *std::move(problem);
  const auto moved = motion_dynamics(words, setup, feed, test.poses.front().at.q);
  if (!moved) return moved.error();
  if (!moved->is_on()) return std::vector<Vec3>{};
  std::vector<double> parameters;
  for (const instruments::TestPose& pose : test.poses) parameters.push_back(pose.parameter);
  const TimedWay way{.axes = test.motion.axes,
                     .from = test.motion.from,
                     .to = test.motion.to,
                     .speed = *feed * per_feed,
                     .corners = corners};
  if (auto problem = too_long(words, way)) return *std::move(problem);
  return deviations_on(*moved, setup.machine, way, setup.tool_length, parameters);
}

Result<std::vector<Vec3>> deviations_of(const MotionWords& words, const MotionSetup& setup,
                                        const instruments::LineTest& line,
                                        const std::optional<double>& feed) {
  if (auto problem = without_use(words, feed)) return *std::move(problem);
  const auto moved = motion_dynamics(words, setup, feed, line.start);
  if (!moved) return moved.error();
  if (!moved->is_on()) return std::vector<Vec3>{};
  const TimedWay way = way_of(line, *feed);
  if (auto problem = too_long(words, way)) return *std::move(problem);
  return deviations_on(*moved, setup.machine, way, setup.tool_length, parameters_on(line));
}

}  // namespace frustum::app
