// Whether a characteristic conforms, with the uncertainty of its measurement or without.
//
// Model    : simple: pass when |value - nominal| is within the tolerance. iso14253: pass when the
//            whole interval of the true value is, fail when nothing of it is, else uncertain. Where
//            no accuracy is stated the interval is the value; where its coverage is not proven it
//            is uncertain
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
