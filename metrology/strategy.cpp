#include "metrology/strategy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrology/nominal.hpp"

namespace frustum::metrology {
namespace {

// Steps of a full turn do not come back to the first point; those of an arc include both ends.
double angle_of(int index, int count, double start, double sweep) {
  const bool full = std::abs(std::abs(sweep) - 2.0 * std::numbers::pi) < 1e-9;
  const int steps = full || count == 1 ? count : count - 1;
  return start + sweep * index / steps;
}

class PointMaker {
 public:
  explicit PointMaker(const PlannedFeature& feature)
      : feature_(feature),
        axis_(unit(feature.axis)),
        u_(zero_direction(feature)),
        v_(axis_.vec().cross(u_)) {}

  std::vector<PlannedPoint> operator()(const SectionStrategy& s) {
    const double growth = feature_.kind == FeatureKind::cone ? std::tan(feature_.half_angle) : 0.0;
    const double sign = material_sign(feature_);
    for (std::size_t section = 0; section < s.sections.size(); ++section) {
      const double along = s.sections[section];
      if (feature_.kind == FeatureKind::sphere) {
        add_latitude(s, section, sign);
        continue;
      }
      const double radius = feature_.radius + along * growth;
      for (int i = 0; i < s.points_per_section; ++i) {
        const Vec3 e = direction(angle_of(i, s.points_per_section, s.start_angle, s.sweep));
        const Vec3 normal = (e - growth * axis_.vec()).normalized();
        add(feature_.point + along * axis_.vec() + radius * e, sign * normal, section);
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const RingStrategy& s) {
    for (std::size_t ring = 0; ring < s.rings.size(); ++ring) {
      for (int i = 0; i < s.points_per_ring; ++i) {
        const Vec3 e = direction(angle_of(i, s.points_per_ring, s.start_angle, s.sweep));
        add(feature_.point + s.rings[ring] * e, axis_, ring);
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const GridStrategy& s) {
    const auto place = [](int index, int count) {
      return count == 1 ? 0.0 : static_cast<double>(index) / (count - 1) - 0.5;
    };
    for (int row = 0; row < s.rows; ++row) {
      for (int column = 0; column < s.columns; ++column) {
        add(feature_.point + place(column, s.columns) * s.u + place(row, s.rows) * s.v, axis_,
            static_cast<std::size_t>(row));
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const LineStrategy& s) {
    const Vec3 across = feature_.normal - feature_.normal.dot(axis_.vec()) * axis_.vec();
    for (int i = 0; i < s.points; ++i) {
      const double along = s.from + (s.to - s.from) * i / (s.points - 1);
      add(feature_.point + along * axis_.vec(), across.normalized(), 0);
    }
    return std::move(points_);
  }

 private:
  [[nodiscard]] Vec3 direction(double angle) const {
    return std::cos(angle) * u_ + std::sin(angle) * v_;
  }
  void add_latitude(const SectionStrategy& s, std::size_t section, double sign) {
    const double along = s.sections[section];
    const double radius = std::sqrt(feature_.radius * feature_.radius - along * along);
    for (int i = 0; i < s.points_per_section; ++i) {
      const Vec3 e = direction(angle_of(i, s.points_per_section, s.start_angle, s.sweep));
      const Vec3 from_centre = along * axis_.vec() + radius * e;
      add(feature_.point + from_centre, sign * from_centre.normalized(), section);
    }
  }
  void add(const Vec3& point, const Vec3& normal, std::size_t section) {
    points_.push_back({point, normal, section});
  }

  const PlannedFeature& feature_;
  UnitVec3 axis_;
  Vec3 u_;
  Vec3 v_;
  std::vector<PlannedPoint> points_;
};

}  // namespace

std::vector<PlannedPoint> planned_points(const PlannedFeature& feature) {
  return std::visit(PointMaker(feature), feature.strategy);
}

std::size_t section_count(const PlannedFeature& feature) {
  if (const auto* s = std::get_if<SectionStrategy>(&feature.strategy)) return s->sections.size();
  if (const auto* s = std::get_if<RingStrategy>(&feature.strategy)) return s->rings.size();
  if (const auto* s = std::get_if<GridStrategy>(&feature.strategy)) {
    return static_cast<std::size_t>(s->rows);
  }
  return 1;
}

Vec3 zero_direction(const PlannedFeature& feature) {
  const UnitVec3 axis = unit(feature.axis);
  // Within 26 deg (cosine 0.9) of X the projection of X would be short and shaky.
  const Vec3 wanted = feature.zero.value_or(std::abs(axis.vec().x()) > 0.9 ? Vec3(Vec3::UnitY())
                                                                           : Vec3(Vec3::UnitX()));
  return (wanted - wanted.dot(axis.vec()) * axis.vec()).normalized();
}

AxialExtent axial_extent(const PlannedFeature& feature) {
  if (const auto* extent = std::get_if<AxialExtent>(&feature.extent)) return *extent;
  if (const auto* s = std::get_if<SectionStrategy>(&feature.strategy)) {
    const auto [low, high] = std::minmax_element(s->sections.begin(), s->sections.end());
    return {*low, *high};
  }
  if (const auto* s = std::get_if<LineStrategy>(&feature.strategy)) {
    return {std::min(s->from, s->to), std::max(s->from, s->to)};
  }
  return {};
}

std::size_t nearest_section(const PlannedFeature& feature, const Vec3& point) {
  const Vec3 w = point - feature.point;
  const UnitVec3 axis = unit(feature.axis);
  const double along = w.dot(axis.vec());
  const auto nearest = [](const std::vector<double>& places, double place) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      if (std::abs(places[i] - place) < std::abs(places[best] - place)) best = i;
    }
    return best;
  };
  if (const auto* s = std::get_if<SectionStrategy>(&feature.strategy)) {
    return nearest(s->sections, along);
  }
  if (const auto* s = std::get_if<RingStrategy>(&feature.strategy)) {
    return nearest(s->rings, (w - along * axis.vec()).norm());
  }
  if (const auto* s = std::get_if<GridStrategy>(&feature.strategy); s != nullptr && s->rows > 1) {
    const double row = (w.dot(s->v) / s->v.squaredNorm() + 0.5) * (s->rows - 1);
    return static_cast<std::size_t>(std::clamp(std::round(row), 0.0, s->rows - 1.0));
  }
  return 0;
}

}  // namespace frustum::metrology
