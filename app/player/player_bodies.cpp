#include "app/player/player_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/player/player_steps.hpp"
#include "cutter/body/cutter.hpp"
#include "stock/mesh/io/mesh_reader.hpp"

namespace frustum::app {
namespace {

using kinematics::MachineBody;

constexpr double kChord = 0.01;  // mm, of arcs of a cutter: less than a pixel

report::PlayerTurned cylinder(double radius, double height) {
  return {{{0.0, 0.0}, {radius, 0.0}, {radius, height}, {0.0, height}}};
}

Result<report::PlayerShape> shape_of(const kinematics::BodyShape& shape) {
  if (const auto* box = std::get_if<kinematics::BoxBody>(&shape)) {
    return report::PlayerShape(report::PlayerBox{box->size});
  }
  if (const auto* round = std::get_if<kinematics::CylinderBody>(&shape)) {
    return report::PlayerShape(cylinder(0.5 * round->diameter, round->height));
  }
  const std::filesystem::path& file = std::get<kinematics::MeshBody>(shape).file;
  const auto mesh = stock::read_mesh(file);
  if (mesh) return report::PlayerShape(player_mesh(*mesh));
  Diagnostics problems = mesh.error();
  for (Diagnostic& d : problems) {
    if (d.file.empty()) d.file = file.string();
  }
  return problems;
}

// Of an arc, with its end: the chords turn by angles of at most 2 acos(1 - chord / radius).
void append_arc(const cutter::GeneratrixSegment& arc, std::vector<std::array<double, 2>>& line) {
  const double begin = std::atan2(arc.from.z - arc.centre.z, arc.from.r - arc.centre.r);
  const double end = std::atan2(arc.to.z - arc.centre.z, arc.to.r - arc.centre.r);
  const double turn = std::remainder(end - begin, 2.0 * std::numbers::pi);
  const double cosine = std::clamp(1.0 - kChord / arc.arc_radius, -1.0, 1.0);
  const double step = std::max(2.0 * std::acos(cosine), 0.05);
  const int parts = 1 + static_cast<int>(std::abs(turn) / step);
  for (int k = 1; k <= parts; ++k) {
    const double angle = begin + turn * k / parts;
    line.push_back({arc.centre.r + arc.arc_radius * std::cos(angle),
                    arc.centre.z + arc.arc_radius * std::sin(angle)});
  }
}

report::PlayerTurned turned(const cutter::Body& body) {
  report::PlayerTurned shape;
  const auto segments = body.generatrix().segments();
  shape.meridian.push_back({segments.front().from.r, segments.front().from.z});
  for (const cutter::GeneratrixSegment& segment : segments) {
    if (is_arc(segment)) {
      append_arc(segment, shape.meridian);
    } else {
      shape.meridian.push_back({segment.to.r, segment.to.z});
    }
  }
  if (shape.meridian.back()[0] > 0.0) shape.meridian.push_back({0.0, shape.meridian.back()[1]});
  return shape;
}

Result<report::PlayerTool> tool_of(int number, const cutter::CutterSpec& spec) {
  report::PlayerTool tool{
      .number = number, .title = cutter::description(spec), .length = spec.length.value};
  if (!(spec.length.value > 0.0)) return tool;  // at the gauge point: nothing to draw
  const auto made = cutter::Cutter::make(spec);
  if (!made) {
    Diagnostics problems = made.error();
    for (Diagnostic& d : problems) d.key = fmt::format("tool.{}", number);
    return problems;
  }
  tool.bodies.emplace_back("cutter", turned(made->body()));
  if (made->shank()) tool.bodies.emplace_back("shank", turned(*made->shank()));
  if (made->holder()) tool.bodies.emplace_back("holder", turned(*made->holder()));
  return tool;
}

Result<report::PlayerBody> body_of(const MachineBody& body, bool is_fixture) {
  auto shape = shape_of(body.shape);
  if (!shape) return shape.error();
  return report::PlayerBody{.name = body.name,
                            .is_fixture = is_fixture,
                            .side = body.part.side,
                            .joints = body.part.joints,
                            .part_from_body = body.part_from_body,
                            .shape = *std::move(shape)};
}

}  // namespace

Result<report::PlayerPage> with_bodies(const Job& job, const std::vector<int>& tools,
                                       report::PlayerPage page) {
  for (const kinematics::Joint& joint : job.machine.joints()) {
    page.joints.push_back({.letter = to_char(joint.letter),
                           .rotary = joint.rotary(),
                           .side = joint.side,
                           .direction = joint.direction,
                           .offset = joint.offset});
  }
  page.spindle_offset = job.machine.spindle_offset();
  page.table_offset = job.machine.table_offset();
  page.table_from_workpiece = job.piece.placement.table_from_workpiece();
  for (const MachineBody& body : job.machine.bodies()) {
    auto drawn = body_of(body, false);
    if (!drawn) return drawn.error();
    page.bodies.push_back(*std::move(drawn));
  }
  const std::size_t table = job.machine.work_chain().size();
  for (MachineBody fixture : job.piece.fixtures) {
    fixture.part = table == 0 ? kinematics::MachinePart{} : kinematics::MachinePart{-1, table};
    fixture.part_from_body = Pose::translated(job.machine.table_offset()) * fixture.part_from_body;
    auto drawn = body_of(fixture, true);
    if (!drawn) return drawn.error();
    page.bodies.push_back(*std::move(drawn));
  }
  for (const int number : tools) {
    const auto spec = job.piece.tools.find(number);
    if (spec == job.piece.tools.end()) continue;
    auto tool = tool_of(number, spec->second);
    if (!tool) return tool.error();
    page.tools.push_back(*std::move(tool));
  }
  return page;
}

}  // namespace frustum::app
