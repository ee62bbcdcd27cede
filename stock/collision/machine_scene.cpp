#include "stock/collision/machine_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "stock/mesh/io/mesh_reader.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {
namespace {

using kinematics::MachinePart;

MachinePart part_of_spindle(const kinematics::Machine& machine) {
  const std::size_t joints = machine.tool_chain().size();
  return joints == 0 ? MachinePart{} : MachinePart{+1, joints};
}
MachinePart part_of_table(const kinematics::Machine& machine) {
  const std::size_t joints = machine.work_chain().size();
  return joints == 0 ? MachinePart{} : MachinePart{-1, joints};
}

Result<SolidBody> solid_form(const kinematics::BoxBody& box) {
  return SolidBody::of(BoxShape{box.size.x(), box.size.y(), box.size.z()});
}
Result<SolidBody> solid_form(const kinematics::CylinderBody& cylinder) {
  const double radius = 0.5 * cylinder.diameter;
  return SolidBody::of(FrustumShape{radius, radius, cylinder.height});
}
// What is within a mesh is only known of one that bounds a body.
std::optional<Diagnostic> unbounded(const MeshMeasure& mesh) {
  if (!mesh.is_closed) {
    return error("body-open"_id, "the mesh of this body is open: it has no inside",
                 "close its gaps, or make the body of boxes and cylinders");
  }
  if (mesh.volume > 0.0) return std::nullopt;
  return error("body-inside-out"_id, "the triangles of this body face inwards",
               "turn them: seen from outside their corners run counterclockwise");
}
Result<SolidBody> solid_form(const kinematics::MeshBody& body) {
  auto mesh = read_mesh(body.file);
  if (!mesh) {
    Diagnostics problems = mesh.error();
    for (Diagnostic& d : problems) {
      if (d.file.empty()) d.file = body.file.string();
    }
    return problems;
  }
  if (auto fault = unbounded(measure(*mesh))) {
    fault->file = body.file.string();
    return *std::move(fault);
  }
  return SolidBody::of(
      std::make_shared<const FacetSolid>(std::move(mesh->vertices), std::move(mesh->triangles)));
}

void add_tool(MachineScene& scene, const kinematics::Setup& setup, int number,
              const cutter::Cutter& tool) {
  const auto geometry = setup.tools.find(number);
  if (geometry == setup.tools.end()) return;
  const double length = geometry->second.length + geometry->second.length_error;
  const Pose at = Pose::translated(scene.machine->spindle_offset() - length * Vec3::UnitZ());
  const auto add = [&](const char* name, const cutter::Body& body) {
    scene.bodies.push_back({.kind = SceneBody::Kind::tool,
                            .name = name,
                            .tool = number,
                            .part = part_of_spindle(*scene.machine),
                            .part_from_body = at,
                            .solid = std::make_shared<const SolidBody>(SolidBody::of(body))});
  };
  add("cutter", tool.body());
  if (tool.shank()) add("shank", *tool.shank());
  if (tool.holder()) add("holder", *tool.holder());
}

// Beyond it rounding would take the place of distances, and no search would end.
constexpr double kFarthest = 1e5;  // mm

std::optional<Diagnostic> too_far(const SceneBody& body) {
  const Box& box = body.solid->bounds();
  const double size = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
  const double place = body.part_from_body.translation.cwiseAbs().maxCoeff();
  if (size <= kFarthest && place <= kFarthest) return std::nullopt;
  return error("body-too-far"_id,
               fmt::format("the body '{}' reaches {:.3g} mm", body.name, std::max(size, place)),
               fmt::format("sizes and places of bodies are at most {:g} mm", kFarthest));
}

}  // namespace

Result<SolidBody> solid_of(const kinematics::BodyShape& shape) {
  return std::visit([](const auto& form) { return solid_form(form); }, shape);
}

Result<std::vector<SceneBody>> bodies_of(const kinematics::Machine& machine) {
  std::vector<SceneBody> bodies;
  for (const kinematics::MachineBody& body : machine.bodies()) {
    auto solid = solid_of(body.shape);
    if (!solid) return solid.error();
    bodies.push_back({.kind = SceneBody::Kind::machine,
                      .name = body.name,
                      .part = body.part,
                      .part_from_body = body.part_from_body,
                      .solid = std::make_shared<const SolidBody>(*std::move(solid)),
                      .ignored = body.ignored});
  }
  return bodies;
}

Result<MachineScene> scene_of(const kinematics::Machine& machine,
                              std::span<const kinematics::MachineBody> fixtures,
                              const kinematics::Setup& setup,
                              const std::map<int, cutter::Cutter>& tools, const Blank& blank) {
  MachineScene scene{.machine = &machine};
  auto own = bodies_of(machine);
  if (!own) return own.error();
  scene.bodies = *std::move(own);
  const Pose part_from_table = Pose::translated(machine.table_offset());
  for (const kinematics::MachineBody& fixture : fixtures) {
    auto solid = solid_of(fixture.shape);
    if (!solid) return solid.error();
    scene.bodies.push_back({.kind = SceneBody::Kind::fixture,
                            .name = fixture.name,
                            .part = part_of_table(machine),
                            .part_from_body = part_from_table * fixture.part_from_body,
                            .solid = std::make_shared<const SolidBody>(*std::move(solid))});
  }
  scene.stated = scene.bodies.size();
  if (scene.stated == 0) return scene;
  for (const auto& [number, tool] : tools) add_tool(scene, setup, number, tool);
  scene.bodies.push_back(
      {.kind = SceneBody::Kind::blank,
       .name = "blank",
       .part = part_of_table(machine),
       .part_from_body =
           part_from_table * setup.table_from_workpiece * Pose::translated(blank.origin()),
       .solid = std::make_shared<const SolidBody>(SolidBody::of(blank.shape()))});
  Diagnostics problems;
  for (const SceneBody& body : scene.bodies) {
    if (auto problem = too_far(body)) problems.push_back(*std::move(problem));
  }
  if (!problems.empty()) return problems;
  return scene;
}

bool may_meet(const SceneBody& a, const SceneBody& b) {
  using Kind = SceneBody::Kind;
  if (a.part == b.part) return false;
  if (a.kind == Kind::tool && b.kind == Kind::blank) return false;
  if (a.kind == Kind::blank && b.kind == Kind::tool) return false;
  const auto ignores = [](const SceneBody& one, const SceneBody& other) {
    return other.kind == Kind::machine &&
           std::ranges::find(one.ignored, other.name) != one.ignored.end();
  };
  return !ignores(a, b) && !ignores(b, a);
}

}  // namespace frustum::stock
