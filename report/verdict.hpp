// The verdict on a characteristic, in the words of each format.
//
// Units: none. Errors: none; a value that is not finite was not measured.
#pragma once

#include <string_view>

#include "metrology/measurement.hpp"

namespace frustum::report {

// uncertain: the limit is within the uncertainty, where a decision rule makes that difference.
enum class Outcome { pass, fail, uncertain, not_measured };

[[nodiscard]] Outcome outcome_of(const metrology::CharacteristicResult& characteristic);
// "pass", "fail", "uncertain", "not measured".
[[nodiscard]] std::string_view name_of(Outcome outcome);

}  // namespace frustum::report
