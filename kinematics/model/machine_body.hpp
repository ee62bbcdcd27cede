// A solid part of a machine or a fixture: its shape, and which part of the machine carries it.
//
// Model    : the machine is a bed with two chains of joints; a body is fixed to the bed or to the
//            moving part of one joint, and moves with the axes from there to the bed. Box and
//            cylinder have the centre of their bottom at the origin of the body's frame and extend
//            along +Z; a mesh has its own zero there
// Units    : mm, rad; in files mm and degrees: origin = [x, y, z], tilt = [a, b, c] as Rz Ry Rx
// Errors   : noted in the table's document: names that are missing or used twice, parts that the
//            machine lacks, sizes that are not above 0, files that are not there, names to ignore
//            that no body has
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/pose.hpp"
#include "core/toml_document.hpp"

namespace frustum::kinematics {

class Machine;

struct BoxBody {
  Vec3 size = Vec3::Zero();
};
struct CylinderBody {
  double diameter = 0.0, height = 0.0;
};
struct MeshBody {
  std::filesystem::path file{};
};
using BodyShape = std::variant<BoxBody, CylinderBody, MeshBody>;

// The part of the machine after the first `joints` of a chain, bed outwards.
struct MachinePart {
  int side = 0;  // +1 tool side, -1 workpiece side, 0: the bed
  std::size_t joints = 0;
  bool operator==(const MachinePart&) const = default;
};

struct MachineBody {
  std::string name{};
  MachinePart part{};
  BodyShape shape{};
  Pose part_from_body{};               // part: the frame of its last joint, or of the bed
  std::vector<std::string> ignored{};  // bodies that it may touch by design
};

// [[bodies]] of a machine file whose chains have been read.
[[nodiscard]] std::vector<MachineBody> read_bodies(const TomlTable& root, const Machine& machine);
// [[fixtures]] of a job, in the frame of the table; `part` is for who knows the machine.
[[nodiscard]] std::vector<MachineBody> read_fixtures(const TomlTable& root);

}  // namespace frustum::kinematics
