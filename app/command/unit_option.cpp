#include "app/command/unit_option.hpp"

#include <fmt/format.h>

#include "app/command/command_line.hpp"

namespace frustum::app {

void add_unit_option(Command& command, std::string& text) {
  command.option("--unit", text, "Of a file that states no other: mm, um, nm, cm, m or inch (mm)");
}

Result<std::optional<metrology::LengthUnit>> unit_of(const std::string& text) {
  if (text.empty()) return std::optional<metrology::LengthUnit>();
  if (auto unit = metrology::length_unit(text)) return unit;
  return error("unknown-unit"_id, fmt::format("--unit {}: not a unit of length", text),
               "mm, um, nm, cm, m or inch");
}

}  // namespace frustum::app
