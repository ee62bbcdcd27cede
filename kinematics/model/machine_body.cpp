#include "kinematics/model/machine_body.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <span>
#include <system_error>

#include "core/spelling.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {
namespace {

BodyShape read_body_shape(const TomlTable& table) {
  const std::size_t shape = table.choice("shape", {"box", "cylinder", "mesh"});
  if (shape == 0) {
    const BoxBody box{table.vector("size")};
    if (table.is_array("size") && !(box.size.array() > 0.0).all()) {
      table.fail("size", "empty-body"_id, "the body is empty: every size must be above 0",
                 "size = [x, y, z] in mm");
    }
    return box;
  }
  if (shape == 1) {
    return CylinderBody{table.length("diameter", Bound::positive).value,
                        table.length("height", Bound::positive).value};
  }
  if (table.text("file").empty()) return MeshBody{};
  const MeshBody mesh{table.file_path("file")};
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(mesh.file, ignored)) {
    table.fail("file", "file-unreadable"_id,
               fmt::format("the file {} cannot be read", mesh.file.string()),
               "paths are relative to the file that names them");
  }
  return mesh;
}

MachineBody read_body(const TomlTable& table, std::set<std::string>& names) {
  MachineBody body{.name = table.text("name"), .shape = read_body_shape(table)};
  if (!body.name.empty() && !names.insert(body.name).second) {
    table.fail("name", "name-used-twice"_id,
               fmt::format("there is another body called '{}'", body.name),
               "reports call bodies by their names: give each its own");
  }
  const Vec3 tilt = table.vector_or("tilt", Vec3::Zero()) * kRadPerDeg;
  if (tilt.cwiseAbs().maxCoeff() > 2.0 * std::numbers::pi) {
    table.fail("tilt", "out-of-range"_id, "an angle is beyond a whole turn",
               "degrees about X, Y and Z, each from -360 to 360");
  }
  body.part_from_body = {rotation_z(tilt.z()) * rotation_y(tilt.y()) * rotation_x(tilt.x()),
                         table.vector_or("origin", Vec3::Zero())};
  return body;
}

std::optional<MachinePart> joint_named(const std::string& on, std::span<const Joint> chain,
                                       int side) {
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if (on == std::string(1, to_char(chain[k].letter))) return MachinePart{side, k + 1};
  }
  return std::nullopt;
}

// A chain without joints is the bed itself.
MachinePart end_of_chain(std::span<const Joint> chain, int side) {
  return chain.empty() ? MachinePart{} : MachinePart{side, chain.size()};
}

void place(const TomlTable& table, const Machine& machine, MachineBody& body) {
  const std::string on = table.text("on");
  if (on.empty() || on == "bed") return;
  if (on == "spindle") {
    body.part = end_of_chain(machine.tool_chain(), +1);
    body.part_from_body.translation += machine.spindle_offset();
    return;
  }
  if (on == "table") {
    body.part = end_of_chain(machine.work_chain(), -1);
    body.part_from_body.translation += machine.table_offset();
    return;
  }
  auto part = joint_named(on, machine.tool_chain(), +1);
  if (!part) part = joint_named(on, machine.work_chain(), -1);
  if (part) {
    body.part = *part;
    return;
  }
  table.fail("on", "unknown-part"_id, fmt::format("the machine has no part '{}'", on),
             "write bed, spindle, table, or one of its axes");
}

}  // namespace

std::vector<MachineBody> read_bodies(const TomlTable& root, const Machine& machine) {
  std::vector<MachineBody> bodies;
  std::set<std::string> names;
  const std::vector<TomlTable> tables = root.tables("bodies");
  for (const TomlTable& table : tables) {
    MachineBody body = read_body(table, names);
    place(table, machine, body);
    body.ignored = table.texts_or("ignore", {});
    bodies.push_back(std::move(body));
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    for (const std::string& name : bodies[k].ignored) {
      if (names.contains(name)) continue;
      const std::vector<std::string> known(names.begin(), names.end());
      tables[k].fail("ignore", "unknown-body"_id, fmt::format("there is no body '{}'", name),
                     suggestion(name, known));
    }
  }
  return bodies;
}

std::vector<MachineBody> read_fixtures(const TomlTable& root) {
  std::vector<MachineBody> fixtures;
  std::set<std::string> names;
  for (const TomlTable& table : root.tables("fixtures")) {
    fixtures.push_back(read_body(table, names));
  }
  return fixtures;
}

}  // namespace frustum::kinematics
