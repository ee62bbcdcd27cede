#include "metrology/plan/point_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/name_index.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/points/length_unit.hpp"

namespace frustum::metrology {
namespace {

class Box {
 public:
  void add(const Vec3& point) {
    min_ = min_.cwiseMin(point);
    max_ = max_.cwiseMax(point);
  }
  [[nodiscard]] double diagonal() const {
    return (min_.array() <= max_.array()).all() ? (max_ - min_).norm() : 0.0;
  }

 private:
  Vec3 min_ = Vec3::Constant(HUGE_VAL);
  Vec3 max_ = Vec3::Constant(-HUGE_VAL);
};

void add_planned(const PlannedFeature& feature, Box& box) {
  for (const PlannedPoint& planned : planned_points(feature)) box.add(planned.point);
}

Diagnostic unit_fault(const char* what, double size, double expected, const LengthUnit& unit) {
  return error("point-scale"_id,
               fmt::format("{} span {:.4g} mm where the plan spans {:.4g} mm: the numbers look "
                           "like {}",
                           what, size, expected, unit.name),
               fmt::format("state the unit with --unit {}, or write mm", unit.name));
}

std::optional<Diagnostic> fault_of(const char* what, double size, double expected) {
  if (const auto unit = likely_unit(size, expected)) {
    return unit_fault(what, size, expected, *unit);
  }
  if (const auto unit = likely_unit(expected, size); unit && unit->name == "inch") {
    return error("point-scale"_id,
                 fmt::format("the plan spans {:.4g} mm where {} span {:.4g} mm: its numbers look "
                             "like inches",
                             expected, what, size),
                 "lengths of a plan are in mm");
  }
  return std::nullopt;
}

}  // namespace

std::optional<Diagnostic> scale_fault(const InspectionPlan& plan,
                                      std::span<const FeaturePoints> features) {
  Box planned, measured;
  const NameIndex places(plan.features, &PlannedFeature::name);
  for (const FeaturePoints& points : features) {
    const bool nameless = points.feature.empty() && plan.features.size() == 1;
    const auto place = nameless ? std::size_t{0} : places.find(points.feature);
    if (!place) continue;
    add_planned(plan.features[*place], planned);
    for (const Vec3& point : points.points) measured.add(point);
  }
  return fault_of("the points", measured.diagonal(), planned.diagonal());
}

std::optional<Diagnostic> scale_fault(const InspectionPlan& plan, std::span<const Vec3> body) {
  Box planned, all;
  for (const PlannedFeature& feature : plan.features) add_planned(feature, planned);
  for (const Vec3& point : body) all.add(point);
  const double size = all.diagonal();
  const double expected = planned.diagonal();
  if (auto fault = fault_of("the mesh's corners", size, expected)) return fault;
  // Half of what is probed: no part of these features.
  if (size > 0.5 * expected) return std::nullopt;
  return error(
      "point-scale"_id,
      fmt::format("the mesh spans {:.4g} mm, the points of the plan {:.4g} mm", size, expected),
      "state the unit of the mesh with --unit inch, m, cm or um");
}

}  // namespace frustum::metrology
