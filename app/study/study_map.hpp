// Which set-ups of a cone make the errors of a machine visible.
//
// Model    : the cone of each set-up is programmed, commanded and cut anew, so that each has
//            travelled spans of its own. Of the deviations of the first characteristic to first
//            order, x = G w with covariance C of the weights: rms^2 = trace(G C G^T) / points;
//            directions = (sum l)^2 / sum l^2 of its eigenvalues l; an error shows if it alone, at
//            its largest and with its worst phase, makes 1 um of form. Median and q95 of the
//            study's draws
// Units    : um, deg, mm
// Shape    : a row for each cone angle, inclination and centre
// Errors   : cones that cannot be made or reached
// Accuracy : first order
// Source   : ours; Bossoni 2010, section 3.9 for the question
#pragma once

#include "app/study/study_model.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

[[nodiscard]] Result<std::vector<studies::MapRow>> map_of(const StudyFile& study);

}  // namespace frustum::app
