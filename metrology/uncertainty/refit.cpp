#include "metrology/uncertainty/refit.hpp"

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::metrology {
namespace {

constexpr int kMost = 6;  // shift and tilt along u and v, radius, half angle
using Step = Eigen::Matrix<double, kMost, 1>;

// A cylinder is a cone of half angle 0 that keeps it.
struct Round {
  Vec3 point = Vec3::Zero();
  UnitVec3 axis = UnitVec3::z();
  double radius = 1.0;
  double half_angle = 0.0;
};

struct Sums {
  Eigen::Matrix<double, kMost, kMost> squares = Eigen::Matrix<double, kMost, kMost>::Zero();
  Step right = Step::Zero();
};

// Tilts and half angles act over `size` mm, so that all parameters are lengths.
Sums sums_of(const Round& round, const std::vector<Vec3>& points, double size) {
  const auto [u, v] = tangents(round.axis);
  const Vec3 axis = round.axis;
  const double c = std::cos(round.half_angle);
  const double s = std::sin(round.half_angle);
  Sums sums;
  for (const Vec3& point : points) {
    const Vec3 w = point - round.point;
    const double along = w.dot(axis);
    const Vec3 lateral = w - along * axis;
    const double away = lateral.norm();
    const Vec3 e = away > 0.0 ? Vec3(lateral / away) : u;
    const double eu = e.dot(u);
    const double ev = e.dot(v);
    const double slant = (along * c + away * s) / size;
    Step row;
    row << -c * eu, -c * ev, -slant * eu, -slant * ev, -1.0, -slant;
    sums.squares.selfadjointView<Eigen::Lower>().rankUpdate(row);
    sums.right -= (away * c - along * s - round.radius) * row;
  }
  return sums;
}

Round moved(const Round& round, const Step& step, double size) {
  const auto [u, v] = tangents(round.axis);
  Round next = round;
  next.point += step[0] * u + step[1] * v;
  next.axis = unit(round.axis.vec() + (step[2] * u + step[3] * v) / size);
  next.radius += step[4];
  next.half_angle += step[5] / size;
  return next;
}

std::optional<Round> settled(Round round, const std::vector<Vec3>& points, int parameters) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : points) centre += p / static_cast<double>(points.size());
  // Away from the centroid shift and tilt would correlate.
  const double along = (centre - round.point).dot(round.axis.vec());
  round.point += along * round.axis.vec();
  round.radius += along * std::sin(round.half_angle);
  double size = 0.0;
  for (const Vec3& p : points) size = std::max(size, (p - centre).norm());
  double previous = HUGE_VAL;
  for (int i = 0; i < 20; ++i) {
    const Sums sums = sums_of(round, points, size);
    Step step = Step::Zero();
    step.head(parameters) = SymmetricFactors(sums.squares.topLeftCorner(parameters, parameters))
                                .solve(Eigen::VectorXd(sums.right.head(parameters)));
    const double length = step.norm();
    if (!std::isfinite(length) || length > 0.1 * size) return std::nullopt;
    round = moved(round, step, size);
    // Errors shrink by form over radius a step: what is left after a step of 1e-8 of the part is
    // below rounding. A step that no longer shrinks is rounding itself.
    if (length < 1e-8 * size) return round;
    if (length > 0.5 * previous) return std::nullopt;
    previous = length;
  }
  return std::nullopt;
}

std::optional<Element> near(const Element& known, const std::vector<Vec3>& points) {
  if (const auto* cylinder = std::get_if<Cylinder>(&known)) {
    const auto found = settled({cylinder->point, cylinder->axis, cylinder->radius}, points, 5);
    if (!found) return std::nullopt;
    return Cylinder{found->point, found->axis, found->radius};
  }
  if (const auto* cone = std::get_if<Cone>(&known)) {
    const auto found =
        settled({cone->point, cone->axis, cone->radius, cone->half_angle}, points, 6);
    if (!found) return std::nullopt;
    return Cone{found->point, found->axis, found->radius, found->half_angle};
  }
  return std::nullopt;
}

}  // namespace

Result<FittedFeature> refit(const FittedFeature& known, const std::vector<Vec3>& points) {
  std::vector<std::size_t> sections;
  sections.reserve(points.size());
  for (const MeasuredPoint& p : known.points) sections.push_back(p.section);
  const auto element = near(known.element, points);
  if (!element) return fit_feature(*known.planned, points, sections, 0.0);
  Fit<Element> fit;
  fit.element = *element;
  double squares = 0.0;
  for (const Vec3& p : points) {
    fit.residuals.push_back(residual(*element, p));
    squares += fit.residuals.back() * fit.residuals.back();
  }
  const auto [low, high] = std::minmax_element(fit.residuals.begin(), fit.residuals.end());
  fit.form = *high - *low;
  fit.rms = std::sqrt(squares / static_cast<double>(points.size()));
  fit.cofactor = known.cofactor;
  return feature_from(*known.planned, std::move(fit), points, sections, 0.0);
}

}  // namespace frustum::metrology
