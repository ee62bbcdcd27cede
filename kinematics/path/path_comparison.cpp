#include "kinematics/path/path_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::kinematics {
namespace {

using Point6 = Eigen::Matrix<double, 6, 1>;

Point6 weighed(const ToolPose& pose, double reach) {
  Point6 point;
  point << pose.tip, reach * pose.axis;
  return point;
}

AxisState between(const AxisState& from, const AxisState& to, double t) {
  AxisState at = from;
  for (const AxisLetter letter : kAxisLetters) {
    at.q[letter] += t * (to.q[letter] - from.q[letter]);
  }
  return at;
}

// The feed moves of a path as one line of places.
std::vector<PathPlace> feed_places(const ToolPath& path) {
  std::vector<PathPlace> places;
  const auto place = [&](std::uint32_t pose, std::uint32_t block, double time) {
    PathPlace p{.block = block, .pose = path.poses[pose], .time = time};
    if (!path.axes.empty()) p.axes = path.axes[pose];
    places.push_back(p);
  };
  double time = 0.0;
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  for (const PathSegment& segment : path.segments) {
    if (path.blocks[segment.block].kind != PathKind::feed) continue;
    if (segment.first_pose != last) place(segment.first_pose, segment.block, time);
    last = segment.first_pose + 1;
    if (!path.times.empty()) time += path.times[last] - path.times[segment.first_pose];
    place(last, segment.block, time);
  }
  return places;
}

// The other path, walked forward.
class Follower {
 public:
  Follower(const std::vector<PathPlace>& places, double reach) : places_(places), reach_(reach) {
    for (const PathPlace& place : places) points_.push_back(weighed(place.pose, reach));
  }

  // The nearest place at most `ahead` further on; the earlier one of two that are equally near.
  PathPlace nearest(const ToolPose& pose, double ahead) {
    const Point6 wanted = weighed(pose, reach_);
    if (points_.size() < 2) return places_.front();
    // Where a stroke begins and ends at one place, digits that were rounded off must not decide. A
    // text has steps of 1e-6 mm; below 1e-5 two places are one.
    constexpr double kSamePlace = 1e-5;
    near_.clear();
    double least = std::numeric_limits<double>::infinity(), walked = 0.0;
    for (std::size_t k = segment_; k + 1 < points_.size(); ++k) {
      const double from = k == segment_ ? t_ : 0.0;
      const Point6 along = points_[k + 1] - points_[k];
      const double length = along.norm();
      const double limit = length > 0.0 ? std::min(1.0, from + (ahead - walked) / length) : 1.0;
      const double foot =
          length > 0.0 ? (wanted - points_[k]).dot(along) / (length * length) : from;
      const double t = std::clamp(foot, from, std::max(from, limit));
      near_.push_back({k, t, (points_[k] + t * along - wanted).norm()});
      least = std::min(least, near_.back().distance);
      walked += (1.0 - from) * length;
      if (walked > ahead) break;
    }
    auto best = std::ranges::find_if(
        near_, [&](const NearPlace& place) { return place.distance <= least + kSamePlace; });
    // On while it becomes nearer; 1e-12: rounding of the distance.
    for (auto next = best + 1; next != near_.end(); best = next++) {
      if (next->distance > best->distance - 1e-12) break;
    }
    segment_ = best->segment;
    t_ = best->t;
    return here();
  }

  [[nodiscard]] double left() const {
    if (points_.size() < 2) return 0.0;
    double length =
        (1.0 - t_) * (places_[segment_ + 1].pose.tip - places_[segment_].pose.tip).norm();
    for (std::size_t k = segment_ + 1; k + 1 < places_.size(); ++k) {
      length += (places_[k + 1].pose.tip - places_[k].pose.tip).norm();
    }
    return length;
  }

 private:
  [[nodiscard]] PathPlace here() const {
    const PathPlace& a = places_[segment_];
    const PathPlace& b = places_[segment_ + 1];
    return {.block = t_ > 0.0 ? b.block : a.block,
            .pose = kinematics::between(a.pose, b.pose, t_),
            .axes = between(a.axes, b.axes, t_),
            .time = a.time + t_ * (b.time - a.time)};
  }

  // Of a segment.
  struct NearPlace {
    std::size_t segment = 0;
    double t = 0.0;
    double distance = 0.0;
  };

  const std::vector<PathPlace>& places_;
  double reach_;
  std::vector<Point6> points_;
  std::vector<NearPlace> near_{};
  std::size_t segment_ = 0;
  double t_ = 0.0;
};

}  // namespace

PathMatches match_paths(const ToolPath& reference, const ToolPath& other,
                        const MatchOptions& options) {
  const std::vector<PathPlace> places = feed_places(reference);
  const std::vector<PathPlace> others = feed_places(other);
  PathMatches result;
  if (places.empty() || others.empty()) return result;
  Follower follower(others, options.reach);
  Point6 before = weighed(places.front().pose, options.reach);
  double apart = 0.0;
  for (const PathPlace& place : places) {
    const Point6 now = weighed(place.pose, options.reach);
    // Half as much again: the other path may round a corner that the reference's chord cuts. Where
    // it is apart it may need that distance there and back to come alongside again.
    const double allowance =
        1.5 * (now - before).norm() + 2.0 * std::min(apart, options.most_apart) + options.slack;
    before = now;
    const PathPlace other_place = follower.nearest(place.pose, allowance);
    apart = (weighed(other_place.pose, options.reach) - now).norm();
    result.matches.push_back({place, other_place});
    if (apart > options.stop_beyond) break;
  }
  result.left_over = follower.left();
  return result;
}

}  // namespace frustum::kinematics
