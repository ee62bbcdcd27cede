// Touches of a probe as a program that a machine runs and logs, for four controls.
//
// Model    : rotary axes are indexed well above the workpiece. For each touch the ball goes over
//            its place of approach, down to it, and feeds until the probe trips, at most to `end`;
//            back, and up. LinuxCNC G38.2 and LOG; Fanuc G31 and DPRNT; Sinumerik MEAS and WRITE;
//            Klartext TCH PROBE 4 and FN 16 with a mask beside the program
// Text     : G54 (datum 1), tool 1 with its length to the centre of the ball. Logged are the rotary
//            axes, the number of the touch and the centre of the ball where the probe tripped:
//            A_deg,C_deg,point,ball_x_mm,ball_y_mm,ball_z_mm, of Fanuc A C POINT BALLX BALLY BALLZ
// Units    : mm, deg, mm/min in the text
// Errors   : none
// Source   : programming manuals of the controls; LinuxCNC's and Fanuc's are read by parser/, none
//            was run on a control
#pragma once

#include <string>
#include <vector>

#include "core/pose.hpp"
#include "parser/dialect.hpp"

namespace frustum::instruments {

struct ProgrammedTouch {
  std::vector<double> turned{};  // rad, of the program's rotary axes
  std::size_t point = 0;         // as it is logged
  // Of the ball's centre, counted from G54 as X, Y and Z.
  Vec3 approach = Vec3::Zero(), end = Vec3::Zero();
};

struct ProbingProgram {
  std::string title{};   // capital letters
  std::string origin{};  // where G54 is, likewise
  std::string name{};    // of the files: "touch"; of the log: touches.csv
  int number = 1;        // of Fanuc's program
  std::string rotary{};  // letters of the rotary axes: "AC"
  // Z at which the ball is clear of everything: where the rotary axes stand, and where they turn;
  // before the first touch they may be anywhere between zero and their first position.
  double safe = 0.0, turning = 0.0;
  double back = 0.0;  // mm that the probe goes back after it has tripped
  std::vector<ProgrammedTouch> touches{};
};

[[nodiscard]] std::string probing_text(const ProbingProgram& program, parser::Dialect dialect);
// By which FN 16 of the Klartext program writes its lines, in NAME.a beside it.
[[nodiscard]] std::string probing_mask(const ProbingProgram& program);

}  // namespace frustum::instruments
