// A stroke: the part of a block between two corrected places, with the directions of approach that
// the correction itself causes.
//
// Model    : errors depend on the direction from which each axis came, and the correction moves the
//            axes, too. The corrected ends and the directions are iterated until they agree with
//            what the axes then do (kinematics/path/approach_direction.hpp): of errors that jump,
//            both ends with the direction in which the stroke leaves and arrives; where play is
//            taken up, by bracketing. Where the direction in which the axes leave asks for another
//            correction than that in which they came, the axes turn: short moves at the place of
//            its beginning. An axis that such a move leaves in the wrong direction, and that the
//            stroke does not move, comes back to its position from the other side. An axis that
//            would go against either direction that it is corrected for stays where it is
// Units    : mm, rad; places are u of the block
// Errors   : none; directions that do not agree are reported in the stroke
#pragma once

#include <optional>
#include <vector>

#include "calibration/compensate/programmed_frame.hpp"
#include "calibration/compensate/wanted_block.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/path/approach_direction.hpp"

namespace frustum::calibration {

// Where the axes are on the way through the corrected program.
struct CorrectedPlace {
  kinematics::AxisPositions q{};
  kinematics::ApproachTracker tracker{};
  // The directions of approach that q is corrected for.
  kinematics::AxisPositions corrected_for{};
};

struct Stroke {
  double from = 0.0, to = 1.0;
  std::vector<Words> turn{};  // before it: moves at the place where it begins
  Words start{}, end{};
  kinematics::ApproachProfile approach{};     // along it
  kinematics::AxisPositions corrected_for{};  // its end
  bool turns = false;                // a direction of approach changes along it, or is not settled
  bool settled = false;              // its directions are those it was corrected for
  std::optional<double> jumps_at{};  // share of it: where an axis turns within
};

class StrokeSolver {
 public:
  // All must outlive it.
  StrokeSolver(const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
               const ProgrammedFrame& frame, const WantedBlock& wanted);

  // `may_turn`: moves may be put before it.
  [[nodiscard]] Stroke solve(const CorrectedPlace& at, double from, double to, bool may_turn) const;
  // Whether the actual tool, with the controller interpolating between the words, passes the wanted
  // poses on the way within the bounds, mm and rad.
  [[nodiscard]] bool follows(const Stroke& stroke, double bound, double axis_bound) const;

 private:
  // Of the direction of approach of one axis whose play is being taken up.
  struct Bracket {
    double lo = -1.0, hi = 1.0;
    bool substitutes = false;  // what was found, or halves: in turns
    [[nodiscard]] double next(double assumed, double found);
  };

  [[nodiscard]] Words corrected(double u, const kinematics::AxisPositions& heading) const;
  [[nodiscard]] kinematics::ApproachProfile follow(kinematics::ApproachTracker& tracker,
                                                   const Words& from, const Words& to) const;
  [[nodiscard]] kinematics::ToolPose actual(const kinematics::AxisState& at) const;
  // What the correction leaves of the direction at a place, near the pole.
  [[nodiscard]] double axis_left(double u, const kinematics::AxisPositions& heading) const;
  [[nodiscard]] bool jumps(kinematics::AxisLetter axis) const;
  [[nodiscard]] bool agree(const kinematics::AxisPositions& a,
                           const kinematics::AxisPositions& b) const;
  // Whether an error that jumps is another one as the axes leave.
  [[nodiscard]] bool asks_for_turn(const kinematics::AxisPositions& leaving,
                                   const kinematics::AxisPositions& corrected_for) const;
  // Ends the stroke where axes with a direction have not moved back from it.
  void hold(Stroke& stroke, const kinematics::ApproachTracker& tracker,
            const kinematics::AxisPositions& direction) const;
  void find_turns(Stroke& stroke) const;

  const kinematics::Machine& machine_;
  const kinematics::GeometricErrors& errors_;
  const ProgrammedFrame& frame_;
  const WantedBlock& wanted_;
};

}  // namespace frustum::calibration
