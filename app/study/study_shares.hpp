// Shares of errors in the scatter of a characteristic, and the allocation of their tolerances.
//
// Model    : studies/answers/shares.hpp and allocation.hpp beside it. Indices by the linear engine
//            where it stands, else by whole trials of fewer draws
// Units    : um, urad
// Shape    : a result for the characteristic that is asked for
// Errors   : groups whose patterns match nothing, or that share an error; characteristics that are
//            not linear in their parts, or have no limit to allocate for; each at its line
// Accuracy : standard errors are given
// Source   : ours
#pragma once

#include "app/study/study_model.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

// Why shares and allocation cannot be found as they are asked for; before any draw is made.
[[nodiscard]] Diagnostics unanswerable_shares(const StudyFile& study, const StudyModel& model);
// Fills shares and allocation, as far as they are asked for and can be found.
void add_shares(const StudyFile& study, const StudyModel& model, studies::StudyResult& result);

}  // namespace frustum::app
