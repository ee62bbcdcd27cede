#include "trials/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dynamics/servo.hpp"
#include "kinematics/controller/controller.hpp"
#include "kinematics/controller/source_lines.hpp"
#include "kinematics/errors/error_size.hpp"
#include "parser/doubts.hpp"
#include "parser/interpreter.hpp"
#include "trials/cut_check.hpp"
#include "trials/piece_reading.hpp"
#include "trials/travel_as_read.hpp"

namespace frustum::trials {
namespace {

using kinematics::AxisSample;
using kinematics::AxisSpans;
using kinematics::GeometricErrors;
using kinematics::Machine;
using programs::TestPiece;

AxisSpans ranges_of(const Machine& machine, std::span<const AxisSample> samples) {
  AxisSpans ranges;
  for (const kinematics::Joint& joint : machine.joints()) {
    const auto [lo, hi] = std::minmax_element(samples.begin(), samples.end(),
                                              [&](const AxisSample& a, const AxisSample& b) {
                                                return a.axes[joint.letter] < b.axes[joint.letter];
                                              });
    ranges[joint.letter] = {lo->axes[joint.letter], hi->axes[joint.letter]};
  }
  return ranges;
}

// The samples of each operation, with the position before its first block.
std::vector<OperationTrace> traces_of(const Machine& machine, const TestPiece& piece,
                                      const std::vector<AxisSample>& axes) {
  std::vector<OperationTrace> traces;
  for (const programs::Operation& op : piece.operations) {
    const auto inside = [&](const AxisSample& s) {
      return kinematics::comes_from(s, op.first_line, op.last_line);
    };
    const auto first = std::find_if(axes.begin(), axes.end(), inside);
    if (first == axes.end() || first == axes.begin()) continue;
    const auto last = std::find_if_not(first, axes.end(), inside);
    OperationTrace trace{op.name, op.kind, std::vector<AxisSample>(std::prev(first), last), {}};
    trace.ranges = ranges_of(machine, trace.samples);
    traces.push_back(std::move(trace));
  }
  return traces;
}

Result<stock::Workpiece> cut(const TestPiece& piece, kinematics::ToolPath path) {
  std::map<int, cutter::Cutter> tools;
  for (const auto& [number, spec] : piece.tools) {
    auto tool = cutter::Cutter::make(spec);
    if (!tool) {
      Diagnostics problems = tool.error();
      for (Diagnostic& d : problems) d.key = fmt::format("tool.{}", number);
      return problems;
    }
    tools.emplace(number, *std::move(tool));
  }
  auto swept = cutter::SweptCutter::sweep(std::move(path), std::move(tools));
  if (!swept) return in_file(swept.error(), piece.program_file);
  auto blank = stock::Blank::make(piece.blank, piece.blank_origin);
  if (!blank) {
    Diagnostics problems = blank.error();
    for (Diagnostic& d : problems) d.key = "blank";
    return problems;
  }
  return stock::Workpiece(*std::move(blank), *std::move(swept));
}

Diagnostics oversize_in(const Machine& machine, const GeometricErrors& errors,
                        const kinematics::CommandedProgram& program) {
  std::vector<kinematics::AxisPositions> places;
  for (const kinematics::AxisSample& end : kinematics::block_ends(program)) {
    places.push_back(end.axes);
  }
  return kinematics::oversize_errors(machine, errors, places);
}

Result<stock::MachineCollisions> machine_collisions_of(const Machine& machine,
                                                       const TestPiece& piece,
                                                       const kinematics::CommandedProgram& program,
                                                       const stock::Workpiece& workpiece) {
  const kinematics::Setup setup = setup_of(piece);
  std::map<int, cutter::Cutter> used;
  for (const kinematics::PathBlock& block : workpiece.removed().path().blocks) {
    used.try_emplace(block.tool, workpiece.removed().tool(block.tool));
  }
  const auto scene = stock::scene_of(machine, piece.fixtures, setup, used, workpiece.blank());
  if (!scene) return scene.error();
  return stock::find_machine_collisions(*scene, setup, program);
}

void add_machine_collisions(Trial& trial) {
  const stock::MachineCollisions& met = trial.machine_collisions;
  trial.collisions.insert(trial.collisions.end(), met.collisions.begin(), met.collisions.end());
  std::ranges::stable_sort(trial.collisions, {}, &stock::Collision::block);
  trial.warnings.insert(trial.warnings.end(), met.warnings.begin(), met.warnings.end());
}

// A part that cannot be measured: likely for what the program ran into.
std::optional<Diagnostic> damage_by(const Trial& trial, const TestPiece& piece) {
  const auto runs_into = [](const stock::Collision& collision) {
    return collision.kind != stock::CollisionKind::feed_with_spindle_off;
  };
  const auto first = std::ranges::find_if(trial.collisions, runs_into);
  if (first == trial.collisions.end()) return std::nullopt;
  const auto count = std::ranges::count_if(trial.collisions, runs_into);
  Diagnostic damage = warning(
      "part-damaged"_id,
      fmt::format("the program runs into the part, the machine or a fixture {} time{}, here "
                  "first: what cannot be measured may be damaged",
                  count, count == 1 ? "" : "s"),
      "frustum check --job lists where, and how deep");
  damage.file = first->source_file ? *first->source_file : piece.program_file;
  damage.line = static_cast<int>(first->source_line);
  return damage;
}

void begin(const std::function<void(Stage)>& on_stage, Stage stage) {
  if (on_stage) on_stage(stage);
}

// Where the program begins: a loop that does not decay there follows no path.
std::optional<Diagnostic> unstable_control(const TrialOptions& options,
                                           const kinematics::CommandedProgram& program) {
  if (!options.has_dynamics() || options.dynamics.method != dynamics::PathMethod::linear) {
    return std::nullopt;
  }
  const dynamics::DynamicModel& model = *options.dynamic_model;
  return instability(model, servo_system(model, program.start, 0.0));
}

// From the tool path on.
struct CutAndMeasure {
  const Machine& machine;
  const TestPiece& piece;
  const kinematics::CommandedProgram* program;  // null: what it meets is in the trial already
  const metrology::CmmModel& cmm;
  const TrialOptions& options;

  // `trial` has what is known of the program.
  [[nodiscard]] Result<Trial> run(Trial trial, kinematics::Travel travel) const;
};

Result<Trial> CutAndMeasure::run(Trial trial, kinematics::Travel travel) const {
  if (travel.path.segments.empty()) {
    Diagnostic idle = warning("no-motion"_id, "the program moves no tool: the blank stays as it is",
                              "check that it is the right file");
    idle.file = piece.program_file;
    trial.warnings.push_back(std::move(idle));
  }
  trial.cycle_time = travel.cycle_time;
  trial.slowed = kinematics::slowed_blocks(travel.path);

  begin(options.on_stage, Stage::cut);
  auto workpiece = cut(piece, std::move(travel.path));
  if (!workpiece) return workpiece.error();
  trial.workpiece = std::make_shared<const stock::Workpiece>(*std::move(workpiece));
  if (auto away = away_from_blank(*trial.workpiece, piece)) {
    trial.wrong_cuts.push_back(*std::move(away));
  }

  if (options.find_collisions) {
    begin(options.on_stage, Stage::collide);
    trial.collisions = stock::find_collisions(*trial.workpiece);
    for (Diagnostic& d : against_hand(*trial.workpiece, piece)) {
      trial.warnings.push_back(std::move(d));
    }
    if (program != nullptr) {
      auto met = machine_collisions_of(machine, piece, *program, *trial.workpiece);
      if (!met) return met.error();
      trial.machine_collisions = *std::move(met);
    }
    add_machine_collisions(trial);
  }
  if (options.measure) {
    begin(options.on_stage, Stage::measure);
    const WorkpieceProbe probe(*trial.workpiece);
    auto measurement = metrology::measure(piece.plan, probe, cmm);
    if (!measurement) {
      Diagnostics problems = measurement.error();
      if (auto damage = damage_by(trial, piece))
        problems.insert(problems.begin(), *std::move(damage));
      return problems;
    }
    trial.measurement = *std::move(measurement);
    for (Diagnostic& d :
         wrongly_cut_features(piece, trial.workpiece->removed().path(), trial.measurement)) {
      trial.wrong_cuts.push_back(std::move(d));
    }
  }
  return trial;
}

Result<Trial> run_as_read(const Machine& machine, const GeometricErrors& errors,
                          const TestPiece& piece, const metrology::CmmModel& cmm,
                          const TrialOptions& options) {
  auto read = travel_as_read(machine, errors, piece, options);
  if (!read) return read.error();
  Trial trial;
  trial.warnings = std::move(read->warnings);
  trial.program_files = std::move(read->program_files);
  trial.machine_collisions = std::move(read->machine_collisions);
  return CutAndMeasure{machine, piece, nullptr, cmm, options}.run(std::move(trial),
                                                                  std::move(read->travel));
}

}  // namespace

Result<kinematics::Travel> still_travel(const Machine& machine, const GeometricErrors& errors,
                                        const kinematics::Setup& setup,
                                        const kinematics::CommandedProgram& program,
                                        const TrialOptions& options) {
  if (auto unstable = unstable_control(options, program)) return *std::move(unstable);
  return kinematics::travel(machine, setup, program, errors,
                            {.path_bound = options.path_bound,
                             .time_law = options.time_law,
                             .servo_lag = options.servo_lag,
                             .time_step = options.has_dynamics() ? options.dynamics.time_step : 0.0,
                             .poses_alone = options.poses_alone && !options.has_dynamics()});
}

Result<kinematics::Travel> tool_travel(const Machine& machine, const GeometricErrors& errors,
                                       const kinematics::Setup& setup,
                                       const kinematics::CommandedProgram& program,
                                       const TrialOptions& options) {
  auto travel = still_travel(machine, errors, setup, program, options);
  if (!travel || !options.has_dynamics()) return travel;
  travel->path =
      with_dynamics(*options.dynamic_model, setup, std::move(travel->path), options.dynamics);
  return travel;
}

Result<CommandedPiece> command_piece(const Machine& machine, const TestPiece& piece,
                                     const std::function<void(Stage)>& on_stage) {
  begin(on_stage, Stage::parse);
  const auto program = parser::parse_program(piece.program, piece.program_file, piece.dialect);
  if (!program) return program.error();
  std::vector<std::string> opened;
  auto motions = parser::motions_of(*program, reading_of(machine, piece, opened));
  if (!motions) return motions.error();
  auto files = hashed(opened);
  if (!files) return files.error();
  begin(on_stage, Stage::execute);
  auto commanded = kinematics::command(machine, setup_of(piece), *motions);
  if (!commanded) return in_file(commanded.error(), piece.program_file);
  CommandedPiece result{.motions = *std::move(motions), .program = *std::move(commanded)};
  result.program_files = *std::move(files);
  result.operations = traces_of(machine, piece, kinematics::block_ends(result.program));
  result.warnings = parser::doubts_of(result.motions);
  auto& warned = result.program.warnings;
  result.warnings.insert(result.warnings.end(), warned.begin(), warned.end());
  result.warnings = in_file(std::move(result.warnings), piece.program_file);
  return result;
}

Result<Trial> run_trial(const Machine& machine, const GeometricErrors& errors,
                        const TestPiece& piece, const CommandedPiece& commanded,
                        const metrology::CmmModel& cmm, const TrialOptions& options) {
  const Diagnostics oversize = oversize_in(machine, errors, commanded.program);
  if (has_error(oversize)) return oversize;
  auto travel = tool_travel(machine, errors, setup_of(piece), commanded.program, options);
  if (!travel) return travel.error();
  Trial trial;
  trial.operations = commanded.operations;
  trial.warnings = commanded.warnings;
  trial.program_files = commanded.program_files;
  trial.warnings.insert(trial.warnings.end(), oversize.begin(), oversize.end());
  return CutAndMeasure{machine, piece, &commanded.program, cmm, options}.run(std::move(trial),
                                                                             *std::move(travel));
}

std::string_view name_of(Stage stage) {
  constexpr std::string_view kNames[] = {"parse", "execute", "cut", "find collisions", "measure"};
  return kNames[static_cast<std::size_t>(stage)];
}

parser::ToolTable called_tools_of(const TestPiece& piece) {
  parser::ToolTable tools;
  for (const auto& [number, cutter] : piece.tools) {
    parser::Tool& tool = parser::entry_of(tools, number);
    tool.diameter = cutter.diameter.value;
    tool.has_diameter = true;
    tool.remark = cutter.name;
  }
  return tools;
}

kinematics::Setup setup_of(const TestPiece& piece) {
  kinematics::Setup setup;
  setup.table_from_workpiece = piece.placement.table_from_workpiece();
  setup.work_offsets = piece.work_offsets;
  for (const auto& [number, tool] : piece.tools) {
    setup.tools[number] = {tool.length.value, tool.length_error.value,
                           cutter::flute_height(tool).value};
  }
  return setup;
}

Result<Trial> run_trial(const Machine& machine, std::span<const kinematics::ErrorEntry> errors,
                        const TestPiece& piece, const metrology::CmmModel& cmm,
                        const TrialOptions& options) {
  if (options.poses_alone && piece.error_span.empty()) {
    const auto resolved = kinematics::resolve(machine, errors, AxisSpans{});
    if (resolved && may_travel_as_read(machine, *resolved, piece, options)) {
      return run_as_read(machine, *resolved, piece, cmm, options);
    }
  }
  const auto commanded = command_piece(machine, piece, options.on_stage);
  if (!commanded) return commanded.error();
  const auto resolved = errors_for(machine, errors, piece, *commanded);
  if (!resolved) return resolved.error();
  return run_trial(machine, *resolved, piece, *commanded, cmm, options);
}

Result<Trial> run_trial(const Machine& machine, const GeometricErrors& errors,
                        const TestPiece& piece, const metrology::CmmModel& cmm,
                        const TrialOptions& options) {
  if (may_travel_as_read(machine, errors, piece, options)) {
    return run_as_read(machine, errors, piece, cmm, options);
  }
  const auto commanded = command_piece(machine, piece, options.on_stage);
  if (!commanded) return commanded.error();
  return run_trial(machine, errors, piece, *commanded, cmm, options);
}

Result<AxisSpans> error_spans(const TestPiece& piece, const CommandedPiece& commanded) {
  if (piece.error_span.empty()) return AxisSpans{};
  for (const OperationTrace& trace : commanded.operations) {
    if (trace.name == piece.error_span) return trace.ranges;
  }
  Diagnostic failure =
      error("unknown-operation"_id,
            fmt::format("there is no operation '{}' with axis motion", piece.error_span),
            "name one of the job's [[operation]] entries");
  failure.key = "error_span.operation";
  return failure;
}

Result<GeometricErrors> errors_for(const Machine& machine,
                                   std::span<const kinematics::ErrorEntry> errors,
                                   const TestPiece& piece) {
  const auto commanded = command_piece(machine, piece);
  if (!commanded) return commanded.error();
  return errors_for(machine, errors, piece, *commanded);
}

Result<GeometricErrors> errors_for(const Machine& machine,
                                   std::span<const kinematics::ErrorEntry> errors,
                                   const TestPiece& piece, const CommandedPiece& commanded) {
  const auto spans = error_spans(piece, commanded);
  if (!spans) return spans.error();
  auto resolved = kinematics::resolve(machine, errors, *spans);
  if (resolved || piece.error_span.empty()) return resolved;
  Diagnostics problems = std::move(resolved).error();
  for (Diagnostic& d : problems) {
    if (d.id == "error-span"_id) d.message += fmt::format(" ('{}')", piece.error_span);
  }
  return problems;
}

std::optional<metrology::Touch> WorkpieceProbe::touch(const Vec3& start, const UnitVec3& direction,
                                                      double length_mm) const {
  const auto surface = workpiece_->first_surface({start, direction}, {0.0, length_mm});
  if (!surface) return std::nullopt;
  return metrology::Touch{surface->point, surface->normal, surface->provenance()};
}

}  // namespace frustum::trials
