#include "parser/language/parameters.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/decimal.hpp"
#include "parser/language/expression.hpp"

namespace frustum::parser {
namespace {

// The names of RS-274 are kept in lower case; those of other dialects are spelled as they are.
std::string spelling_of(std::string_view name) {
  const bool plain = !name.empty() && name.front() >= 'A' && name.front() <= 'Z';
  return fmt::format(fmt::runtime(plain ? "{}" : "#<{}>"), name);
}

}  // namespace

Result<int> Parameters::index_of(double number, const ParameterRules& rules) {
  if (is_vacant(number)) {
    return error("parameter-number"_id, "the number of the parameter is vacant",
                 "set it on an earlier block");
  }
  // A computed index may be off by rounding; RS-274 forgives 1e-4.
  const double nearest = std::round(number);
  if (std::abs(number - nearest) > 1e-4) {
    return error(
        "parameter-number"_id,
        fmt::format("parameter {}{} is not a whole number", rules.prefix, shortest_decimal(number)),
        rules.prefix == '#' ? "use ROUND, FIX or FUP on the computed number"
                            : "use ROUND or TRUNC on the computed number");
  }
  if (nearest < rules.first || nearest > rules.last) {
    return error(
        "parameter-number"_id,
        fmt::format("parameter {}{} does not exist", rules.prefix, shortest_decimal(nearest)),
        fmt::format("parameters are {0}{1} to {0}{2}", rules.prefix, rules.first, rules.last));
  }
  return static_cast<int>(nearest);
}

Result<double> Parameters::read(double number) const {
  if (rules_.unset_is_vacant && (number == 0.0 || is_vacant(number))) return kVacant;
  auto index = index_of(number, rules_);
  if (!index) return std::move(index).error();
  if (system_ != nullptr) {
    if (const auto kept = system_->number(*index)) {
      if (!is_vacant(*kept) || rules_.values_may_be_unknown) return *kept;
      return error("unknown-parameter"_id,
                   fmt::format("the value of #{} is the setup's and not known here", *index),
                   "set it in the program before it is read");
    }
  }
  const Numbered& all = numbered(*index);
  const auto found = all.find(*index);
  if (found == all.end()) {
    if (rules_.first_system != 0 && *index >= rules_.first_system) {
      return error("unknown-parameter"_id, fmt::format("system variable #{} is not known", *index),
                   "positions are known once they are programmed; leave clocks, signals and "
                   "screens out of the "
                   "simulated program");
    }
    if (rules_.unset_is_zero) return 0.0;
    if (rules_.unset_is_vacant) return kVacant;
    return error("parameter-unset"_id, fmt::format("parameter #{} has no value", *index),
                 fmt::format("set it on an earlier block: #{}=...", *index));
  }
  return found->second;
}

Result<double> Parameters::read(std::string_view name) const {
  if (const auto number = number_in(name)) return read(*number);
  const Named& all = named(name);
  const auto found = all.find(name);
  if (found == all.end() && system_ != nullptr) {
    if (const auto kept = system_->named(name)) return *kept;
  }
  if (found == all.end()) {
    if (rules_.names_are_defined) {
      const bool system = name.starts_with('$');
      return error(system ? "parameter-unset"_id : "unknown-parameter"_id,
                   fmt::format("{} {}", name, system ? "has no value here" : "is not defined"),
                   system ? "it is known once the program has moved the axis in this frame"
                          : "define it before: DEF REAL and its name");
    }
    // Of a pin of the machine, or of its configuration.
    const bool of_machine = name.starts_with("_hal[") || name.starts_with("_ini[");
    if (rules_.values_may_be_unknown && of_machine) return kVacant;
    const std::string spelled = spelling_of(name);
    return error("parameter-unset"_id, fmt::format("parameter {} has no value", spelled),
                 fmt::format("set it on an earlier block: {}=...", spelled));
  }
  return found->second;
}

std::optional<double> Parameters::number_in(std::string_view name) const {
  if (!rules_.names_are_defined || name.size() < 2 || name.front() != rules_.prefix) {
    return std::nullopt;
  }
  double number = 0.0;
  for (const char c : name.substr(1)) {
    if (c < '0' || c > '9') return std::nullopt;
    number = 10.0 * number + (c - '0');
  }
  return number;
}

void Parameters::set(std::string_view name, double value) {
  if (const auto number = number_in(name)) {
    if (const auto index = index_of(*number, rules_)) set(*index, value);
    return;
  }
  if (const auto kind = locals_.back().kinds.find(name); kind != locals_.back().kinds.end()) {
    if (kind->second == VariableKind::whole) value = std::round(value);
    if (kind->second == VariableKind::truth) value = value != 0.0 ? 1.0 : 0.0;
  }
  named(name).insert_or_assign(std::string(name), value);
}

void Parameters::define(std::string_view name, VariableKind kind, double value) {
  locals_.back().kinds.insert_or_assign(std::string(name), kind);
  set(name, value);
}

bool Parameters::can_set(std::string_view name) const {
  if (!rules_.names_are_defined) return true;
  if (const auto number = number_in(name)) return index_of(*number, rules_).has_value();
  return named(name).contains(name);
}

bool Parameters::has(std::string_view name) const {
  return named(name).contains(name) || (system_ != nullptr && system_->named(name));
}

bool Parameters::has(double number) const {
  const auto value = read(number);
  return value && !is_vacant(*value);
}

void Parameters::enter(std::span<const double> arguments) {
  locals_.emplace_back();
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!is_vacant(arguments[i]) || rules_.values_may_be_unknown)
      locals_.back().numbered[static_cast<int>(i) + 1] = arguments[i];
  }
}

void Parameters::leave() { locals_.pop_back(); }

}  // namespace frustum::parser
