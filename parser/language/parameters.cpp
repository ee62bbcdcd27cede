#include "parser/language/parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

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
    if (rules_.is_system(*index)) return unknown_value(fmt::format("#{}", *index));
    if (*index >= rules_.first_stored && *index <= rules_.last_stored) stored_read_ = *index;
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
    // What the machine knows, its global data among it; an error where the path depends on it.
    if (name.starts_with('$') || rules_.names_are_defined) return unknown_value(name);
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
    if (is_symbol(value)) {
      // as it is
    } else if (kind->second == VariableKind::whole) {
      value = std::round(value);
    } else if (kind->second == VariableKind::truth) {
      value = value != 0.0 ? 1.0 : 0.0;
    }
  }
  named(name).insert_or_assign(std::string(name), value);
}

double Parameters::text_value(std::string_view text) const {
  auto found = symbol_numbers_.find(text);
  if (found == symbol_numbers_.end()) {
    found = symbol_numbers_.emplace(text, symbols_.size()).first;
    symbols_.push_back(&found->first);
  }
  return kFirstText + static_cast<double>(found->second);
}

double Parameters::unknown_value(std::string_view name) const {
  return kFirstUnknown + (text_value(name) - kFirstText);
}

const std::string& Parameters::text_of(double symbol) const {
  const double first = is_unknown(symbol) ? kFirstUnknown : kFirstText;
  const auto place = static_cast<std::size_t>(symbol - first);
  // A number so large, which no word can have.
  static const std::string kNumber = "a number beyond 8e15";
  return place < symbols_.size() ? *symbols_[place] : kNumber;
}

std::string Parameters::name_of_element(std::string_view name, std::span<const double> indices) {
  std::string full(name);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    full += i == 0 ? '[' : ',';
    full += shortest_decimal(indices[i]);
  }
  return full + ']';
}

const Parameters::Array* Parameters::array_of(std::string_view name) const {
  const auto found = locals_.back().arrays.find(name);
  return found == locals_.back().arrays.end() ? nullptr : &found->second;
}

void Parameters::define_array(std::string_view name, VariableKind kind,
                              std::vector<std::size_t> dimensions, double value) {
  std::size_t count = 1;
  for (const std::size_t size : dimensions) count *= size;
  locals_.back().arrays.insert_or_assign(
      std::string(name), Array{kind, std::move(dimensions), std::vector<double>(count, value)});
}

bool Parameters::take_array(std::string_view from, std::string_view name,
                            std::span<const std::size_t> sizes) {
  const auto& caller = locals_[locals_.size() - 2].arrays;
  const auto found = caller.find(from);
  if (found == caller.end() || found->second.dimensions.size() != sizes.size()) return false;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] != 0 && sizes[i] != found->second.dimensions[i]) return false;
  }
  locals_.back().arrays.insert_or_assign(std::string(name), found->second);
  return true;
}

void Parameters::give_array_back(std::string_view name, std::string_view to) {
  const auto found = locals_.back().arrays.find(name);
  if (found == locals_.back().arrays.end()) return;
  locals_[locals_.size() - 2].arrays.insert_or_assign(std::string(to), found->second);
}

std::size_t Parameters::size_of(std::string_view name) const {
  const Array* array = array_of(name);
  return array == nullptr ? 0 : array->values.size();
}

Result<std::size_t> Parameters::place_in(std::string_view name,
                                         std::span<const double> indices) const {
  const Array* array = array_of(name);
  if (array == nullptr) {
    return error("unknown-parameter"_id, fmt::format("{}[] is not defined", name),
                 fmt::format("define it before: DEF REAL {}[10]", name));
  }
  if (indices.size() != array->dimensions.size()) {
    return error("array-index"_id, fmt::format("{} has {} indices", name, array->dimensions.size()),
                 "give as many as in its definition");
  }
  std::size_t place = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const double nearest = std::round(indices[i]);
    if (!(nearest >= 0.0 && nearest < static_cast<double>(array->dimensions[i]))) {
      return error("array-index"_id,
                   fmt::format("{} has no element {}", name, shortest_decimal(nearest)),
                   fmt::format("its elements are 0 to {}", array->dimensions[i] - 1));
    }
    place = place * array->dimensions[i] + static_cast<std::size_t>(nearest);
  }
  return place;
}

Result<double> Parameters::read_element(std::string_view name,
                                        std::span<const double> indices) const {
  if (name.starts_with('$')) return read(name_of_element(name, indices));
  if (array_of(name) == nullptr) return unknown_value(name_of_element(name, indices));
  const auto place = place_in(name, indices);
  if (!place) return place.error();
  return array_of(name)->values[*place];
}

bool Parameters::set_element(std::string_view name, std::size_t place, double value) {
  const auto found = locals_.back().arrays.find(name);
  if (found == locals_.back().arrays.end() || place >= found->second.values.size()) return false;
  if (found->second.kind == VariableKind::whole && !is_symbol(value)) value = std::round(value);
  found->second.values[place] = value;
  return true;
}

void Parameters::define(std::string_view name, VariableKind kind, double value) {
  locals_.back().kinds.insert_or_assign(std::string(name), kind);
  set(name, value);
}

bool Parameters::can_set(std::string_view name) const {
  if (!rules_.names_are_defined) return true;
  if (const auto number = number_in(name)) return index_of(*number, rules_).has_value();
  return name.starts_with('$') || named(name).contains(name);
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
