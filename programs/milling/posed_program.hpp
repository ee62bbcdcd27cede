// The NC program of a test piece whose path is a list of tool poses, in any of three forms.
//
// Model    : each operation starts from Z at home, the rotary axes at home or where its first pose
//            has them; then come its moves, tip and axis in program coordinates
// Units    : mm, rad; mm/min, 1/min
// Errors   : poses that the machine cannot reach, or only beyond its travels
// Accuracy : tips of axis positions within 2 nm of straight lines between poses
// Source   : ours
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/tool_pose.hpp"
#include "programs/piece_program.hpp"

namespace frustum::programs {

// How the NC program states the tool's pose.
enum class ProgramForm {
  vector,  // G43.5: tip and tool vector; any machine
  angles,  // G43.4: tip and rotary angles of one machine
  axes,    // axis positions of one machine, no tool-centre-point control
};

struct PathMove {
  kinematics::ToolPose pose{};
  bool rapid = false;
};
// Moves of one operation, from clear of the part to clear of the part.
struct PathOperation {
  std::string name{};
  OperationKind kind = OperationKind::other;
  std::vector<std::string> makes{};  // features of the plan
  std::vector<PathMove> lead_in{};   // approach
  std::vector<PathMove> cut{};       // what the operation is named after
  std::vector<PathMove> lead_out{};  // departure
};

struct PosedProgramSettings {
  std::string number{};  // of controllers that number programs
  std::string title{};
  std::vector<std::string> remarks{};
  std::string piece{};         // in words, for errors: "the cone test"
  std::string remedy{};        // where it does not fit
  Vec3 origin = Vec3::Zero();  // of the program in the table frame
  Mm tool_length{150.0};
  double feed = 500.0;
  double spindle_speed = 4000.0;
  ProgramForm form = ProgramForm::vector;
  // The rotary axes go to the start of each operation first, which settles which of two ways to
  // reach its poses the control takes: that with the tilting axis at 0 or above.
  bool rotary_start = false;
};

// The work offsets that programs of a form call: 1 is the origin, another one is zero.
inline constexpr int kMachineOffset = 6;  // G59 = 0: axis positions as the machine shows them
inline constexpr int kPieceTool = 1;

// Writes the program of `made` and names its operations' lines.
[[nodiscard]] Result<TestPiece> write_posed_program(const PosedProgramSettings& settings,
                                                    const std::vector<PathOperation>& operations,
                                                    const kinematics::Machine& machine,
                                                    TestPiece made, parser::Dialect dialect);

}  // namespace frustum::programs
