#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/fixed_radius.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kCylinderWording{
    "cylinder", "probe at two or more heights and around more of the circumference"};

// A given radius leaves the centre on the side to which the points bend, or on the other when they
// hardly bend.
void add_either_side(std::vector<Element>& starts, const AxisCandidate& c,
                     const Constraints& keep) {
  const double ratio = keep.radius && c.radius > 0.0 ? *keep.radius / c.radius : 1.0;
  const auto add = [&](double factor) {
    const Element free = Cylinder{factor * c.point, unit(c.axis), c.radius};
    starts.push_back(constrained(free, keep));
  };
  add(ratio);
  if (keep.radius) add(-ratio);
}

std::vector<Element> initial_cylinders(const AxialPoints& points) {
  std::vector<Element> starts;
  for (const AxisCandidate& c : points.axes.initial_estimates(RoundKind::cylinder)) {
    add_either_side(starts, c, points.few.constraints);
  }
  return starts;
}

std::vector<Element> searched_cylinder(const AxialPoints& points) {
  const Constraints& keep = points.few.constraints;
  std::vector<Element> starts;
  for (const AxisCandidate& c : points.axes.candidates(RoundKind::cylinder, kAxisCandidates)) {
    add_either_side(starts, c, keep);
    if (!keep.radius || keep.axis) continue;
    for (const Vec3& centre : circle_centres(points.few, unit(c.axis), *keep.radius, 3)) {
      starts.push_back(constrained(Cylinder{centre, unit(c.axis), *keep.radius}, keep));
    }
  }
  return starts;
}

Result<Minimum> solve_cylinder(const NormalisedPoints& local) {
  return axial_minimum(local, kCylinderWording, initial_cylinders, searched_cylinder);
}

Result<Minimum> solve_cylinder_nearby(const NormalisedPoints& local) {
  auto found = nearby_minimum(local, kCylinderWording);
  return found ? Result<Minimum>(*std::move(found)) : solve_cylinder(local);
}

}  // namespace

Result<Fit<Cylinder>> fit_cylinder(std::span<const Vec3> points, const FitOptions& options) {
  return round_fit<Cylinder>(points, options, {ElementKind::cylinder, kCylinderWording.what, 5},
                             solve_cylinder);
}

Result<Fit<Cylinder>> fit_cylinder_nearby(std::span<const Vec3> points, const FitOptions& options) {
  return round_fit<Cylinder>(points, options, {ElementKind::cylinder, kCylinderWording.what, 5},
                             solve_cylinder_nearby);
}

}  // namespace frustum::metrology
