#include "app/dynamics/dynamics_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "app/job/axis_words.hpp"
#include "app/job/number_list.hpp"
#include "core/constants.hpp"
#include "core/counted.hpp"

namespace frustum::app {
namespace {

using dynamics::DynamicModel;
using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Joint;
using kinematics::Machine;

std::vector<std::string> parts_of(const std::string& text, char delimiter) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, delimiter);) parts.push_back(part);
  return parts;
}

// "0.1:1": as many numbers as there may be.
Result<std::vector<double>> colon_numbers(std::string text, std::size_t least, std::size_t most,
                                          const std::string& what, const std::string& hint) {
  const auto count = 1U + static_cast<std::size_t>(std::ranges::count(text, ':'));
  if (count < least || count > most) {
    return error("number-count"_id,
                 fmt::format("{}: '{}' has {}", what, text, counted(count, "number")), hint);
  }
  std::ranges::replace(text, ':', ',');
  return numbers_of(text, count, what);
}

struct AxisWord {
  std::size_t axis = 0;  // of the model
  std::string value{};
};
// "X=0.1:1"; `separator` is after the axis.
Result<AxisWord> axis_word(const DynamicModel& model, const std::string& word, char separator,
                           const std::string& what) {
  const auto at = word.find(separator);
  std::string name = word.substr(0, at);
  std::erase(name, ' ');
  const auto letter = kinematics::axis_named(name);
  const auto axis = letter ? model.axis(*letter) : std::nullopt;
  if (at == std::string::npos || !axis) {
    std::vector<std::string> known;
    for (std::size_t k = 0; k < model.axes.size(); ++k) known.push_back(model.body_name(k + 1));
    return error("unknown-axis"_id,
                 fmt::format("{}: '{}' is not an axis of machine {}", what, word, model.name),
                 fmt::format("axes: {}", fmt::join(known, ", ")));
  }
  return AxisWord{*axis, word.substr(at + 1)};
}

double unit_of(const Joint& joint) { return joint.rotary() ? kRadPerDeg : 1.0; }
// From m or rad to mm or rad.
double rate_unit(const Joint& joint) { return joint.rotary() ? 1.0 : kMillimetres; }

Result<std::vector<double>> read_frequencies(const DynamicModel& model, const std::string& text) {
  constexpr std::size_t kMost = 100'000;  // lines of a table that somebody reads
  const std::string hint = "for example 20,57 or 1:200 or 1:200:0.5, in Hz";
  std::vector<double> found;
  for (const std::string& part : parts_of(text, ',')) {
    const auto range = colon_numbers(part, 1, 3, "--frf", hint);
    if (!range) return range.error();
    const double from = range->front(), to = range->size() > 1 ? (*range)[1] : from;
    const double step = range->size() > 2 ? (*range)[2] : 1.0;
    if (!(from >= 0.0 && to >= from && step > 0.0 && (to - from) / step < double(kMost))) {
      return error("out-of-range"_id,
                   fmt::format("--frf {}: expected frequencies from 0 Hz on, rising, {} at most",
                               part, kMost),
                   hint);
    }
    const auto count = static_cast<int>(std::floor((to - from) / step * (1.0 + 1e-12))) + 1;
    for (int i = 0; i < count; ++i) found.push_back(from + i * step);
    if (found.size() > kMost) {
      return error("out-of-range"_id, fmt::format("--frf: more than {} frequencies", kMost), hint);
    }
  }
  if (model.is_controlled() && std::ranges::count(found, 0.0) > 0) {
    return error("out-of-range"_id,
                 "--frf: at 0 Hz an integral part is infinitely stiff; give a frequency above 0",
                 hint);
  }
  return found;
}

Result<RatesRequest> read_rates(const DynamicModel& model, const std::string& text) {
  RatesRequest rates;
  for (const std::string& word : parts_of(text, ',')) {
    const auto named = axis_word(model, word, '=', "--rates");
    if (!named) return named.error();
    const auto values = colon_numbers(named->value, 2, 2, "--rates",
                                      "VELOCITY:ACCELERATION in m, rad and s: X=0.1:1,B=-1.5:3");
    if (!values) return values.error();
    const Joint& joint = model.axes[named->axis].joint;
    rates.velocity[joint.letter] = values->front() * rate_unit(joint);
    rates.acceleration[joint.letter] = values->back() * rate_unit(joint);
  }
  return rates;
}

Result<dynamics::MapAxis> read_map_axis(const DynamicModel& model, const std::string& word) {
  const auto named = axis_word(model, word, '=', "--map");
  if (!named) return named.error();
  const auto values = colon_numbers(named->value, 3, 3, "--map",
                                    "FROM:TO:COUNT in mm or degrees: Y=-300:300:20,Z=-100:500:20");
  if (!values) return values.error();
  const double count = (*values)[2];
  constexpr double kMost = 1000.0;  // a map of a million positions takes minutes
  if (!(count >= 1.0 && count <= kMost && count == std::floor(count))) {
    return error(
        "out-of-range"_id,
        fmt::format("--map {}: expected a whole number of positions, 1 to {:g}", word, kMost));
  }
  const Joint& joint = model.axes[named->axis].joint;
  return dynamics::MapAxis{joint.letter, (*values)[0] * unit_of(joint),
                           (*values)[1] * unit_of(joint), static_cast<int>(count)};
}

std::optional<Eigen::Index> direction_of(char letter) {
  return letter >= 'x' && letter <= 'z' ? std::optional<Eigen::Index>(letter - 'x') : std::nullopt;
}

struct NamedQuantity {
  dynamics::MapQuantity quantity{};
  std::string title{};
};

// "Hx/x", "Hx/x.." for the acceleration of axis X, "f1", "Gxx".
Result<NamedQuantity> read_quantity(const DynamicModel& model, const std::string& text) {
  std::string word = text;
  while (word.ends_with('.') || word.ends_with('\'')) word.pop_back();
  if (word.size() == 4 && word[0] == 'H' && word[2] == '/') {
    const auto direction = direction_of(word[1]);
    const char axis_name = static_cast<char>(std::toupper(word[3]));
    const auto letter = kinematics::axis_named(std::string(1, axis_name));
    const auto axis = letter ? model.axis(*letter) : std::nullopt;
    if (direction && axis) {
      return NamedQuantity{dynamics::InertialQuantity{*direction, *letter},
                           fmt::format("|H{}/{}..| {}", word[1], axis_name,
                                       is_rotary(*letter) ? "um/(rad/s^2)" : "um/gn")};
    }
  }
  if (word.size() == 3 && word[0] == 'G') {
    const auto motion = direction_of(word[1]), force = direction_of(word[2]);
    if (motion && force) {
      return NamedQuantity{dynamics::ComplianceQuantity{*motion, *force},
                           fmt::format("|{}| um/N", word)};
    }
  }
  const auto modes = static_cast<int>(6 * (model.axes.size() + 1));
  if (word.size() >= 2 && word.size() <= 4 && word[0] == 'f' &&
      std::all_of(word.begin() + 1, word.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    const int mode = std::stoi(word.substr(1));
    if (mode >= 1 && mode <= modes) {
      return NamedQuantity{dynamics::FrequencyQuantity{mode - 1}, word + " Hz"};
    }
  }
  return error(
      "unknown-choice"_id,
      fmt::format("--quantity: '{}' is not a quantity of machine {}", text, model.name),
      fmt::format("Hx/x (tip x for acceleration of X), f1 to f{}, Gxx (static compliance)", modes));
}

Result<WorkspaceMapRequest> read_map(const DynamicModel& model, const DynamicsWords& words) {
  const auto parts = parts_of(words.map, ',');
  if (parts.size() != 2) {
    return error("number-count"_id, fmt::format("--map {}: expected two axes", words.map),
                 "for example Y=-300:300:20,Z=-100:500:20");
  }
  const auto rows = read_map_axis(model, parts[0]), columns = read_map_axis(model, parts[1]);
  if (!rows) return rows.error();
  if (!columns) return columns.error();
  if (rows->letter == columns->letter) {
    return error("given-twice"_id,
                 fmt::format("--map: axis {} is given twice", to_char(rows->letter)));
  }
  const auto quantity = read_quantity(model, words.quantity.empty() ? "Hx/x" : words.quantity);
  if (!quantity) return quantity.error();
  return WorkspaceMapRequest{*rows, *columns, quantity->quantity, quantity->title};
}

Result<double> positive(const std::optional<double>& value, const char* option, const char* unit) {
  constexpr double kLargest = 1e9;
  if (value && *value > 0.0 && *value <= kLargest) return *value;
  return error("out-of-range"_id,
               value ? fmt::format("{} {}: expected a number of {} above 0", option, *value, unit)
                     : fmt::format("--circle needs {} in {}", option, unit),
               "for example --circle XY --radius 50 --feed 10000");
}

Result<CircleRequest> read_circle(const DynamicModel& model, const DynamicsWords& words) {
  CircleRequest circle;
  std::vector<std::size_t> axes;
  for (const char name : words.circle) {
    const auto letter = kinematics::axis_named(std::string(1, name));
    const auto axis = letter && !is_rotary(*letter) ? model.axis(*letter) : std::nullopt;
    if (axis) axes.push_back(*axis);
  }
  if (words.circle.size() != 2 || axes.size() != 2 || axes[0] == axes[1]) {
    return error("unknown-choice"_id,
                 fmt::format("--circle {}: expected two linear axes", words.circle), "XY, YZ, ZX");
  }
  const auto radius = positive(words.radius, "--radius", "mm");
  if (!radius) return radius.error();
  const auto feed = positive(words.feed, "--feed", "mm/min");
  if (!feed) return feed.error();
  return CircleRequest{axes[0], axes[1], *radius / kMillimetres,
                       *feed / kMillimetres / kSecondsPerMinute};
}

Result<MoveRequest> read_move(const DynamicModel& model, const std::string& text) {
  const auto named = axis_word(model, text, ':', "--move");
  if (!named) return named.error();
  const std::string hint =
      "AXIS:DISTANCE:VELOCITY:ACCELERATION:JERK, the distance in mm or degrees, the others in m, "
      "rad and s: X:100:0.5:4:100";
  const auto values = colon_numbers(named->value, 4, 4, "--move", hint);
  if (!values) return values.error();
  const bool limits =
      std::all_of(values->begin() + 1, values->end(), [](double v) { return v > 0.0; });
  if (!limits || values->front() == 0.0) {
    return error(
        "out-of-range"_id,
        fmt::format("--move {}: expected a distance that is not 0 and limits above 0", text), hint);
  }
  const Joint& joint = model.axes[named->axis].joint;
  const double unit = joint.rotary() ? kRadPerDeg : 1.0 / kMillimetres;
  const MoveRequest move{named->axis,
                         {(*values)[0] * unit, (*values)[1], (*values)[2], (*values)[3]}};
  constexpr double kLongest = 1000.0;  // s, of which each half millisecond is computed
  const double takes = dynamics::jerk_profile(move.limits).back().time;
  if (!(takes <= kLongest)) {
    return error("out-of-range"_id,
                 fmt::format("--move {} takes {:.3g} s, more than {:g}", text, takes, kLongest),
                 hint);
  }
  return move;
}

}  // namespace

Result<DynamicsRequest> read_dynamics_request(const Machine& machine, const DynamicModel& model,
                                              const DynamicsWords& words) {
  DynamicsRequest request;
  constexpr double kLongest = 1e9;  // mm, as far as axes go
  if (!(words.tool_length >= 0.0 && words.tool_length <= kLongest)) {
    return error(
        "out-of-range"_id,
        fmt::format("--tool-length {}: expected a length in mm, 0 or more", words.tool_length));
  }
  request.tool_length = words.tool_length;
  const auto axes = read_axis_words(machine, words.axes);
  if (!axes) return axes.error();
  for (const auto& [letter, value] : *axes) request.axes[letter] = value;
  const auto frequencies = read_frequencies(model, words.frequencies);
  if (!frequencies) return frequencies.error();
  request.frequencies = *frequencies;
  for (const auto& [given, option, needed, needs] :
       {std::tuple{!words.quantity.empty(), "--quantity", "--map", words.map.empty()},
        std::tuple{words.radius.has_value(), "--radius", "--circle", words.circle.empty()},
        std::tuple{words.feed.has_value(), "--feed", "--circle", words.circle.empty()}}) {
    if (given && needs) {
      return error("missing-option"_id, fmt::format("{} is of {}", option, needed),
                   fmt::format("add {}, or leave {} out", needed, option));
    }
  }
  if (!words.rates.empty()) {
    auto rates = read_rates(model, words.rates);
    if (!rates) return rates.error();
    request.rates = *rates;
  }
  if (!words.map.empty()) {
    auto map = read_map(model, words);
    if (!map) return map.error();
    request.map = *map;
  }
  if (!words.circle.empty()) {
    auto circle = read_circle(model, words);
    if (!circle) return circle.error();
    request.circle = *circle;
  }
  if (!words.move.empty()) {
    auto move = read_move(model, words.move);
    if (!move) return move.error();
    request.move = *move;
  }
  return request;
}

}  // namespace frustum::app
