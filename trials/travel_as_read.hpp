// A piece's program travelled while it is read: motion by motion, for programs of which neither the
// motions nor what they command fits into memory.
//
// Model    : the text is checked as a whole, then run; what it commands goes into the path at once.
//            Portions of motions are commanded and travelled while the next ones are read
// Units    : mm, rad, s
// Errors   : those of command_piece(), in the same order: syntax, then what cannot be run, then
//            what cannot be commanded
// Accuracy : the path is that of command_piece() and still_travel(), bit for bit
// Threads  : runs on oneTBB; the same bits for any number of threads
#pragma once

#include <vector>

#include "core/result.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/path/travel.hpp"
#include "programs/test_piece.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

// Nothing has to be known of the program as a whole: no operations, no dynamics, no errors whose
// size depends on where the axes go, none that is too large.
[[nodiscard]] bool may_travel_as_read(const kinematics::Machine& machine,
                                      const kinematics::GeometricErrors& errors,
                                      const programs::TestPiece& piece,
                                      const TrialOptions& options);

struct TravelAsRead {
  kinematics::Travel travel{};  // its path has poses and times alone
  Diagnostics warnings{};       // those of CommandedPiece, then those of oversize errors
  std::vector<ProgramFile> program_files{};
  stock::MachineCollisions machine_collisions{};  // where the options ask for them
};
[[nodiscard]] Result<TravelAsRead> travel_as_read(const kinematics::Machine& machine,
                                                  const kinematics::GeometricErrors& errors,
                                                  const programs::TestPiece& piece,
                                                  const TrialOptions& options);

}  // namespace frustum::trials
