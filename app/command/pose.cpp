// frustum pose: forward and inverse kinematics of one machine, nominal and with errors.
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/axis_words.hpp"
#include "app/job/error_sources.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

using kinematics::AxisPositions;
using kinematics::Joint;
using kinematics::Machine;
using kinematics::ToolPose;
using nlohmann::ordered_json;

struct PoseOptions : AnswerOptions {
  std::string machine{};
  std::string axes{};
  std::string inverse{};
  std::string heading{};
  ErrorWords errors{};
  double tool_length = 0.0;
};

ordered_json numbers_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

ordered_json axes_json(const Machine& machine, const AxisPositions& q) {
  ordered_json axes = ordered_json::object();
  for (const kinematics::AxisLetter letter : kinematics::kAxisLetters) {
    const Joint* joint = machine.joint(letter);
    if (joint == nullptr) continue;
    axes[std::string(1, to_char(letter))] = joint->rotary() ? q[letter] * kDegPerRad : q[letter];
  }
  return axes;
}

// "X=10,Y=0,A=-30": axes not named stay 0.
Result<AxisPositions> read_axis_values(const Machine& machine, const std::string& text) {
  std::vector<std::string> known;
  for (const Joint& joint : machine.joints()) known.emplace_back(1, to_char(joint.letter));
  AxisPositions q;
  std::vector<std::string> given;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const auto equals = part.find('=');
    std::string name = part.substr(0, equals);
    std::erase(name, ' ');
    if (equals == std::string::npos || std::find(known.begin(), known.end(), name) == known.end()) {
      return error("unknown-axis"_id,
                   fmt::format("'{}' is not an axis of machine {} ({})", part, machine.name(),
                               machine.structure()),
                   fmt::format("write {}", fmt::join(known, "=..,")) + "=..");
    }
    if (std::find(given.begin(), given.end(), name) != given.end()) {
      return error("given-twice"_id, fmt::format("axis {} is given twice", name));
    }
    given.push_back(name);
    const auto value = numbers_of(part.substr(equals + 1), 1, "axis " + name);
    if (!value) return value.error();
    for (const Joint& joint : machine.joints()) {
      if (name[0] == to_char(joint.letter)) q[joint.letter] = value->front();
    }
  }
  return q;
}

// mm and degrees.
Result<AxisPositions> read_axes(const Machine& machine, const std::string& text) {
  auto q = read_axis_values(machine, text);
  if (!q) return q;
  for (const Joint& joint : machine.joints()) {
    if (joint.rotary()) (*q)[joint.letter] *= kRadPerDeg;
  }
  return q;
}

// From -1, after motion in -, to +1.
Result<AxisPositions> read_headings(const Machine& machine, const std::string& text) {
  auto heading = read_axis_values(machine, text);
  if (!heading) return heading;
  for (const Joint& joint : machine.joints()) {
    const double h = (*heading)[joint.letter];
    if (std::abs(h) <= 1.0) continue;
    return error("out-of-range"_id,
                 fmt::format("--approach {}={}: expected -1 .. +1", to_char(joint.letter), h),
                 "+1 after motion in +, -1 after motion in -");
  }
  return heading;
}

int forward(const PoseOptions& options, const Machine& machine,
            const kinematics::GeometricErrors& errors) {
  const auto q = read_axes(machine, options.axes);
  if (!q) return refuse(q.error(), options);
  const auto heading = read_headings(machine, options.heading);
  if (!heading) return refuse(heading.error(), options);
  const Pose nominal = nominal_pose(machine, *q, options.tool_length);
  const Pose actual = actual_pose(machine, errors, {*q, *heading}, options.tool_length);
  const ToolPose n = kinematics::tool_pose(nominal), a = kinematics::tool_pose(actual);
  // The rotation from the nominal tool frame to the actual one, as a vector in the table
  // frame.
  const Eigen::AngleAxisd turn(actual.rotation * nominal.rotation.transpose());
  const Vec3 turned = turn.angle() * turn.axis() * kUradPerRad;
  const std::vector<std::string> beyond = kinematics::travel_violations(machine, *q);
  ordered_json doc{{"schema", "frustum/pose/1"},
                   {"version", program_version()},
                   {"axes", axes_json(machine, *q)},
                   {"nominal", {{"tip", numbers_json(n.tip)}, {"axis", numbers_json(n.axis)}}},
                   {"actual", {{"tip", numbers_json(a.tip)}, {"axis", numbers_json(a.axis)}}},
                   {"error_um", numbers_json((a.tip - n.tip) * kUmPerMm)},
                   {"error_urad", numbers_json(turned)},
                   {"within_travel", beyond.empty()},
                   {"beyond_travel", beyond}};
  for (const std::string& axis : beyond) {
    print(std::cerr, {warning("axis-overtravel"_id, "beyond travel: " + axis)});
  }
  if (options.json) {
    std::cout << doc.dump(2) << '\n';
    return kDone;
  }
  if (options.quiet) return kDone;
  const auto row = [](const char* name, const Vec3& v, const char* unit) {
    std::cout << fmt::format("{:<22} {:>16.9f} {:>16.9f} {:>16.9f} {}\n", name, v.x(), v.y(), v.z(),
                             unit);
  };
  row("nominal tip", n.tip, "mm");
  row("nominal axis", n.axis, "");
  row("actual tip", a.tip, "mm");
  row("actual axis", a.axis, "");
  row("tip position error", (a.tip - n.tip) * kUmPerMm, "um");
  row("tool orientation error", turned, "urad");
  return kDone;
}

int inverse(const PoseOptions& options, const Machine& machine) {
  const auto values = numbers_of(options.inverse, 6, "--inverse");
  if (!values) return refuse(values.error(), options);
  const auto& v = *values;
  const auto axis = UnitVec3::of(Vec3(v[3], v[4], v[5]));
  if (!axis)
    return refuse(
        error("no-direction"_id, "the tool direction i,j,k has no length", "give x,y,z,i,j,k"),
        options);
  const auto solutions =
      kinematics::all_solutions(machine, {Vec3(v[0], v[1], v[2]), *axis}, options.tool_length);
  if (!solutions) return refuse(solutions.error(), options);
  ordered_json list = ordered_json::array();
  for (const kinematics::InverseSolution& s : *solutions) {
    list.push_back({{"axes", axes_json(machine, s.axes)},
                    {"within_travel", s.within_travel},
                    {"singular", s.singular}});
  }
  if (options.json) {
    std::cout << ordered_json{{"schema", "frustum/pose/1"},
                              {"version", program_version()},
                              {"solutions", list}}
                     .dump(2)
              << '\n';
    return kDone;
  }
  if (options.quiet) return kDone;
  for (const auto& s : list) {
    for (const auto& [name, value] : s["axes"].items()) {
      std::cout << fmt::format("{} {:.9f}  ", name, value.get<double>());
    }
    std::cout << (s["within_travel"].get<bool>() ? "within travel" : "outside travel") << '\n';
  }
  return kDone;
}

int run_pose(const PoseOptions& options) {
  constexpr double kLongest = 1e9;  // mm, as far as axes go
  if (!(options.tool_length >= 0.0 && options.tool_length <= kLongest)) {
    return refuse(
        error("out-of-range"_id, fmt::format("--tool-length {}: expected a length in mm, 0 to {:g}",
                                             options.tool_length, kLongest)),
        options);
  }
  const auto machine = load_machine(options.machine, ".");
  if (!machine) return refuse(machine.error(), options);
  const auto entries =
      gather_errors({}, options.errors, drawn_by(options.errors, std::nullopt), *machine);
  if (!entries) return refuse(entries.error(), options);
  const auto errors = kinematics::resolve(*machine, *entries);
  if (!errors) return refuse(errors.error(), options);
  if (options.axes.empty() == options.inverse.empty()) {
    return refuse(error("conflicting-options"_id, "give either --axes or --inverse",
                        "for example --axes \"X=10,A=-30\""),
                  options);
  }
  return options.inverse.empty() ? forward(options, *machine, *errors) : inverse(options, *machine);
}

}  // namespace

void add_pose(Command& program) {
  auto options = std::make_shared<PoseOptions>();
  Command command = program.command(
      "pose",
      "Tool tip and axis in the table frame from axis positions, or axis positions from a pose");
  command
      .option("machine,--machine", options->machine,
              "Machine file, or the name of a shipped machine")
      .required();
  command.option("--axes", options->axes, "\"X=10,Y=0,Z=5,A=-30,C=45\" (mm, degrees; default 0)");
  command.option(
      "--inverse", options->inverse,
      "\"x,y,z,i,j,k\": tip (mm) and tool axis; all axis solutions, those within travel and "
      "nearest to zero first");
  command.option("--approach,--heading", options->heading,
                 "\"X=1,B=-1\": direction of approach of the axes (default 0: not moved yet)");
  add_error_options(command, options->errors);
  command.option("--tool-length", options->tool_length,
                 "mm, default 0: the tip is the gauge point");
  add_answer_options(command, *options);
  command.footer(
      "Shapes without a span extend over the axis's travel.\n"
      "Example: frustum pose --machine zx-yac --axes \"X=10,A=-30,C=45\" --error beta_CA=20urad");
  command.runs([options] { return run_pose(*options); });
}

}  // namespace frustum::app
