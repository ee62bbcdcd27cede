// Of what a characteristic is the value: features, datums, sections; which parameter of a form: the
// symbols of the standards, and in words.
//
// A kind of which no standard has symbols (the form of a cone) gets words. Texts are empty, or
// those of name and kind alone, where the plan states no parameter.
// Units  : none
// Errors : none
// Source : ISO 12180-1 (CYL), ISO 12181-1 (RON), ISO 12780-1 (STR), ISO 12781-1 (FLT)
#pragma once

#include <string>
#include <string_view>

#include "metrology/measurement.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// "RONp"; "highest peak" of a kind without symbols. `parameter` as plans state it: "p".
[[nodiscard]] std::string parameter_symbol(std::string_view kind, std::string_view parameter,
                                           const Wording& words = Wording());
// "RONp, highest peak"
[[nodiscard]] std::string parameter_text(std::string_view kind, std::string_view parameter,
                                         const Wording& words = Wording());

// "roundness RONp"
[[nodiscard]] std::string kind_text(const metrology::CharacteristicResult& characteristic,
                                    const Wording& words = Wording());
// What it is the value of: "cone to cylinder" (toleranced, datum), "bore, section 0", "lid in frame
// top"; empty where nothing is known of it.
[[nodiscard]] std::string subject_text(const metrology::CharacteristicResult& characteristic,
                                       const Wording& words = Wording());
// "bore.roundness RONp", for where the kind is not printed.
[[nodiscard]] std::string name_text(const metrology::CharacteristicResult& characteristic,
                                    const Wording& words = Wording());

}  // namespace frustum::report
