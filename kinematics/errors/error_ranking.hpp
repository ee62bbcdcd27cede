// Which errors of a machine weigh most at a pose: by gain, and by their share of the mean square.
//
// Model    : gain |G_k|, the length of the displacement rows of an error's column; share of
//            independent errors with zero mean whose limits are the same number of standard
//            deviations: |G_k|^2 t_k^2 / sum of all, which no such number changes
// Units    : gains um per um and um per urad (levers in metres); tolerances mm or rad; shares sum
//            to 1
// Shape    : one entry an error, largest first, equal ones in the order given
// Errors   : none
// Accuracy : the published tables of the DVF 5000 (tests/kinematics/error_ranking_test.cpp)
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinematics/errors/error_gain.hpp"

namespace frustum::kinematics {

struct RankedError {
  std::string name{};
  double weight = 0.0;  // gain or share
};

[[nodiscard]] double gain_length(const MachineError& error, const GainMatrix& gains,
                                 std::size_t column);
[[nodiscard]] std::vector<RankedError> rank_by_gain(std::span<const MachineError> errors,
                                                    const GainMatrix& gains);
// `tolerances`: one an error; all zero: all shares are zero.
[[nodiscard]] std::vector<RankedError> rank_by_share(std::span<const MachineError> errors,
                                                     const GainMatrix& gains,
                                                     std::span<const double> tolerances);

}  // namespace frustum::kinematics
