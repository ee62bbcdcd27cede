#include "programs/milling/flank_milling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustum::programs {
namespace {

// Heights of the two points that the axis keeps R from.
struct Rails {
  double low, high;
};
Rails rails_of(FlankMethod method) {
  switch (method) {
    case FlankMethod::two_point:
      break;
    case FlankMethod::balanced:
      return {0.5 * (1.0 - std::numbers::sqrt2 / 2.0), 0.5 * (1.0 + std::numbers::sqrt2 / 2.0)};
    case FlankMethod::three_point:
      return {0.5 * (1.0 - std::numbers::sqrt3 / 2.0), 0.5 * (1.0 + std::numbers::sqrt3 / 2.0)};
  }
  return {0.0, 1.0};
}

class FlankAxis {
 public:
  FlankAxis(const SplineSurface& surface, const FlankCutter& cutter, double u)
      : surface_(surface), radius_(cutter.radius), rails_(rails_of(cutter.method)), u_(u) {}

  [[nodiscard]] Vec3 low(double d) const { return beside(u_ - d, rails_.low); }
  [[nodiscard]] Vec3 high(double d) const { return beside(u_ + d, rails_.high); }
  [[nodiscard]] double low_height() const { return rails_.low; }

  // How far the middle is from where it should be.
  [[nodiscard]] double off(double d) const {
    return surface_.nearest(0.5 * (low(d) + high(d))).distance - radius_;
  }

  // By secants, from the shift that a surface of constant curvature and twist would need.
  [[nodiscard]] double shift() const {
    constexpr double kThere = 1e-9;  // mm: where the surface has no twist, nothing tells d better
    double before = first_shift();
    double off_before = off(before);
    if (std::abs(off_before) < kThere) return before;
    constexpr double kAside = 1e-5;  // of u
    double now = before + kAside;
    double off_now = off(now);
    constexpr int kMost = 30;
    constexpr double kStill = 1e-13;  // mm
    double best = before, least = std::abs(off_before);
    for (int i = 0; i < kMost && off_now != off_before; ++i) {
      const double next = now - off_now * (now - before) / (off_now - off_before);
      if (!(std::abs(next) < 0.25)) break;  // the surface has no such place
      before = now;
      off_before = off_now;
      now = next;
      off_now = off(now);
      if (std::abs(off_now) < least) {
        least = std::abs(off_now);
        best = now;
      }
      if (least < kStill) break;
    }
    return best;
  }

 private:
  [[nodiscard]] Vec3 beside(double u, double v) const {
    const SplinePoint p = surface_.at(u, v);
    return p.r + radius_ * p.normal();
  }
  [[nodiscard]] double first_shift() const {
    const SplinePoint middle = surface_.at(u_, 0.5);
    const SplinePoint a = surface_.at(u_, rails_.low), b = surface_.at(u_, rails_.high);
    const double apart = (b.r - a.r).norm(), along = middle.u.norm();
    const double tau = (b.normal() - a.normal()).dot(middle.u) / (along * apart);
    const double bend = 1.0 + middle.curvature_along_u() * radius_;
    return -tau * radius_ * apart / (2.0 * along * (1.0 + std::sqrt(std::max(bend, 0.0))));
  }

  const SplineSurface& surface_;
  double radius_;
  Rails rails_;
  double u_;
};

// Of a point from an axis without ends.
double from_axis(const Vec3& point, const kinematics::ToolPose& pose) {
  return (point - pose.tip).cross(pose.axis).norm();
}

}  // namespace

FlankPose flank_pose(const SplineSurface& surface, const FlankCutter& cutter, double u) {
  const FlankAxis axis(surface, cutter, u);
  FlankPose out;
  if (cutter.method == FlankMethod::three_point) out.shift = axis.shift();
  const Vec3 low = axis.low(out.shift);
  const Vec3 along = (axis.high(out.shift) - low).normalized();
  const double ruling = (surface.point(u, 1.0) - surface.point(u, 0.0)).norm();
  out.pose = {low - (axis.low_height() * ruling + cutter.overhang) * along, along};
  return out;
}

std::vector<FlankPose> flank_path(const SplineSurface& surface, const FlankCutter& cutter,
                                  double lead, std::size_t blocks) {
  const double first = -lead / surface.at(0.0, 0.0).u.norm();
  const double last = 1.0 + lead / surface.at(1.0, 0.0).u.norm();
  std::vector<FlankPose> path;
  for (std::size_t i = 0; i <= blocks; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(blocks);
    path.push_back(flank_pose(surface, cutter, first + (last - first) * share));
  }
  return path;
}

double length_of(const std::vector<FlankPose>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i].pose.tip - path[i - 1].pose.tip).norm();
  }
  return length;
}

NarrowestHollow narrowest_hollow(const SplineSurface& surface, double v) {
  NarrowestHollow narrowest{0.0, std::numeric_limits<double>::infinity()};
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double u = static_cast<double>(i) / kSteps;
    const double curvature = surface.at(u, v).curvature_along_u();
    if (curvature >= 0.0 || -1.0 / curvature >= narrowest.radius) continue;
    narrowest = {u, -1.0 / curvature};
  }
  return narrowest;
}

std::optional<Diagnostic> does_not_fit(const SplineSurface& surface, const FlankCutter& cutter) {
  const NarrowestHollow middle = narrowest_hollow(surface);
  const NarrowestHollow low = narrowest_hollow(surface, 0.0), high = narrowest_hollow(surface, 1.0);
  const bool is_low = low.radius < high.radius;
  const NarrowestHollow& edge = is_low ? low : high;
  if (cutter.radius < std::min(middle.radius, edge.radius)) return std::nullopt;
  const std::string at_edge = fmt::format("{:.3f} mm at u = {:.3f} of the edge v = {}", edge.radius,
                                          edge.u, is_low ? 0 : 1);
  const std::string at_middle =
      fmt::format("{:.3f} mm at u = {:.3f} half way up", middle.radius, middle.u);
  const std::string largest = cutter.radius < middle.radius  ? at_edge
                              : middle.radius <= edge.radius ? at_middle
                                                             : at_middle + ", " + at_edge;
  Diagnostic failure =
      error("cutter-does-not-fit"_id,
            fmt::format("a cutter of radius {:g} mm does not fit into the hollow of the surface: "
                        "the largest radius that does is {}",
                        cutter.radius, largest),
            "choose a smaller cutter");
  failure.key = "cutter";
  return failure;
}

double flank_deviation(const SplineSurface& surface, const FlankCutter& cutter, double u,
                       double v) {
  const SplinePoint on = surface.at(u, v);
  const Vec3 normal = on.normal();
  double left = 0.0, at = u;
  // First with the surface's own point, then where the cutter leaves it.
  for (int round = 0; round < 3; ++round) {
    const Vec3 point = on.r + left * normal;
    double least = from_axis(point, flank_pose(surface, cutter, at).pose);
    // The place of the nearest axis by parabolas, which narrow.
    for (const double step : {4e-3, 1e-3, 2e-4, 1e-4}) {
      const double before = from_axis(point, flank_pose(surface, cutter, at - step).pose);
      const double middle = from_axis(point, flank_pose(surface, cutter, at).pose);
      const double after = from_axis(point, flank_pose(surface, cutter, at + step).pose);
      const double bend = before - 2.0 * middle + after;
      if (!(bend > 0.0)) break;
      const double move = 0.5 * (before - after) / bend;
      at += std::clamp(move, -10.0, 10.0) * step;
      least = from_axis(point, flank_pose(surface, cutter, at).pose);
    }
    left += least - cutter.radius;
  }
  return left;
}

}  // namespace frustum::programs
