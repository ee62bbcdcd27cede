// The controller: canonical motions in, axis commands and the actual tool path out.
//
// Model    : with tool-centre-point control the tip moves as programmed in the frame of the words (straight,
//            or on an arc) while the rotary axes move linearly or the tool axis runs on the great circle;
//            without it all axes move linearly. Both see the nominal machine; where the tool really goes,
//            and when, is for path_recorder.hpp. Modes and feeds in words: docs/controller.md
// Frames   : frame of the words = table frame shifted by the active work offset, then the tilted plane.
//            Without either control or plane a word is an axis position: at rotary zero the tip is where
//            the words say. Machine coordinates (G53) are axis positions.
// Units    : mm, rad, s
// Errors   : over-travel (axis, value, limits), axes the machine lacks, unreachable directions, tools and
//            work offsets that the setup lacks, feed without a tool, feed per revolution without a turning
//            spindle, alignment without a plane, rotary positions off the great circle; each with the NC line
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/path/path_recorder.hpp"
#include "kinematics/path/tool_path.hpp"
#include "parser/motion.hpp"

namespace frustum::kinematics {

// What the controller and the machine know of a tool.
struct ToolGeometry {
  double length = 0.0;         // mm, gauge point to tip: the offset table's value
  double length_error = 0.0;   // mm: the real tool is longer by this
  double flute_length = 50.0;  // mm: cutting height, for the path bound
};

struct Setup {
  Pose table_from_workpiece{};
  // Program origin in the table frame, by offset number: 1 = G54 ... 6 = G59.
  std::map<int, Vec3> work_offsets{};
  std::map<int, ToolGeometry> tools{};
};

// Axis positions at the end of a block.
struct AxisSample {
  std::uint32_t source_line = 0;
  PathKind kind = PathKind::feed;
  AxisPositions axes{};
};

struct Execution {
  ToolPath path{};                 // empty when only axes were asked for
  std::vector<AxisSample> axes{};  // the first entry is the start position
  double cycle_time = 0.0;         // s
  Diagnostics warnings{};
};

struct BlockMotion;  // block_motion.hpp

struct ControllerOptions {
  double path_bound = 1e-5;  // mm
  bool sample_path = true;   // false: axis positions only (errors and times play no part)
  bool check_travel = true;  // false: positions beyond the travels are executed all the same
  TimeLawOptions time_law{};
  bool servo_lag = false;       // the path is where the axes are behind their commands
  PathSink sink{};              // takes the path in parts as it grows; nothing of it is then kept
  bool feeds_need_tool = true;  // false: feed moves with an empty spindle are executed too
  // Sees each move that is made, for those who judge it; without sample_path nothing of the axes is kept.
  std::function<void(const BlockMotion&, const PathBlock&)> watch{};
  // Takes what is wrong with a motion, which is then not made, and those after it are. Without it the first
  // problem ends the execution.
  std::function<void(Diagnostic&&)> problems{};
};

class Controller {
 public:
  Controller(const Machine& machine, const GeometricErrors& errors, const Setup& setup,
             const ControllerOptions& options);
  ~Controller();
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  // Executes one motion; after the first error nothing more is executed.
  // Returns false when the motion could not be executed.
  bool execute(const parser::Motion& motion);

  [[nodiscard]] Result<Execution> finish() &&;

 private:
  class State;
  std::unique_ptr<State> state_;
};

// All at once.
[[nodiscard]] Result<Execution> execute(const Machine& machine, const GeometricErrors& errors,
                                        const Setup& setup, std::span<const parser::Motion> motions,
                                        const ControllerOptions& options = {});

}  // namespace frustum::kinematics
