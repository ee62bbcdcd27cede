// Which engine makes the samples of a study, and how far it may be off.
//
// Model    : studies/engine/engine_controls.hpp: the first 59 draws by both engines, and again with
//            all errors doubled. The choice does not depend on how many samples there are, so that
//            a study may grow
// Units    : um, urad
// Shape    : one bound a characteristic
// Errors   : a linear engine that is asked for and refused, with the reason
// Accuracy : statistical
// Source   : ours
#pragma once

#include <functional>
#include <vector>

#include "app/study/sampler.hpp"
#include "studies/answers/study_result.hpp"

namespace frustum::app {

struct ChosenEngine {
  studies::EngineKind kind = studies::EngineKind::full;
  studies::EngineResult result{};  // without the bound
  double largest_of_controls = 0.0;
  std::vector<studies::EngineControls> controls{};  // by characteristic; empty: full

  // Bounds by characteristic, for draws whose points move so far at most.
  [[nodiscard]] std::vector<double> bounds(double largest_of_draws) const;
};

// `progress`: shares of the work.
[[nodiscard]] Result<ChosenEngine> choose_engine(const StudyFile& study, const StudyModel& model,
                                                 const std::function<void(double)>& progress);

}  // namespace frustum::app
