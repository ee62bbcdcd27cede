// A test piece: everything that is needed to cut it and to measure it.
//
// Units: mm, rad. Frames: the inspection plan and the blank are in the workpiece frame, which
// setup.table_from_workpiece places on the table; the NC program is in program coordinates.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cutter/body/cutter.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine_body.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "parser/control_settings.hpp"
#include "parser/dialect.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::programs {

// What an operation is for the report: one round of a cone, whose axes are drawn over the angle
// about its axis, or anything else, drawn over blocks.
enum class OperationKind { other, cone };

// A named range of lines of the main program (both included), with the subprograms that they call:
// what the report plots, and where error shapes find the travelled range of each axis.
struct Operation {
  std::string name{};
  std::uint32_t first_line = 0;
  std::uint32_t last_line = 0;
  // Features of the plan that these lines cut; a measured point of theirs that anything else made,
  // or nothing, is worth a warning.
  std::vector<std::string> makes{};
  OperationKind kind = OperationKind::other;
};

// How the workpiece is on the table, as people write it.
struct Placement {
  Vec3 origin = Vec3::Zero();  // mm, of the workpiece frame in the table frame
  Vec3 tilt = Vec3::Zero();    // rad: Rz(tilt.z) Ry(tilt.y) Rx(tilt.x)

  [[nodiscard]] Pose table_from_workpiece() const {
    return {rotation_z(tilt.z()) * rotation_y(tilt.y()) * rotation_x(tilt.x()), origin};
  }
};

// How the control reads the program, beyond what the machine's file says.
struct ProgramReading {
  std::vector<std::filesystem::path> search_path{};  // subprograms, after the program's folder
  bool block_delete = false;                         // blocks that begin with / are left out
  std::optional<parser::ControlSettings> control{};  // in place of the machine's
};

struct TestPiece {
  std::string title{};
  std::string program{};       // NC text
  std::string program_file{};  // names it in diagnostics
  parser::Dialect dialect = parser::Dialect::fanuc;
  ProgramReading reading{};
  Placement placement{};
  std::map<int, Vec3> work_offsets{};  // 1 = G54 ...: program origin in the table frame
  cutter::ToolList tools{};
  stock::BlankShape blank{};
  Vec3 blank_origin = Vec3::Zero();                 // centre of its bottom, workpiece frame
  std::vector<kinematics::MachineBody> fixtures{};  // in the frame of the table
  metrology::InspectionPlan plan{};
  std::vector<Operation> operations{};
  // Error shapes without a span of their own are over the range that this operation travels.
  std::string error_span{};
};

}  // namespace frustum::programs
