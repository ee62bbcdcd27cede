#include "app/motion/motion_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "app/job/axis_words.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "core/constants.hpp"
#include "core/spelling.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_size.hpp"

namespace frustum::app {
namespace {

using instruments::SetupErrors;
using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

Result<SetupErrors> setup_of(const std::string& text) {
  SetupErrors setup;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    const auto equals = part.find('=');
    std::string name = part.substr(0, equals);
    std::erase(name, ' ');
    if (name != "ball" && name != "table_ball" && name != "length") {
      return unknown_word("--setup", name, {"ball", "table_ball", "length"});
    }
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const auto numbers = numbers_of(value, name == "length" ? 1 : 3, "--setup " + name);
    if (!numbers) return numbers.error();
    if (name == "length") {
      setup.length = numbers->front() / kUmPerMm;
    } else {
      (name == "ball" ? setup.ball : setup.table_ball) =
          Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]) / kUmPerMm;
    }
  }
  return setup;
}

Result<double> length_of(const std::string& text, const std::string& option) {
  if (text.empty()) return 0.0;
  const auto length = parse_length(text);
  if (!length) {
    Diagnostics problems = length.error();
    for (Diagnostic& each : problems) each.key = option;
    return problems;
  }
  if (length->value < 0.0) {
    return error("out-of-range"_id, fmt::format("{} {}: expected 0 or more", option, text));
  }
  return length->value;
}

}  // namespace

Diagnostic unknown_word(const std::string& option, const std::string& word,
                        const std::vector<std::string>& known) {
  return error("unknown-choice"_id, fmt::format("'{}' is no choice of {}", word, option),
               suggestion(word, known));
}

std::optional<Diagnostic> no_stroke(double stroke) {
  constexpr double kLongest = 1e3;
  if (stroke > 0.0 && stroke <= kLongest) return std::nullopt;
  return error("out-of-range"_id,
               fmt::format("--stroke {}: expected mm above 0, at most {:g}", stroke, kLongest));
}

Result<MotionSetup> motion_setup(const MotionWords& words) {
  if (auto problem = no_stroke(words.stroke)) return *std::move(problem);
  constexpr double kLongest = 1e9;  // mm, as far as axes go
  if (!(words.tool_length >= 0.0 && words.tool_length <= kLongest)) {
    return error("out-of-range"_id,
                 fmt::format("--tool-length {}: expected a length in mm, 0 to {:g}",
                             words.tool_length, kLongest));
  }
  auto machine = load_machine(words.machine, ".");
  if (!machine) return machine.error();
  auto entries =
      gather_errors(words.of_file, words.errors, drawn_by(words.errors, std::nullopt), *machine);
  if (!entries) return entries.error();
  auto errors = kinematics::resolve(*machine, *entries);
  if (!errors) return errors.error();
  const auto setup = setup_of(words.setup);
  if (!setup) return setup.error();
  const auto noise = length_of(words.noise, "--noise");
  if (!noise) return noise.error();
  const auto resolution = length_of(words.resolution, "--resolution");
  if (!resolution) return resolution.error();
  return MotionSetup{.machine = *std::move(machine),
                     .entries = *std::move(entries),
                     .errors = *std::move(errors),
                     .setup = *setup,
                     .instrument = {*noise, *resolution, words.seed},
                     .tool_length = words.tool_length};
}

Result<std::optional<double>> feed_per_second(const MotionWords& words) {
  if (!words.feed) return std::optional<double>{};
  constexpr double kFastest = 1e9;
  if (!(*words.feed > 0.0 && *words.feed <= kFastest)) {
    return error("out-of-range"_id, fmt::format("--feed {}: expected a feed above 0", *words.feed));
  }
  return std::optional(*words.feed / kSecondsPerMinute);
}

instruments::SpindleBall spindle_ball_of(const MotionWords& words) {
  return words.ball_known ? instruments::SpindleBall::known : instruments::SpindleBall::unknown;
}

Result<AxisPositions> held_axes(const Machine& machine, const std::string& text,
                                LinearAxes linear) {
  const auto words = read_axis_words(machine, text);
  if (!words) return words.error();
  AxisPositions held;
  for (const auto& [letter, position] : *words) {
    if (linear == LinearAxes::moved && !is_rotary(letter)) {
      return error("axis-moved"_id,
                   fmt::format("--at holds rotary axes: {} follows the test", to_char(letter)));
    }
    held[letter] = position;
  }
  return held;
}

Result<std::vector<AxisPositions>> pose_list(const Machine& machine, const std::string& text) {
  std::vector<AxisPositions> poses;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    const auto held = held_axes(machine, part, LinearAxes::moved);
    if (!held) return held.error();
    poses.push_back(*held);
  }
  return poses;
}

Result<std::map<AxisLetter, kinematics::AxisRange>> box_of(const std::string& text) {
  std::map<AxisLetter, kinematics::AxisRange> box;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const auto equals = part.find('='), colon = part.find(':');
    std::string name = part.substr(0, equals);
    std::erase(name, ' ');
    const auto letter = kinematics::axis_named(name);
    if (equals == std::string::npos || colon == std::string::npos || colon < equals || !letter) {
      return error("box-text"_id, fmt::format("'{}' in --box is no range of an axis", part),
                   "for example \"X=-200:200,Y=-150:150,Z=0:300\"");
    }
    if (box.contains(*letter)) {
      return error("given-twice"_id, fmt::format("axis {} is given twice in --box", name));
    }
    const auto low = numbers_of(part.substr(equals + 1, colon - equals - 1), 1, "--box " + name);
    if (!low) return low.error();
    const auto high = numbers_of(part.substr(colon + 1), 1, "--box " + name);
    if (!high) return high.error();
    box[*letter] = {low->front(), high->front()};
  }
  return box;
}

Result<Vec3> place_of(const std::string& text, const std::string& option) {
  const auto numbers = numbers_of(text, 3, option);
  if (!numbers) return numbers.error();
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Result<std::optional<std::vector<double>>> angle_list(const std::string& text) {
  if (text.empty()) return std::optional<std::vector<double>>{};
  auto angles = number_list(text, "--angles");
  if (!angles) return angles.error();
  constexpr double kMost = 3600.0;  // deg: ten turns to either side
  for (double& angle : *angles) {
    if (std::abs(angle) > kMost) {
      return error("out-of-range"_id,
                   fmt::format("{:g} deg in --angles: expected at most {:g}", angle, kMost));
    }
    angle *= kRadPerDeg;
  }
  return std::optional(*std::move(angles));
}

}  // namespace frustum::app
