#include "app/motion/motion_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
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

}  // namespace

Diagnostic unknown_word(const std::string& option, const std::string& word,
                        const std::vector<std::string>& known) {
  return at_option(error("unknown-choice"_id, fmt::format("'{}' is no choice of {}", word, option),
                         suggestion(word, known)),
                   option);
}

Result<SetupErrors> setup_errors_of(const std::string& text, const std::string& option) {
  const bool in_file = !option.starts_with('-');
  SetupErrors setup;
  std::set<std::string> given;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    const auto equals = part.find('=');
    std::string name = part.substr(0, equals);
    std::erase(name, ' ');
    if (name != "ball" && name != "table_ball" && name != "length") {
      return unknown_word(option, name, {"ball", "table_ball", "length"});
    }
    if (!given.insert(name).second) {
      return at_option(
          error("given-twice"_id, fmt::format("'{}' is given twice in {}", name, option),
                "once is enough"),
          option);
    }
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const std::string what = in_file ? option + "." + name + "_um" : option + " " + name;
    const auto numbers = numbers_of(value, name == "length" ? 1 : 3, what);
    if (!numbers) return at_option(numbers.error(), what);
    if (name == "length") {
      setup.length = numbers->front() / kUmPerMm;
    } else {
      (name == "ball" ? setup.ball : setup.table_ball) =
          Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]) / kUmPerMm;
    }
  }
  return setup;
}

Result<double> length_of_words(const std::string& text, const std::string& option) {
  if (text.empty()) return 0.0;
  const auto length = parse_length(text);
  if (!length) {
    Diagnostics problems = length.error();
    for (Diagnostic& each : problems) each.key = option;
    return problems;
  }
  if (length->value < 0.0) {
    return at_option(
        error("out-of-range"_id, fmt::format("{} {}: expected 0 or more", option, text)), option);
  }
  return length->value;
}

Result<instruments::ProbeLobes> lobes_of(const LobeWords& words, bool in_file) {
  const std::string dashes = in_file ? "" : "--";
  const auto constant = length_of_words(words.constant, dashes + "pretravel");
  if (!constant) return constant.error();
  const auto amplitude = length_of_words(words.amplitude, dashes + "lobe");
  if (!amplitude) return amplitude.error();
  if (!(std::abs(words.phase) <= 360.0)) {
    const std::string option = in_file ? "lobe_phase" : "--lobe-phase";
    return at_option(error("out-of-range"_id, fmt::format("{} {}: expected degrees, -360 to 360",
                                                          option, words.phase)),
                     option);
  }
  return instruments::ProbeLobes{*constant, *amplitude, words.phase * kRadPerDeg};
}

std::optional<Diagnostic> no_stroke(double stroke, const std::string& option) {
  constexpr double kLongest = 1e3;
  if (stroke > 0.0 && stroke <= kLongest) return std::nullopt;
  return at_option(error("out-of-range"_id, fmt::format("{} {}: expected mm above 0, at most {:g}",
                                                        option, stroke, kLongest)),
                   option);
}

Result<MotionSetup> motion_setup(const MotionWords& words) {
  if (auto problem = no_stroke(words.stroke, words.option("stroke"))) return *std::move(problem);
  constexpr double kLongest = 1e9;  // mm, as far as axes go
  if (!(words.tool_length >= 0.0 && words.tool_length <= kLongest)) {
    const std::string option = words.option("tool_length");
    return at_option(
        error("out-of-range"_id, fmt::format("{} {}: expected a length in mm, 0 to {:g}", option,
                                             words.tool_length, kLongest)),
        option);
  }
  auto machine = load_machine(words.machine, ".");
  if (!machine) return machine.error();
  auto entries =
      gather_errors(words.of_file, words.errors, drawn_by(words.errors, std::nullopt), *machine);
  if (!entries) return entries.error();
  auto errors = kinematics::resolve(*machine, *entries);
  if (!errors) return errors.error();
  const auto setup = setup_errors_of(words.setup, words.option("setup"));
  if (!setup) return setup.error();
  const auto noise = length_of_words(words.noise, words.option("noise"));
  if (!noise) return noise.error();
  const auto resolution = length_of_words(words.resolution, words.option("resolution"));
  if (!resolution) return resolution.error();
  return MotionSetup{.machine = *std::move(machine),
                     .entries = *std::move(entries),
                     .errors = *std::move(errors),
                     .setup = *setup,
                     .instrument = {*noise, *resolution, words.seed},
                     .tool_length = words.tool_length,
                     .words = report::Wording(words.style)};
}

Result<std::optional<double>> feed_per_second(const MotionWords& words) {
  if (!words.feed) return std::optional<double>{};
  constexpr double kFastest = 1e9;
  if (!(*words.feed > 0.0 && *words.feed <= kFastest)) {
    const std::string option = words.option("feed");
    return at_option(error("out-of-range"_id,
                           fmt::format("{} {}: expected a feed above 0", option, *words.feed)),
                     option);
  }
  return std::optional(*words.feed / kSecondsPerMinute);
}

instruments::SpindleBall spindle_ball_of(const MotionWords& words) {
  return words.ball_known ? instruments::SpindleBall::known : instruments::SpindleBall::unknown;
}

Result<AxisPositions> held_axes(const Machine& machine, const std::string& text,
                                const std::string& option, std::span<const AxisLetter> moved) {
  const auto words = read_axis_words(machine, text);
  if (!words) return at_option(words.error(), option);
  AxisPositions held;
  for (const auto& [letter, position] : *words) {
    if (std::ranges::find(moved, letter) != moved.end()) {
      return at_option(error("axis-moved"_id,
                             fmt::format("{} holds axes that stand: {} is moved by the test",
                                         option, to_char(letter)),
                             "leave it out"),
                       option);
    }
    held[letter] = position;
  }
  return held;
}

Result<std::vector<AxisPositions>> pose_list(const Machine& machine, const std::string& text,
                                             const std::string& option) {
  std::vector<AxisPositions> poses;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    const auto held = held_axes(machine, part, option, kinematics::kLinearAxes);
    if (!held) return held.error();
    poses.push_back(*held);
  }
  return poses;
}

Result<std::map<AxisLetter, kinematics::AxisRange>> box_of(const std::string& text,
                                                           const std::string& option) {
  std::map<AxisLetter, kinematics::AxisRange> box;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const auto equals = part.find('='), colon = part.find(':');
    std::string name = part.substr(0, equals);
    std::erase(name, ' ');
    const auto letter = kinematics::axis_named(name);
    if (equals == std::string::npos || colon == std::string::npos || colon < equals || !letter) {
      return at_option(
          error("box-text"_id, fmt::format("'{}' in {} is no range of an axis", part, option),
                "for example \"X=-200:200,Y=-150:150,Z=0:300\""),
          option);
    }
    if (box.contains(*letter)) {
      return at_option(
          error("given-twice"_id, fmt::format("axis {} is given twice in {}", name, option)),
          option);
    }
    const std::string what = option + " " + name;
    const auto low = numbers_of(part.substr(equals + 1, colon - equals - 1), 1, what);
    if (!low) return at_option(low.error(), option);
    const auto high = numbers_of(part.substr(colon + 1), 1, what);
    if (!high) return at_option(high.error(), option);
    box[*letter] = {low->front(), high->front()};
  }
  return box;
}

Result<Vec3> place_of(const std::string& text, const std::string& option) {
  const auto numbers = numbers_of(text, 3, option);
  if (!numbers) return at_option(numbers.error(), option);
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Result<std::optional<std::vector<double>>> angle_list(const std::string& text,
                                                      const std::string& option) {
  if (text.empty()) return std::optional<std::vector<double>>{};
  auto angles = number_list(text, option);
  if (!angles) return at_option(angles.error(), option);
  constexpr double kMost = 3600.0;  // deg: ten turns to either side
  for (double& angle : *angles) {
    if (std::abs(angle) > kMost) {
      return at_option(error("out-of-range"_id, fmt::format("{:g} deg in {}: expected at most {:g}",
                                                            angle, option, kMost)),
                       option);
    }
    angle *= kRadPerDeg;
  }
  return std::optional(*std::move(angles));
}

Diagnostic at_option(Diagnostic problem, const std::string& option) {
  if (!option.starts_with('-')) problem.key = option;
  return problem;
}

Diagnostics at_option(Diagnostics problems, const std::string& option) {
  for (Diagnostic& each : problems) each = at_option(std::move(each), option);
  return problems;
}

std::string MotionWords::option(std::string_view key) const {
  if (in_file) {
    constexpr std::array<std::string_view, 4> kOfInstrument{"noise", "resolution", "seed",
                                                            "stroke"};
    const bool of_instrument = std::ranges::find(kOfInstrument, key) != kOfInstrument.end();
    return (of_instrument ? "instrument." : "") + std::string(key);
  }
  std::string option = "--" + std::string(key);
  std::ranges::replace(option, '_', '-');
  return option;
}

}  // namespace frustum::app
