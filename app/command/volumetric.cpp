// frustum volumetric: error vectors over the working volume of a machine, and which errors weigh
// most.
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/axis_words.hpp"
#include "app/job/machine_files.hpp"
#include "app/view/console.hpp"
#include "core/file_set.hpp"
#include "core/program_version.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_ranking.hpp"
#include "kinematics/errors/volumetric.hpp"
#include "report/number_text.hpp"
#include "report/page/volumetric_page.hpp"

namespace frustum::app {
namespace {

using kinematics::ErrorEntry;
using kinematics::ErrorName;
using kinematics::GeometricErrors;
using kinematics::HeldAxes;
using kinematics::Joint;
using kinematics::Machine;
using kinematics::MachineError;
using kinematics::VolumetricErrors;
using kinematics::VolumetricPoint;
using kinematics::VolumetricStatistics;
using nlohmann::ordered_json;

struct VolumetricOptions : AnswerOptions {
  std::string machine{};
  std::vector<std::string> errors{};
  std::vector<std::string> tolerances{};
  std::string axes{};
  int grid = 5;
  double tool_length = 0.0;
  std::string out{};
};

// Errors with their tolerances, mm or rad.
struct Tolerances {
  std::vector<MachineError> errors{};
  std::vector<double> values{};
};

struct Study {
  Machine machine;
  std::vector<ErrorEntry> entries{};
  Tolerances tolerances{};
  VolumetricErrors volume{};
};

// --- reading -------------------------------------------------------------------------------------

Result<std::vector<ErrorEntry>> read_entries(const std::vector<std::string>& texts) {
  std::vector<ErrorEntry> entries;
  for (const std::string& text : texts) {
    const auto entry = kinematics::parse_error(text);
    if (!entry) return entry.error();
    entries.push_back(*entry);
  }
  return entries;
}

// "B=30,C=0; B=-30": one position after the other.
Result<std::vector<HeldAxes>> read_positions(const Machine& machine, const std::string& text) {
  std::vector<HeldAxes> positions;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    auto words = read_axis_words(machine, part);
    if (!words) return words.error();
    positions.push_back(*std::move(words));
  }
  if (positions.empty()) positions.emplace_back();
  return positions;
}

// Errors that a group's name represents.
struct Group {
  const char* name;
  bool location;
  bool rotation;
};
constexpr Group kGroups[] = {{"displacements", false, false},
                             {"rotations", false, true},
                             {"positions", true, false},
                             {"orientations", true, true}};

std::vector<MachineError> members(const Machine& machine, const Group& group) {
  std::vector<MachineError> errors;
  for (const MachineError& e : every_error(machine)) {
    if (e.error.location == group.location && is_rotation(e.error.direction) == group.rotation) {
      errors.push_back(e);
    }
  }
  return errors;
}

Result<std::vector<MachineError>> errors_meant(const Machine& machine, const std::string& name) {
  for (const Group& group : kGroups) {
    if (name == group.name) return members(machine, group);
  }
  return errors_named(machine, std::vector{name});
}

// A later word replaces what an earlier one said of an error.
void set_tolerance(Tolerances& tolerances, const MachineError& error, double value) {
  for (std::size_t i = 0; i < tolerances.errors.size(); ++i) {
    if (tolerances.errors[i].name == error.name) {
      tolerances.values[i] = value;
      return;
    }
  }
  tolerances.errors.push_back(error);
  tolerances.values.push_back(value);
}

Result<Tolerances> read_tolerances(const Machine& machine, const std::vector<std::string>& texts) {
  const auto entries = read_entries(texts);
  if (!entries) return entries.error();
  Tolerances tolerances;
  for (const ErrorEntry& entry : *entries) {
    const auto errors = errors_meant(machine, entry.name);
    if (!errors) return errors.error();
    if (errors->empty()) continue;
    const auto& amount = entry.terms.front().amount;
    const bool angle = is_rotation(errors->front().error.direction);
    const bool constant = entry.terms.size() == 1 &&
                          entry.terms.front().kind == kinematics::ErrorShape::Kind::constant;
    if (!constant || amount.kind != (angle ? UnitKind::angle : UnitKind::length) ||
        !(amount.value > 0.0)) {
      return error("out-of-range"_id,
                   fmt::format("tolerance {} = {}: expected {} greater than 0", entry.name,
                               entry.written, angle ? "an angle" : "a length"),
                   angle ? "for example 20 urad" : "for example 10 um");
    }
    for (const MachineError& e : *errors) set_tolerance(tolerances, e, amount.value);
  }
  return tolerances;
}

Result<Study> study_of(const VolumetricOptions& options) {
  if (!std::isfinite(options.tool_length) || options.tool_length < 0.0) {
    return error(
        "out-of-range"_id,
        fmt::format("--tool-length {}: expected a length in mm, 0 or more", options.tool_length));
  }
  // A page and a JSON document of a hundred points an axis would be a million vectors.
  constexpr int kMostPoints = 41;
  if (options.grid > kMostPoints) {
    return error("out-of-range"_id,
                 fmt::format("--grid {}: at most {} points an axis", options.grid, kMostPoints));
  }
  auto machine = load_machine(options.machine, ".");
  if (!machine) return machine.error();
  auto entries = read_entries(options.errors);
  if (!entries) return entries.error();
  const auto errors = kinematics::resolve(*machine, *entries);
  if (!errors) return errors.error();
  auto tolerances = read_tolerances(*machine, options.tolerances);
  if (!tolerances) return tolerances.error();
  auto positions = read_positions(*machine, options.axes);
  if (!positions) return positions.error();
  auto volume = volumetric_errors(*machine, *errors,
                                  {.grid = options.grid,
                                   .tool_length = options.tool_length,
                                   .positions = *std::move(positions)});
  if (!volume) return volume.error();
  return Study{*std::move(machine), *std::move(entries), *std::move(tolerances),
               *std::move(volume)};
}

// --- telling -------------------------------------------------------------------------------------

struct RankRow {
  MachineError error{};
  double gain = 0.0;
  double share = 0.0;
};

// Largest share first.
std::vector<RankRow> ranking_of(const Study& study, double tool_length) {
  const Tolerances& t = study.tolerances;
  const auto gains = mean_gains(study.machine, t.errors, study.volume, tool_length);
  std::vector<RankRow> rows;
  for (const auto& ranked : rank_by_share(t.errors, gains, t.values)) {
    for (std::size_t i = 0; i < t.errors.size(); ++i) {
      if (t.errors[i].name != ranked.name) continue;
      rows.push_back({t.errors[i], gain_length(t.errors[i], gains, i), ranked.weight});
    }
  }
  return rows;
}

// A length of a length is a number, whose unit is 1.
const char* gain_unit(const MachineError& e) {
  return is_rotation(e.error.direction) ? "um/urad" : "1";
}
std::string gain_text(const RankRow& row) {
  const std::string number = fmt::format("{:.4f}", row.gain);
  return is_rotation(row.error.error.direction) ? number + " um/urad" : number;
}
const char* side_of(const Machine& machine, const MachineError& e) {
  return machine.joint(e.error.axis)->side > 0 ? "tool" : "workpiece";
}

ordered_json axes_json(const Machine& machine, const kinematics::AxisPositions& q, bool rotary) {
  ordered_json axes = ordered_json::object();
  for (const kinematics::AxisLetter letter : kinematics::kAxisLetters) {
    const Joint* joint = machine.joint(letter);
    if (joint == nullptr || joint->rotary() != rotary) continue;
    axes[std::string(1, to_char(letter))] = joint->rotary() ? q[letter] * kDegPerRad : q[letter];
  }
  return axes;
}

ordered_json place_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
ordered_json um(const Vec3& v) { return place_json(v * kUmPerMm); }
ordered_json um(const VolumetricStatistics& s) {
  return {{"max", s.max * kUmPerMm}, {"mean", s.mean * kUmPerMm}, {"p95", s.p95 * kUmPerMm}};
}

ordered_json document(const Study& study, const VolumetricOptions& options,
                      const std::vector<RankRow>& ranking) {
  ordered_json errors = ordered_json::object();
  for (const ErrorEntry& entry : study.entries) errors[entry.name] = entry.written;
  const VolumetricPoint& worst = study.volume.worst();
  ordered_json doc{{"schema", "frustum/volumetric/1"},
                   {"version", program_version()},
                   {"machine", study.machine.name()},
                   {"structure", study.machine.structure()},
                   {"tool_length_mm", options.tool_length},
                   {"errors", errors},
                   {"counts", study.volume.counts},
                   {"statistics_um",
                    {{"tool", um(study.volume.tool)},
                     {"workpiece", um(study.volume.workpiece)},
                     {"relative", um(study.volume.relative)}}},
                   {"worst",
                    {{"linear", axes_json(study.machine, worst.axes, false)},
                     {"rotary", axes_json(study.machine, worst.axes, true)},
                     {"relative_um", um(worst.relative)}}}};
  ordered_json list = ordered_json::array();
  for (const RankRow& row : ranking) {
    list.push_back({{"name", row.error.name},
                    {"side", side_of(study.machine, row.error)},
                    {"gain", row.gain},
                    {"gain_unit", gain_unit(row.error)},
                    {"share", row.share}});
  }
  doc["ranking"] = list;
  ordered_json positions = ordered_json::array();
  for (std::size_t i = 0; i < study.volume.position_count; ++i) {
    const auto points = study.volume.at_position(i);
    ordered_json rows = ordered_json::array();
    for (const VolumetricPoint& p : points) {
      rows.push_back({{"linear", axes_json(study.machine, p.axes, false)},
                      {"place_mm", place_json(p.place)},
                      {"tool_um", um(p.tool)},
                      {"workpiece_um", um(p.workpiece)},
                      {"relative_um", um(p.relative)}});
    }
    positions.push_back(
        {{"rotary", axes_json(study.machine, points.front().axes, true)}, {"points", rows}});
  }
  doc["positions"] = positions;
  return doc;
}

std::string axes_text(const Machine& machine, const kinematics::AxisPositions& q, bool rotary) {
  const ordered_json axes = axes_json(machine, q, rotary);
  std::string text;
  for (const auto& [name, value] : axes.items()) {
    text += fmt::format("{}{} {:.6g}{}", text.empty() ? "" : ", ", name, value.get<double>(),
                        rotary ? "°" : " mm");
  }
  return text;
}

std::string worst_text(const Study& study) {
  const VolumetricPoint& p = study.volume.worst();
  const std::string rotary = axes_text(study.machine, p.axes, true);
  const Vec3 e = p.relative * kUmPerMm;
  return fmt::format("largest error of tool to workpiece at {}{}{}: ({}, {}, {}) µm",
                     axes_text(study.machine, p.axes, false), rotary.empty() ? "" : ", ", rotary,
                     report::fixed_text(e.x(), 3), report::fixed_text(e.y(), 3),
                     report::fixed_text(e.z(), 3));
}

std::vector<std::array<std::string, 4>> statistics_rows(const VolumetricErrors& volume) {
  const auto row = [](const char* side, const VolumetricStatistics& s) {
    const auto text = [](double mm) { return fmt::format("{:.3f}", mm * kUmPerMm); };
    return std::array<std::string, 4>{side, text(s.max), text(s.mean), text(s.p95)};
  };
  return {row("tool", volume.tool), row("workpiece", volume.workpiece),
          row("tool to workpiece", volume.relative)};
}

report::VolumetricPage page_of(const Study& study, const VolumetricOptions& options,
                               const std::vector<RankRow>& ranking) {
  report::VolumetricPage page;
  page.title = study.machine.title();
  std::string errors;
  for (const ErrorEntry& e : study.entries) {
    errors += fmt::format("{}{} = {}", errors.empty() ? "" : "; ", e.name, e.written);
  }
  page.facts = {{"Machine", study.machine.name()},
                {"Structure", study.machine.structure()},
                {"Tool length", fmt::format("{} mm", options.tool_length)},
                {"Grid", fmt::format("{} × {} × {} points", study.volume.counts[0],
                                     study.volume.counts[1], study.volume.counts[2])},
                {"Errors", errors.empty() ? "none" : errors}};
  page.statistics = statistics_rows(study.volume);
  page.worst = worst_text(study);
  for (const RankRow& row : ranking) {
    page.ranking.push_back({row.error.name, row.error.error.meaning(), gain_text(row),
                            fmt::format("{:.1f} %", 100.0 * row.share)});
  }
  page.counts = study.volume.counts;
  for (const VolumetricPoint& p : study.volume.at_position(0)) page.places.push_back(p.place);
  for (std::size_t i = 0; i < study.volume.position_count; ++i) {
    report::VolumetricView view;
    const auto points = study.volume.at_position(i);
    view.position = axes_text(study.machine, points.front().axes, true);
    for (const VolumetricPoint& p : points) {
      view.tool.emplace_back(p.tool * kUmPerMm);
      view.workpiece.emplace_back(p.workpiece * kUmPerMm);
      view.relative.emplace_back(p.relative * kUmPerMm);
    }
    page.views.push_back(std::move(view));
  }
  return page;
}

void print_summary(const Study& study, const std::vector<RankRow>& ranking) {
  std::cout << fmt::format("{:<18} {:>12} {:>12} {:>12}   um\n", "", "maximum", "mean", "95 %");
  for (const auto& row : statistics_rows(study.volume)) {
    std::cout << fmt::format("{:<18} {:>12} {:>12} {:>12}\n", row[0], row[1], row[2], row[3]);
  }
  std::cout << worst_text(study) << '\n';
  if (!ranking.empty()) std::cout << "\nerrors by their share of the mean square\n";
  for (const RankRow& row : ranking) {
    std::cout << fmt::format("{:<8} {:>6.1f} %  gain {:<15} {}\n", row.error.name,
                             100.0 * row.share, gain_text(row), row.error.error.meaning());
  }
}

int run_volumetric(const VolumetricOptions& options) {
  std::optional<FileSet> set;
  if (!options.out.empty()) {
    auto opened = FileSet::open(options.out, {"volumetric.json", "volumetric.html"});
    if (!opened) return refuse(opened.error(), options);
    set = *std::move(opened);
  }
  const auto study = with_progress(options, "evaluate the volume",
                                   [&](report::Progress&) { return study_of(options); });
  if (!study) return refuse(study.error(), options);
  std::vector<RankRow> ranking;
  if (!study->tolerances.errors.empty()) ranking = ranking_of(*study, options.tool_length);
  const ordered_json doc = document(*study, options, ranking);
  if (set) {
    set->add("volumetric.json", doc.dump(1) + "\n");
    set->add("volumetric.html", report::volumetric_html(page_of(*study, options, ranking)));
    if (const auto written = set->write(); !written) return refuse(written.error(), options);
  }
  if (options.json) {
    std::cout << doc.dump(1) << '\n';
  } else if (!options.quiet) {
    print_summary(*study, ranking);
  }
  return kDone;
}

}  // namespace

void add_volumetric(Command& program) {
  auto options = std::make_shared<VolumetricOptions>();
  Command command = program.command(
      "volumetric", "Error vectors over the working volume, and which errors weigh most");
  command
      .option("machine,--machine", options->machine,
              "Machine file, or the name of a shipped machine")
      .required();
  command.option("--error", options->errors, "NAME=VALUE, repeated; for example EB0C=30urad");
  command.option("--tolerance", options->tolerances,
                 "NAME=VALUE, repeated: ranks these errors; NAME may be displacements, "
                 "rotations, positions or orientations");
  command.option("--grid", options->grid, "Points along each linear axis's travel, default 5");
  command.option("--axes", options->axes,
                 "\"B=30,C=0;B=-30\": axes held there (mm, degrees), one position after the "
                 "other; default: rotary axes at home");
  command.option("--tool-length", options->tool_length,
                 "mm, default 0: the tip is the gauge point");
  command.option("--out", options->out, "Folder for volumetric.html and volumetric.json");
  add_answer_options(command, *options);
  command.footer(
      "Shapes without a span extend over the axis's travel.\n"
      "Example: frustum volumetric iwf-bc --error EB0Z=20urad --error \"EXX=linear 10um\" --out "
      "vol");
  command.computes([options] { return run_volumetric(*options); });
}

}  // namespace frustum::app
