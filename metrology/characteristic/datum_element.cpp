#include "metrology/characteristic/datum_element.hpp"

#include <fmt/format.h>

#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
Result<Association> associated(const FittedFeature& feature, Criterion criterion,
                               const Constraints& constraints) {
  const PlannedFeature& planned = *feature.planned;
  AssociationOptions options;
  options.criterion = criterion;
  options.constraints = constraints;
  if (criterion == Criterion::outside_material) {
    options.is_hole = planned.side == Side::inside;
    if (planned.kind == FeatureKind::plane) options.outward = axis_of(feature.element)->vec();
    if (planned.kind == FeatureKind::line) options.outward = planned.normal;
  }
  auto association = associate(kind_of(feature.element), feature.all_points(), options);
  if (!association) {
    Diagnostics failure = std::move(association).error();
    for (Diagnostic& d : failure) {
      d.message = fmt::format("feature '{}': {}", planned.name, d.message);
    }
    return failure;
  }
  if (const UnitVec3* axis = axis_of(feature.element)) {
    // Residuals of a plane follow its normal.
    const bool turned = axis->vec().dot(axis_of(association->fit.element)->vec()) < 0.0;
    association->fit.element = agreeing(association->fit.element, *axis);
    if (turned && planned.kind == FeatureKind::plane) {
      for (double& r : association->fit.residuals) r = -r;
    }
  }
  return association;
}

Result<Element> datum_element(const FittedFeature& feature, Criterion criterion,
                              const Constraints& constraints) {
  // One touch has nothing to choose, a ball no direction. How a line or a circle runs along its
  // surface is its scan path's.
  const FeatureKind kind = feature.planned->kind;
  const bool is_surface =
      kind == FeatureKind::plane || kind == FeatureKind::cylinder || kind == FeatureKind::cone;
  const bool as_fitted =
      criterion == Criterion::least_squares && !(constraints.any() && is_surface);
  if (as_fitted || kind == FeatureKind::point) return feature.element;
  auto association = associated(feature, criterion, constraints);
  if (!association) return std::move(association).error();
  return association->fit.element;
}

Result<Line> common_axis(std::span<const FittedFeature* const> datums, Criterion criterion) {
  if (datums.size() == 1) {
    const auto element = datum_element(*datums.front(), criterion);
    if (!element) return element.error();
    return Line{point_of(*element), *axis_of(*element)};
  }
  std::vector<Vec3> centres;
  for (const FittedFeature* datum : datums) {
    if (datum->planned->kind == FeatureKind::circle) {
      centres.push_back(point_of(datum->element));
      continue;
    }
    const auto of_datum = median_line(*datum);
    if (!of_datum) return of_datum.error();
    centres.insert(centres.end(), of_datum->centres.begin(), of_datum->centres.end());
  }
  const auto line = fit_line(centres);
  if (!line) return line.error();
  return line->element;
}

}  // namespace frustum::metrology
