// frustum compare: a part's mesh against its nominal shape.
#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/picture_option.hpp"
#include "app/job/job_report.hpp"
#include "app/view/console.hpp"
#include "core/counted.hpp"
#include "core/program_version.hpp"
#include "core/quantile.hpp"
#include "core/units.hpp"
#include "metrology/cmm.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "report/picture/picture.hpp"
#include "stock/mesh/io/mesh_file.hpp"
#include "stock/mesh/io/mesh_reader.hpp"
#include "stock/mesh/open_edges.hpp"
#include "stock/mesh/weld_mesh.hpp"
#include "stock/solid/mesh_alignment.hpp"
#include "stock/solid/nominal_mesh.hpp"
#ifdef FRUSTUM_WITH_STEP
#include "stock/step/step_reader.hpp"
#endif
#include "trials/mesh_probe.hpp"

namespace frustum::app {
namespace {

using nlohmann::ordered_json;
using stock::SurfaceMesh;
namespace fs = std::filesystem;

constexpr std::size_t kBars = 20;

struct CompareOptions : AnswerOptions {
  std::string part{}, nominal{}, align = "none", plan{}, tolerance{}, deflection{}, mesh{},
                                 picture{};
};

struct Bar {
  double from = 0.0, to = 0.0;  // mm
  std::size_t count = 0;
};

struct Comparison {
  std::size_t points = 0;
  double lowest = 0.0, highest = 0.0, mean = 0.0, rms = 0.0, sd = 0.0;  // mm
  std::vector<std::pair<double, double>> quantiles{};                   // share, mm
  std::vector<Bar> histogram{};
  std::optional<double> tolerance{};  // mm, to either side
  double within = 1.0;                // share of the points
  Pose nominal_from_part{};
  std::size_t nominal_facets = 0;
  std::string aligned{};

  [[nodiscard]] bool passes() const { return within >= 1.0; }
};

bool is_step(const std::string& file) {
  const std::string ending = fs::path(file).extension().string();
  constexpr std::array<std::string_view, 4> kEndings{".step", ".stp", ".STEP", ".STP"};
  return std::ranges::find(kEndings, ending) != kEndings.end();
}

Result<SurfaceMesh> read_step_shape(const std::string& file, Mm deflection) {
#ifdef FRUSTUM_WITH_STEP
  return stock::read_step(file, deflection);
#else
  (void)deflection;
  Diagnostic failure =
      error("not-built-in"_id, "this Frustum was built without a reader of STEP",
            "export the model as a mesh (STL, PLY or OBJ) with a chord below the tolerance, or "
            "build with OpenCASCADE installed (scripts/setup --with-step)");
  failure.file = file;
  return failure;
#endif
}

Result<SurfaceMesh> read_shape(const std::string& file, Mm deflection) {
  if (is_step(file)) return read_step_shape(file, deflection);
  auto mesh = stock::read_mesh(file);
  if (mesh) return mesh;
  Diagnostics faults = std::move(mesh).error();
  for (Diagnostic& d : faults) {
    if (d.file.empty()) d.file = file;
  }
  return faults;
}

// How far triangles may leave the faces of a STEP file.
Result<Mm> deflection_of(const CompareOptions& options) {
  constexpr double kUsual = 1e-3;  // mm
  if (options.deflection.empty()) return Mm{kUsual};
  if (!is_step(options.part) && !is_step(options.nominal)) {
    return error("option-conflict"_id, "--deflection is of STEP files, and none is given",
                 "leave it out: meshes are as fine as they are");
  }
  const auto deflection = parse_quantity(options.deflection);
  if (!deflection || deflection->kind != UnitKind::length || !(deflection->value > 0.0)) {
    return error(
        "bad-deflection"_id,
        fmt::format("--deflection {}: expected a length above 0 with its unit", options.deflection),
        "for example --deflection 1um");
  }
  return Mm{deflection->value};
}

// A nominal shape says of every point whether it is inside.
Result<SurfaceMesh> closed_shape(SurfaceMesh shape, const std::string& file) {
  const auto refused = [&file](DiagnosticId id, std::string what, std::string hint) {
    Diagnostic failure = error(id, std::move(what), std::move(hint));
    failure.file = file;
    return failure;
  };
  if (stock::open_edges(shape)) shape = stock::welded(std::move(shape)).mesh;
  if (const auto open = stock::open_edges(shape)) {
    return refused(
        "mesh-open"_id,
        fmt::format("the nominal shape is not closed: {} with no facet on the other side, the "
                    "first from ({:.3f}, {:.3f}, {:.3f}) to ({:.3f}, {:.3f}, {:.3f}) mm",
                    counted(open->count, "edge"), open->from.x(), open->from.y(), open->from.z(),
                    open->to.x(), open->to.y(), open->to.z()),
        "close the holes, and let all facets run counter-clockwise seen from outside: beside a "
        "hole nothing says where the material is");
  }
  return shape;
}

// The mean of the facets at each corner, by their areas.
void add_vertex_normals(SurfaceMesh& mesh) {
  mesh.normals.assign(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3 normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                            .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    for (const std::uint32_t corner : t) mesh.normals[corner] += normal;
  }
  for (Vec3& normal : mesh.normals) {
    normal = UnitVec3::of(normal).value_or(UnitVec3::z());
  }
}

// Into the frame of the nominal shape.
Result<Pose> aligned(const CompareOptions& options, const SurfaceMesh& part,
                     const stock::FacetSolid& nominal) {
  if (options.align == "best-fit") {
    return stock::laid_into(nominal, part.vertices).transform([](stock::MeshAlignment&& fit) {
      return fit.nominal_from_part;
    });
  }
  if (options.align != "datum") return Pose{};
  const auto plan = metrology::load_plan(options.plan);
  if (!plan) return plan.error();
  const auto probe = trials::read_mesh_probe(options.part, std::nullopt, *plan);
  if (!probe) return probe.error();
  const auto measured = metrology::measure(*plan, *probe);
  if (!measured) return measured.error();
  return measured->workpiece_from_datum.inverse();
}

std::vector<Bar> histogram_of(const std::vector<double>& all, double low, double high) {
  std::vector<Bar> bars(kBars);
  const double width = (high - low) / kBars;
  for (std::size_t i = 0; i < kBars; ++i) {
    bars[i].from = low + width * static_cast<double>(i);
    bars[i].to = i + 1 == kBars ? high : low + width * static_cast<double>(i + 1);
  }
  for (const double d : all) {
    const double place = width > 0.0 ? (d - low) / width : 0.0;
    ++bars[std::min(static_cast<std::size_t>(place), kBars - 1)].count;
  }
  return bars;
}

Result<Comparison> compared(const CompareOptions& options, SurfaceMesh& part, SurfaceMesh shape) {
  Comparison found;
  if (!options.tolerance.empty()) {
    const auto tolerance = parse_quantity(options.tolerance);
    if (!tolerance || tolerance->kind != UnitKind::length || !(tolerance->value > 0.0)) {
      return error(
          "bad-tolerance"_id,
          fmt::format("--tolerance {}: expected a length above 0 with its unit", options.tolerance),
          "for example --tolerance 50um");
    }
    found.tolerance = tolerance->value;
  }
  const stock::FacetSolid nominal(std::move(shape.vertices), std::move(shape.triangles));
  if (!(nominal.volume() > 0.0)) {
    Diagnostic failure =
        error("mesh-inside-out"_id, "the nominal shape is inside out",
              "turn its facets so that they run counter-clockwise seen from outside");
    failure.file = options.nominal;
    return failure;
  }
  found.nominal_facets = nominal.facets().size();
  found.aligned = options.align;
  const auto pose = aligned(options, part, nominal);
  if (!pose) return pose.error();
  found.nominal_from_part = *pose;
  for (Vec3& p : part.vertices) p = pose->point(p);
  for (Vec3& n : part.normals) n = pose->direction(n);
  part.deviation = stock::deviations_from(nominal, part.vertices);
  std::vector<double> all;
  all.reserve(part.deviation.size());
  for (const auto& d : part.deviation) {
    if (d && std::isfinite(*d)) all.push_back(*d);
  }
  if (all.empty()) return error("nothing-to-compare"_id, "the part has no vertices");
  found.points = all.size();
  const auto [low, high] = std::ranges::minmax_element(all);
  found.lowest = *low;
  found.highest = *high;
  double sum = 0.0, squares = 0.0;
  for (const double d : all) sum += d;
  found.mean = sum / static_cast<double>(all.size());
  for (const double d : all) squares += (d - found.mean) * (d - found.mean);
  found.sd = std::sqrt(squares / static_cast<double>(all.size()));
  found.rms = std::hypot(found.sd, found.mean);
  found.histogram = histogram_of(all, found.lowest, found.highest);
  if (found.tolerance) {
    const auto is_within = [&](double d) { return std::abs(d) <= *found.tolerance; };
    found.within = static_cast<double>(std::ranges::count_if(all, is_within)) /
                   static_cast<double>(all.size());
  }
  // Last: that leaves them in another order.
  for (const double share : {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99}) {
    found.quantiles.emplace_back(share, quantile(all, share));
  }
  return found;
}

ordered_json json_of(const Comparison& c) {
  ordered_json json{{"schema", "frustum/compare/1"},
                    {"version", program_version()},
                    {"points", c.points},
                    {"nominal_facets", c.nominal_facets},
                    {"aligned", c.aligned},
                    {"lowest_um", c.lowest * kUmPerMm},
                    {"highest_um", c.highest * kUmPerMm},
                    {"mean_um", c.mean * kUmPerMm},
                    {"rms_um", c.rms * kUmPerMm},
                    {"sd_um", c.sd * kUmPerMm}};
  for (const auto& [share, value] : c.quantiles) {
    json["quantiles"].push_back({{"p", share}, {"value_um", value * kUmPerMm}});
  }
  for (const Bar& bar : c.histogram) {
    json["histogram"].push_back(
        {{"from_um", bar.from * kUmPerMm}, {"to_um", bar.to * kUmPerMm}, {"count", bar.count}});
  }
  if (c.tolerance) {
    json["tolerance_um"] = *c.tolerance * kUmPerMm;
    json["within_percent"] = 100.0 * c.within;
    json["status"] = c.passes() ? "pass" : "fail";
  }
  const Pose& pose = c.nominal_from_part;
  ordered_json rotation = ordered_json::array();
  for (int i = 0; i < 3; ++i) {
    rotation.push_back({pose.rotation(i, 0), pose.rotation(i, 1), pose.rotation(i, 2)});
  }
  json["nominal_from_part"] = {
      {"translation_mm", {pose.translation.x(), pose.translation.y(), pose.translation.z()}},
      {"rotation", std::move(rotation)}};
  return json;
}

std::string text_of(const Comparison& c) {
  std::string text = fmt::format(
      "{} against {}, alignment {}\n"
      "deviation, um, above 0 where material is left:\n"
      "  lowest {:.3f}  highest {:.3f}  mean {:.3f}  rms {:.3f}  sd {:.3f}\n",
      counted(c.points, "vertex", "vertices"), counted(c.nominal_facets, "facet"), c.aligned,
      c.lowest * kUmPerMm, c.highest * kUmPerMm, c.mean * kUmPerMm, c.rms * kUmPerMm,
      c.sd * kUmPerMm);
  std::size_t most = 1;
  for (const Bar& bar : c.histogram) most = std::max(most, bar.count);
  constexpr std::size_t kWidth = 40;
  for (const Bar& bar : c.histogram) {
    text += fmt::format("  {:>11.3f} .. {:>11.3f} {:>9} {}\n", bar.from * kUmPerMm,
                        bar.to * kUmPerMm, bar.count, std::string(bar.count * kWidth / most, '#'));
  }
  if (c.tolerance) {
    text += fmt::format("within +- {:g} um: {:.3f} %\n", *c.tolerance * kUmPerMm, 100.0 * c.within);
  }
  return text;
}

// What would be written over what is read, or in a form that holds no deviations.
Diagnostics unwritable_outputs(const CompareOptions& options) {
  Diagnostics wrong;
  for (const auto& [option, file] :
       {std::pair{"--mesh", options.mesh}, std::pair{"--picture", options.picture}}) {
    std::error_code missing;
    if (file.empty()) continue;
    for (const std::string& read : {options.part, options.nominal, options.plan}) {
      if (!read.empty() && fs::equivalent(file, read, missing)) {
        wrong.push_back(error("output-overwrites-input"_id,
                              fmt::format("{} {} would overwrite what is read", option, file),
                              "choose another file"));
      }
    }
  }
  const std::string form = fs::path(options.mesh).extension().string();
  if (!options.mesh.empty() && form != ".ply" && form != ".vtp") {
    wrong.push_back(error("unknown-extension"_id,
                          fmt::format("--mesh {} cannot hold deviations", options.mesh),
                          "name a .ply or .vtp file"));
  }
  if (!options.picture.empty() && fs::path(options.picture).extension() != ".png") {
    wrong.push_back(error("unknown-extension"_id,
                          fmt::format("--picture {} is no .png file", options.picture),
                          "pictures are written as PNG"));
  }
  return wrong;
}

double diagonal_of(const SurfaceMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

// A part that is as much larger or smaller as inches or metres are.
Diagnostics other_units(const SurfaceMesh& part, const SurfaceMesh& shape,
                        const CompareOptions& options) {
  constexpr double kNear = 0.02;
  const double ratio = diagonal_of(part) / diagonal_of(shape);
  for (const auto& [factor, unit] :
       {std::pair{25.4, "inches"}, {1000.0, "metres"}, {10.0, "centimetres"}}) {
    const bool part_is = std::abs(ratio * factor - 1.0) < kNear;
    if (!part_is && !(std::abs(ratio / factor - 1.0) < kNear)) continue;
    return {warning("other-unit"_id,
                    fmt::format("{} is {:.4g} times as large as {}: one of them seems to be in {}",
                                options.part, ratio, options.nominal, unit),
                    "meshes are read as millimetres")};
  }
  return {};
}

int compare_meshes(const CompareOptions& options, const report::PictureOptions& picture) {
  if (const auto wrong = unwritable_outputs(options); !wrong.empty()) {
    return refuse(wrong, options);
  }
  if ((options.align == "datum") == options.plan.empty()) {
    return refuse(error("conflicting-options"_id, "--plan goes with --align datum",
                        "the plan's datum system says how the part lies"),
                  options);
  }
  Result<SurfaceMesh> part{SurfaceMesh{}}, shape{SurfaceMesh{}};
  const auto deflection = deflection_of(options);
  if (!deflection) return refuse(deflection.error(), options);
  tbb::parallel_invoke([&] { part = read_shape(options.part, *deflection); },
                       [&] { shape = read_shape(options.nominal, *deflection); });
  if (!part) return refuse(part.error(), options);
  if (!shape) return refuse(shape.error(), options);
  shape = closed_shape(*std::move(shape), options.nominal);
  if (!shape) return refuse(shape.error(), options);
  print(std::cerr, other_units(*part, *shape, options));
  const auto found = compared(options, *part, *std::move(shape));
  if (!found) return refuse(found.error(), options);
  std::vector<std::string> written;
  add_vertex_normals(*part);
  part->kinds.assign(part->vertices.size(), stock::VertexKind::surface);
  if (!options.mesh.empty()) {
    if (const auto file = stock::write_mesh(*part, options.mesh); !file) {
      return refuse(file.error(), options);
    }
    written.push_back(options.mesh);
  }
  if (!options.picture.empty()) {
    const auto file = report::write_picture(options.picture, picture_of(*part, {}), picture);
    if (!file) return refuse(file.error(), options);
    written.push_back(options.picture);
  }
  if (options.json) {
    ordered_json json = json_of(*found);
    json["files"] = written;
    std::cout << json.dump(2) << '\n';
  } else if (!options.quiet) {
    std::cout << text_of(*found);
    for (const std::string& file : written) std::cout << file << '\n';
  }
  return found->passes() ? kDone : kOutOfTolerance;
}

}  // namespace

void add_compare(Command& program) {
  auto o = std::make_shared<CompareOptions>();
  auto view = std::make_shared<std::string>();
  Command compare =
      program.command("compare", "Compare a part's mesh with its nominal shape: deviations");
  compare.option("part", o->part, "STL, PLY or OBJ of the part: a scan, or frustum cut --mesh")
      .required();
  compare
      .option("nominal", o->nominal,
              "STL, PLY or OBJ of the closed nominal shape; STEP, where this Frustum is built with "
              "OpenCASCADE")
      .required();
  compare
      .option("--align", o->align,
              "none (default): as they lie; best-fit; datum: by the datum system of --plan")
      .one_of({"none", "best-fit", "datum"});
  compare.option("--plan", o->plan, "Inspection plan whose datum system aligns the part");
  compare.option(
      "--tolerance", o->tolerance,
      "To either side, with its unit (50um); the share within is printed, and exit code 1 "
      "says that it is not all");
  compare.option("--deflection", o->deflection,
                 "How far triangles may leave the faces of a STEP file, with its unit (1um)");
  compare.option("--mesh", o->mesh, "Writes the part with its deviations: .ply, .vtp");
  compare.option("--picture", o->picture, "Writes a PNG coloured by deviation");
  compare.option("--view", *view, "AZIMUTH,ELEVATION of the picture, deg");
  add_answer_options(compare, *o);
  compare.footer("Example: frustum compare part.ply nominal.stl --align best-fit --tolerance 50um");
  compare.computes([o, view] {
    report::PictureOptions picture;
    if (!view->empty()) {
      if (const auto problem = look_from(*view, picture)) return refuse(*problem, *o);
    }
    return compare_meshes(*o, picture);
  });
}

}  // namespace frustum::app
