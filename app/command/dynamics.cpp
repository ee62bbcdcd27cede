// frustum dynamics: modes, compliances and deviations in motion of a machine of rigid bodies.
#include <iostream>
#include <memory>
#include <sstream>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/dynamics/dynamics_files.hpp"
#include "app/dynamics/dynamics_json.hpp"
#include "app/job/machine_files.hpp"
#include "app/view/console.hpp"
#include "app/view/dynamics_view.hpp"
#include "dynamics/model_file.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::app {
namespace {

struct DynamicsOptions : AnswerOptions {
  std::string machine{};
  std::string other{};
  DynamicsWords words{};
  unsigned modes = 20;
  std::string out{};
  std::string measured{};
  std::string identify{};
};

struct MachineInMotion {
  kinematics::Machine machine;
  dynamics::DynamicModel model{};
};

Result<MachineInMotion> load_moving(const std::string& name) {
  const auto file = find_machine(name, ".");
  if (!file) return file.error();
  auto machine = kinematics::Machine::load(*file);
  if (!machine) return machine.error();
  auto model = dynamics::load_model(*file, *machine);
  if (!model) return model.error();
  if (!*model) return dynamics::no_dynamics(*machine, *file);
  return MachineInMotion{*std::move(machine), **std::move(model)};
}

Result<ComparedMachine> compare(const DynamicsOptions& options, const MachineInMotion& first,
                                const DynamicsAnswer& of_first) {
  const auto second = load_moving(options.other);
  if (!second) return second.error();
  const DynamicsWords same_place{.axes = options.words.axes,
                                 .tool_length = options.words.tool_length};
  const auto request = read_dynamics_request(second->machine, second->model, same_place);
  if (!request) return request.error();
  const auto of_second = answer_dynamics(second->model, *request);
  if (!of_second) return of_second.error();
  return ComparedMachine{second->machine.name(),
                         compare_inertial(first.model, of_first, second->model, *of_second)};
}

// What measured responses show of the machine, and the responses.
struct Measured {
  std::vector<dynamics::FrequencyResponse> responses{};
  std::optional<dynamics::Identification> identified{};
};

Result<Measured> read_measured(const DynamicsOptions& options, const dynamics::DynamicModel& model,
                               const DynamicsRequest& request) {
  if (options.measured.empty()) {
    if (options.identify.empty()) return Measured{};
    return error("missing-option"_id, "--identify needs --measured", "a universal file or CSV");
  }
  auto responses = dynamics::load_responses(options.measured);
  if (!responses) return responses.error();
  Measured found{*std::move(responses), std::nullopt};
  if (options.identify.empty()) {
    if (!options.out.empty() && !request.frequencies.empty()) return found;
    return error(
        "missing-option"_id,
        "--measured is drawn into the page of --out with --frf, or explained by --identify",
        "for example --out DIR --frf 1:200");
  }
  std::vector<std::string> names;
  std::istringstream in(options.identify);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  auto identified =
      identify_parameters(model, request.axes, request.tool_length, found.responses, names);
  if (!identified) return identified.error();
  found.identified = *std::move(identified);
  return found;
}

int run_dynamics(const DynamicsOptions& options) {
  std::optional<FileSet> files;
  if (!options.out.empty()) {
    auto opened = FileSet::open(options.out, dynamics_file_names());
    if (!opened) return refuse(opened.error(), options);
    files = *std::move(opened);
  }
  const auto found = load_moving(options.machine);
  if (!found) return refuse(found.error(), options);
  const auto request = read_dynamics_request(found->machine, found->model, options.words);
  if (!request) return refuse(request.error(), options);
  for (const std::string& axis : kinematics::travel_violations(found->machine, request->axes)) {
    print(std::cerr, {warning("axis-overtravel"_id, "beyond travel: " + axis)});
  }
  const auto answer = answer_dynamics(found->model, *request);
  if (!answer) return refuse(answer.error(), options);
  std::optional<ComparedMachine> compared;
  if (!options.other.empty()) {
    auto other = compare(options, *found, *answer);
    if (!other) return refuse(other.error(), options);
    compared = *std::move(other);
  }
  const auto measured = read_measured(options, found->model, *request);
  if (!measured) return refuse(measured.error(), options);
  const DynamicsReport report{found->machine, found->model,        *request, *answer, options.modes,
                              compared,       measured->identified};
  const std::string document = dynamics_json(report) + '\n';
  if (files) {
    add_dynamics_files(*files, found->machine, found->model, *request, *answer,
                       measured->responses);
    files->add("dynamics.json", document);
    if (const auto written = files->write(); !written) return refuse(written.error(), options);
  }
  if (options.json) {
    std::cout << document;
  } else if (!options.quiet) {
    std::cout << dynamics_text(report);
  }
  return kDone;
}

}  // namespace

void add_dynamics(Command& program) {
  auto options = std::make_shared<DynamicsOptions>();
  DynamicsWords& words = options->words;
  Command command = program.command(
      "dynamics", "Modes, compliances and deviations in motion of a machine with [dynamics]");
  command
      .option("machine,--machine", options->machine,
              "Machine file, or the name of a shipped machine")
      .required();
  command.option("--axes", words.axes, "\"X=10,Y=0,Z=5,B=-30,C=45\" (mm, degrees; default 0)");
  command.option("--tool-length", words.tool_length, "mm, default 0: the tip is the gauge point");
  command.option("--modes", options->modes, "Modes and poles to list at most, default 20")
      .within(1U, 1000U);
  command.option(
      "--frf", words.frequencies,
      "Hz: \"20,57\", or \"1:200\" in steps of 1, or \"1:200:0.5\": responses to a force "
      "at the tip and to accelerations of the axes");
  command.option("--rates", words.rates,
                 "\"X=0.1:1,B=-1.5:3\": velocity and acceleration (m, rad, s) of each axis");
  command.option(
      "--map", words.map,
      "\"Y=-300:300:20,Z=-100:500:20\": from, to (mm, degrees) and number of positions of "
      "two axes");
  command.option("--quantity", words.quantity, "Of the map: Hx/x (default), f1, Gxx and so on");
  command.option("--circle", words.circle, "XY: circle of two linear axes, in its steady state");
  command.option("--radius", words.radius, "mm, of the circle");
  command.option("--feed", words.feed, "mm/min, of the circle");
  command.option(
      "--move", words.move,
      "\"X:100:0.5:4:100\": distance (mm, degrees), velocity, acceleration, jerk (m, rad, "
      "s) from rest to rest");
  command.option("--compare", options->other,
                 "Another machine in the same position: change of the inertial compliances");
  command.option(
      "--measured", options->measured,
      "Measured responses: a universal file (58), or CSV with frequency_hz,Gxx_re,Gxx_im "
      "(Hz, um/N)");
  command.option("--identify", options->identify,
                 "\"mount.stiffness.z,mount.damping\": factors on these that explain --measured");
  command.option("--out", options->out,
                 "Folder for dynamics.json, report.html, and frf.csv, frf.uff with --frf, map.csv");
  add_answer_options(command, *options);
  command.footer(
      "Example: frustum dynamics iwf-bc --axes \"Z=300\" --tool-length 150 --frf 1:200 "
      "--map \"Y=-300:300:20,Z=-100:500:20\" --quantity Hx/x");
  command.runs([options] { return run_dynamics(*options); });
}

}  // namespace frustum::app
