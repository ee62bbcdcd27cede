#include "bench/peers/path_truth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustum::bench {
namespace {

constexpr std::size_t kPart = 8;  // segments: a part moves little, and parts are few

// Of a solid whose signed distances across and along its axis are these.
double corner_distance(double across, double along) {
  return std::min(std::max(across, along), 0.0) +
         std::hypot(std::max(across, 0.0), std::max(along, 0.0));
}

double to_box(const Box& box, const Vec3& p) {
  const Vec3 beyond = (box.min - p).cwiseMax(p - box.max);
  const double outside = beyond.cwiseMax(0.0).norm();
  return outside > 0.0 ? outside : beyond.maxCoeff();
}

}  // namespace

PathTruth::PathTruth(const PeerScene& scene)
    : blank_(scene.blank.bounds()), radius_(scene.radius), height_(scene.height) {
  const kinematics::ToolPath& path = scene.path;
  const double reach = std::hypot(radius_, height_);
  for (std::size_t first = 0; first < path.segments.size(); first += kPart) {
    const std::size_t last = std::min(first + kPart, path.segments.size());
    kinematics::ToolPath some;
    some.blocks = path.blocks;
    for (std::size_t i = first; i < last; ++i) {
      some.poses.push_back(path.from(path.segments[i]));
      some.poses.push_back(path.to(path.segments[i]));
      some.segments.push_back({static_cast<std::uint32_t>(some.poses.size() - 2), 0});
    }
    const kinematics::ToolPose middle = some.poses[some.poses.size() / 2];
    double motion = 0.0;
    for (const kinematics::ToolPose& pose : some.poses) {
      const double turn =
          std::atan2(pose.axis.cross(middle.axis).norm(), pose.axis.dot(middle.axis));
      motion = std::max(motion, (pose.tip - middle.tip).norm() + reach * turn);
    }
    parts_.push_back({proof::StandingCutters(scene.meridian, true, some), middle, motion});
  }
}

double PathTruth::lower_bound(const Part& part, const Vec3& point) const {
  const Vec3 m = point - part.middle.tip;
  const double z = m.dot(part.middle.axis);
  const double r = (m - z * part.middle.axis).norm();
  return corner_distance(r - radius_, std::max(-z, z - height_)) - part.motion;
}

double PathTruth::to_void(const Vec3& point) const {
  std::vector<std::pair<double, const Part*>> near;
  for (const Part& part : parts_) {
    const double least = lower_bound(part, point);
    if (least < kFarthest) near.emplace_back(least, &part);
  }
  std::sort(near.begin(), near.end());
  double best = kFarthest;
  for (const auto& [least, part] : near) {
    if (least > best || best <= -kFarthest) break;
    best = std::min(best, static_cast<double>(
                              part->cutters.depth(point.cast<proof::Real>(), best, -kFarthest)));
  }
  return std::max(best, -kFarthest);
}

PathTruth::Offset PathTruth::of(const Vec3& point) const {
  const double blank = to_box(blank_, point);
  const double cut = -to_void(point);
  return {std::max(blank, cut), cut > blank,
          std::abs(blank) < kFarthest && std::abs(cut) < kFarthest};
}

}  // namespace frustum::bench
