// Quantities with their unit in the type, and the units people write.
//
// Inside: mm, rad. People write "10 um", "0.02 mm", "30 urad", "15 deg", "1 in"; a bare number has
// the unit that its key documents. Length + Angle does not compile.
//
// Units: this is where they are defined.
// Errors: parse_quantity names the text and the units it would have accepted.
#pragma once

#include <compare>
#include <numbers>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum {

template <typename Dimension>
struct Quantity {
  double value = 0.0;  // in the dimension's internal unit

  constexpr auto operator<=>(const Quantity&) const = default;
  constexpr Quantity operator+(Quantity other) const { return {value + other.value}; }
  constexpr Quantity operator-(Quantity other) const { return {value - other.value}; }
  constexpr Quantity operator-() const { return {-value}; }
  constexpr Quantity operator*(double factor) const { return {value * factor}; }
  constexpr Quantity operator/(double divisor) const { return {value / divisor}; }
  constexpr double operator/(Quantity other) const { return value / other.value; }
};
template <typename Dimension>
constexpr Quantity<Dimension> operator*(double factor, Quantity<Dimension> quantity) {
  return quantity * factor;
}

using Mm = Quantity<struct LengthDimension>;
using Rad = Quantity<struct AngleDimension>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kUmPerMm = 1e3;
constexpr double kUradPerRad = 1e6;
constexpr double kMmPerInch = 25.4;

constexpr Mm operator""_mm(long double v) { return {static_cast<double>(v)}; }
constexpr Mm operator""_um(long double v) { return {static_cast<double>(v) / kUmPerMm}; }
constexpr Rad operator""_deg(long double v) { return {static_cast<double>(v) * kRadPerDeg}; }
constexpr Rad operator""_urad(long double v) { return {static_cast<double>(v) / kUradPerRad}; }

enum class UnitKind { none, length, angle };

// A number as written, with the kind its unit says; in mm or rad, or as written when unitless.
struct ParsedQuantity {
  double value = 0.0;
  UnitKind kind = UnitKind::none;
};

// "10 um", "10um", "-0.5 mm", "1e-3 in", "30 urad", "2 mrad", "15 deg", "7".
[[nodiscard]] Result<ParsedQuantity> parse_quantity(std::string_view text);

// As above, but the dimension must fit; a bare number is refused: nobody could know its unit.
[[nodiscard]] Result<Mm> parse_length(std::string_view text);
[[nodiscard]] Result<Rad> parse_angle(std::string_view text);

}  // namespace frustum
