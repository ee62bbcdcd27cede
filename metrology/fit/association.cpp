#include "metrology/fit/association.hpp"

#include <algorithm>

#include "metrology/fit/minimax/extreme_association.hpp"

namespace frustum::metrology {

std::string_view name_of(Criterion criterion) {
  return kCriterionNames.at(static_cast<std::size_t>(criterion));
}

std::optional<Criterion> criterion_named(std::string_view name) {
  const auto* const found = std::find(kCriterionNames.begin(), kCriterionNames.end(), name);
  if (found == kCriterionNames.end()) return std::nullopt;
  return static_cast<Criterion>(found - kCriterionNames.begin());
}

Result<Association> associate(ElementKind kind, std::span<const Vec3> points,
                              const AssociationOptions& options) {
  return associate(name_of(kind), points, options);
}

Result<Association> associate(std::string_view name, std::span<const Vec3> points,
                              const AssociationOptions& options) {
  if (options.criterion != Criterion::least_squares) {
    return extreme_association(name, points, options);
  }
  auto fit = fit_element(name, points, {options.constraints, options.weights});
  if (!fit) return std::move(fit).error();
  return Association{std::move(*fit), options.criterion, std::nullopt};
}

}  // namespace frustum::metrology
