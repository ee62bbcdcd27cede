#include "metrology/plan/qif/qif_agreement.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/plan/qif/qif_kinds.hpp"

namespace frustum::metrology {
namespace {

// Elements have 17 decimals of mm and deg: what is left is the rounding of doubles at 10 m.
constexpr double kRounding = 1e-9;

bool is_along(const Vec3& a, const Vec3& b) {
  return (a.normalized() - b.normalized()).norm() <= kRounding;
}

std::string_view stem_of(CharacteristicKind kind) {
  const auto* const row = std::ranges::find(kQifKinds, kind, &QifKind::kind);
  return row == kQifKinds.end() ? std::string_view() : row->stem;
}

}  // namespace

const char* disagreement(const PlannedFeature& stated, const PlannedFeature& read) {
  if (stated.kind != read.kind) return "kind";
  const bool has_axis = stated.kind != FeatureKind::sphere;
  if (has_axis && !is_along(stated.axis, read.axis)) return "axis";
  Vec3 away = read.point - stated.point;
  if (stated.kind == FeatureKind::cylinder || stated.kind == FeatureKind::line) {
    const Vec3 axis = stated.axis.normalized();
    away -= away.dot(axis) * axis;
  }
  if (away.norm() > kRounding) return "point";
  if (is_round(stated.kind)) {
    if (std::abs(stated.radius - read.radius) > kRounding) return "radius";
    if (stated.side != read.side) return "side";
  }
  if (stated.kind == FeatureKind::cone && std::abs(stated.half_angle - read.half_angle) > kRounding)
    return "half_angle";
  if (stated.kind == FeatureKind::line && !is_along(stated.normal, read.normal)) return "normal";
  return nullptr;
}

const char* disagreement(const PlannedCharacteristic& stated, const PlannedCharacteristic& read) {
  if (stem_of(stated.kind) != stem_of(read.kind)) return "kind";
  if (std::abs(stated.tolerance - read.tolerance) > kRounding) return "tolerance";
  if (stated.criterion != read.criterion) return "criterion";
  if (stated.direction.norm() > 0.0 && !is_along(stated.direction, read.direction))
    return "direction";
  return nullptr;
}

}  // namespace frustum::metrology
