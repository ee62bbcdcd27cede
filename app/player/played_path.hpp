// The tool path as the player shows it: a bounded number of points with the deviation of each.
//
// Model    : the path of the actual machine with chords of half a micrometre, or coarser ones where
//            these would be too many points; the ends of blocks are always points unless there are
//            more blocks than points. A deviation is from the tip of the error-free machine at the
//            same axis positions; where the control lags or the machine vibrates, from the nearest
//            place of the error-free path as programmed
// Units    : mm, rad, s; frame: workpiece
// Errors   : those of the path
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/job/job.hpp"
#include "core/result.hpp"
#include "kinematics/path/tool_path.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

struct PathPoint {
  double time = 0.0;
  Vec3 tip = Vec3::Zero();  // without errors
  Vec3 deviation = Vec3::Zero();
  kinematics::AxisPositions axes{};
  double feed = 0.0;  // mm/min: the way of the error-free tip since the point before over its time
  std::uint32_t block = 0;
  bool starts = false;  // a chain begins here
};

struct PlayedPath {
  std::vector<PathPoint> points{};
  std::vector<kinematics::PathBlock> blocks{};
  double cycle_time = 0.0;         // s
  double bound = 0.0;              // mm: of the chords
  std::size_t left_out = 0;        // points, for a page of sane size
  bool by_place = false;           // deviations are from the nearest place
  double largest_deviation = 0.0;  // mm
};

struct PointBudget {
  std::size_t most = 300000;
  double bound = 5e-4;  // mm
};
[[nodiscard]] Result<PlayedPath> played_path(const Job& job,
                                             const trials::CommandedPiece& commanded,
                                             const kinematics::GeometricErrors& errors,
                                             const PointBudget& budget = {});

}  // namespace frustum::app
