// Which set-up of the cone shows the machine's errors best.
//
// Model    : the tip's ring of each set-up (tip_ring.hpp) with the spans that it travels. Signal:
//            root mean square of the centred deviation over points and draws, exact from the gains.
//            Directions: participation ratio (sum l)^2 / sum l^2 of the eigenvalues of the points'
//            covariance: in how many independent ways errors shape the ring. Shown: errors that
//            make a form of 1 um or more at their limit, waves with a phase of 0 or 90 deg,
//            whichever shows more
// Units    : mm, rad; results um
// Shape    : a row a set-up
// Errors   : a set-up that the machine cannot reach; cone angles not above the inclination
// Accuracy : rms 1e-6 um; medians of the given draws (tests/studies/setup_map_test.cpp)
// Source   : Bossoni 2010, section 3.10; ours
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "studies/answers/study_result.hpp"
#include "studies/engine/tip_ring.hpp"

namespace frustum::studies {

struct MapOptions {
  FactorOptions factors{};  // spans are those of each set-up
  std::uint64_t seed = 1;
  std::uint32_t draws = 4096;
};

// A row each; result rows in the order of the rings.
[[nodiscard]] Result<std::vector<MapRow>> setup_map(const kinematics::Machine& machine,
                                                    std::span<const kinematics::ErrorEntry> errors,
                                                    std::span<const ConeRing> rings,
                                                    const MapOptions& options);

// The form (um) that each factor makes alone at its limit, as the map counts it, by the centred
// gains (um per mm or rad).
[[nodiscard]] std::vector<double> forms_at_limits(const FactorSet& set,
                                                  const Eigen::MatrixXd& gains);

}  // namespace frustum::studies
