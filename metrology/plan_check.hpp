// What makes a plan impossible to measure, told to whoever knows the place in a file.
//
// Units  : as inspection_plan.hpp
// Errors : each fault is one call
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "metrology/inspection_plan.hpp"

namespace frustum::metrology {

enum class PlanPart { root, probe, datum, feature, characteristic };

// Which part (and which one of its array, from 0), the key in it, the message, the hint.
using PlanFault =
    std::function<void(PlanPart, std::size_t, std::string_view, std::string, std::string)>;

void check(const InspectionPlan& plan, const PlanFault& fault);

}  // namespace frustum::metrology
