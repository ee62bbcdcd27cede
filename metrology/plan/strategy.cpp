#include "metrology/plan/strategy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/spline_surface.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

bool is_full_turn(double sweep) {
  return std::abs(std::abs(sweep) - 2.0 * std::numbers::pi) < 1e-9;
}

// Steps of a full turn do not come back to the first point; those of an arc include both ends.
double angle_of(int index, int count, double start, double sweep) {
  const int steps = is_full_turn(sweep) || count == 1 ? count : count - 1;
  return start + sweep * index / steps;
}

// So many points that the largest distance along a run of `length` is `pitch`; a closed run does
// not repeat its first point. `least`: what fits need.
int points_for(double length, double pitch, bool closed, int least) {
  // A length that is a multiple of the pitch but for rounding takes no further point.
  const double steps = std::ceil(length / pitch * (1.0 - 1e-12));
  return std::max(static_cast<int>(steps) + (closed ? 0 : 1), least);
}

class PointMaker {
 public:
  explicit PointMaker(const PlannedFeature& feature)
      : feature_(feature),
        axis_(unit(feature.axis)),
        u_(zero_direction(feature)),
        v_(axis_.vec().cross(u_)) {}

  std::vector<PlannedPoint> operator()(const SectionStrategy& s) {
    scanned_ = s.scan;
    for (std::size_t section = 0; section < s.sections.size(); ++section) {
      const double along = s.sections[section];
      const int count =
          on_circle(s.points_per_section, s.pitch, section_radius(feature_, along), s.sweep);
      for (int i = 0; i < count; ++i) {
        add_round(along, angle_of(i, count, s.start_angle, s.sweep), section);
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const GeneratrixStrategy& s) {
    scanned_ = s.scan;
    const int count = on_line(s.points, s.pitch, std::abs(s.to - s.from));
    for (int line = 0; line < s.generatrices; ++line) {
      const double angle = angle_of(line, s.generatrices, s.start_angle, s.sweep);
      for (int i = 0; i < count; ++i) {
        add_round(s.from + (s.to - s.from) * i / (count - 1), angle,
                  static_cast<std::size_t>(line));
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const SpiralStrategy& s) {
    scanned_ = s.scan;
    const int count = on_line(s.points, s.pitch, spiral_length(feature_, s), 8);
    for (int i = 0; i < count; ++i) {
      const double share = static_cast<double>(i) / (count - 1);
      add_round(s.from + (s.to - s.from) * share,
                s.start_angle + 2.0 * std::numbers::pi * s.turns * share, 0);
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const SphereStrategy& s) {
    for (std::size_t circle = 0; circle < s.points.size(); ++circle) {
      const auto share = static_cast<double>(circle) / static_cast<double>(s.points.size() - 1);
      const double polar = s.polar_from + (s.polar_to - s.polar_from) * share;
      const double start = s.start_angle + static_cast<double>(circle) * s.twist;
      for (int i = 0; i < s.points[circle]; ++i) {
        const Vec3 e = direction(angle_of(i, s.points[circle], start, 2.0 * std::numbers::pi));
        const Vec3 out = std::cos(polar) * axis_.vec() + std::sin(polar) * e;
        add(feature_.point + feature_.radius * out, material_sign(feature_) * out, circle);
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const RingStrategy& s) {
    scanned_ = s.scan;
    for (std::size_t ring = 0; ring < s.rings.size(); ++ring) {
      const int count = on_circle(s.points_per_ring, s.pitch, s.rings[ring], s.sweep);
      for (int i = 0; i < count; ++i) {
        const Vec3 e = direction(angle_of(i, count, s.start_angle, s.sweep));
        add(feature_.point + s.rings[ring] * e, axis_, ring);
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const GridStrategy& s) {
    scanned_ = s.scan;
    const auto place = [](int index, int count) {
      return count == 1 ? 0.0 : static_cast<double>(index) / (count - 1) - 0.5;
    };
    const int columns = on_line(s.columns, s.pitch, s.u.norm());
    for (int row = 0; row < s.rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        add(feature_.point + place(column, columns) * s.u + place(row, s.rows) * s.v, axis_,
            static_cast<std::size_t>(row));
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const SurfaceLineStrategy& s) {
    scanned_ = s.scan;
    for (std::size_t line = 0; line < s.heights.size(); ++line) {
      for (int i = 0; i < s.points; ++i) {
        const double u = s.from + (s.to - s.from) * i / (s.points - 1);
        const SplinePoint p = feature_.net.surface->at(u, s.heights[line]);
        add(p.r, p.normal(), line);
      }
    }
    return std::move(points_);
  }
  std::vector<PlannedPoint> operator()(const LineStrategy& s) {
    scanned_ = s.scan;
    const Vec3 across = feature_.normal - feature_.normal.dot(axis_.vec()) * axis_.vec();
    const int count = on_line(s.points, s.pitch, std::abs(s.to - s.from));
    for (int i = 0; i < count; ++i) {
      const double along = s.from + (s.to - s.from) * i / (count - 1);
      add(feature_.point + along * axis_.vec(), across.normalized(), 0);
    }
    return std::move(points_);
  }

 private:
  [[nodiscard]] Vec3 direction(double angle) const {
    return std::cos(angle) * u_ + std::sin(angle) * v_;
  }
  static int on_circle(int points, double pitch, double radius, double sweep) {
    if (!(pitch > 0.0)) return points;
    return points_for(std::abs(sweep) * radius, pitch, is_full_turn(sweep), 3);
  }
  static int on_line(int points, double pitch, double length, int least = 2) {
    return pitch > 0.0 ? points_for(length, pitch, false, least) : points;
  }
  // A point of a cylinder, cone, circle or sphere.
  void add_round(double along, double angle, std::size_t section) {
    if (feature_.kind == FeatureKind::sphere) {
      const Vec3 out = along * axis_.vec() + section_radius(feature_, along) * direction(angle);
      add(feature_.point + out, material_sign(feature_) * out.normalized(), section);
      return;
    }
    const double growth = feature_.kind == FeatureKind::cone ? std::tan(feature_.half_angle) : 0.0;
    const Vec3 e = direction(angle);
    const Vec3 normal = (e - growth * axis_.vec()).normalized();
    add(feature_.point + along * axis_.vec() + section_radius(feature_, along) * e,
        material_sign(feature_) * normal, section);
  }
  void add(const Vec3& point, const Vec3& normal, std::size_t section) {
    points_.push_back({point, normal, section, scanned_});
  }

  const PlannedFeature& feature_;
  UnitVec3 axis_;
  Vec3 u_;
  Vec3 v_;
  bool scanned_ = false;
  std::vector<PlannedPoint> points_;
};

// The generatrix whose angle is nearest, counted round the turn.
std::size_t nearest_direction(const GeneratrixStrategy& s, double angle) {
  std::size_t best = 0;
  double closest = HUGE_VAL;
  for (int i = 0; i < s.generatrices; ++i) {
    const double away = angle - angle_of(i, s.generatrices, s.start_angle, s.sweep);
    const double distance = std::abs(std::remainder(away, 2.0 * std::numbers::pi));
    if (distance < closest) {
      closest = distance;
      best = static_cast<std::size_t>(i);
    }
  }
  return best;
}

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
  if (const auto* s = std::get_if<GeneratrixStrategy>(&feature.strategy)) {
    return static_cast<std::size_t>(s->generatrices);
  }
  if (const auto* s = std::get_if<SphereStrategy>(&feature.strategy)) return s->points.size();
  if (const auto* s = std::get_if<SurfaceLineStrategy>(&feature.strategy)) {
    return s->heights.size();
  }
  return 1;
}

double section_radius(const PlannedFeature& feature, double along) {
  if (feature.kind == FeatureKind::cone) {
    return feature.radius + along * std::tan(feature.half_angle);
  }
  if (feature.kind == FeatureKind::sphere) {
    return std::sqrt(std::max(feature.radius * feature.radius - along * along, 0.0));
  }
  return feature.radius;
}

double spiral_length(const PlannedFeature& feature, const SpiralStrategy& s) {
  const double radius = std::max(section_radius(feature, s.from), section_radius(feature, s.to));
  return std::hypot(2.0 * std::numbers::pi * s.turns * radius, s.to - s.from);
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
  if (const auto* s = std::get_if<GeneratrixStrategy>(&feature.strategy)) {
    return {std::min(s->from, s->to), std::max(s->from, s->to)};
  }
  if (const auto* s = std::get_if<SpiralStrategy>(&feature.strategy)) {
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
  if (const auto* s = std::get_if<SurfaceLineStrategy>(&feature.strategy)) {
    return nearest(s->heights, feature.net.surface->nearest(point).v);
  }
  if (const auto* s = std::get_if<RingStrategy>(&feature.strategy)) {
    return nearest(s->rings, (w - along * axis.vec()).norm());
  }
  if (const auto* s = std::get_if<GridStrategy>(&feature.strategy); s != nullptr && s->rows > 1) {
    const double row = (w.dot(s->v) / s->v.squaredNorm() + 0.5) * (s->rows - 1);
    return static_cast<std::size_t>(std::clamp(std::round(row), 0.0, s->rows - 1.0));
  }
  if (const auto* s = std::get_if<GeneratrixStrategy>(&feature.strategy)) {
    const Vec3 u = zero_direction(feature);
    return nearest_direction(*s, std::atan2(w.dot(axis.vec().cross(u)), w.dot(u)));
  }
  if (const auto* s = std::get_if<SphereStrategy>(&feature.strategy)) {
    const double polar = std::atan2((w - along * axis.vec()).norm(), along);
    const double circle = (polar - s->polar_from) / (s->polar_to - s->polar_from) *
                          static_cast<double>(s->points.size() - 1);
    return static_cast<std::size_t>(
        std::clamp(std::round(circle), 0.0, static_cast<double>(s->points.size() - 1)));
  }
  return 0;
}

}  // namespace frustum::metrology
