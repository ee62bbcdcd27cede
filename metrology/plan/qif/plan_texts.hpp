// What a plan says, key by key, as its file does: for formats that carry keys of plans along.
//
// Units  : as in a plan file
// Errors : none
#pragma once

#include <string>
#include <vector>

#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// `value` is a TOML value on one line; tables are inline tables.
struct PlanKey {
  std::string key{};
  std::string value{};
};
using PlanKeys = std::vector<PlanKey>;

struct PlanTexts {
  PlanKeys root{};  // probe, datum, report and the list of frames are one key each
  std::vector<PlanKeys> features{};
  std::vector<PlanKeys> characteristics{};
};
[[nodiscard]] PlanTexts plan_texts(const InspectionPlan& plan);

}  // namespace frustum::metrology
