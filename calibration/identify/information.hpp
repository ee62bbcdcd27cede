// How much of what is known of an unknown hangs on one group of measurements.
//
// Model    : share = 1 - variance with all / variance without the group; 1 where the unknown can no
//            longer be identified without it. Shares do not add up to 1: groups replace each other
// Units    : dimensionless
// Shape    : unknowns x groups; zero for fixed unknowns and for those that cannot be identified at
//            all
// Errors   : those of weighted_system
// Accuracy : rounding
// Source   : JCGM 102:2011, section 6
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/identify/identification.hpp"

namespace frustum::calibration {

struct InformationShares {
  std::vector<std::string> groups{};  // in the order of the rows
  Eigen::MatrixXd shares{};
};

[[nodiscard]] Result<InformationShares> information_shares(const Observations& observations,
                                                           const IdentifyOptions& options = {});

}  // namespace frustum::calibration
