// Errors in words, for the report.
#include "kinematics/errors/error_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustum::kinematics {
namespace {

constexpr std::array<std::string_view, 5> kReadings{"uniform", "normal-2sd", "normal-3sd",
                                                    "normal-3sd-cut", "triangular"};

// With as many digits as it takes to read the same value again, at least six.
std::string quantity_text(double value, UnitKind kind) {
  const double shown = kind == UnitKind::length  ? value * kUmPerMm
                       : kind == UnitKind::angle ? value * kUradPerRad
                                                 : value;
  const char* unit = kind == UnitKind::length ? " um" : kind == UnitKind::angle ? " urad" : "";
  std::string text;
  for (const int digits : {6, 15, 16, 17}) {
    text = fmt::format("{:.{}g}{}", shown, digits, unit);
    const auto read = parse_quantity(text);
    if (read && read->value == value) break;
  }
  return text;
}

std::string distribution_text(const Distribution& d) {
  if (d.kind == Distribution::Kind::uniform)
    return "uniform " + quantity_text(d.lo, d.unit) + " .. " + quantity_text(d.hi, d.unit);
  if (d.kind == Distribution::Kind::triangular)
    return "triangular " + quantity_text(d.lo, d.unit) + " .. " + quantity_text(d.hi, d.unit);
  if (d.kind == Distribution::Kind::tolerance) {
    return "nominal " + quantity_text(d.mean, d.unit) + " tolerance " +
           quantity_text(*d.limit, d.unit) +
           (d.reading ? fmt::format(" as {}", name_of(*d.reading)) : "");
  }
  return "normal " + quantity_text(d.mean, d.unit) + " sd " + quantity_text(d.deviation, d.unit) +
         (d.limit ? " limit " + quantity_text(*d.limit, d.unit) : "");
}

std::string amount_text(const Amount& amount) {
  if (amount.drawn.empty()) return quantity_text(amount.value, amount.kind);
  std::string text;
  if (amount.value != 1.0) text = fmt::format("{:.6g} * ", amount.value);
  for (std::size_t i = 0; i < amount.drawn.size(); ++i) {
    const DrawnFactor& factor = amount.drawn[i];
    std::string drawn = factor.name.empty() ? distribution_text(factor.distribution) : factor.name;
    if (factor.shift != 0.0) drawn += " + " + quantity_text(factor.shift, factor.distribution.unit);
    if (i > 0) text += " * ";
    switch (factor.function) {
      case DrawnFactor::Function::itself:
        text += drawn;
        break;
      case DrawnFactor::Function::cosine:
        text += fmt::format("cos({})", drawn);
        break;
      case DrawnFactor::Function::sine:
        text += fmt::format("sin({})", drawn);
        break;
    }
  }
  return text;
}

std::string position_text(double value, UnitKind kind) {
  return kind == UnitKind::angle ? fmt::format("{:g} deg", value * kDegPerRad)
                                 : fmt::format("{:g} mm", value);
}

}  // namespace

std::string_view name_of(ToleranceReading reading) {
  return kReadings.at(static_cast<std::size_t>(reading));
}

std::optional<ToleranceReading> tolerance_reading_named(std::string_view text) {
  const auto found = std::find(kReadings.begin(), kReadings.end(), text);
  if (found == kReadings.end()) return std::nullopt;
  return static_cast<ToleranceReading>(found - kReadings.begin());
}

std::string_view name_of(FieldKernel kernel) {
  return kernel == FieldKernel::gaussian ? "gaussian" : "matern32";
}

Distribution Distribution::read_as(ToleranceReading otherwise) const {
  if (kind != Kind::tolerance) return *this;
  Distribution law{.unit = unit, .mean = mean};
  switch (reading.value_or(otherwise)) {
    case ToleranceReading::normal_2sd:
      law.kind = Kind::normal;
      law.deviation = *limit / 2.0;
      return law;
    case ToleranceReading::normal_3sd_cut:
      law.limit = limit;
      [[fallthrough]];
    case ToleranceReading::normal_3sd:
      law.kind = Kind::normal;
      law.deviation = *limit / 3.0;
      return law;
    case ToleranceReading::triangular:
      law.kind = Kind::triangular;
      break;
    case ToleranceReading::uniform:
      break;
  }
  law.lo = mean - *limit;
  law.hi = mean + *limit;
  return law;
}

std::string written(const ErrorShape& shape) {
  std::string text;
  if (shape.kind != ErrorShape::Kind::constant) text = std::string(name_of(shape.kind)) + " ";
  const UnitKind positions = shape.position_kind;
  switch (shape.kind) {
    case ErrorShape::Kind::table:
      text += fmt::format("of {} points", shape.points.size());
      break;
    case ErrorShape::Kind::surface:
      text += fmt::format("of {} x {} points over {} and {}", shape.surface.first_positions.size(),
                          shape.surface.second_positions.size(), to_char(shape.surface.first),
                          to_char(shape.surface.second));
      break;
    case ErrorShape::Kind::polynomial:
      for (std::size_t i = 0; i < shape.coefficients.size(); ++i) {
        text += (i > 0 ? ", " : "") + amount_text(shape.coefficients[i]);
      }
      break;
    case ErrorShape::Kind::harmonic:
      text += fmt::format("{} {}", shape.order, amount_text(shape.amount));
      break;
    default:
      text += amount_text(shape.amount);
  }
  if (shape.kind == ErrorShape::Kind::cyclic)
    text += " period " + position_text(shape.period, positions);
  if (shape.kind == ErrorShape::Kind::field) {
    text += fmt::format(" correlation {} kernel {}", position_text(shape.correlation, positions),
                        name_of(shape.kernel));
  }
  if (shape.kind == ErrorShape::Kind::tent) {
    text += " at " + (shape.peak.drawn.empty() ? position_text(shape.peak.value, positions)
                                               : amount_text(shape.peak));
  }
  if (!shape.phase.drawn.empty()) text += " phase " + amount_text(shape.phase);
  if (shape.phase.drawn.empty() && shape.phase.value != 0.0)
    text += fmt::format(" phase {:g} deg", shape.phase.value * kDegPerRad);
  if (shape.span) {
    text += fmt::format(" over {} .. {}", position_text(shape.span->lo, positions),
                        position_text(shape.span->hi, positions));
  }
  if (shape.zero) text += " zero " + position_text(*shape.zero, positions);
  if (shape.settle) text += " settle " + position_text(*shape.settle, positions);
  if (shape.factor) text += fmt::format(" times a factor of {}", to_char(shape.factor->axis));
  return text;
}

std::string written(const std::vector<ErrorShape>& terms) {
  std::string text;
  for (const ErrorShape& shape : terms) text += (text.empty() ? "" : " + ") + written(shape);
  return text;
}

}  // namespace frustum::kinematics
