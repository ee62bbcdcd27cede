// The blocks of a motion test's program while it is made.
//
// Units  : mm, rad, mm/min
// Errors : those of the writer
#pragma once

#include <functional>
#include <string>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/motion/motion_program.hpp"
#include "programs/piece_program.hpp"

namespace frustum::programs {

class MotionBlocks {
 public:
  // `origin`: of G54 in the frame of the table.
  MotionBlocks(const kinematics::Machine& machine, const std::string& number,
               const std::string& title, const Vec3& origin, double tool_length,
               const MotionProgramOptions& options);

  void comment(const std::string& text) { nc_.comment(text); }
  // Z and the rotary axes home, the tool, the rotary axes to their place, then the frame in force.
  void begin(const kinematics::AxisPositions& first);
  // X and Y, then Z.
  void approach(const kinematics::AxisPositions& to);
  void rapid(const kinematics::AxisPositions& to);
  void feed(const kinematics::AxisPositions& to);
  // Along a motion from one parameter to another.
  void along(const std::function<kinematics::AxisPositions(double)>& motion, double from,
             double to);
  void arc(const kinematics::AxisPositions& to, const kinematics::AxisPositions& centre,
           instruments::Plane plane, double turn);
  void dwell(double seconds);
  void stop(const std::string& message);
  [[nodiscard]] Result<TestPiece> end(const std::string& name, const std::string& title);

 private:
  [[nodiscard]] parser::AxisTarget words_of(const kinematics::AxisPositions& q) const;
  // By how many times the chord's bound a straight block is off the motion.
  [[nodiscard]] double unevenness(const std::function<kinematics::AxisPositions(double)>& motion,
                                  double from, double to) const;
  [[nodiscard]] Vec3 tip_of(const kinematics::AxisPositions& q) const;
  void split(const std::function<kinematics::AxisPositions(double)>& motion, double from, double to,
             int depth);
  void retract();

  const kinematics::Machine& machine_;
  MotionProgramOptions options_;
  Vec3 origin_;
  double tool_length_;
  kinematics::AxisPositions zero_;  // at which the words are zero in the form axes
  PieceProgram nc_;
};

}  // namespace frustum::programs
