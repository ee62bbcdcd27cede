// Threads cut on a lathe by G76: every pass of the cycle, in X and Z.
//
//   X drive line   where the tool is at the start, clear of the part
//   X crest        I from the drive line: below zero for a thread outside, above for one inside
//   depths         J, then J n^(1/R) at pass n, at last K; H passes more at K
//   slide          the passes begin and end later along Z by depth tan Q, so that one flank cuts
//   tapers over E along Z the tool goes in from the crest, or out to it, at the thread's lead
//
// Units : mm, mm a revolution, rad
// Shape : for each pass: to its start by rapid, in, along the thread, out by rapid; at the end to
//         the drive line
// Errors: none; the words are checked by the caller
// Source: LinuxCNC's user manual, G76 threading cycle
#pragma once

#include <vector>

namespace frustum::parser {

struct ThreadingCycle {
  double start_x = 0.0;  // the drive line
  double start_z = 0.0;
  double end_z = 0.0;
  double lead = 0.0;         // P
  double crest = 0.0;        // I
  double first_depth = 0.0;  // J
  double full_depth = 0.0;   // K
  double degression = 1.0;   // R, from 1 on
  double slide_angle = 0.0;  // Q
  int spring_passes = 0;     // H
  double taper = 0.0;        // E; 0: none
  bool tapers_in = false;    // L
  bool tapers_out = false;

  // How many times it cuts, or a number too large to be meant.
  [[nodiscard]] double passes() const;
};

struct ThreadMove {
  double x = 0.0;
  double z = 0.0;
  double lead = 0.0;  // 0: by rapid
};

[[nodiscard]] std::vector<ThreadMove> moves_of(const ThreadingCycle& cycle);

}  // namespace frustum::parser
