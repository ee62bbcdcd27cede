// Numbers as text: for people by unit, with shares of a tolerance and unit symbols; for files
// exactly.
//
// Units: a characteristic's own unit ("um", "mm", "deg", "urad"); unknown units get six digits.
// Errors: none; a number that is not finite prints as "-".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "metrology/measurement.hpp"

namespace frustum::report {

// A fixed number of decimals, without a negative zero.
[[nodiscard]] std::string fixed_text(double value, int decimals);

// Seconds as people say them: "4.20 s", "12 min 03.4 s", "2 h 05 min".
[[nodiscard]] std::string duration_text(double seconds);

// The decimals that the unit deserves: 3 for um, 4 for mm, 5 for deg, 2 for urad.
[[nodiscard]] std::string value_text(double value, std::string_view unit);

// The value of a characteristic; with its sign, also "+", where it is a deviation of either sign
// (its nominal is 0).
[[nodiscard]] std::string result_text(const metrology::CharacteristicResult& characteristic);
// Its nominal; empty when it has none or is a deviation itself.
[[nodiscard]] std::string nominal_text(const metrology::CharacteristicResult& characteristic);

// Uncertainties get two significant digits.
[[nodiscard]] std::string uncertainty_text(double value);

// "0.000 .. 1.234", the interval of the true value; empty without one.
[[nodiscard]] std::string interval_text(const metrology::CharacteristicResult& characteristic);

// "um" -> "µm", "deg" -> "°", "urad" -> "µrad", "mm3" -> "mm³"; anything else unchanged. UTF-8.
[[nodiscard]] std::string unit_symbol(std::string_view unit);

// Value minus nominal, or the value itself for a characteristic without nominal; in its unit.
[[nodiscard]] double deviation_of(const metrology::CharacteristicResult& characteristic);

// |deviation| / tolerance; nothing when the tolerance is not a positive number.
[[nodiscard]] std::optional<double> used_share(
    const metrology::CharacteristicResult& characteristic);

// The smallest of 1, 2, 5 times a power of ten that is not below `value` (> 0); 1 for anything
// else.
[[nodiscard]] double round_up_125(double value);

// Numbers as files hold them: the shortest digits that read back to the same double, never an
// exponent; "0" for what is not finite.
[[nodiscard]] std::string exact_decimal(double value);

// The same within what every reader of XML takes of an xs:decimal, 18 digits in all: small numbers
// are rounded to 17 decimals.
[[nodiscard]] std::string xml_decimal(double value);

}  // namespace frustum::report
