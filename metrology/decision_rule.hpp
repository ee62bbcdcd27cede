// Whether a characteristic conforms, with the uncertainty of its measurement or without.
//
// Model    : simple: pass when |value - nominal| is within the tolerance, whatever U is. iso14253,
//            by value +- U, which every receiver of a result sees: pass when value + U is within
//            the tolerance, and value - U of a value with two limits; fail when all of value +- U
//            is outside, else uncertain. An ideal machine has U = 0; where the coverage of U is not
//            proven, or no accuracy of a real machine is stated, it is uncertain
// Units    : those of the characteristic
// Shape    : one characteristic or all of a measurement
// Errors   : read_decision notes a rule that there is not
// Accuracy : exact
// Source   : ISO 14253-1 (pass within the tolerance less U, fail beyond the tolerance plus U)
#pragma once

#include <array>
#include <string_view>

#include "core/toml_document.hpp"
#include "metrology/measurement.hpp"

namespace frustum::metrology {

enum class DecisionRule { simple, iso14253 };
inline constexpr std::array<std::string_view, 2> kDecisionNames{"simple", "iso14253"};

// decision = "simple" | "iso14253" of a plan or of a job's [inspection]; simple when absent.
// Mistakes are noted in the table's document.
[[nodiscard]] DecisionRule read_decision(const TomlTable& table);

[[nodiscard]] Verdict verdict_of(const CharacteristicResult& characteristic, DecisionRule rule);
// Sets `pass` and `uncertain` of all.
void decide(Measurement& measurement, DecisionRule rule);

}  // namespace frustum::metrology
