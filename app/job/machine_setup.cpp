#include "app/job/machine_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "app/job/job.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "core/spelling.hpp"
#include "core/units.hpp"
#include "kinematics/model/inverse.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

// "5=120.5"
Result<std::pair<std::string, std::string>> halves_of(const std::string& text, const char* what,
                                                      const char* example) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && equals > 0) {
    return std::pair{text.substr(0, equals), text.substr(equals + 1)};
  }
  return error("malformed-option"_id, fmt::format("{} {}: expected {}", what, text, example));
}

struct ToolWord {
  int number = 0;
  double value = 0.0;
};
// "1=150" of an option.
Result<ToolWord> tool_word(const std::string& text, const char* option, const char* example) {
  const auto halves = halves_of(text, option, example);
  if (!halves) return halves.error();
  const auto number = numbers_of(halves->first, 1, option);
  const auto value = numbers_of(halves->second, 1, option);
  if (!number) return number.error();
  if (!value) return value.error();
  const double n = number->front();
  if (!(n >= 1.0 && n <= 99999.0 && n == std::floor(n))) {
    return error("malformed-option"_id,
                 fmt::format("{} {}: a tool is named by its number", option, text), "1 to 99999");
  }
  return ToolWord{static_cast<int>(n), value->front()};
}

std::optional<Diagnostic> add_tool_length(const std::string& text, kinematics::Setup& setup) {
  const auto word = tool_word(text, "--tool-length", "NUMBER=LENGTH, for example 1=150");
  if (!word) return word.error().front();
  if (!(word->value >= 0.0)) {
    return error("out-of-range"_id, fmt::format("--tool-length {}: a length is not negative", text),
                 "mm from the spindle's gauge point to the tip");
  }
  setup.tools[word->number].length = word->value;
  return std::nullopt;
}

std::optional<Diagnostic> add_tool_diameter(const std::string& text, parser::ToolTable& tools) {
  const auto word = tool_word(text, "--tool-diameter", "NUMBER=DIAMETER, for example 1=10");
  if (!word) return word.error().front();
  if (!(word->value > 0.0)) {
    return error("out-of-range"_id,
                 fmt::format("--tool-diameter {}: a diameter is above zero", text), "in mm");
  }
  parser::Tool& tool = parser::entry_of(tools, word->number);
  tool.diameter = word->value;
  tool.has_diameter = true;
  return std::nullopt;
}

// G54 to G59 are 1 to 6, G59.1 to G59.3 7 to 9, G54.1 P1 and on 101 and on.
std::optional<int> offset_number(const std::string& name) {
  for (int number = 1; number <= 6; ++number) {
    if (name == fmt::format("G{}", 53 + number)) return number;
  }
  for (int number = 1; number <= 3; ++number) {
    if (name == fmt::format("G59.{}", number)) return 6 + number;
  }
  constexpr std::string_view kExtended = "G54.1P";
  if (!name.starts_with(kExtended)) return std::nullopt;
  const std::string digits = name.substr(kExtended.size());
  const bool number = !digits.empty() && digits.size() <= 3 && digits.front() != '0' &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
  if (!number) return std::nullopt;
  return 100 + std::stoi(digits);
}

std::optional<Diagnostic> add_offset(const std::string& text, kinematics::Setup& setup) {
  const auto halves = halves_of(text, "--offset", "G54=X,Y,Z in mm");
  if (!halves) return halves.error().front();
  const auto number = offset_number(halves->first);
  if (!number) {
    return error("unknown-work-offset"_id,
                 fmt::format("--offset {}: no such work offset", halves->first),
                 "G54 to G59, G59.1 to G59.3, G54.1P1 to G54.1P999");
  }
  const auto origin = numbers_of(halves->second, 3, "--offset");
  if (!origin) return origin.error().front();
  setup.work_offsets[*number] = Vec3((*origin)[0], (*origin)[1], (*origin)[2]);
  return std::nullopt;
}

// Positions without tool at which the words of an offset are zero.
kinematics::AxisPositions positions_at(const std::optional<kinematics::Machine>& machine,
                                       const Vec3& origin) {
  if (machine) return kinematics::place_tip(*machine, origin, 0.0, kinematics::AxisPositions{});
  kinematics::AxisPositions at;
  for (std::size_t i = 0; i < parser::kLinearAxes.size(); ++i) {
    at[parser::kLinearAxes.at(i)] = origin[static_cast<Eigen::Index>(i)];
  }
  return at;
}

// G54 is in force, no tool in the spindle.
parser::AxisTarget home_of(const KnownSetup& known) {
  parser::AxisTarget start;
  const auto first = known.setup.work_offsets.find(1);
  const kinematics::AxisPositions home = known.machine->home();
  for (const kinematics::Joint& joint : known.machine->joints()) {
    if (joint.rotary()) {
      start[joint.letter] = home[joint.letter];
    } else if (first != known.setup.work_offsets.end()) {
      start[joint.letter] =
          home[joint.letter] - positions_at(known.machine, first->second)[joint.letter];
    }
  }
  return start;
}

// "X0,Y0,Z100" or "X=0,B=30": mm and degrees.
std::optional<Diagnostic> read_start(const std::string& text, parser::AxisTarget& start) {
  parser::AxisTarget given;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    std::erase_if(part, [](char c) { return c == ' ' || c == '='; });
    const auto letter = std::find_if(
        parser::kAxisLetters.begin(), parser::kAxisLetters.end(),
        [&](parser::AxisLetter axis) { return !part.empty() && part[0] == to_char(axis); });
    if (letter == parser::kAxisLetters.end()) {
      return error("unknown-axis"_id, fmt::format("--start {}: '{}' is no axis", text, part),
                   "for example --start X0,Y0,Z100,B30 (mm, degrees, of X Y Z A B C)");
    }
    if (given[*letter]) {
      return error("given-twice"_id,
                   fmt::format("--start {}: axis {} is given twice", text, to_char(*letter)));
    }
    const auto value = numbers_of(part.substr(1), 1, "--start");
    if (!value) return value.error().front();
    given[*letter] = value->front() * (is_rotary(*letter) ? kRadPerDeg : 1.0);
  }
  for (const parser::AxisLetter axis : parser::kAxisLetters) {
    if (given[axis]) start[axis] = given[axis];
  }
  return std::nullopt;
}

// The machine's own settings, then what the words add to them.
std::optional<Diagnostic> read_control(const SetupWords& words, KnownSetup& known) {
  if (known.machine) {
    known.control = known.machine->controller().settings();
    known.decimal_point_is_known = known.machine->controller().decimal_point.has_value();
  }
  for (const std::string& name : words.words) {
    const auto word = parser::control_word(name);
    if (!word) return word.error().front();
    known.control.words.push_back(*word);
  }
  if (words.max_blocks) known.control.max_blocks = words.max_blocks;
  if (!words.units.empty()) {
    const auto unit = parser::start_unit_named(words.units);
    if (!unit) {
      return error("malformed-option"_id,
                   fmt::format("units {}: mm or inch is expected", words.units));
    }
    known.control.unit = *unit;
  }
  if (words.decimal_point.empty()) return std::nullopt;
  const auto rule = parser::decimal_point_named(words.decimal_point);
  if (!rule) {
    return error(
        "malformed-option"_id,
        fmt::format("decimal_point {}: calculator or increment is expected", words.decimal_point));
  }
  known.control.decimal_point = *rule;
  known.decimal_point_is_known = true;
  return std::nullopt;
}

}  // namespace

void KnownSetup::tell(parser::InterpreterOptions& options) const {
  options.start = start;
  options.control = control;
  options.tools = tools;
  options.tools_are_all = false;
  for (const auto& [number, tool] : setup.tools) {
    parser::Tool& told = parser::entry_of(options.tools, number);
    told.has_length = true;
    told.offset.at(static_cast<std::size_t>(parser::AxisLetter::Z)) = tool.length;
  }
  for (const auto& [number, origin] : setup.work_offsets) {
    if (number == 1 && first_offset_is_assumed) continue;
    const kinematics::AxisPositions at = positions_at(machine, origin);
    for (const parser::AxisLetter axis : parser::kLinearAxes) {
      options.work_offsets[number].origin[axis] = at[axis];
    }
  }
}

Result<KnownSetup> known_setup_of(const SetupWords& words) {
  KnownSetup known;
  if (!words.job.empty()) {
    auto job = load_job(words.job, {}, false);
    if (!job) return job.error();
    known.setup = trials::setup_of(job->piece);
    known.tools = trials::called_tools_of(job->piece);
    known.machine = job->machine;
  } else {
    // The table's own origin is what a program without a setup sheet means.
    known.setup.work_offsets[1] = Vec3::Zero();
    known.first_offset_is_assumed = true;
  }
  for (const std::string& text : words.tool_lengths) {
    if (auto problem = add_tool_length(text, known.setup)) return *problem;
  }
  for (const std::string& text : words.tool_diameters) {
    if (auto problem = add_tool_diameter(text, known.tools)) return *problem;
  }
  for (const std::string& text : words.offsets) {
    if (auto problem = add_offset(text, known.setup)) return *problem;
    if (text.starts_with("G54=")) known.first_offset_is_assumed = false;
  }
  if (!words.machine.empty()) {
    auto loaded = load_machine(words.machine, ".");
    if (!loaded) return loaded.error();
    known.machine = *std::move(loaded);
  }
  if (auto problem = read_control(words, known)) return *problem;
  if (known.machine) known.home = known.start = home_of(known);
  if (known.first_offset_is_assumed) {
    for (const parser::AxisLetter axis : parser::kLinearAxes) known.start[axis].reset();
  }
  if (words.start.empty()) return known;
  if (auto problem = read_start(words.start, known.start)) return *problem;
  if (auto problem = read_start(words.start, known.home)) return *problem;
  return known;
}

Result<MachineSetup> machine_setup_of(const SetupWords& words) {
  auto known = known_setup_of(words);
  if (!known) return known.error();
  if (!known->machine)
    return error("no-machine"_id, "no machine", "name one with --machine, or a job with --job");
  return MachineSetup{*std::move(known->machine), std::move(known->setup), std::move(known->tools),
                      std::move(known->control)};
}

}  // namespace frustum::app
