// frustum machines, frustum errors: what ships, and what a machine accepts.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/view/console.hpp"
#include "core/decimal.hpp"
#include "core/program_version.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {
namespace {

using kinematics::ErrorName;
using kinematics::Joint;
using kinematics::Machine;
using nlohmann::ordered_json;

struct MachinesOptions : AnswerOptions {
  std::string machine{};
};

double shown(const Joint& joint, double q) {
  return joint.rotary() ? as_stated(q * kDegPerRad) : q;
}
const char* unit(const Joint& joint) { return joint.rotary() ? "deg" : "mm"; }

int list_machines(const MachinesOptions& options) {
  ordered_json list = ordered_json::array();
  const auto files = shipped_machines();
  if (files.empty()) {
    std::string places;
    for (const auto& folder : machine_folders()) places += " " + folder.string();
    return refuse(error("no-machines"_id, "there are no machine files in" + places,
                        "the program finds them beside itself, by /proc"),
                  options);
  }
  for (const auto& file : files) {
    const auto machine = Machine::load(file);
    if (!machine) return refuse(machine.error(), options);
    if (options.json) {
      list.push_back({{"name", machine->name()},
                      {"structure", machine->structure()},
                      {"title", machine->title()},
                      {"file", file.string()},
                      {"version", program_version()}});
    } else if (!options.quiet) {
      std::cout << fmt::format("{:<20} {:<24} {}\n", machine->name(), machine->structure(),
                               machine->title());
    }
  }
  if (options.json) std::cout << list.dump(2) << '\n';
  return kDone;
}

// Where the angular component errors of an axis turn, and in whose directions its errors point.
std::string place_of(const Machine& machine, const Joint& joint) {
  std::string point = "the origin of its frame";
  if (joint.functional_point.at_tip) {
    point = "the tool tip";
  } else if (!joint.functional_point.point.isZero(0.0)) {
    const Vec3& p = joint.functional_point.point;
    point = fmt::format("({:g}, {:g}, {:g}) mm of its frame", p.x(), p.y(), p.z());
  }
  const bool rotor =
      joint.rotary() && machine.rotary_error_frame() == kinematics::RotaryErrorFrame::rotor;
  return fmt::format("errors turn about {}, directions of the {}", point,
                     rotor ? "rotor" : "stator");
}

// Errors that the machine has by name but not by choice.
ordered_json zero_by_choice(const Machine& machine) {
  ordered_json list = ordered_json::array();
  for (const Joint& joint : machine.joints()) {
    for (const auto d : {kinematics::ErrorDirection::A, kinematics::ErrorDirection::B,
                         kinematics::ErrorDirection::C}) {
      const ErrorName name{d, joint.letter, true};
      if (const auto reason = machine.refused(name)) {
        list.push_back({{"name", name.text()}, {"reason", *reason}});
      }
    }
  }
  return list;
}

std::string coordinates(const Vec3& v) {
  return fmt::format("{:g}, {:g}, {:g}", v.x(), v.y(), v.z());
}

// What the file states of its axes' places and senses, to be held against a drawing.
std::string geometry_text(const Machine& machine) {
  std::string text =
      "\nplaces, mm from the part before; senses of the tool relative to the workpiece\n";
  const auto row = [&](std::string_view name, const Vec3& offset, const std::string& rest) {
    text += fmt::format("  {:<8} at {:<{}}{}\n", name, coordinates(offset), rest.empty() ? 0 : 22,
                        rest);
  };
  for (const Joint& joint : machine.joints()) {
    row(std::string(1, to_char(joint.letter)), joint.offset,
        fmt::format(" {} {:<12} home {:g} {}", joint.rotary() ? "about" : "along",
                    coordinates(joint.direction), shown(joint, joint.home), unit(joint)));
  }
  row("spindle", machine.spindle_offset(), "");
  row("table", machine.table_offset(), "");
  return text;
}

int list_errors(const MachinesOptions& options) {
  const auto machine = load_machine(options.machine, ".");
  if (!machine) return refuse(machine.error(), options);
  ordered_json axes = ordered_json::array(), names = ordered_json::array();
  const auto error_unit = [](const ErrorName& e) {
    return is_rotation(e.direction) ? "urad" : "um";
  };
  for (const Joint& joint : machine->joints()) {
    ordered_json axis{{"axis", std::string(1, to_char(joint.letter))},
                      {"side", joint.side > 0 ? "tool" : "workpiece"},
                      {"unit", unit(joint)},
                      {"errors", place_of(*machine, joint)}};
    axis["travel"] =
        joint.endless
            ? ordered_json(nullptr)
            : ordered_json({shown(joint, joint.travel.lo), shown(joint, joint.travel.hi)});
    axes.push_back(axis);
  }
  for (const ErrorName& e : machine->error_names()) {
    names.push_back({{"name", e.text()}, {"unit", error_unit(e)}, {"meaning", e.meaning()}});
  }
  for (const auto& [symbol, alias] : machine->aliases()) {
    names.push_back({{"name", symbol},
                     {"unit", error_unit(alias.error)},
                     {"meaning", alias.meaning},
                     {"alias_of", alias.error.text()}});
  }
  if (options.json) {
    std::cout << ordered_json{{"schema", "frustum/errors/1"},
                              {"version", program_version()},
                              {"machine", machine->name()},
                              {"structure", machine->structure()},
                              {"axes", axes},
                              {"errors", names},
                              {"zero_by_choice", zero_by_choice(*machine)}}
                     .dump(2)
              << '\n';
    return kDone;
  }
  if (options.quiet) return kDone;
  std::cout << fmt::format("{}  {}  {}\n\naxes, from the bed outwards\n", machine->name(),
                           machine->structure(), machine->title());
  for (const auto& axis : axes) {
    const std::string travel =
        axis["travel"].is_null()
            ? "endless"
            : fmt::format("{} .. {} {}", axis["travel"][0].dump(), axis["travel"][1].dump(),
                          axis["unit"].get<std::string>());
    std::cout << fmt::format("  {}  {:<10} {:<20} {}\n", axis["axis"].get<std::string>(),
                             axis["side"].get<std::string>(), travel,
                             axis["errors"].get<std::string>());
  }
  std::cout << geometry_text(*machine) << "\nerrors (--error NAME=VALUE)\n";
  for (const auto& e : names) {
    std::cout << fmt::format(
        "  {:<10} {:<5} {}{}\n", e["name"].get<std::string>(), e["unit"].get<std::string>(),
        e["meaning"].get<std::string>(),
        e.contains("alias_of") ? fmt::format(" [{}]", e["alias_of"].get<std::string>()) : "");
  }
  std::cout << "\nzero by the choice of reference axes\n";
  for (const auto& e : zero_by_choice(*machine)) {
    std::cout << fmt::format("  {:<10} {}\n", e["name"].get<std::string>(),
                             e["reason"].get<std::string>());
  }
  return kDone;
}

}  // namespace

void add_machines(Command& program) {
  auto options = std::make_shared<MachinesOptions>();
  Command command = program.command("machines", "List the machines that ship");
  add_answer_options(command, *options);
  command.runs([options] { return list_machines(*options); });
}

void add_errors(Command& program) {
  auto options = std::make_shared<MachinesOptions>();
  Command command = program.command("errors",
                                    "A machine's axes, travels and every error name it "
                                    "accepts: meaning, place, and what is zero");
  command
      .option("machine,--machine", options->machine,
              "Machine file, or the name of a shipped machine")
      .required();
  add_answer_options(command, *options);
  command.footer("Example: frustum errors iwf-bc");
  command.runs([options] { return list_errors(*options); });
}

}  // namespace frustum::app
