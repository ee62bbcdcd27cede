// frustum cut: the workpiece at any state of the program as a mesh and a picture, and what the
// program did to it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/picture_option.hpp"
#include "app/job/cut_result.hpp"
#include "app/job/job.hpp"
#include "app/job/job_report.hpp"
#include "app/job/number_list.hpp"
#include "app/job/polyhedral_engine.hpp"
#include "app/job/trial_run.hpp"
#include "app/view/console.hpp"
#include "app/view/removal_csv.hpp"
#include "core/counted.hpp"
#include "core/whole_file.hpp"
#include "report/picture/picture.hpp"
#include "stock/mesh/decimate_surface.hpp"
#include "stock/mesh/io/mesh_file.hpp"
#include "stock/mesh/surface_sequence.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

struct CutOptions : AnswerOptions {
  std::string job{};
  std::string mesh{};
  std::string picture{};
  std::string view{};
  std::string size{};
  std::string removal{};
  std::string point{};
  double pitch = 0.0;
  std::string until_line{};  // empty: to the end
  int snapshots = 0;
  std::string engine = "ray";
  PolyhedralFacets facets{};
  double facet_tolerance_mm = 0.01;
  bool facets_given = false;                           // one of both
  double gouge_limit_um = 0.0, excess_limit_um = 0.0;  // 0: none
  JobOverrides overrides{};
  double chord = 0.0, decimate = 0.0;  // mm; 0: not asked for

  [[nodiscard]] bool polyhedral() const { return engine == "polyhedral"; }
  [[nodiscard]] bool limited() const { return gouge_limit_um > 0.0 || excess_limit_um > 0.0; }
  [[nodiscard]] bool wants_surface() const {
    return !mesh.empty() || !picture.empty() || limited();
  }
};

std::optional<Diagnostic> fault_of(const CutOptions& o) {
  if (!o.wants_surface() && o.removal.empty() && o.point.empty()) {
    return error("nothing-to-write"_id, "nothing to write",
                 "give --mesh OUT.stl|.ply|.obj|.3mf|.vtp, --picture OUT.png, "
                 "--removal OUT.csv, --point X,Y,Z or a limit");
  }
  if (!o.wants_surface() && (o.chord > 0.0 || o.decimate > 0.0)) {
    return error("missing-option"_id, "--chord and --decimate are for a surface",
                 "give --mesh OUT.stl|.ply|.obj|.3mf|.vtp, --picture OUT.png or a limit");
  }
  if (o.polyhedral() && (o.chord > 0.0 || o.decimate > 0.0)) {
    return error("conflicting-options"_id,
                 "--chord and --decimate are for the surface that rays find",
                 "the polyhedral engine's facets follow --facets and --facet-tolerance");
  }
  if (!o.polyhedral() && o.facets_given) {
    return error("conflicting-options"_id,
                 "--facets and --facet-tolerance are of the polyhedral engine",
                 "add --engine polyhedral, or choose --pitch and --chord");
  }
  constexpr double kFinest = 1e-6;  // mm: as exact as the surface is
  if (o.chord > 0.0 && o.chord < kFinest) {
    return error("out-of-range"_id,
                 fmt::format("--chord {:g} mm is finer than the surface is exact", o.chord),
                 "give 1e-6 mm or more");
  }
  if (o.snapshots > 0 && o.mesh.empty()) {
    return error("missing-option"_id, "snapshots need a name",
                 "give --mesh part.ply for part_0001.ply and so on");
  }
  if (!o.mesh.empty()) {
    if (const auto format = stock::mesh_format_of(o.mesh); !format) return format.error().front();
  }
  if (!o.picture.empty() && fs::path(o.picture).extension() != ".png") {
    return error("unknown-format"_id, "pictures are written as .png, not " + o.picture);
  }
  if (!o.view.empty() && o.picture.empty()) {
    return error("missing-option"_id, "a view without a picture", "give --picture OUT.png");
  }
  if (!o.size.empty() && o.picture.empty()) {
    return error("missing-option"_id, "a size without a picture", "give --picture OUT.png");
  }
  if (!o.removal.empty() && fs::path(o.removal).extension() != ".csv") {
    return error("unknown-format"_id,
                 "the removal of each block is written as .csv, not " + o.removal);
  }
  for (const std::string& file : {o.mesh, o.picture, o.removal}) {
    if (auto fault = file.empty() ? std::nullopt : unwritable(file)) return fault;
  }
  return std::nullopt;
}

using Failure = std::optional<Diagnostics>;

Result<report::PictureOptions> picture_options(const CutOptions& o) {
  report::PictureOptions options;
  if (!o.view.empty()) {
    if (auto failure = look_from(o.view, options)) return *std::move(failure);
  }
  if (!o.size.empty()) {
    if (auto failure = draw_at(o.size, options)) return *std::move(failure);
  }
  return options;
}

// Steps of the command; each fills its part of the result, or says what is wrong.
class Cut {
 public:
  Cut(const CutOptions& options, const report::PictureOptions& view, const Job& job,
      const trials::Trial& trial, TrialRun& run)
      : options_(options), view_(view), job_(job), trial_(trial), run_(run) {}

  [[nodiscard]] Result<CutResult> result() {
    if (options_.limited() && job_.piece.plan.features.empty() && !job_.nominal) {
      return error("nothing-to-judge-by"_id, "a limit, but nothing that the part is judged by",
                   "give the job an inspection plan or a [nominal] mesh");
    }
    if (auto failure = find_state()) return *failure;
    result_.blank_volume = workpiece().blank().volume();
    result_.machine_bodies = machine_bodies_of(trial_.machine_collisions);
    for (const stock::Collision& c : trial_.collisions) {
      if (result_.until.block && c.block <= *result_.until.block) result_.collisions.push_back(c);
    }
    if (auto failure = find_originating_block()) return *failure;
    if (options_.wants_surface()) {
      if (auto failure = write_surfaces()) return *failure;
    }
    if (!options_.removal.empty()) {
      if (auto failure = write_removal()) return *failure;
    }
    return result_;
  }

 private:
  [[nodiscard]] const stock::Workpiece& workpiece() const { return *trial_.workpiece; }
  [[nodiscard]] const kinematics::ToolPath& path() const { return workpiece().removed().path(); }
  [[nodiscard]] stock::WorkpieceAt part() const { return {workpiece(), result_.until}; }

  Failure find_state() {
    result_.until = stock::end_of(path());
    if (options_.until_line.empty()) return std::nullopt;
    const auto program_state = state_after(options_.until_line);
    if (!program_state) {
      Diagnostics problems = program_state.error();
      for (Diagnostic& d : problems) {
        d.message = fmt::format("--until-line {}: {}", options_.until_line, d.message);
      }
      return problems;
    }
    result_.finished = program_state->segments == result_.until.segments;
    result_.until = *program_state;
    return std::nullopt;
  }

  // `words`: a line of the program, or FILE:LINE of a subprogram.
  [[nodiscard]] Result<stock::ProgramState> state_after(std::string_view words) const {
    const std::size_t colon = words.rfind(':');
    const std::string_view digits = words.substr(colon == words.npos ? 0 : colon + 1);
    std::uint32_t line = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), line);
    if (fault != std::errc() || end != digits.data() + digits.size()) {
      return error("bad-number"_id, "no line of a program",
                   "N counts the lines of the program from 1; FILE:N those of a subprogram's file");
    }
    if (colon != words.npos) {
      return stock::after_line(path(), std::string(words.substr(0, colon)), line);
    }
    const std::string& text = job_.piece.program;
    const auto ends = static_cast<std::uint32_t>(std::ranges::count(text, '\n'));
    const std::uint32_t lines = text.ends_with('\n') ? ends : ends + 1;
    if (line > lines) {
      return error("out-of-range"_id, fmt::format("the program has {}", counted(lines, "line")),
                   "its lines are counted from 1");
    }
    return stock::after_line(path(), line);
  }

  Failure find_originating_block() {
    if (options_.point.empty()) return std::nullopt;
    const auto words = numbers_of(options_.point, 3, "--point");
    if (!words) return words.error();
    result_.asked_point = Vec3((*words)[0], (*words)[1], (*words)[2]);
    result_.originating_block = stock::originating_block_of(part(), *result_.asked_point);
    return std::nullopt;
  }

  struct Meshed {
    stock::SurfaceMesh mesh{};
    std::optional<Mm> bound{};
    std::optional<stock::Refinement> refinement{};
    // What is judged where it is not the mesh itself: decimation takes away the vertices of flat
    // faces.
    std::optional<stock::SurfaceMesh> whole{};
  };
  // Of states that follow each other what did not change is not asked again.
  [[nodiscard]] Result<FinishedSurface> ray_surface_of(const stock::WorkpieceAt& part) {
    if (options_.snapshots == 0) {
      return finished_surface(job_, part, {options_.pitch, options_.chord});
    }
    if (!surfaces_) {
      const auto pitch = surface_pitch(job_, workpiece().blank().bounds(), options_.pitch);
      if (!pitch) return pitch.error();
      surfaces_.emplace(workpiece(), *pitch);
    }
    auto mesh = surfaces_->at(part.program_state());
    if (!mesh) return mesh.error();
    return finished_surface(job_, part, *std::move(mesh), options_.chord);
  }
  [[nodiscard]] Result<Meshed> surface_of(const stock::WorkpieceAt& part) {
    if (!options_.polyhedral()) {
      auto surface = ray_surface_of(part);
      if (!surface) return surface.error();
      if (options_.decimate <= 0.0) {
        return Meshed{.mesh = std::move(surface->mesh), .refinement = surface->refinement};
      }
      auto fewer = stock::decimate_surface(surface->mesh, Mm{options_.decimate});
      if (!fewer) return fewer.error();
      judge_surface(job_, *fewer);
      return Meshed{.mesh = *std::move(fewer),
                    .refinement = surface->refinement,
                    .whole = std::move(surface->mesh)};
    }
    auto faceted = faceted_surface(part, options_.facets);
    if (!faceted) {
      Diagnostics problems = faceted.error();
      for (Diagnostic& each : problems) {
        if (each.line > 0 && each.file.empty()) each.file = job_.piece.program_file;
      }
      return problems;
    }
    judge_surface(job_, faceted->mesh);
    return Meshed{.mesh = std::move(faceted->mesh), .bound = faceted->bound};
  }

  Failure write_surfaces() {
    run_.begin("mesh the surface");
    if (options_.snapshots > 0) {
      if (auto failure = write_snapshots()) return failure;
    }
    const auto meshed = surface_of(part());
    run_.end();
    if (!meshed) return meshed.error();
    const stock::SurfaceMesh& mesh = meshed->mesh;
    if (!options_.mesh.empty() && options_.snapshots == 0) {
      if (const auto file = stock::write_mesh(mesh, options_.mesh); !file) return file.error();
    }
    if (!options_.picture.empty()) {
      const auto file =
          report::write_picture(options_.picture, picture_of(mesh, edge_plan()), view_);
      if (!file) return file.error();
    }
    describe(*meshed);
    return std::nullopt;
  }

  // What separates the deviations of a sharp edge's faces: a nominal mesh does not.
  [[nodiscard]] metrology::InspectionPlan edge_plan() const {
    return job_.nominal ? metrology::InspectionPlan{} : job_.piece.plan;
  }

  void describe(const Meshed& meshed) {
    const stock::SurfaceMesh& mesh = meshed.mesh;
    const stock::SurfaceMesh& judged = meshed.whole ? *meshed.whole : mesh;
    // A faceted vertex is looked up where it is, as far off the exact surface as it may be.
    const Mm near{std::max(1e-3, meshed.bound.value_or(Mm{}).value)};
    CutSurface surface{.vertices = mesh.vertices.size(),
                       .triangles = mesh.triangles.size(),
                       .measure = stock::measure(mesh),
                       .deviations = stock::worst_deviations(part(), judged, near),
                       .faceted_within = meshed.bound,
                       .refinement = meshed.refinement};
    bool first = true;
    for (const auto& d : judged.deviation) {
      if (!d) continue;
      surface.lowest = first ? *d : std::min(surface.lowest, *d);
      surface.highest = first ? *d : std::max(surface.highest, *d);
      first = false;
    }
    result_.surface = std::move(surface);
  }

  Failure write_snapshots() {
    const fs::path name(options_.mesh);
    const auto states = stock::equally_spaced(path(), options_.snapshots, result_.until);
    for (const stock::ProgramState& program_state : states) {
      run_.at(static_cast<double>(result_.snapshots.size()) / static_cast<double>(states.size()));
      const auto meshed = surface_of({workpiece(), program_state});
      if (!meshed) return meshed.error();
      const fs::path file =
          name.parent_path() / fmt::format("{}_{:04}{}", name.stem().string(),
                                           result_.snapshots.size() + 1, name.extension().string());
      if (const auto written = stock::write_mesh(meshed->mesh, file); !written) {
        return written.error();
      }
      result_.snapshots.push_back(
          {file.string(), program_state, stock::enclosed_volume(meshed->mesh)});
    }
    // The index comes last: where it is, the series is complete.
    const auto index = write_whole_file(fs::path(name).replace_extension(".json"),
                                        snapshot_index(result_.snapshots));
    return index ? std::nullopt : Failure(index.error());
  }

  Failure write_removal() {
    run_.begin("follow the removal");
    auto removal = stock::removal_of(workpiece(), {.pitch = Mm{options_.pitch}});
    run_.end();
    if (!removal) return removal.error();
    removal->resize(result_.until.block ? *result_.until.block + 1 : 0);
    const auto file = write_whole_file(options_.removal, removal_csv(path(), *removal));
    if (!file) return file.error();
    RemovalTotal total{.file = options_.removal};
    for (const stock::BlockRemoval& r : *removal) {
      if (r.volume > 0.0) ++total.blocks;
      total.volume += r.volume;
    }
    result_.removal = total;
    return std::nullopt;
  }

  const CutOptions& options_;
  const report::PictureOptions& view_;
  const Job& job_;
  const trials::Trial& trial_;
  TrialRun& run_;
  CutResult result_{};
  std::optional<stock::SurfaceSequence> surfaces_{};  // of snapshots and of what follows them
};

void tell_collisions(const Job& job, const CutResult& result) {
  for (const stock::Collision& c : result.collisions) {
    Diagnostic found = error("collision"_id, collision_text(c));
    found.file = file_of(c, job.piece.program_file);
    found.line = static_cast<int>(c.source_line);
    print(std::cerr, {found});
  }
}

int cut(CutOptions options) {
  if (const auto fault = fault_of(options)) return refuse(*fault, options);
  const auto view = picture_options(options);
  if (!view) return refuse(view.error(), options);
  options.facets.tolerance = Mm{options.facet_tolerance_mm};
  const auto job = load_job(options.job, options.overrides, false);
  if (!job) return refuse(job.error(), options);
  TrialRun run(progress_style(options));
  const auto trial = run.trial(*job, false);
  if (!trial) return refuse(trial.error(), options);
  print(std::cerr, trial->warnings);
  print(std::cerr, trial->wrong_cuts);
  auto result = Cut(options, *view, *job, *trial, run).result();
  if (!result) return refuse(result.error(), options);
  if (options.gouge_limit_um > 0.0) result->limits.gouge = options.gouge_limit_um / kUmPerMm;
  if (options.excess_limit_um > 0.0) result->limits.excess = options.excess_limit_um / kUmPerMm;
  tell_collisions(*job, *result);
  if (options.json) {
    std::cout << cut_json(*result);
  } else {
    std::cout << (options.quiet ? originating_block_text(*result) : cut_text(*result));
  }
  return result->passes() && !has_error(trial->wrong_cuts) ? kDone : kOutOfTolerance;
}

void add_options(Command& command, CutOptions& o) {
  command.option("job", o.job, "Job file").required();
  command.option("--mesh", o.mesh,
                 "Mesh to write: .stl, .obj, .3mf, or with deviations .ply, .vtp");
  command.option("--picture", o.picture, "Picture to write: .png, coloured by deviation");
  command.option("--view", o.view,
                 "AZIMUTH,ELEVATION the picture is seen from, deg (default: -60,32)");
  command.option("--size", o.size, "WIDTH,HEIGHT of the picture, px (default: 1600,1100)");
  command.option("--pitch", o.pitch, "Of the sampling grid, mm (default: longest side / 120)")
      .holds(positive_number());
  command.option("--chord", o.chord, "Refine until the triangles leave the surface by less, mm")
      .holds(positive_number());
  command.option("--decimate", o.decimate, "Take away what is not needed for this tolerance, mm")
      .holds(positive_number());
  command.option("--until-line", o.until_line,
                 "Stop after the last motion of this NC line, or of FILE:LINE of a subprogram");
  command
      .option("--snapshots", o.snapshots,
              "Number of meshes at equal steps of time, named after --mesh, with an index .json")
      .within(1, 9999);
  command.option("--removal", o.removal,
                 "Table to write, .csv: volume, rate and engagement of each block");
  command.option("--point", o.point, "X,Y,Z: say which NC line made the surface there");
  command.option("--engine", o.engine, "ray: exact; polyhedral: Boolean operations, to compare")
      .one_of({"ray", "polyhedral"})
      .default_shown();
  command.option("--facets", o.facets.facets, "Of the polyhedral engine, around the axis")
      .within(3, 4096)
      .default_shown();
  command.option("--facet-tolerance", o.facet_tolerance_mm, "Of the polyhedral engine's sweeps, mm")
      .holds(positive_number())
      .default_shown();
  command.option("--gouge-limit", o.gouge_limit_um, "um: exit code 1 where more is missing")
      .holds(positive_number());
  command.option("--excess-limit", o.excess_limit_um, "um: exit code 1 where more is left")
      .holds(positive_number());
  add_error_options(command, o.overrides.errors);
  command.option("--tool-radius-error", o.overrides.tool_radius_error, "With unit");
  add_answer_options(command, o);
}

}  // namespace

void add_cut(Command& program) {
  auto options = std::make_shared<CutOptions>();
  Command command = program.command("cut", "Cut a job and write the workpiece after any block");
  add_options(command, *options);
  command.footer("Example: frustum cut job.toml --mesh part.ply --pitch 0.5");
  command.computes([command, options] {
    options->facets_given = command.was_given("--facets") || command.was_given("--facet-tolerance");
    return cut(*options);
  });
}

}  // namespace frustum::app
