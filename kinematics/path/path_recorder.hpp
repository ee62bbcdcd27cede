// From commanded moves to the tool path: directions of approach, sampling, times, servo lag;
// streamed.
//
// Model    : the commanded motion of each block goes through the memory of the directions of
//            approach (direction-dependent errors), is sampled to the path bound, cut where an
//            error jumps (both sides of the jump are in the path), and given times by the time law.
//            With servo lag the axes follow their commands late, and the path is where they really
//            are
// Units    : mm, rad, s
// Errors   : none; motions have been checked before they come here
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/path/approach_direction.hpp"
#include "kinematics/path/tool_path.hpp"
#include "kinematics/timing/servo_lag.hpp"
#include "kinematics/timing/time_law.hpp"

namespace frustum::kinematics {

// A part of the tool path in program order. Its first pose is the last of the part before, where
// the path goes on.
using PathSink = std::function<void(const ToolPath&)>;

struct TravelOptions {
  double path_bound = 1e-5;  // mm
  TimeLawOptions time_law{};
  bool servo_lag = false;  // the path is where the axes are behind their commands
  // s: poses at all multiples of it, too, through rests with a tool; 0: none. With servo_lag,
  // whose steps are its own, no step is longer.
  double time_step = 0.0;
  PathSink sink{};  // takes the path in parts as it grows; without one the whole path is kept
  // Poses and their times are all that is kept of the path: no axes, velocities and shares. Not
  // with a sink or a time step, which go on from these.
  bool poses_alone = false;
};

class PathRecorder {
 public:
  // Machine, set-up and errors must outlive it.
  PathRecorder(const Machine& machine, const Setup& setup, const GeometricErrors& errors,
               const AxisPositions& start, TravelOptions options);

  void follow(const CommandedStep& step);

  // Rest, and the path that no sink has taken.
  [[nodiscard]] ToolPath finish();
  // s since the beginning: after finish(), all of the program.
  [[nodiscard]] double clock() const { return clock_; }

 private:
  struct Sample {
    double u = 0.0;
    ToolPose pose{};
    AxisState axes{};
  };
  // Waits for its times.
  struct Pending {
    CommandedMove move;
    double tool_length = 0.0;  // mm, of the real tool
    double reach = 0.0;        // mm above the tip up to which the bound holds
    bool starts_chain = false;
    std::vector<Sample> samples{};
    std::optional<ApproachProfile> approach{};  // where poses are at multiples of a time
    std::vector<double> ends{};                 // u at the ends of its segments
    std::vector<TimedSegment> segments{};

    [[nodiscard]] bool has_tool() const { return move.tool != 0; }
  };
  struct TimedPose {
    ToolPose pose{};
    AxisState axes{};
    double time = 0.0;
    AxisPositions velocity{};
    double share = 1.0;  // of its block
  };

  void travel(const CommandedMove& move);
  void rest(double seconds);
  [[nodiscard]] ToolPose pose_at(const AxisState& axes, double tool_length);
  void sample(Pending& pending, int parts);
  void give_to_time_law(Pending& pending, int parts);
  void collect_times();
  void deliver(Pending& pending);
  [[nodiscard]] std::vector<TimedPose> timed_samples(const Pending& pending) const;
  void add_even_times(const Pending& pending, std::vector<TimedPose>& poses);
  void stand(double seconds);
  [[nodiscard]] std::vector<TimedPose> lagged_samples(const Pending& pending, double duration);
  [[nodiscard]] TimedPose lagged(const AxisPositions& commanded, double seconds, double time,
                                 double tool_length);
  void settle(double seconds);
  void append(const std::vector<TimedPose>& poses, bool continues);
  void hand_over();

  const Machine& machine_;
  const Setup& setup_;
  const GeometricErrors& errors_;
  Pose workpiece_from_table_;
  TravelOptions options_;
  std::optional<ForwardChain> chain_{};  // with the tool of chain_length_
  double chain_length_ = 0.0;
  ApproachTracker tracker_;
  TimeLaw law_;
  std::deque<Pending> pending_{};
  bool chain_broken_ = true;  // of the motions that come in
  ToolPose last_pose_{};      // of them
  ToolPath path_{};
  double clock_ = 0.0;
  ServoLag lag_;
  double lag_step_ = 0.0;  // s
  double lag_tool_ = 0.0;  // mm: length of the tool whose path is on
  bool lag_has_path_ = false;
  bool has_path_ = false;  // the last motion was with a tool
};

}  // namespace frustum::kinematics
