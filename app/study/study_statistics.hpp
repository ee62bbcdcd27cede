// From the samples of a study to its result.
//
// Model    : studies/statistics/ and studies/answers/. A draw that
//            failed makes no part, so that it counts as one that does not conform
// Units    : um, urad
// Shape    : one result a characteristic, in the order of the plan
// Errors   : samples that are missing; a scheme with too few dimensions; risks without a
//            measuring uncertainty; groups that are unknown
// Accuracy : the same bits for any number of threads
// Source   : ours
#pragma once

#include <optional>
#include <vector>

#include "app/study/engine_choice.hpp"
#include "app/study/sample_columns.hpp"
#include "app/study/study_model.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

// What a stop rule has found.
struct StopState {
  std::optional<double> half_width{};
  bool reached = false;
};
[[nodiscard]] std::vector<StopState> stop_states(const StudyFile& study,
                                                 const studies::Scheme& scheme,
                                                 const SampleColumns& samples);

// Before any draw is made: the scheme can draw so much, and what is asked for can be answered.
[[nodiscard]] Diagnostics unanswerable(const StudyFile& study, const StudyModel& model);

[[nodiscard]] Result<studies::StudyResult> result_of(const StudyFile& study,
                                                     const StudyModel& model,
                                                     const ChosenEngine& engine,
                                                     const SampleColumns& samples,
                                                     std::uint64_t count);

}  // namespace frustum::app
