#include "app/job/job.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/job/export_request.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/mesh_input.hpp"
#include "core/spelling.hpp"
#include "core/toml_document.hpp"
#include "core/whole_file.hpp"
#include "cutter/body/cutter_file.hpp"
#include "dynamics/model_file.hpp"
#include "kinematics/errors/error_assignment.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

Result<std::string> read_text(const fs::path& file, const TomlTable& table, std::string_view key) {
  auto text = read_whole_file(file);
  if (text) return text;
  table.fail(key, "file-unreadable"_id, fmt::format("the file {} cannot be read", file.string()),
             "paths are relative to the job file");
  return error("file-unreadable"_id, "unreadable");
}

void read_program(const TomlTable& root, programs::TestPiece& piece) {
  const TomlTable program = root.table("program");
  piece.program_file = program.text("file");
  constexpr std::size_t kAbsent = parser::kDialects.size() + 1;
  const std::size_t dialect = program.choice_or(
      "dialect", {"fanuc", "linuxcnc", "sinumerik", "heidenhain", "cldata", "iso"}, kAbsent);
  if (piece.program_file.empty()) return;
  const fs::path file = program.file_path("file");
  if (auto text = read_text(file, program, "file")) {
    piece.program = *std::move(text);
    piece.program_file = file.string();
    piece.dialect = dialect < parser::kDialects.size() ? parser::kDialects.at(dialect)
                    : dialect < kAbsent
                        ? parser::Dialect::fanuc
                        : parser::recognise_dialect(piece.program, piece.program_file).dialect;
  }
}

// sections = [[z, size_x, size_y], ...]; what makes no body is reported by stock::Blank::make.
stock::LoftShape read_loft(const TomlTable& blank) {
  stock::LoftShape loft;
  const auto rows = blank.rows("sections", 3);
  for (const auto& row : rows) loft.sections.push_back({row[0], row[1], row[2]});
  if (rows.empty()) return loft;
  if (const auto made = stock::Blank::make(loft, Vec3::Zero()); !made) {
    blank.fail("sections", made.error().front());
  }
  return loft;
}

void read_blank(const TomlTable& root, programs::TestPiece& piece) {
  const TomlTable blank = root.table("blank");
  const std::size_t shape = blank.choice("shape", {"box", "cylinder", "frustum", "loft", "mesh"});
  double height = 0.0;
  if (shape == 0) {
    const Vec3 size = blank.vector("size");
    if (!(size.array() > 0.0).all()) {
      blank.fail("size", "empty-blank"_id, "the blank is empty: every size must be above 0",
                 "size = [x, y, z] in mm");
    }
    piece.blank = stock::BoxShape{size.x(), size.y(), size.z()};
    height = size.z();
  } else if (shape == 3) {
    stock::LoftShape loft = read_loft(blank);
    if (!loft.sections.empty()) height = loft.sections.back().z;
    piece.blank = std::move(loft);
  } else if (shape == 4) {
    // Its coordinates are those of the workpiece unless `origin` moves them.
    stock::MeshShape mesh{read_closed_mesh(blank, "file", Vec3::Zero()), blank.text("file")};
    if (mesh.solid != nullptr) piece.blank = std::move(mesh);
  } else {
    height = blank.length("height", Bound::positive).value;
    const char* bottom = shape == 1 ? "diameter" : "bottom_diameter";
    const double bottom_radius = 0.5 * blank.length(bottom, Bound::positive).value;
    const double top_radius =
        shape == 1 ? bottom_radius : 0.5 * blank.length("top_diameter", Bound::positive).value;
    piece.blank = stock::FrustumShape{bottom_radius, top_radius, height};
  }
  // Without the key the workpiece origin is on the top face, as a machinist would zero it.
  piece.blank_origin = blank.vector_or("origin", Vec3(0.0, 0.0, -height));
}

// tools = "library.toml" or a LinuxCNC table; [tool.N] are tools of the job's own or change one of
// those.
void read_tools(const TomlTable& root, programs::TestPiece& piece, Diagnostics& problems) {
  cutter::ToolList library;
  if (root.has("tools") && !root.text("tools").empty()) {
    auto loaded = cutter::load_tool_library(root.file_path("tools"));
    if (!loaded) {
      problems.insert(problems.end(), loaded.error().begin(), loaded.error().end());
      // What the job changes of unknown tools cannot be judged.
      static_cast<void>(root.has("tool"));
      return;
    }
    library = *std::move(loaded);
  }
  if (library.empty() || root.has("tool")) {
    piece.tools = cutter::read_tools(root.table("tool"), std::move(library));
  } else {
    piece.tools = std::move(library);
  }
}

void read_setup(const TomlTable& root, programs::TestPiece& piece) {
  if (const auto setup = root.table_if("setup")) {
    piece.placement.origin = setup->vector_or("origin", Vec3::Zero());
    piece.placement.tilt = setup->vector_or("tilt", Vec3::Zero()) * kRadPerDeg;
  }
  // G54 in the table frame's own origin is what a program without a setup sheet means.
  piece.work_offsets = {{1, Vec3::Zero()}};
  if (const auto offsets = root.table_if("offsets")) {
    for (int number = 1; number <= 6; ++number) {
      const std::string key = fmt::format("G{}", 53 + number);
      if (offsets->has(key)) piece.work_offsets[number] = offsets->vector(key);
    }
  }
}

void read_operations(const TomlTable& root, programs::TestPiece& piece) {
  for (const TomlTable& table : root.tables("operation")) {
    programs::Operation op;
    op.name = table.text("name");
    constexpr std::size_t kOther = 0;
    const bool other = table.choice_or("kind", {"other", "cone"}, kOther) == kOther;
    op.kind = other ? programs::OperationKind::other : programs::OperationKind::cone;
    op.makes = table.texts_or("makes", {});
    const auto lines = table.numbers("lines");
    const bool valid =
        lines.size() == 2 && lines[0] >= 1.0 && lines[1] >= lines[0] && lines[1] < 4e9;
    if (valid) {
      op.first_line = static_cast<std::uint32_t>(lines[0]);
      op.last_line = static_cast<std::uint32_t>(lines[1]);
    } else if (!lines.empty()) {
      table.fail("lines", "wrong-lines"_id, "expected [first, last] line of the NC program");
    }
    piece.operations.push_back(std::move(op));
  }
  if (const auto span = root.table_if("error_span")) piece.error_span = span->text("operation");
}

void read_inspection(const TomlTable& root, bool want_plan, programs::TestPiece& piece,
                     metrology::CmmModel& cmm_model, fs::path& plan_file, std::string& plan_text,
                     Diagnostics& problems) {
  const std::optional<TomlTable> inspection =
      want_plan ? root.table("inspection") : root.table_if("inspection");
  if (!inspection) return;
  if (const auto cmm = inspection->table_if("cmm")) cmm_model = metrology::read_cmm_model(*cmm);
  const auto uncertainty = inspection->table_if("uncertainty");
  const auto monte_carlo = uncertainty ? metrology::read_monte_carlo(*uncertainty) : std::nullopt;
  const metrology::DecisionRule decision = metrology::read_decision(*inspection);
  if (!inspection->has("plan") && !want_plan) return;
  if (inspection->text("plan").empty()) return;
  plan_file = inspection->file_path("plan");
  auto bytes = read_whole_file(plan_file);
  if (!bytes) {
    problems.insert(problems.end(), bytes.error().begin(), bytes.error().end());
    return;
  }
  plan_text = *std::move(bytes);
  auto plan = metrology::parse_plan(plan_text, plan_file);
  if (plan && want_plan && plan->characteristics.empty()) {
    inspection->fail("plan", "the plan has no [[characteristic]]: there is nothing to check",
                     "add at least one characteristic with a tolerance");
  }
  if (plan) {
    piece.plan = *std::move(plan);
    if (uncertainty) piece.plan.monte_carlo = monte_carlo;
    if (inspection->has("decision")) piece.plan.decision = decision;
  } else {
    problems.insert(problems.end(), plan.error().begin(), plan.error().end());
  }
}

// What operations make must be in the plan, when there is one.
void check_made_features(const TomlTable& root, const programs::TestPiece& piece) {
  if (piece.plan.features.empty()) return;
  std::vector<std::string> names;
  for (const auto& feature : piece.plan.features) names.push_back(feature.name);
  for (const TomlTable& table : root.tables("operation")) {
    for (const std::string& name : table.texts_or("makes", {})) {
      if (metrology::find_feature(piece.plan, name) != nullptr) continue;
      table.fail("makes", "unknown-feature"_id, fmt::format("the plan has no feature '{}'", name),
                 suggestion(name, names));
    }
  }
}

// error_draw = { seed = 1, index = 0 }
std::optional<ErrorDraw> read_draw(const TomlTable& root) {
  const auto table = root.table_if("error_draw");
  if (!table) return std::nullopt;
  const auto seed = table->integer("seed", Bound::non_negative);
  const auto index = table->integer_or("index", 0, Bound::non_negative);
  constexpr std::int64_t kMostDraws = std::numeric_limits<std::uint32_t>::max();
  if (index > kMostDraws) {
    table->fail("index", "out-of-range"_id,
                fmt::format("must be at most {}, is {}", kMostDraws, index));
  }
  return ErrorDraw{static_cast<std::uint64_t>(seed), static_cast<std::uint32_t>(index)};
}

void override_tool_radius(programs::TestPiece& piece, const JobOverrides& overrides,
                          Diagnostics& problems) {
  if (!overrides.tool_radius_error) return;
  const auto radius_error = parse_length(*overrides.tool_radius_error);
  if (!radius_error) {
    problems.insert(problems.end(), radius_error.error().begin(), radius_error.error().end());
    return;
  }
  for (auto& [number, tool] : piece.tools) tool.radius_error = *radius_error;
}

// The file of the machine that is named.
std::optional<fs::path> machine_of(const TomlTable& root) {
  const std::string name = root.text("machine");
  if (!root.has("machine")) return std::nullopt;  // which text() has reported
  const auto file = find_machine(name, root.folder());
  if (file) return *file;
  root.fail("machine", file.error().front());
  return std::nullopt;
}

// Those in the job itself are reported with their place.
void check_error_names(const TomlTable& root, const kinematics::Machine& machine,
                       const std::vector<kinematics::ErrorEntry>& entries) {
  const auto table = root.table_if("errors");
  if (!table) return;
  for (const kinematics::ErrorEntry& e : entries) {
    const auto unknown = kinematics::unknown_error(machine, e.name);
    if (unknown && table->has(e.name)) table->fail(e.name, unknown->message, unknown->hint);
  }
}

// Of a job that asks for it.
std::shared_ptr<const dynamics::DynamicModel> load_dynamics(const TomlTable& root,
                                                            const ControllerSettings& controller,
                                                            const kinematics::Machine& machine,
                                                            const fs::path& machine_file,
                                                            Diagnostics& problems) {
  auto model = dynamics::load_model(machine_file, machine);
  if (!model) {
    problems.insert(problems.end(), model.error().begin(), model.error().end());
  } else if (!*model) {
    root.table("controller").fail("dynamics", dynamics::no_dynamics(machine, machine_file));
  } else if (controller.servo_lag && (*model)->is_controlled()) {
    root.table("controller")
        .fail("servo_lag", "conflicting-keys"_id,
              fmt::format("the controls of [dynamics.axis] of machine {} lag themselves",
                          machine.name()),
              "remove servo_lag, or the control tables of the machine");
  } else {
    return std::make_shared<const dynamics::DynamicModel>(**std::move(model));
  }
  return nullptr;
}

}  // namespace

Result<Job> load_job(const fs::path& file, const JobOverrides& overrides, bool want_plan) {
  auto text = read_whole_file(file);
  if (!text) return text.error();
  auto document = TomlDocument::parse(*text, file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  Diagnostics problems;

  programs::TestPiece piece;
  piece.title = root.text("title");
  read_program(root, piece);
  read_setup(root, piece);
  read_blank(root, piece);
  piece.fixtures = kinematics::read_fixtures(root);
  std::shared_ptr<const stock::FacetSolid> nominal;
  if (const auto table = root.table_if("nominal")) {
    nominal = read_closed_mesh(*table, "file", table->vector_or("origin", Vec3::Zero()));
  }
  read_tools(root, piece, problems);
  read_operations(root, piece);
  kinematics::ErrorList written_errors;
  if (const auto table = root.table_if("errors")) {
    written_errors = kinematics::read_errors(*table, find_error_file);
  }
  std::optional<ErrorDraw> draw = drawn_by(overrides.errors, read_draw(root));
  if (overrides.undrawn) draw.reset();
  double mesh_pitch = 0.0;
  bool report = true;
  std::vector<fs::path> exports;
  if (const auto output = root.table_if("output")) {
    report = output->boolean_or("report", true);
    mesh_pitch = output->length_or("mesh_pitch", {}, Bound::positive).value;
    exports = read_exports(*output);
  }
  double path_bound = 1e-5;
  if (const auto accuracy = root.table_if("accuracy")) {
    path_bound = accuracy->length_or("path_bound", Mm{1e-5}, Bound::positive).value;
  }
  const ControllerSettings controller = read_controller(root);
  override_tool_radius(piece, overrides, problems);

  metrology::CmmModel cmm;
  fs::path plan_file;
  std::string plan_text;
  read_inspection(root, want_plan, piece, cmm, plan_file, plan_text, problems);
  if (const auto head = root.table_if("report")) {
    piece.plan.header = metrology::joined(metrology::read_report_header(*head), piece.plan.header);
  }
  check_made_features(root, piece);
  const auto machine_file = machine_of(root);
  std::optional<kinematics::Machine> machine;
  if (machine_file) {
    if (auto loaded = kinematics::Machine::load(*machine_file)) {
      machine = *std::move(loaded);
    } else {
      problems.insert(problems.end(), loaded.error().begin(), loaded.error().end());
    }
  }
  std::shared_ptr<const dynamics::DynamicModel> dynamic_model;
  if (machine && controller.dynamics.method != dynamics::PathMethod::off) {
    dynamic_model = load_dynamics(root, controller, *machine, *machine_file, problems);
  }
  std::vector<kinematics::ErrorEntry> errors;
  if (machine) {
    check_error_names(root, *machine, written_errors.entries);
    auto gathered = gather_errors(std::move(written_errors), overrides.errors, draw, *machine);
    if (gathered) {
      errors = *std::move(gathered);
    } else {
      problems.insert(problems.end(), gathered.error().begin(), gathered.error().end());
    }
  }

  Diagnostics all = document->finish();
  all.insert(all.end(), problems.begin(), problems.end());
  if (has_error(all)) return all;
  return Job{.machine = *std::move(machine),
             .file = file,
             .text = *std::move(text),
             .machine_file = *machine_file,
             .plan_file = std::move(plan_file),
             .plan_text = std::move(plan_text),
             .piece = std::move(piece),
             .errors = std::move(errors),
             .error_files = error_files_of(overrides.errors),
             .draw = draw,
             .nominal = std::move(nominal),
             .cmm = cmm,
             .controller = controller,
             .dynamic_model = std::move(dynamic_model),
             .path_bound = path_bound,
             .mesh_pitch = mesh_pitch,
             .report = report,
             .exports = std::move(exports)};
}

}  // namespace frustum::app
