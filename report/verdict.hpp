// The verdict on a characteristic, in the words of each format.
//
// Units: none. Errors: none; a value that is not finite was not measured.
#pragma once

#include <string>
#include <string_view>

#include "metrology/measurement.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// uncertain: the limit is within the uncertainty, where a decision rule makes that difference.
enum class Outcome { pass, fail, uncertain, not_measured };

[[nodiscard]] Outcome outcome_of(const metrology::CharacteristicResult& characteristic);
// "pass", "fail", "uncertain", "not measured".
[[nodiscard]] std::string_view name_of(Outcome outcome);

// What is to be said beside U where nothing tells how often value +- U holds the true value: "not
// proven" or "not stated"; empty elsewhere.
[[nodiscard]] std::string_view doubt_of(const metrology::CharacteristicResult& characteristic);

// "6 pass, 1 fails, 1 uncertain": how many characteristics came to what, those that none came to
// left out; empty without characteristics.
[[nodiscard]] std::string counts_text(const metrology::Measurement& measurement,
                                      const Wording& words = Wording());

// Every characteristic states an uncertainty of exactly 0: nothing is known of the machine that
// measured, or it is ideal.
[[nodiscard]] bool has_no_uncertainty(const metrology::Measurement& measurement);
// A real machine measured, or made the mesh that was measured, and nothing is stated of it.
[[nodiscard]] bool is_accuracy_unknown(const metrology::Measurement& measurement);

}  // namespace frustum::report
