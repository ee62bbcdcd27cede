// --unit: the unit of a file that states none.
//
// Units: mm per unit. Errors: a word that names no unit of length.
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "metrology/points/length_unit.hpp"

namespace frustum::app {

class Command;

void add_unit_option(Command& command, std::string& text);

// Nothing when the option was not given.
[[nodiscard]] Result<std::optional<metrology::LengthUnit>> unit_of(const std::string& text);

}  // namespace frustum::app
