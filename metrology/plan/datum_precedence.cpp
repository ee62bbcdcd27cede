#include "metrology/plan/datum_precedence.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/plan/nominal.hpp"
#include "metrology/plan/plan_check.hpp"

namespace frustum::metrology {
namespace {

// 1e-6 rad and mm: planned in decimals, meant to be exact.
constexpr double kAlong = 1e-6;

bool gives_direction(FeatureKind kind) {
  return kind == FeatureKind::plane || kind == FeatureKind::cylinder || kind == FeatureKind::cone ||
         kind == FeatureKind::line;
}
bool has_datum_axis(FeatureKind kind) {
  return kind == FeatureKind::cylinder || kind == FeatureKind::cone;
}
// Its place is held in two directions or three, so that a line can be drawn from it to another.
bool gives_place(FeatureKind kind) {
  return has_datum_axis(kind) || kind == FeatureKind::circle || kind == FeatureKind::sphere;
}

Vec3 laid_into(const Vec3& v, const Vec3& normal) { return v - v.dot(normal) * normal; }

Vec3 foot(const Element& element, const Vec3& near) {
  const Vec3 axis = *axis_of(element);
  return point_of(element) + (near - point_of(element)).dot(axis) * axis;
}

// Where on its axis a measured cone has the planned radius.
Vec3 planned_section(const PlannedFeature& f, const Cone& cone) {
  const double along =
      (f.radius - cone.section_radius(0.0)) / std::tan(std::max(cone.half_angle, 1e-3));
  return cone.point + along * cone.axis.vec();
}

std::vector<DatumShare> no_shares(const DatumSystem& system) {
  std::vector<DatumShare> shares;
  for (const std::string& name : features_of(system)) shares.push_back({name, {}});
  return shares;
}

}  // namespace

void DegreeNames::take(DatumShare& share, bool rotation, const Vec3& axis) {
  std::size_t best = 6;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t name = k + (rotation ? 3 : 0);
    if (taken_[name]) continue;
    const auto part = [&](std::size_t i) {
      return std::abs(axis[static_cast<Eigen::Index>(i % 3)]);
    };
    if (best == 6 || part(name) > part(best) + 1e-9) best = name;
  }
  if (best == 6) return;
  taken_[best] = true;
  share.degrees.emplace_back(kDegreeNames[best]);
  std::sort(share.degrees.begin(), share.degrees.end(), [](const auto& a, const auto& b) {
    return std::find(kDegreeNames.begin(), kDegreeNames.end(), a) <
           std::find(kDegreeNames.begin(), kDegreeNames.end(), b);
  });
}

std::vector<std::string> DegreeNames::left() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < 6; ++k) {
    if (!taken_[k]) names.emplace_back(kDegreeNames[k]);
  }
  return names;
}

DatumPrecedence::DatumPrecedence(const DatumSystem& system) : shares_(no_shares(system)) {}

void DatumPrecedence::add(const Datum& datum, std::size_t index) {
  datums_.push_back({datum, index});
  const PlannedFeature& planned = *datum.planned;
  if (gives_direction(planned.kind)) {
    turn(index, {unit(planned.axis), axis_of(datum.measured)->vec()});
  }
  if (!gives_place(planned.kind)) return;
  const Pair place = place_of(datum);
  if (first_place_) {
    turn(index, {place.planned - first_place_->planned, place.measured - first_place_->measured});
  } else {
    first_place_ = place;
  }
}

Constraints DatumPrecedence::constraints(const PlannedFeature& planned) const {
  Constraints keep;
  if (!first_) return keep;
  const Vec3 axis = unit(planned.axis);
  if (second_) {
    keep.parallel_to = unit(rotation() * axis);
  } else if (axis.cross(first_->planned).norm() < kAlong) {
    keep.parallel_to = unit(first_->measured);
  } else if (std::abs(axis.dot(first_->planned)) < kAlong) {
    keep.perpendicular_to = unit(first_->measured);
  }
  return keep;
}

FoundDatum DatumPrecedence::found() {
  FoundDatum out;
  Pose& pose = out.workpiece_from_datum;
  pose.rotation = rotation();
  for (const auto& [datum, index] : datums_) hold(datum, index, pose);
  for (const Held& held : held_) pose.translation += held.value * held.direction;
  out.datums = std::move(shares_);
  out.free_degrees = names_.left();
  return out;
}

void DatumPrecedence::turn(std::size_t index, const Pair& direction) {
  const double length = direction.planned.norm();
  if (!first_) {
    if (!(length > kAlong)) return;
    first_ = {direction.planned / length, direction.measured.normalized()};
    // The two axes of the workpiece nearest to the plane across it.
    Eigen::Index most = 0;
    first_->planned.cwiseAbs().maxCoeff(&most);
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (k != most) names_.take(shares_[index], true, Vec3::Unit(k));
    }
    return;
  }
  if (second_) return;
  const Vec3 across = laid_into(direction.planned, first_->planned);
  if (!(length > kAlong) || !(across.norm() > kSlack * length)) return;
  const Vec3 measured = laid_into(direction.measured, first_->measured);
  if (!(measured.norm() > kAlong)) return;
  second_ = {across.normalized(), measured.normalized()};
  names_.take(shares_[index], true, first_->planned);
}

Mat3 DatumPrecedence::rotation() const {
  if (!first_) return Mat3::Identity();
  const auto axes = [](const Vec3& z, const Vec3& x) {
    Mat3 m;
    m << x, z.cross(x), z;
    return m;
  };
  if (second_) {
    return axes(first_->measured, second_->measured) *
           axes(first_->planned, second_->planned).transpose();
  }
  const Vec3 clocking =
      std::abs(first_->planned.y()) > 0.9 ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
  return axes(first_->measured, laid_into(clocking, first_->measured).normalized()) *
         axes(first_->planned, laid_into(clocking, first_->planned).normalized()).transpose();
}

// Planned and measured point that belong together.
DatumPrecedence::Pair DatumPrecedence::place_of(const Datum& datum) const {
  const PlannedFeature& f = *datum.planned;
  Pair place{f.point, point_of(datum.measured)};
  if (!has_datum_axis(f.kind) || !first_) return place;
  const Vec3 planned_axis = unit(f.axis);
  const Vec3 measured_axis = *axis_of(datum.measured);
  const double steep = planned_axis.dot(first_->planned);
  if (std::abs(steep) < kSlack) return place;
  // An axis is held where it pierces the first datum's plane, or the plane across its axis.
  const Datum& first = datums_.front().first;
  const Vec3 planned_reference = first.planned->point;
  const Vec3 reference = has_datum_axis(first.planned->kind)
                             ? foot(first.measured, planned_reference)
                             : point_of(first.measured);
  place.planned += (planned_reference - place.planned).dot(first_->planned) / steep * planned_axis;
  place.measured += (reference - place.measured).dot(first_->measured) /
                    measured_axis.dot(first_->measured) * measured_axis;
  return place;
}

void DatumPrecedence::hold(const Datum& datum, std::size_t index, const Pose& pose) {
  const PlannedFeature& f = *datum.planned;
  const Vec3 axis = unit(f.axis);
  const auto [u, v] = tangents(unit(f.axis));
  const Pair place = place_of(datum);
  switch (f.kind) {
    case FeatureKind::plane:
    case FeatureKind::point:
      hold(index, axis, place, pose);
      return;
    case FeatureKind::line:
      hold(index, laid_into(f.normal, axis).normalized(), place, pose);
      return;
    case FeatureKind::cylinder:
    case FeatureKind::circle:
    case FeatureKind::cone:
      // The direction farthest from what is held already comes first.
      for (const Vec3& across : across_first(axis, u, v)) hold(index, across, place, pose);
      if (f.kind == FeatureKind::cone) {
        hold(index, axis, {f.point, planned_section(f, std::get<Cone>(datum.measured))}, pose);
      }
      return;
    case FeatureKind::sphere:
      for (Eigen::Index k = 0; k < 3; ++k) hold(index, Vec3::Unit(k), place, pose);
      return;
    case FeatureKind::ruled:  // a datum of a best fit alone
      return;
  }
}

std::array<Vec3, 2> DatumPrecedence::across_first(const Vec3& axis, const Vec3& u,
                                                  const Vec3& v) const {
  if (first_) {
    const Vec3 across = axis.cross(first_->planned);
    if (across.norm() > kSlack) {
      const Vec3 level = across.normalized();
      return {level, axis.cross(level)};
    }
  }
  return {u, v};
}

void DatumPrecedence::hold(std::size_t index, const Vec3& direction, const Pair& place,
                           const Pose& pose) {
  const Vec3 row = pose.direction(direction);
  double value = row.dot(place.measured - pose.direction(place.planned));
  Vec3 left = row;
  for (const Held& held : held_) {
    const double part = row.dot(held.direction);
    left -= part * held.direction;
    value -= part * held.value;
  }
  const double length = left.norm();
  if (!(length > kSlack)) return;
  held_.push_back({left / length, value / length});
  names_.take(shares_[index], false, pose.rotation.transpose() * held_.back().direction);
}

std::vector<std::string> features_of(const DatumSystem& system) {
  if (!system.best_fit.empty()) return system.best_fit;
  std::vector<std::string> names;
  for (const std::string& name : {system.primary, system.secondary, system.tertiary}) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

std::vector<DatumShare> planned_shares(const InspectionPlan& plan, const DatumSystem& system) {
  DatumPrecedence precedence(system);
  const std::vector<std::string> names = features_of(system);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PlannedFeature* feature = find_feature(plan, names[i]);
    if (feature != nullptr) precedence.add({feature, nominal_element(*feature)}, i);
  }
  return precedence.found().datums;
}

}  // namespace frustum::metrology
