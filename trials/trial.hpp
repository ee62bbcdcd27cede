// One trip round the loop: parse, interpret, command, travel with errors, cut, measure.
//
// A pure function of its arguments: the same input gives the same bits. Everything that runs the
// loop, once or a million times, goes through run_trial(). What does not depend on the machine's
// errors, from the program's text to the commanded axes, is done once: CommandedPiece.
// Units: mm, rad
// Errors: those of every room on the way, with the place in the NC program or the plan
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "dynamics/path_deviation.hpp"
#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/path/slowed_blocks.hpp"
#include "kinematics/path/travel.hpp"
#include "kinematics/timing/time_law.hpp"
#include "metrology/cmm.hpp"
#include "metrology/measurement.hpp"
#include "parser/motion.hpp"
#include "parser/tool_table.hpp"
#include "programs/test_piece.hpp"
#include "stock/collision/collision.hpp"
#include "stock/collision/machine_collision.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::trials {

// Axis positions of one operation: where it starts, then the end of every block.
struct OperationTrace {
  std::string name{};
  programs::OperationKind kind = programs::OperationKind::other;
  std::vector<kinematics::AxisSample> samples{};
  kinematics::AxisSpans ranges{};  // travelled range of each axis of the machine
};

// A file with subprograms that a program has opened, as it was when it ran.
struct ProgramFile {
  std::string name{};
  std::string sha256{};
};

// Everything that one trip leaves behind.
struct Trial {
  metrology::Measurement measurement{};
  std::vector<OperationTrace> operations{};
  double cycle_time = 0.0;                        // s
  std::vector<kinematics::SlowedBlock> slowed{};  // those that lose most time first
  std::vector<stock::Collision> collisions{};     // in program order
  // What was looked for of machine and fixtures; its collisions are among those above.
  stock::MachineCollisions machine_collisions{};
  Diagnostics warnings{};
  Diagnostics wrong_cuts{};                  // cut_check.hpp
  std::vector<ProgramFile> program_files{};  // as of CommandedPiece
  std::shared_ptr<const stock::Workpiece> workpiece{};
};

enum class Stage { parse, execute, cut, collide, measure };
[[nodiscard]] std::string_view name_of(Stage stage);

struct TrialOptions {
  double path_bound = 1e-5;  // mm
  // Where the tool goes does not depend on when, so that studies leave the limits out.
  kinematics::TimeLawOptions time_law{.limits = false};
  bool servo_lag = false;
  // What masses and springs of the machine add to the path; without a model nothing.
  std::shared_ptr<const dynamics::DynamicModel> dynamic_model{};
  dynamics::PathDynamics dynamics{};
  bool find_collisions = true;

  [[nodiscard]] bool has_dynamics() const {
    return dynamic_model != nullptr && dynamics.method != dynamics::PathMethod::off;
  }
  bool measure = true;  // false: stop with the finished workpiece
  // The path has poses and times alone, and the trial nothing that is known of the program as a
  // whole: then a program of any length is read, commanded and travelled at once, where nothing
  // else asks for it (travel_as_read.hpp). Only without `measure`.
  bool poses_alone = false;
  // Called when a stage begins; for progress bars and clocks, which are above this room.
  std::function<void(Stage)> on_stage{};
};

// Where the tool goes: with the errors and the lag that the options ask for, and poses for their
// dynamics.
[[nodiscard]] Result<kinematics::Travel> still_travel(const kinematics::Machine& machine,
                                                      const kinematics::GeometricErrors& errors,
                                                      const kinematics::Setup& setup,
                                                      const kinematics::CommandedProgram& program,
                                                      const TrialOptions& options);
// The same with the dynamic deviation.
[[nodiscard]] Result<kinematics::Travel> tool_travel(const kinematics::Machine& machine,
                                                     const kinematics::GeometricErrors& errors,
                                                     const kinematics::Setup& setup,
                                                     const kinematics::CommandedProgram& program,
                                                     const TrialOptions& options);

// The tools as programs call them: names, and the diameters that radius compensation counts with.
// The lengths are the setup's.
[[nodiscard]] parser::ToolTable called_tools_of(const programs::TestPiece& piece);
// What the controller knows of the piece: placement, offsets and tools.
[[nodiscard]] kinematics::Setup setup_of(const programs::TestPiece& piece);

// A piece's program as the controller commands it, whatever the errors of machine and tools.
struct CommandedPiece {
  std::vector<parser::Motion> motions{};  // those that it commands
  kinematics::CommandedProgram program{};
  std::vector<OperationTrace> operations{};
  Diagnostics warnings{};
  std::vector<ProgramFile> program_files{};  // in the order in which they were opened
};
[[nodiscard]] Result<CommandedPiece> command_piece(const kinematics::Machine& machine,
                                                   const programs::TestPiece& piece,
                                                   const std::function<void(Stage)>& on_stage = {});

[[nodiscard]] Result<Trial> run_trial(const kinematics::Machine& machine,
                                      std::span<const kinematics::ErrorEntry> errors,
                                      const programs::TestPiece& piece,
                                      const metrology::CmmModel& cmm,
                                      const TrialOptions& options = {});
// With errors whose shapes have found their spans already.
[[nodiscard]] Result<Trial> run_trial(const kinematics::Machine& machine,
                                      const kinematics::GeometricErrors& errors,
                                      const programs::TestPiece& piece,
                                      const metrology::CmmModel& cmm,
                                      const TrialOptions& options = {});
// Of a piece that has been commanded before; its tools may since have other radius and length
// errors.
[[nodiscard]] Result<Trial> run_trial(const kinematics::Machine& machine,
                                      const kinematics::GeometricErrors& errors,
                                      const programs::TestPiece& piece,
                                      const CommandedPiece& commanded,
                                      const metrology::CmmModel& cmm,
                                      const TrialOptions& options = {});

// What the operation that the piece's error_span names travels; nothing where it names none.
[[nodiscard]] Result<kinematics::AxisSpans> error_spans(const programs::TestPiece& piece,
                                                        const CommandedPiece& commanded);
// The errors as this piece's program meets them: shapes without a span are over what the operation
// that its error_span names travels.
[[nodiscard]] Result<kinematics::GeometricErrors> errors_for(
    const kinematics::Machine& machine, std::span<const kinematics::ErrorEntry> errors,
    const programs::TestPiece& piece);
[[nodiscard]] Result<kinematics::GeometricErrors> errors_for(
    const kinematics::Machine& machine, std::span<const kinematics::ErrorEntry> errors,
    const programs::TestPiece& piece, const CommandedPiece& commanded);

// Makes a workpiece answer approaches: the bridge between stock and metrology.
class WorkpieceProbe {
 public:
  explicit WorkpieceProbe(const stock::Workpiece& workpiece) : workpiece_(&workpiece) {}
  [[nodiscard]] std::optional<metrology::Touch> touch(const Vec3& start, const UnitVec3& direction,
                                                      double length_mm) const;

 private:
  const stock::Workpiece* workpiece_;
};

}  // namespace frustum::trials
