#include "core/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

namespace frustum {
namespace {

struct Unit {
  std::string_view name;
  UnitKind kind;
  double to_internal;
};

constexpr std::array kUnits{
    Unit{"mm", UnitKind::length, 1.0},
    Unit{"um", UnitKind::length, 1e-3},
    Unit{"\u00b5m", UnitKind::length, 1e-3},  // micro sign
    Unit{"\u03bcm", UnitKind::length, 1e-3},  // Greek mu
    Unit{"nm", UnitKind::length, 1e-6},
    Unit{"m", UnitKind::length, 1e3},
    Unit{"in", UnitKind::length, kMmPerInch},
    Unit{"inch", UnitKind::length, kMmPerInch},
    Unit{"rad", UnitKind::angle, 1.0},
    Unit{"mrad", UnitKind::angle, 1e-3},
    Unit{"urad", UnitKind::angle, 1e-6},
    Unit{"\u00b5rad", UnitKind::angle, 1e-6},
    Unit{"\u03bcrad", UnitKind::angle, 1e-6},
    Unit{"deg", UnitKind::angle, kRadPerDeg},
    Unit{"arcsec", UnitKind::angle, kRadPerDeg / 3600.0},
};

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

Result<ParsedQuantity> parse_quantity(std::string_view text) {
  std::string_view rest = trim(text);
  const bool plus = rest.starts_with('+');
  if (plus) rest.remove_prefix(1);
  double number = 0.0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  // Below the largest double by more than any unit's factor, so that the product is finite too.
  constexpr double kLargest = 1e300;
  if (status != std::errc{} || !(std::abs(number) < kLargest) || (plus && rest.starts_with('-'))) {
    return error("wrong-quantity"_id, fmt::format("'{}' is not a number with a unit", text),
                 "write for example 10 um");
  }
  const std::string_view name = trim(rest.substr(static_cast<std::size_t>(end - rest.data())));
  if (name.empty()) return ParsedQuantity{number, UnitKind::none};
  for (const Unit& unit : kUnits) {
    if (unit.name == name) return ParsedQuantity{number * unit.to_internal, unit.kind};
  }
  return error("unknown-unit"_id, fmt::format("unknown unit '{}' in '{}'", name, text),
               "lengths: mm um nm m in; angles: deg rad mrad urad arcsec");
}

Result<Mm> parse_length(std::string_view text) {
  const auto parsed = parse_quantity(text);
  if (!parsed) return parsed.error();
  if (parsed->kind == UnitKind::length) return Mm{parsed->value};
  return error("wrong-quantity"_id, fmt::format("'{}' is not a length", text),
               "write a length such as 10 um or 0.5 mm");
}

Result<Rad> parse_angle(std::string_view text) {
  const auto parsed = parse_quantity(text);
  if (!parsed) return parsed.error();
  if (parsed->kind == UnitKind::angle) return Rad{parsed->value};
  return error("wrong-quantity"_id, fmt::format("'{}' is not an angle", text),
               "write an angle such as 30 urad or 15 deg");
}

}  // namespace frustum
