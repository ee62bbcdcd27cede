#include "metrology/fit/minimax/minimax_surface.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::metrology {
namespace {

using namespace surface_parameter;
using Row = Eigen::Matrix<double, 1, kSurfaceParameters>;

// What all points have in common.
struct Axis {
  explicit Axis(const SurfaceParameters& at)
      : point(at.head<3>()),
        length(std::sqrt(1.0 + at[kTiltX] * at[kTiltX] + at[kTiltY] * at[kTiltY])),
        direction(Vec3(at[kTiltX], at[kTiltY], 1.0) / length) {}
  Vec3 point;
  double length;
  Vec3 direction;
};

// A point in the half plane through the axis, with its slopes.
struct Place {
  Place(const Axis& axis, const Vec3& x) {
    const Vec3 w = x - axis.point;
    along = w.dot(axis.direction);
    lateral = w - along * axis.direction;
    away = lateral.norm();
  }
  double along = 0.0;
  double away = 0.0;
  Vec3 lateral = Vec3::Zero();

  [[nodiscard]] Row along_row(const Axis& axis) const {
    Row row = Row::Zero();
    row.head<3>() = -axis.direction.transpose();
    row.segment<2>(kTiltX) = lateral.head<2>().transpose() / axis.length;
    return row;
  }
  [[nodiscard]] Row away_row(const Axis& axis) const {
    Row row = Row::Zero();
    if (!(away > 0.0)) return row;
    row.head<3>() = -lateral.transpose() / away;
    row.segment<2>(kTiltX) = -along / (away * axis.length) * lateral.head<2>().transpose();
    return row;
  }
};

double from(Surface surface, const Axis& axis, const SurfaceParameters& at, double cosine,
            double sine, const Vec3& x) {
  switch (surface) {
    case Surface::plane:
      return (x - axis.point).dot(axis.direction) - at[kRadius];
    case Surface::sphere:
      return (x - axis.point).norm() - at[kRadius];
    case Surface::straight: {
      const Place place(axis, x);
      return place.away * cosine - place.along * sine - at[kRadius];
    }
    case Surface::ring:
      break;
  }
  const Place place(axis, x);
  return std::hypot(place.away - at[kShape], place.along) - at[kRadius];
}

Row row_of(Surface surface, const Axis& axis, const SurfaceParameters& at, double cosine,
           double sine, const Vec3& x) {
  Row row = Row::Zero();
  const Place place(axis, x);
  switch (surface) {
    case Surface::plane:
      row = place.along_row(axis);
      break;
    case Surface::sphere: {
      const Vec3 w = x - axis.point;
      const double length = w.norm();
      if (length > 0.0) row.head<3>() = -w.transpose() / length;
      break;
    }
    case Surface::straight:
      row = cosine * place.away_row(axis) - sine * place.along_row(axis);
      row[kShape] = -sine * place.away - cosine * place.along;
      break;
    case Surface::ring: {
      const double outward = place.away - at[kShape];
      const double length = std::hypot(outward, place.along);
      if (length > 0.0) {
        row = (outward * place.away_row(axis) + place.along * place.along_row(axis)) / length;
        row[kShape] = -outward / length;
      }
      break;
    }
  }
  row[kRadius] = -1.0;
  return row;
}

Row slope(Surface surface, const SurfaceParameters& at, const Vec3& x) {
  return row_of(surface, Axis(at), at, std::cos(at[kShape]), std::sin(at[kShape]), x);
}

double bend_radius(Surface surface, const SurfaceParameters& at, const Vec3& x) {
  const Axis axis(at);
  const Place place(axis, x);
  switch (surface) {
    case Surface::plane:
      return 1.0;
    case Surface::sphere:
      return (x - axis.point).norm();
    case Surface::straight:
      return place.away;
    case Surface::ring:
      break;
  }
  return std::min(place.away, std::hypot(place.away - at[kShape], place.along));
}

}  // namespace

double distance(Surface surface, const SurfaceParameters& at, const Vec3& point) {
  return from(surface, Axis(at), at, std::cos(at[kShape]), std::sin(at[kShape]), point);
}

Eigen::VectorXd distances(Surface surface, const SurfaceParameters& at,
                          std::span<const Vec3> points) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(points.size()));
  const Axis axis(at);
  const double cosine = std::cos(at[kShape]);
  const double sine = std::sin(at[kShape]);
  for (std::size_t i = 0; i < points.size(); ++i) {
    all[static_cast<Eigen::Index>(i)] = from(surface, axis, at, cosine, sine, points[i]);
  }
  return all;
}

SurfaceSlopes slopes(Surface surface, const SurfaceParameters& at, std::span<const Vec3> points) {
  SurfaceSlopes all(static_cast<Eigen::Index>(points.size()), kSurfaceParameters);
  const Axis axis(at);
  const double cosine = std::cos(at[kShape]);
  const double sine = std::sin(at[kShape]);
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.row(static_cast<Eigen::Index>(i)) = row_of(surface, axis, at, cosine, sine, points[i]);
  }
  return all;
}

SurfaceCurvature curvature(Surface surface, const SurfaceParameters& at, const Vec3& point,
                           const SurfaceSteps& steps) {
  // Central differences of exact slopes: 1e-10, which only sets how fast Newton steps shrink.
  // Slopes turn within the distance from the centre, axis or ring: next to nothing for a line's own
  // points.
  const double reach = 1e-5 * std::min(1.0, bend_radius(surface, at, point));
  SurfaceCurvature second = SurfaceCurvature::Zero(steps.cols(), steps.cols());
  if (!(reach > 0.0)) return second;
  for (Eigen::Index i = 0; i < steps.cols(); ++i) {
    const double share = reach / steps.col(i).norm();
    const SurfaceParameters step = share * steps.col(i);
    const Row change = slope(surface, at + step, point) - slope(surface, at - step, point);
    second.row(i) = (change * steps) / (2.0 * share);
  }
  return 0.5 * (second + second.transpose());
}

Vec3 axis_direction(const SurfaceParameters& at) { return Axis(at).direction; }

}  // namespace frustum::metrology
