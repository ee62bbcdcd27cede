#include "programs/milling/point_milling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::programs {
namespace {

// The least of both principal curvatures, above 0 where the surface bulges along its normal.
double most_hollow(const SplinePoint& p) {
  const Vec3 n = p.normal();
  const double e = p.u.squaredNorm(), f = p.u.dot(p.v), g = p.v.squaredNorm();
  const double l = -n.dot(p.uu), m = -n.dot(p.uv), nn = -n.dot(p.vv);
  const double area = e * g - f * f;
  const double mean = 0.5 * (l * g - 2.0 * m * f + nn * e) / area;
  const double gauss = (l * nn - m * m) / area;
  return mean - std::sqrt(std::max(0.0, mean * mean - gauss));
}

}  // namespace

kinematics::ToolPose ball_pose(const SplineSurface& surface, const BallCutter& cutter, double u,
                               double v) {
  const SplinePoint p = surface.at(u, v);
  const Vec3 normal = p.normal();
  const Vec3 axis = std::cos(cutter.lead) * normal + std::sin(cutter.lead) * p.u.normalized();
  return {p.r + cutter.radius * (normal - axis), axis};
}

std::vector<kinematics::ToolPose> ball_pass(const SplineSurface& surface, const BallCutter& cutter,
                                            double v, double run_out, std::size_t blocks) {
  const double first = -run_out / surface.at(0.0, v).u.norm();
  const double last = 1.0 + run_out / surface.at(1.0, v).u.norm();
  std::vector<kinematics::ToolPose> pass;
  for (std::size_t i = 0; i <= blocks; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(blocks);
    pass.push_back(ball_pose(surface, cutter, first + (last - first) * share, v));
  }
  return pass;
}

std::vector<double> ball_passes(const SplineSurface& surface, const BallCutter& cutter,
                                double cusp) {
  // The longest way across, and how unevenly v runs along it.
  constexpr int kSamples = 20;
  double longest = 0.0;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      longest = std::max(longest, surface.at(1.0 * i / kSamples, 1.0 * j / kSamples).v.norm());
    }
  }
  const double step = std::sqrt(8.0 * cutter.radius * cusp);
  const auto gaps = static_cast<std::size_t>(std::max(1.0, std::ceil(longest / step)));
  std::vector<double> passes;
  for (std::size_t i = 0; i <= gaps; ++i) {
    passes.push_back(static_cast<double>(i) / static_cast<double>(gaps));
  }
  return passes;
}

std::optional<Diagnostic> does_not_fit(const SplineSurface& surface, const BallCutter& cutter) {
  constexpr int kSamples = 100;
  double smallest = std::numeric_limits<double>::infinity(), at_u = 0.0, at_v = 0.0;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      const double u = 1.0 * i / kSamples, v = 1.0 * j / kSamples;
      const double curvature = most_hollow(surface.at(u, v));
      if (curvature >= 0.0 || -1.0 / curvature >= smallest) continue;
      smallest = -1.0 / curvature;
      at_u = u;
      at_v = v;
    }
  }
  if (cutter.radius < smallest) return std::nullopt;
  Diagnostic failure = error(
      "cutter-does-not-fit"_id,
      fmt::format("a ball of radius {:g} mm does not fit into the hollow of the surface at u = "
                  "{:.3f}, v = {:.3f}: the largest radius that does is {:.3f} mm",
                  cutter.radius, at_u, at_v, smallest),
      "choose a smaller cutter");
  failure.key = "cutter";
  return failure;
}

}  // namespace frustum::programs
