#include "metrology/points/length_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/units.hpp"

namespace frustum::metrology {
namespace {

struct UnitRow {
  std::string_view name;  // as a file writes it, in lower case
  std::string_view unit;  // as we write it
  double mm;
};

constexpr std::array kUnits{
    UnitRow{"mm", "mm", 1.0},
    UnitRow{"millimetre", "mm", 1.0},
    UnitRow{"millimeter", "mm", 1.0},
    UnitRow{"millimetres", "mm", 1.0},
    UnitRow{"millimeters", "mm", 1.0},
    UnitRow{"um", "um", 1e-3},
    UnitRow{"\u00b5m", "um", 1e-3},  // micro sign
    UnitRow{"\u03bcm", "um", 1e-3},  // Greek mu
    UnitRow{"\xb5m", "um", 1e-3},    // micro sign of Windows-1252, which UTF-8 has not
    UnitRow{"micron", "um", 1e-3},
    UnitRow{"microns", "um", 1e-3},
    UnitRow{"micrometre", "um", 1e-3},
    UnitRow{"micrometer", "um", 1e-3},
    UnitRow{"nm", "nm", 1e-6},
    UnitRow{"cm", "cm", 10.0},
    UnitRow{"m", "m", 1e3},
    UnitRow{"metre", "m", 1e3},
    UnitRow{"meter", "m", 1e3},
    UnitRow{"in", "inch", kMmPerInch},
    UnitRow{"inch", "inch", kMmPerInch},
    UnitRow{"inches", "inch", kMmPerInch},
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::string lower(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return copy;
}

// What follows "unit" or "units" and a colon, equals sign or blank: "# unit inch" too. Behind a
// blank only a unit counts, since "# units of the part" says nothing.
std::optional<std::string_view> after_unit_key(std::string_view text) {
  for (const std::string_view key : {"units", "unit"}) {
    if (!text.starts_with(key)) continue;
    const std::string_view behind = text.substr(key.size());
    const std::string_view rest = trimmed(behind);
    if (rest.starts_with(':') || rest.starts_with('=')) return trimmed(rest.substr(1));
    if (behind.size() > rest.size() && length_unit(rest)) return rest;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LengthUnit> length_unit(std::string_view name) {
  const std::string wanted = lower(trimmed(name));
  for (const UnitRow& row : kUnits) {
    if (row.name == wanted) return LengthUnit{std::string(row.unit), row.mm};
  }
  return std::nullopt;
}

Result<std::optional<LengthUnit>> stated_unit(std::string_view comment) {
  const std::string text = lower(trimmed(comment));
  if (const auto word = after_unit_key(text)) {
    if (auto unit = length_unit(*word)) return unit;
    return error("length-unit"_id, fmt::format("'{}' is not a unit of length", *word),
                 "write unit: mm, um, nm, cm, m or inch");
  }
  // "# in" or "# m" may mean anything; nobody writes "# inch" for another reason.
  return text.size() > 1 && text != "in" ? length_unit(text) : std::nullopt;
}

NameWithUnit name_with_unit(std::string_view text) {
  const std::string all = lower(trimmed(text));
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const auto at = all.find(open);
    if (at != std::string::npos && all.back() == close) {
      const auto inside = std::string_view(all).substr(at + 1, all.size() - at - 2);
      std::string unit(trimmed(inside));
      // The sign of inches, twice where it is quoted itself.
      if (unit.empty() && inside.find('"') != std::string_view::npos) unit = "inch";
      return {std::string(trimmed(std::string_view(all).substr(0, at))), std::move(unit)};
    }
  }
  const bool is_coordinate = all.size() > 2 && all[0] >= 'x' && all[0] <= 'z' && all[1] == '_';
  if (is_coordinate && length_unit(all.substr(2))) return {all.substr(0, 1), all.substr(2)};
  return {all, {}};
}

Diagnostic unlike_units(const LengthUnit& stated, const LengthUnit& asked) {
  return error("length-unit"_id,
               fmt::format("the file states the unit {}, --unit says {}", stated.name, asked.name),
               "leave --unit out, or correct the file");
}

std::optional<LengthUnit> likely_unit(double size, double expected) {
  if (!(size > 0.0) || !(expected > 0.0)) return std::nullopt;
  const double ratio = expected / size;  // mm per unit of the file
  for (const char* name : {"inch", "m", "um"}) {
    const auto unit = length_unit(name);
    if (std::abs(std::log(ratio / unit->mm)) < std::log(1.5)) return unit;
  }
  return std::nullopt;
}

}  // namespace frustum::metrology
