// frustum cut: the finished workpiece as a mesh and a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/console.hpp"
#include "app/job.hpp"
#include "app/job_report.hpp"
#include "app/number_check.hpp"
#include "app/trial_run.hpp"
#include "report/picture.hpp"
#include "stock/mesh_file.hpp"
#include "stock/nominal_mesh.hpp"

namespace frustum::app {
namespace {

struct Options {
  std::string job{};
  std::string mesh{};
  std::string picture{};
  double pitch = 0.0;
  double chord = 0.0;
  double decimate = 0.0;
  JobOverrides overrides{};
  bool json = false;
  bool quiet = false;
};

struct DeviationRange {
  std::size_t vertices = 0;  // with a nominal
  double lowest = 0.0, highest = 0.0;
};

DeviationRange range_of(const stock::SurfaceMesh& mesh) {
  DeviationRange range;
  for (const auto& d : mesh.deviation) {
    if (!d) continue;
    range.lowest = range.vertices == 0 ? *d : std::min(range.lowest, *d);
    range.highest = range.vertices == 0 ? *d : std::max(range.highest, *d);
    ++range.vertices;
  }
  return range;
}

// A vertex that stands out, and the NC line that made it (0: the blank).
struct Extreme {
  double deviation = 0.0;
  Vec3 point = Vec3::Zero();
  std::uint32_t line = 0;
};

std::optional<Extreme> extreme_of(const stock::SurfaceMesh& mesh,
                                  const std::optional<std::size_t>& vertex,
                                  const stock::Workpiece& workpiece) {
  if (!vertex) return std::nullopt;
  Extreme found{mesh.deviation[*vertex].value_or(0.0), mesh.vertices[*vertex]};
  // Just beside the vertex, along its normal; a feature vertex has several makers, one is told.
  constexpr double kBeside = 1e-3;  // mm
  const Vec3& normal = mesh.normals[*vertex];
  const stock::Ray inwards{found.point + kBeside * normal, -normal};
  if (const auto surface = workpiece.first_surface(inwards, {0.0, 2.0 * kBeside})) {
    found.line = surface->source_line;
  }
  return found;
}

nlohmann::ordered_json json_of(const std::optional<Extreme>& extreme) {
  if (!extreme) return nullptr;
  return {{"deviation_um", extreme->deviation * kUmPerMm},
          {"point_mm", {extreme->point.x(), extreme->point.y(), extreme->point.z()}},
          {"line", extreme->line}};
}

std::string told(const char* what, const std::optional<Extreme>& extreme) {
  if (!extreme) return fmt::format("no {}\n", what);
  return fmt::format("worst {} {:.3f} um at ({:.4f}, {:.4f}, {:.4f}) mm, {}\n", what,
                     std::abs(extreme->deviation) * kUmPerMm, extreme->point.x(),
                     extreme->point.y(), extreme->point.z(),
                     extreme->line > 0 ? fmt::format("line {}", extreme->line)
                                       : std::string("on the blank's own surface"));
}

int cut(const Options& options) {
  if (options.mesh.empty() && options.picture.empty()) {
    return refuse("nothing to write", "give --mesh OUT.stl|.ply|.obj|.3mf|.vtp or --picture OUT.png");
  }
  if (!options.mesh.empty()) {
    if (const auto format = stock::mesh_format_of(options.mesh); !format)
      return refuse(format.error());
  }
  if (!options.picture.empty() && std::filesystem::path(options.picture).extension() != ".png") {
    return refuse("pictures are written as .png, not " + options.picture);
  }
  const auto job = load_job(options.job, options.overrides, false);
  if (!job) return refuse(job.error());
  TrialRun run(progress_style(options.quiet || options.json));
  const auto trial = run.trial(*job, false);
  if (!trial) return refuse(trial.error());
  run.begin("mesh the surface");
  const auto mesh = finished_surface(*job, *trial->workpiece,
                                     {options.pitch, options.chord, options.decimate});
  run.end();
  if (!mesh) return refuse(mesh.error());
  if (!options.mesh.empty()) {
    if (const auto file = stock::write_mesh(*mesh, options.mesh); !file)
      return refuse(file.error());
  }
  if (!options.picture.empty()) {
    const auto file = report::write_picture(options.picture, picture_of(*mesh, job->piece.plan));
    if (!file) return refuse(file.error());
  }
  const stock::MeshMeasure measure = stock::measure(*mesh);
  const double blank = trial->workpiece->blank().volume();
  const DeviationRange deviation = range_of(*mesh);
  const auto worst = stock::worst_deviations(*mesh);
  const auto gouge = extreme_of(*mesh, worst.gouge, *trial->workpiece);
  const auto excess = extreme_of(*mesh, worst.excess, *trial->workpiece);
  nlohmann::ordered_json collision_list = nlohmann::ordered_json::array();
  for (const report::Collision& c : report_of(*job, *trial).collisions) {
    collision_list.push_back({{"line", c.line}, {"text", c.text}});
    Diagnostic told = error(c.text);
    told.file = job->piece.program_file;
    told.line = static_cast<int>(c.line);
    print(std::cerr, {told});
  }
  if (options.json) {
    const nlohmann::ordered_json doc{
        {"vertices", mesh->vertices.size()},
        {"triangles", mesh->triangles.size()},
        {"closed", measure.is_closed},
        {"manifold", measure.is_manifold},
        {"volume_mm3", measure.volume},
        {"blank_volume_mm3", blank},
        {"removed_volume_mm3", removed_volume(blank, measure.volume)},
        {"vertices_with_nominal", deviation.vertices},
        {"deviation_um", {deviation.lowest * kUmPerMm, deviation.highest * kUmPerMm}},
        {"worst_gouge", json_of(gouge)},
        {"worst_excess", json_of(excess)},
        {"collisions", trial->collisions.size()},
        {"collision_list", collision_list}};
    std::cout << doc.dump(2) << '\n';
  } else if (!options.quiet) {
    std::cout << fmt::format(
        "{} vertices, {} triangles, {}\nvolume {:.3f} mm3 of {:.3f}, removed {:.3f}\n"
        "deviation {:.3f} .. {:.3f} um on {} vertices with a nominal\n",
        mesh->vertices.size(), mesh->triangles.size(),
        measure.is_closed && measure.is_manifold ? "closed and manifold" : "NOT closed",
        measure.volume, blank, removed_volume(blank, measure.volume), deviation.lowest * kUmPerMm,
        deviation.highest * kUmPerMm, deviation.vertices);
    if (deviation.vertices > 0) std::cout << told("gouge", gouge) << told("excess", excess);
  }
  return trial->collisions.empty() ? kDone : kOutOfTolerance;
}

}  // namespace

void add_cut(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("cut", "Cut a job and write the finished workpiece");
  command->add_option("job", options->job, "Job file")->required();
  command->add_option("--mesh", options->mesh,
                      "Mesh to write: .stl, .obj, .3mf, or with deviations .ply, .vtp");
  command->add_option("--picture", options->picture,
                      "Picture to write: .png, coloured by deviation");
  command
      ->add_option("--pitch", options->pitch,
                   "Of the sampling grid, mm (default: longest side / 120)")
      ->check(positive_number());
  command
      ->add_option("--chord", options->chord,
                   "Refine until the triangles leave the surface by less, mm")
      ->check(positive_number());
  command
      ->add_option("--decimate", options->decimate,
                   "Take away what is not needed for this tolerance, mm")
      ->check(positive_number());
  add_error_options(*command, options->overrides.errors);
  command->add_option("--tool-radius-error", options->overrides.tool_radius_error, "With unit");
  command->add_flag("--json", options->json, "One JSON document on stdout and nothing else");
  command->add_flag("--quiet", options->quiet, "No progress, no summary");
  command->footer("Example: frustum cut job.toml --mesh part.ply --pitch 0.5");
  command->callback([options, &exit_code] { exit_code = cut(*options); });
}

}  // namespace frustum::app
