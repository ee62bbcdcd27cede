#include "trials/parameter.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace frustum::trials {
namespace {

using kinematics::ErrorEntry;
using kinematics::ErrorName;
using kinematics::ErrorShape;
using kinematics::Machine;

// Whether the name means a small rotation; an unknown one is left to resolve(), which says what is
// wrong.
bool is_angle(const Machine& machine, const std::string& name) {
  const auto alias = machine.aliases().find(name);
  const auto error = alias != machine.aliases().end() ? std::optional(alias->second.error)
                                                      : ErrorName::parse(name);
  return error && is_rotation(error->direction);
}

}  // namespace

Result<Parameter> Parameter::named(const Machine& machine, const std::string& name) {
  if (name == kToolRadius) return Parameter{name, false, std::nullopt};
  const bool angular = is_angle(machine, name);
  ErrorShape one;
  one.amount = {.value = 1.0, .kind = angular ? UnitKind::angle : UnitKind::length};
  const ErrorEntry entry{name, angular ? "1 rad" : "1 mm", {one}};
  auto unit = resolve(machine, std::span(&entry, 1));
  if (!unit) return std::move(unit).error();
  return Parameter{name, angular, *std::move(unit)};
}

Result<std::vector<Parameter>> parameters_named(const Machine& machine,
                                                std::span<const std::string> names) {
  std::vector<Parameter> parameters;
  Diagnostics problems;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    const auto before = names.first(i);
    if (std::find(before.begin(), before.end(), name) != before.end()) {
      problems.push_back(
          error("given-twice"_id, fmt::format("{} is given twice", name), "once is enough"));
    } else if (auto parameter = Parameter::named(machine, name)) {
      parameters.push_back(*std::move(parameter));
    } else {
      problems.insert(problems.end(), parameter.error().begin(), parameter.error().end());
    }
  }
  if (!problems.empty()) return problems;
  return parameters;
}

std::vector<std::string> constant_errors(const Machine& machine) {
  std::vector<std::string> names;
  for (const auto& [alias, meaning] : machine.aliases()) names.push_back(alias);
  names.emplace_back(kToolRadius);
  for (const ErrorName& error : machine.error_names()) {
    if (error.location) names.push_back(error.text());
  }
  return names;
}

}  // namespace frustum::trials
