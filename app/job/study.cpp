#include "app/job/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/job/measured_values.hpp"
#include "core/toml_document.hpp"
#include "core/units.hpp"
#include "metrology/plan/point_deviations.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"
#include "trials/parameter.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using trials::Parameter;

void append_all(Diagnostics& all, const Diagnostics& more) {
  all.insert(all.end(), more.begin(), more.end());
}

bool is_planned(const metrology::InspectionPlan& plan, const std::string& characteristic) {
  return std::ranges::any_of(plan.characteristics,
                             [&](const auto& c) { return c.name == characteristic; });
}

// Hours of work, where they are stated.
std::optional<double> read_hours(const TomlTable& table) {
  if (!table.has("hours")) return std::nullopt;
  return table.number("hours", Bound::positive);
}

// Of a part that nobody has measured yet: everything that the plan asks for.
MeasuredPart as_planned(const metrology::InspectionPlan& plan) {
  MeasuredPart part;
  for (const auto& c : plan.characteristics) part[c.name] = MeasuredValue{};
  return part;
}

std::optional<StudyPart> read_part(const TomlTable& table, const fs::path& folder, bool planned,
                                   Diagnostics& problems) {
  const std::string name = table.text("name");
  const std::string job_name = table.text("job");
  const std::vector<std::string> files = table.texts_or("measured", {});
  const auto rows = static_cast<calibration::PlannedRows>(
      table.choice_or("rows", {"characteristics", "points", "floating-points"}, 0));
  const std::optional<double> hours = read_hours(table);
  if (files.empty() && !planned) {
    table.fail("measured", "nothing-measured"_id, "no measured values",
               "measured = [\"part-1.toml\"]: .toml values, .json results or .csv points; several "
               "files are several parts of one kind");
  }
  if (job_name.empty()) {
    // Of another type or missing, text() has reported it.
    if (table.is_sound()) table.fail("job", "no-job"_id, "names no file", "job = \"job.toml\"");
    return std::nullopt;
  }
  auto job = load_job(table.file_path("job"), {}, true);
  if (!job) {
    append_all(problems, job.error());
    return std::nullopt;
  }
  StudyPart part{name, *std::move(job), {}, rows, hours};
  // Surfaces tell their errors point by point.
  metrology::InspectionPlan& plan = part.job.piece.plan;
  plan = metrology::with_point_deviations(std::move(plan));
  if (planned) part.measured.push_back(as_planned(plan));
  for (const std::string& file : planned ? std::vector<std::string>() : files) {
    if (auto measured = read_measured_part(folder / file, part.job.piece.plan)) {
      part.measured.push_back(*std::move(measured));
    } else {
      append_all(problems, measured.error());
    }
  }
  plan = metrology::without_surface_profiles(std::move(plan));
  for (MeasuredPart& measured : part.measured) {
    std::erase_if(measured, [&](const auto& each) { return !is_planned(plan, each.first); });
  }
  return part;
}

// An error's amount in mm or rad, checked against what the name means. A bare number would be mm or
// degrees, where um and urad are meant.
double amount(const TomlTable& table, std::string_view key, const Parameter& parameter) {
  if (table.is_number(key) && table.number(key) != 0.0) {
    table.fail(key, "no-unit"_id, fmt::format("{:g} has no unit", table.number(key)),
               parameter.angular ? "write for example \"30 urad\"" : "write for example \"10 um\"");
  }
  return parameter.angular ? table.angle(key).value : table.length(key).value;
}

std::optional<Parameter> known_parameter(const kinematics::Machine& machine, const TomlTable& table,
                                         const std::string& name) {
  auto parameter = Parameter::named(machine, name);
  if (parameter) return *std::move(parameter);
  for (const Diagnostic& d : parameter.error()) table.fail(name, d);
  return std::nullopt;
}

std::vector<KnownError> read_known(const TomlTable& table, const kinematics::Machine& machine) {
  std::vector<KnownError> known;
  for (const std::string& name : table.keys()) {
    const bool is_table = table.is_table(name);
    const auto parameter = known_parameter(machine, table, name);
    if (!parameter) {
      if (is_table) (void)table.table(name).text_or("value", "");
      continue;
    }
    KnownError error{name, 0.0, 0.0};
    if (is_table) {
      const TomlTable entry = table.table(name);
      error.value = amount(entry, "value", *parameter);
      error.uncertainty = amount(entry, "uncertainty", *parameter);
      if (error.uncertainty < 0.0)
        entry.fail("uncertainty", "out-of-range"_id, "must not be negative");
    } else {
      error.value = amount(table, name, *parameter);
    }
    known.push_back(error);
  }
  return known;
}

std::vector<OtherEstimate> read_others(const TomlTable& table, const kinematics::Machine& machine) {
  std::vector<OtherEstimate> others;
  for (const std::string& name : table.keys()) {
    const TomlTable values = table.table(name);
    OtherEstimate other{name, {}};
    for (const std::string& error : values.keys()) {
      if (const auto parameter = known_parameter(machine, values, error)) {
        other.values[error] = amount(values, error, *parameter);
      }
    }
    others.push_back(std::move(other));
  }
  return others;
}

// The machine's own symbols when it has any, else its location errors.
std::vector<std::string> default_unknowns(const kinematics::Machine& machine) {
  std::vector<std::string> names;
  for (const auto& [alias, meaning] : machine.aliases()) names.push_back(alias);
  if (!names.empty()) return names;
  for (const auto& error : machine.error_names()) {
    if (error.location) names.push_back(error.text());
  }
  return names;
}

void check_machines(const std::vector<std::string>& names, const TomlTable& root) {
  const std::set<std::string> machines(names.begin(), names.end());
  if (machines.size() > 1) {
    root.fail(root.has("part") ? "part" : "motion", "different-machines"_id,
              fmt::format("the parts and tests are of different machines: {} and {}",
                          *machines.begin(), *machines.rbegin()),
              "one study identifies one machine");
  }
}

struct Parts {
  std::vector<StudyPart> parts{};
  std::vector<StudyMotion> motions{};
  Diagnostics problems{};

  [[nodiscard]] bool empty() const { return parts.empty() && motions.empty(); }
  [[nodiscard]] std::vector<std::string> machines() const {
    std::vector<std::string> names;
    for (const StudyPart& part : parts) names.push_back(part.job.machine.name());
    for (const StudyMotion& motion : motions) names.push_back(motion.machine.name());
    return names;
  }
};

// The same test measured again counts as another: its rows have a name of their own.
void rename_if_known(calibration::MeasuredMotion& motion, const std::vector<StudyMotion>& others) {
  const std::string given = motion.name;
  const auto is_known = [&](const std::string& name) {
    return std::ranges::any_of(others, [&](const auto& o) { return o.motion.name == name; });
  };
  for (int k = 2; is_known(motion.name); ++k) motion.name = fmt::format("{} ({})", given, k);
  if (motion.name == given) return;
  for (calibration::Row& row : motion.names) {
    row.name = motion.name + row.name.substr(given.size());
    row.group = motion.name;
  }
}

// Tests share the offset of their ball, and with it what is known of it.
void check_ball(const TomlTable& table, const calibration::MeasuredMotion& motion,
                const std::vector<StudyMotion>& others) {
  if (!motion.ball_known_to) return;
  for (const StudyMotion& other : others) {
    const auto& before = other.motion.ball_known_to;
    if (other.motion.ball != motion.ball || !before || *before == *motion.ball_known_to) continue;
    table.fail("ball_uncertainty", "contradiction"_id,
               fmt::format("test '{}' says {:g} um of the same ball", other.motion.name,
                           *before * kUmPerMm),
               "say it once, or give the balls different names: ball = \"..\"");
    return;
  }
}

Parts read_parts(const TomlDocument& document, const MotionReader& read_motion, bool planned) {
  Parts found;
  const std::vector<TomlTable> tables = document.root().tables("part");
  std::vector<TomlTable> tests;
  if (read_motion && document.root().has("motion")) tests = document.root().tables("motion");
  if (tables.empty() && tests.empty()) {
    document.root().fail("part", "nothing-measured"_id, "no part to learn from",
                         "add [[part]] with name, job and measured, or [[motion]] with test and "
                         "traces");
  }
  for (const TomlTable& table : tests) {
    const std::optional<double> hours = read_hours(table);
    if (auto motion = read_motion(table)) {
      if (!*motion) continue;
      check_ball(table, (*motion)->motion, found.motions);
      rename_if_known((*motion)->motion, found.motions);
      found.motions.push_back(**std::move(motion));
      found.motions.back().hours = hours;
    } else {
      append_all(found.problems, motion.error());
    }
  }
  for (const TomlTable& table : tables) {
    if (auto part = read_part(table, document.folder(), planned, found.problems)) {
      found.parts.push_back(*std::move(part));
    }
  }
  return found;
}

void read_uncertainty(const TomlTable& table, Study& study) {
  if (const auto cmm = table.table_if("cmm")) {
    study.cmm = metrology::read_cmm_model(*cmm);
    if (metrology::point_uncertainty(*study.cmm).is_zero()) {
      cmm->fail("e0", "no-uncertainty"_id, "a CMM without errors gives measured values no weight",
                "state its e0, l_per_um or both; leave cmm out for the job's own");
    }
  }
  if (const auto floor = table.table_if("floor")) {
    for (const char* key : {"length", "angle"}) {
      if (floor->is_number(key) && floor->number(key) != 0.0) {
        floor->fail(key, "no-unit"_id, fmt::format("{:g} has no unit", floor->number(key)),
                    "write for example \"4 um\" or \"20 urad\"");
      }
    }
    study.floor_length = floor->length_or("length", {}, Bound::non_negative).value;
    study.floor_angle = floor->angle_or("angle", {}, Bound::non_negative).value;
  }
}

// What work takes, by names that say their unit.
void read_times(const TomlTable& table, calibration::WorkingTimes& times) {
  const auto read = [&table](const char* key, double& time, double unit) {
    time = table.number_or(key, time / unit, Bound::non_negative) * unit;
  };
  constexpr double kHoursPerMinute = 1.0 / 60.0;
  read("piece_setup_min", times.piece_setup, kHoursPerMinute);
  read("cmm_setup_min", times.cmm_setup, kHoursPerMinute);
  read("touch_s", times.touch, 1.0);
  read("test_setup_min", times.test_setup, kHoursPerMinute);
}

// Unknown errors are those listed, or all, and whatever is known of any besides.
void read_unknowns(const TomlTable& root, const kinematics::Machine& machine, Study& study) {
  if (const auto unknown = root.table_if("unknown")) {
    study.unknowns = unknown->texts_or("errors", {});
    study.tool_radius =
        static_cast<ToolRadius>(unknown->choice_or("tool_radius", {"common", "each", "exact"}, 0));
  }
  if (study.unknowns.empty()) study.unknowns = default_unknowns(machine);
  if (const auto known = root.table_if("known")) study.known = read_known(*known, machine);
  for (const KnownError& k : study.known) {
    if (std::find(study.unknowns.begin(), study.unknowns.end(), k.name) == study.unknowns.end()) {
      study.unknowns.push_back(k.name);
    }
  }
  const bool radius_listed = std::find(study.unknowns.begin(), study.unknowns.end(),
                                       trials::kToolRadius) != study.unknowns.end();
  if (radius_listed && study.tool_radius != ToolRadius::common) {
    root.fail("unknown", "given-twice"_id,
              "tool_radius_error is listed by name, which means one radius error for all parts",
              "tool_radius = \"common\", or take it out of unknown.errors and [known]");
  }
  const auto parameters = trials::parameters_named(machine, study.unknowns);
  if (parameters) return;
  for (const Diagnostic& d : parameters.error()) root.fail("unknown", d);
}

}  // namespace

Result<Study> load_study(const fs::path& file, const MotionReader& read_motion, bool planned) {
  auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  const bool measured = root.has("part") || root.has("motion");
  if (!measured && (root.has("job") || root.has("target"))) {
    Diagnostic population = error(
        "not-a-study"_id, "this is a study of a population, not of measured parts",
        "frustum study reads it; frustum identify wants [[part]] with name, job and measured");
    population.file = file.string();
    return population;
  }
  if (!measured && root.has("program") && root.has("machine")) {
    Diagnostic no_study = error("not-a-study"_id, "this is a job, not a study",
                                "a study names jobs and what was measured of them: [[part]] with "
                                "name, job and measured");
    no_study.file = file.string();
    return no_study;
  }
  Parts parts = read_parts(*document, read_motion, planned);
  // Without a machine nothing else of the file can be judged.
  if (has_error(parts.problems) || parts.empty()) {
    for (const char* key :
         {"title", "unknown", "known", "uncertainty", "method", "compare", "times"}) {
      (void)root.has(key);  // known, though not read
    }
    Diagnostics all = document->finish();
    append_all(all, parts.problems);
    return all;
  }

  Study study;
  study.file = file;
  study.title = root.text_or("title", "");
  check_machines(parts.machines(), root);
  study.parts = std::move(parts.parts);
  study.on = study.parts.empty() ? parts.motions.front().machine : study.parts.front().job.machine;
  for (StudyMotion& each : parts.motions) {
    study.motions.push_back(std::move(each.motion));
    study.motion_hours.push_back(each.hours);
  }
  read_unknowns(root, study.machine(), study);
  if (const auto table = root.table_if("uncertainty")) read_uncertainty(*table, study);
  if (const auto table = root.table_if("times")) read_times(*table, study.times);
  if (const auto table = root.table_if("method")) {
    study.refine = table->boolean_or("refine", true);
    study.recipe =
        static_cast<RecipeChoice>(table->choice_or("recipe", {"none", "case-1", "case-2"}, 0));
  }
  if (const auto table = root.table_if("compare"))
    study.others = read_others(*table, study.machine());
  Diagnostics all = document->finish();
  append_all(all, parts.problems);
  if (has_error(all)) return all;
  return study;
}

}  // namespace frustum::app
