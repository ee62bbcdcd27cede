#include "app/job/job_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "app/job/job_evidence.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "metrology/geometric_values.hpp"
#include "metrology/plan/nominal.hpp"
#include "metrology/probing/acceptance_test.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"
#include "stock/mesh/deviation.hpp"
#include "stock/mesh/refine_surface.hpp"
#include "stock/solid/nominal_mesh.hpp"

namespace frustum::app {
namespace {

using kinematics::AxisLetter;
using kinematics::Joint;

std::string meaning_of(const kinematics::Machine& machine, const std::string& name) {
  const auto alias = machine.aliases().find(name);
  if (alias != machine.aliases().end()) return alias->second.meaning;
  const auto error = kinematics::ErrorName::parse(name);
  return error ? error->meaning() : "";
}

// Over the cone angle when the operation is one round of a cone, over its blocks otherwise.
report::AxisTrace trace_of(const Job& job, const trials::OperationTrace& operation) {
  // A page does not show more; every k-th block and the last are kept.
  constexpr std::size_t kMostSamples = 720;
  report::AxisTrace trace;
  trace.operation = operation.name;
  const bool cone = operation.kind == programs::OperationKind::cone;
  trace.abscissa_kind = cone ? report::Abscissa::cone_angle : report::Abscissa::block;
  const std::size_t last = operation.samples.size() - 1;
  const std::size_t step = std::max<std::size_t>(1, last / kMostSamples);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i <= last; i += step) kept.push_back(i);
  if (kept.back() != last) kept.push_back(last);
  for (const std::size_t i : kept) {
    const double share = last == 0 ? 0.0 : static_cast<double>(i) / static_cast<double>(last);
    trace.abscissa.push_back(cone ? 360.0 * share : static_cast<double>(i));
  }
  for (const AxisLetter letter : kinematics::kAxisLetters) {
    const Joint* joint = job.machine.joint(letter);
    if (joint == nullptr) continue;
    const double scale = joint->rotary() ? kDegPerRad : 1.0;
    report::AxisSeries series{.axis = std::string(1, to_char(letter)), .rotary = joint->rotary()};
    for (const std::size_t i : kept)
      series.values.push_back(operation.samples[i].axes[letter] * scale);
    const kinematics::AxisRange range = operation.ranges.at(letter);
    series.range = report::AxisRange{range.lo * scale, range.hi * scale};
    trace.axes.push_back(std::move(series));
  }
  return trace;
}

// A vertex on an edge has no normal of its own; it is judged by the face of the first triangle
// there that a planned feature owns.
void judge_edges(stock::SurfaceMesh& mesh, const metrology::InspectionPlan& plan) {
  for (const auto& triangle : mesh.triangles) {
    const Vec3& a = mesh.vertices[triangle[0]];
    const Vec3 across = (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
    const auto normal = UnitVec3::of(across);
    if (!normal) continue;
    for (const std::uint32_t corner : triangle) {
      const bool on_edge = mesh.kinds[corner] != stock::VertexKind::surface;
      if (!on_edge || mesh.deviation[corner]) continue;
      mesh.deviation[corner] =
          metrology::deviation_from_nominal(plan, mesh.vertices[corner], *normal);
    }
  }
}

std::string body_text(const stock::Collision& c) {
  switch (c.body) {
    case stock::CollisionBody::cutter:
      break;
    case stock::CollisionBody::shank:
      return "shank ";
    case stock::CollisionBody::holder:
      return "holder ";
  }
  return "";
}

std::string kind_text(const stock::Collision& c) {
  const std::string material =
      c.body == stock::CollisionBody::shank ? "material above the flutes" : "material";
  switch (c.kind) {
    case stock::CollisionKind::rapid_through_material:
      return "rapid move (G0) through " + material;
    case stock::CollisionKind::feed_with_spindle_off:
      return "feed move with the spindle off in material";
    case stock::CollisionKind::body_in_material:
    case stock::CollisionKind::bodies_meet:
      break;
  }
  return "in " + material + " during a feed move";
}

std::string lines_text(const stock::Collision& c) {
  const std::string until =
      c.last_line == c.source_line ? "" : fmt::format(", until line {}", c.last_line);
  const std::string within =
      c.source_file
          ? fmt::format(", in {}", std::filesystem::path(*c.source_file).filename().string())
          : "";
  return until + within;
}

std::string meeting_text(const stock::Collision& c) {
  const std::string tool = c.tool == 0 ? "" : fmt::format(" with tool T{}", c.tool);
  return fmt::format("{} meets {}{} at ({:.1f}, {:.1f}, {:.1f}){}", c.first, c.second, tool,
                     c.point.x(), c.point.y(), c.point.z(), lines_text(c));
}

std::array<float, 3> in_single_precision(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

std::string collision_text(const stock::Collision& c) {
  if (c.kind == stock::CollisionKind::bodies_meet) return meeting_text(c);
  std::string what = kind_text(c);
  if (c.body != stock::CollisionBody::cutter) {
    what = body_text(c) + (c.kind == stock::CollisionKind::body_in_material ? "" : "in a ") + what;
  }
  return fmt::format("{}: tool T{}, {:.3f} mm deep at ({:.1f}, {:.1f}, {:.1f}){}", what, c.tool,
                     c.depth, c.point.x(), c.point.y(), c.point.z(), lines_text(c));
}

std::string file_of(const stock::Collision& collision, const std::string& main_program) {
  return collision.source_file ? *collision.source_file : main_program;
}

namespace {

// The virtual CMM may be drawn worse than its statement.
std::optional<Diagnostic> failed_acceptance(const metrology::CmmModel& cmm) {
  if (metrology::point_uncertainty(cmm).is_zero()) return std::nullopt;
  const metrology::AcceptanceReport tested = metrology::acceptance_test(cmm);
  if (tested.passes()) return std::nullopt;
  return warning(
      "cmm-acceptance"_id,
      fmt::format(
          "the CMM of the job fails its own acceptance test: the worst of {} lengths uses "
          "{:.0f} % of its limit (ISO 10360-2); a sphere has form {:.3f} um and size {:.3f} "
          "um, limit {:.3f} um (ISO 10360-5)",
          tested.lengths.size(), 100.0 * tested.worst_length_share(),
          tested.probing_form * kUmPerMm, tested.probing_size * kUmPerMm,
          tested.probing_limit * kUmPerMm),
      "model = \"field\" in inspection.cmm draws machines that pass; frustum cmm prints the test");
}

}  // namespace

report::MachineBodies machine_bodies_of(const stock::MachineCollisions& met) {
  report::MachineBodies bodies{.bodies = met.bodies};
  if (!met.closest) return bodies;
  bodies.smallest_distance = met.closest->distance;
  bodies.first = met.closest->first;
  bodies.second = met.closest->second;
  bodies.line = met.closest->source_line;
  if (met.closest->source_file) {
    bodies.file = std::filesystem::path(*met.closest->source_file).filename().string();
  }
  return bodies;
}

report::RunReport report_of(const Job& job, const trials::Trial& trial, report::Evidence evidence) {
  report::RunReport report;
  report.title = job.piece.title;
  report.evidence = std::move(evidence);
  add_subprograms(report.evidence, trial);
  report.version = FRUSTUM_VERSION;
  report.machine = job.machine.name() + ", " + job.machine.title();
  report.structure = job.machine.structure();
  report.program = std::filesystem::path(job.piece.program_file).filename().string();
  report.tools = job.piece.tools;
  for (const kinematics::ErrorEntry& e : job.errors) {
    report.errors.push_back({e.name, e.written, meaning_of(job.machine, e.name)});
  }
  report.measurement = trial.measurement;
  metrology::add_geometric_values(report.measurement, job.piece.plan);
  for (const trials::OperationTrace& operation : trial.operations) {
    report.traces.push_back(trace_of(job, operation));
  }
  for (const stock::Collision& c : trial.collisions) {
    report.collisions.push_back({c.source_line, collision_text(c)});
  }
  report.machine_bodies = machine_bodies_of(trial.machine_collisions);
  report.cycle_time = trial.cycle_time;
  for (const kinematics::SlowedBlock& block : trial.slowed) {
    report.slowed.push_back({block.source_line, std::string(1, kinematics::to_char(block.axis)),
                             block.programmed_feed, block.reached_feed});
  }
  const double kNmPerMm = 1e6;
  report.budget = {
      {"tool path chord", job.path_bound * kUmPerMm, {}, "um"},
      {"ray against sweep", trial.workpiece->removed().accuracy() * kNmPerMm, {}, "nm"}};
  report.diagnostics = trial.warnings;
  report.diagnostics.insert(report.diagnostics.end(), trial.wrong_cuts.begin(),
                            trial.wrong_cuts.end());
  if (!trial.measurement.characteristics.empty()) {
    if (auto failed = failed_acceptance(job.cmm)) report.diagnostics.push_back(*std::move(failed));
  }
  const Vec3& at = job.piece.placement.origin;
  const Vec3 tilt = job.piece.placement.tilt * kDegPerRad;
  report.notes.push_back(fmt::format(
      "workpiece frame on the table at ({:g}, {:g}, {:g}) mm, tilted ({:g}, {:g}, {:g}) deg",
      at.x(), at.y(), at.z(), tilt.x(), tilt.y(), tilt.z()));
  if (!job.piece.error_span.empty()) {
    report.notes.push_back(fmt::format(
        "error shapes without a span of their own extend over the range that '{}' travels",
        job.piece.error_span));
  }
  return report;
}

void add_proof(report::RunReport& report, const trials::PointProof& proof) {
  if (proof.points == 0) return;
  report.bounds = {proof.points, proof.worst_bound, proof.sampled,
                   proof.proven, proof.regular,     proof.refuted};
  report.budget.push_back({"measured point, together", proof.worst_bound * kUmPerMm, {}, "um"});
  if (proof.refuted > 0) {
    report.diagnostics.push_back(
        error("point-refuted"_id,
              fmt::format("{} of {} sampled points are not where the engine says: {}",
                          proof.refuted, proof.sampled, proof.first_refuted),
              "this is a fault of the program: please report it with the job"));
  }
  if (!proof.first_open.empty()) {
    report.notes.push_back(fmt::format("{} of {} sampled points could not be proven: {}",
                                       proof.sampled - proof.proven - proof.refuted, proof.sampled,
                                       proof.first_open));
  }
}

Result<Mm> surface_pitch(const Job& job, const stock::BoundingBox& box, double asked) {
  double pitch = asked;
  if (pitch <= 0.0) pitch = job.mesh_pitch;
  if (pitch <= 0.0) pitch = (box.max - box.min).maxCoeff() / 120.0;
  // A grid that the part falls through would be answered with nothing at all.
  const double coarsest = (box.max - box.min).minCoeff() / 4.0;
  if (pitch > coarsest) {
    return error("out-of-range"_id,
                 fmt::format("a pitch of {:g} mm is too coarse for this blank", pitch),
                 fmt::format("at most a quarter of its shortest side: {:g} mm", coarsest));
  }
  return Mm{pitch};
}

Result<FinishedSurface> finished_surface(const Job& job, const stock::WorkpieceAt& part,
                                         const SurfaceRequest& request) {
  const stock::BoundingBox box = part.workpiece().blank().bounds();
  const auto pitch = surface_pitch(job, box, request.pitch);
  if (!pitch) return pitch.error();
  auto mesh = stock::extract_surface(part, box, *pitch);
  if (!mesh) return mesh.error();
  return finished_surface(job, part, *std::move(mesh), request.chord);
}

Result<FinishedSurface> finished_surface(const Job& job, const stock::WorkpieceAt& part,
                                         stock::SurfaceMesh extracted, double chord) {
  FinishedSurface surface{std::move(extracted), {}};
  if (chord > 0.0) {
    auto refined = stock::refine_surface(part, std::move(surface.mesh), {.chord = Mm{chord}});
    if (!refined) return refined.error();
    surface = {std::move(refined->mesh), *refined};
  }
  judge_surface(job, surface.mesh);
  return surface;
}

void judge_surface(const Job& job, stock::SurfaceMesh& mesh) {
  if (job.nominal != nullptr) {
    mesh.deviation = stock::deviations_from(*job.nominal, mesh.vertices);
    return;
  }
  const metrology::InspectionPlan& plan = job.piece.plan;
  if (plan.features.empty()) return;
  stock::compare(mesh, [&](const Vec3& point, const Vec3& normal) {
    return metrology::deviation_from_nominal(plan, point, normal);
  });
  judge_edges(mesh, plan);
}

double removed_volume(double blank, double finished) {
  constexpr double kRounding = 1e-9;  // of the blank: the mesh's volume is a sum of a million terms
  const double removed = blank - finished;
  return std::abs(removed) < kRounding * blank ? 0.0 : removed;
}

report::SurfacePicture picture_of(const stock::SurfaceMesh& mesh,
                                  const metrology::InspectionPlan& plan) {
  report::SurfacePicture picture;
  const auto add = [&](const Vec3& v, const Vec3& normal, const std::optional<double>& deviation) {
    picture.vertices.push_back(in_single_precision(v));
    picture.normals.push_back(in_single_precision(normal));
    if (mesh.deviation.empty()) return;
    picture.deviation.push_back(deviation ? std::optional(static_cast<float>(*deviation))
                                          : std::nullopt);
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const bool smooth = !mesh.normals.empty() && mesh.kinds[i] == stock::VertexKind::surface;
    add(mesh.vertices[i], smooth ? mesh.normals[i] : Vec3(Vec3::Zero()),
        mesh.deviation.empty() ? std::nullopt : mesh.deviation[i]);
  }
  picture.triangles = mesh.triangles;
  if (mesh.deviation.empty()) return picture;
  // An edge belongs to two faces with deviations of their own: it gets a vertex for each, so that
  // colours do not run across it.
  std::map<std::pair<std::uint32_t, float>, std::uint32_t> split;
  for (auto& triangle : picture.triangles) {
    const Vec3& a = mesh.vertices[triangle[0]];
    const auto normal =
        UnitVec3::of((mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a));
    if (!normal) continue;
    std::array<std::uint32_t, 3> corners = triangle;
    for (std::uint32_t& corner : corners) {
      if (mesh.kinds[corner] == stock::VertexKind::surface) continue;
      const auto own = metrology::deviation_from_nominal(plan, mesh.vertices[corner], *normal);
      if (!own) continue;
      const auto next = static_cast<std::uint32_t>(picture.vertices.size());
      const auto [at, is_new] = split.try_emplace({corner, static_cast<float>(*own)}, next);
      if (is_new) add(mesh.vertices[corner], Vec3::Zero(), own);
      corner = at->second;
    }
    triangle = corners;
  }
  return picture;
}

}  // namespace frustum::app
