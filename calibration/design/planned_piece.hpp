// A test piece that is planned as rows of a design: what its measurement would tell, and how long
// the machine is busy with it.
//
// Model    : by characteristics: those that identification takes of it (piece_observations.hpp).
//            By points: every probed point that the program cuts, along its normal, with the noise
//            of the CMM (point_uncertainty.hpp) and its linear field; where nobody has placed the
//            workpiece, a shift and a turn of all points are unknowns of their own. Kept is the
//            information, G^T S^-1 G less what these unknowns take of it, in as many rows as there
//            are unknowns
// Units    : mm, rad; rows of points over their standard deviation; s
// Shape    : columns: the unknowns; causes after the last one of the pieces do nothing
// Errors   : those of the trial; no CMM, or one without errors; nothing that is cut is probed
// Accuracy : first order in the errors (trials/surface_gain.hpp)
// Source   : Pukelsheim, Optimal Design of Experiments, section 3.11 (parameters of no interest)
#pragma once

#include <cstdint>

#include "calibration/identify/piece_observations.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

enum class PlannedRows : std::uint8_t {
  characteristics,
  points,          // the workpiece is where the program means it
  floating_points  // the workpiece is anywhere on the CMM
};

struct PlannedPiece {
  MeasuredPiece piece{};  // its values are not used
  PlannedRows rows = PlannedRows::characteristics;
};

struct PlannedObservations {
  Observations observations{};
  std::size_t touches = 0;
  double cutting_time = 0.0;  // s, as programmed
};

// `index`: of the piece among those of the causes.
[[nodiscard]] Result<PlannedObservations> planned_observations(const kinematics::Machine& machine,
                                                               const PlannedPiece& planned,
                                                               std::size_t index,
                                                               const std::vector<Unknown>& unknowns,
                                                               std::vector<Cause> causes);

}  // namespace frustum::calibration
