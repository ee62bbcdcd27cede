#include "metrology/characteristic/best_shifted_line.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::metrology {

std::vector<PlaceOnLine> shifted(std::span<const MeasuredPoint> points, const LineAxes& axes,
                                 const Vec3& normal, double height) {
  // across per height along the surface
  const double lean = -normal.dot(axes.height) / normal.dot(axes.across);
  std::vector<PlaceOnLine> places;
  places.reserve(points.size());
  for (const MeasuredPoint& p : points) {
    places.push_back({p.point.dot(axes.along),
                      p.point.dot(axes.across) + lean * (height - p.point.dot(axes.height))});
  }
  return places;
}

Result<StraightLine> straight_line(std::span<const PlaceOnLine> places) {
  const auto n = static_cast<double>(places.size());
  PlaceOnLine mean;
  double farthest = 0.0;
  for (const PlaceOnLine& p : places) {
    mean.along += p.along / n;
    mean.across += p.across / n;
    farthest = std::max(farthest, std::abs(p.along));
  }
  double squares = 0.0;
  double products = 0.0;
  for (const PlaceOnLine& p : places) {
    squares += (p.along - mean.along) * (p.along - mean.along);
    products += (p.along - mean.along) * (p.across - mean.across);
  }
  // Coordinates carry 16 digits: a spread of less than 1e-11 of them is rounding.
  if (!(std::sqrt(squares) > 1e-11 * farthest)) {
    return error("degenerate-points"_id, "the points are at one place along the line",
                 "a line needs 2 or more points at different places");
  }
  const double slope = products / squares;
  return StraightLine{mean.across - slope * mean.along, slope};
}

}  // namespace frustum::metrology
