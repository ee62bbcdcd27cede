#include "app/study/study_characteristic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/spelling.hpp"
#include "core/units.hpp"

namespace frustum::app {
namespace {

// "q50", "q2.5", "median", "q1", "mean".
struct Statistic {
  bool known = false;
  std::optional<double> quantile{};
};

Statistic statistic_named(std::string_view text) {
  if (text == "mean") return {true, std::nullopt};
  if (text == "median") return {true, 0.5};
  if (!text.starts_with('q')) return {};
  double percent = 0.0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + 1, end, percent);
  if (read.ec != std::errc{} || read.ptr != end || !(percent > 0.0) || !(percent < 100.0)) {
    return {};
  }
  return {true, percent / 100.0};
}

}  // namespace

bool StudyCharacteristic::conforms(double value) const {
  return !limit || (both_sides ? std::abs(value) : value) <= *limit;
}

std::vector<StudyCharacteristic> characteristics_of(const metrology::InspectionPlan& plan) {
  std::vector<StudyCharacteristic> all;
  for (const metrology::PlannedCharacteristic& planned : plan.characteristics) {
    const bool angular = metrology::is_angle(planned.kind);
    all.push_back({.name = planned.name,
                   .angular = angular,
                   .both_sides = metrology::has_derivative(planned.kind),
                   .limit = planned.tolerance * (angular ? kUradPerRad : kUmPerMm)});
  }
  return all;
}

std::vector<std::string> names_of(std::span<const StudyCharacteristic> known) {
  std::vector<std::string> names;
  for (const StudyCharacteristic& c : known) names.push_back(c.name);
  return names;
}

std::optional<std::size_t> place_of(std::span<const StudyCharacteristic> known,
                                    std::string_view name) {
  const auto found = std::ranges::find(known, name, &StudyCharacteristic::name);
  if (found == known.end()) return std::nullopt;
  return static_cast<std::size_t>(found - known.begin());
}

Diagnostic unknown_characteristic(std::string_view name,
                                  std::span<const StudyCharacteristic> known) {
  return error("unknown-characteristic"_id, fmt::format("there is no characteristic '{}'", name),
               suggestion(name, names_of(known)));
}

Result<double> parse_limit(std::string_view text, const StudyCharacteristic& of) {
  const auto quantity = parse_quantity(text);
  if (!quantity) return quantity.error();
  const UnitKind wanted = of.angular ? UnitKind::angle : UnitKind::length;
  if (quantity->kind != wanted) {
    return error(quantity->kind == UnitKind::none ? "no-unit"_id : "wrong-unit"_id,
                 fmt::format("'{}' is {}, {} is in {}", text,
                             quantity->kind == UnitKind::none     ? "without a unit"
                             : quantity->kind == UnitKind::length ? "a length"
                                                                  : "an angle",
                             of.name, of.unit()),
                 of.angular ? "write for example \"60 urad\"" : "write for example \"10 um\"");
  }
  if (!(quantity->value > 0.0) || !std::isfinite(quantity->value)) {
    return error("out-of-range"_id, fmt::format("'{}' must be above 0", text));
  }
  return quantity->value * (of.angular ? kUradPerRad : kUmPerMm);
}

Result<StopRule> parse_stop_rule(std::string_view statistic, std::string_view width,
                                 std::span<const StudyCharacteristic> known) {
  const std::size_t space = statistic.rfind(' ');
  const std::string_view name = statistic.substr(0, space);
  const std::string_view word =
      space == std::string_view::npos ? std::string_view{} : statistic.substr(space + 1);
  const auto at = place_of(known, name);
  if (!at) return unknown_characteristic(name, known);
  const Statistic what = statistic_named(word);
  if (!what.known) {
    return error(
        "unknown-statistic"_id, fmt::format("'{}' names no statistic of {}", statistic, name),
        fmt::format("write \"{0} mean\", \"{0} median\" or a percentile, \"{0} q95\"", name));
  }
  const auto half = parse_limit(width, known[*at]);
  if (!half) return half.error();
  return StopRule{std::string(statistic), *at, what.quantile, *half};
}

}  // namespace frustum::app
