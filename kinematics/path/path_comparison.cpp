#include "kinematics/path/path_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

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

// Where a stroke begins and ends at one place, digits that were rounded off must not decide: a text
// has steps of 1e-6 mm and 1e-7 deg, three words and their rotary axes make 1e-5 mm of them, and no
// comparison asks for less than 0.05 um. Below that two places are one.
constexpr double kSamePlace = 5e-5;

// A place on the other path.
struct OtherPlace {
  std::size_t segment = 0;
  double t = 0.0;
  double distance = 0.0;  // from the pose that is matched

  [[nodiscard]] bool is_before(const OtherPlace& b) const {
    return segment != b.segment ? segment < b.segment : t < b.t;
  }
};

// From one pose of the reference to the next one.
struct ReferenceStep {
  Point6 from, to;

  [[nodiscard]] double length() const { return (to - from).norm(); }
  [[nodiscard]] double distance(const Point6& point) const {
    const double length2 = (to - from).squaredNorm();
    const double t =
        length2 > 0.0 ? std::clamp((point - from).dot(to - from) / length2, 0.0, 1.0) : 0.0;
    return (from + t * (to - from) - point).norm();
  }
};

// The other path, as a line of weighed places.
class OtherPath {
 public:
  OtherPath(const std::vector<PathPlace>& places, const MatchOptions& options)
      : places_(places), options_(options) {
    points_.reserve(places.size());
    for (const PathPlace& place : places) points_.push_back(weighed(place.pose, options.reach));
    if (points_.size() == 1) {  // one segment without length
      places_.push_back(places_.front());
      points_.push_back(points_.front());
    }
  }

  // Adds each place, from `start` on, that is nearer to the end of the step than those just before
  // and after it. The search ends where the other path has gone further than the reference, not
  // counting what it moves close beside the step: it may go to and fro there. No later place is
  // better than one that is the same.
  void find_near(const ReferenceStep& step, const OtherPlace& start,
                 std::vector<OtherPlace>& near) const {
    constexpr double kEqual = 1e-12;  // mm: rounding of a distance
    // Half as much again: the other path may round a corner that the reference's chord cuts. Where
    // it is apart it may need that distance there and back to come alongside again.
    const double ahead =
        1.5 * step.length() + 2.0 * std::min(start.distance, options_.most_apart) + options_.slack;
    const double beside = options_.slack + std::min(start.distance, options_.slack);
    OtherPlace nearest{start.segment, start.t, std::numeric_limits<double>::infinity()};
    double before = nearest.distance, walked = 0.0;
    bool comes_nearer = true, is_beside = step.distance(points_[start.segment]) <= beside;
    const auto pass = [&](std::size_t k, double t, double now) {
      if (now < before - kEqual) {
        comes_nearer = true;
        nearest = {k, t, now};
      } else if (now > before + kEqual && std::exchange(comes_nearer, false)) {
        near.push_back(nearest);
      }
      before = now;
      return !near.empty() && near.back().distance <= kSamePlace;
    };
    for (std::size_t k = start.segment; k + 1 < points_.size() && walked <= ahead; ++k) {
      const double from = k == start.segment ? start.t : 0.0;
      const Point6 along = points_[k + 1] - points_[k];
      const double length = along.norm();
      const double limit = length > 0.0 ? std::min(1.0, from + (ahead - walked) / length) : 1.0;
      const double to = std::max(from, limit);
      const auto distance_at = [&](double t) { return (points_[k] + t * along - step.to).norm(); };
      const double foot =
          length > 0.0 ? (step.to - points_[k]).dot(along) / (length * length) : from;
      const double t = std::clamp(foot, from, to);
      if (pass(k, t, distance_at(t)) || (t < to && pass(k, to, distance_at(to)))) return;
      const bool was_beside = std::exchange(is_beside, step.distance(points_[k + 1]) <= beside);
      if (!was_beside || !is_beside) walked += (1.0 - from) * length;
    }
    if (comes_nearer) near.push_back(nearest);
  }

  [[nodiscard]] PathPlace place(const OtherPlace& at) const {
    const PathPlace& a = places_[at.segment];
    const PathPlace& b = places_[at.segment + 1];
    return {.block = at.t > 0.0 ? b.block : a.block,
            .pose = kinematics::between(a.pose, b.pose, at.t),
            .axes = between(a.axes, b.axes, at.t),
            .time = a.time + at.t * (b.time - a.time)};
  }

  // mm of the tip after a place.
  [[nodiscard]] double left_after(const OtherPlace& at) const {
    const auto length = [&](std::size_t k) {
      return (places_[k + 1].pose.tip - places_[k].pose.tip).norm();
    };
    double left = (1.0 - at.t) * length(at.segment);
    for (std::size_t k = at.segment + 1; k + 1 < places_.size(); ++k) left += length(k);
    return left;
  }

 private:
  std::vector<PathPlace> places_;
  MatchOptions options_;
  std::vector<Point6> points_{};
};

// Ways to walk both paths together so far, each at another place of the other path. Of two ways the
// one that is less far on stays only if it is no worse: it can still go wherever the other one can.
class Walks {
 public:
  explicit Walks(const OtherPath& other) : other_(other) {}

  // On to the next pose of the reference; false where all ways are farther apart than that.
  [[nodiscard]] bool step(const ReferenceStep& step, double stop_beyond) {
    found_.clear();
    const std::size_t end = nodes_.size();
    for (std::size_t i = first_; i < end; ++i) {
      near_.clear();
      other_.find_near(step, nodes_[i].at, near_);
      for (const OtherPlace& at : near_) {
        found_.push_back({at, nodes_[i].cost + cost_of(at), i});
      }
    }
    if (end == 0) {
      near_.clear();
      other_.find_near(step, {}, near_);
      for (const OtherPlace& at : near_) found_.push_back({at, cost_of(at), kNone});
    }
    const auto goes_on = [&](const Node& node) { return node.at.distance <= stop_beyond; };
    const bool any = std::ranges::any_of(found_, goes_on);
    if (any) std::erase_if(found_, std::not_fn(goes_on));
    keep_the_best();
    first_ = end;
    nodes_.insert(nodes_.end(), found_.begin(), found_.end());
    return any;
  }

  // The places of the best way, one for each step.
  [[nodiscard]] std::vector<OtherPlace> best() const {
    std::vector<OtherPlace> places;
    if (nodes_.empty()) return places;
    // The first of equals.
    std::size_t at = first_;
    const double least = nodes_.back().cost;
    while (nodes_[at].cost > least * (1.0 + kSameCost)) ++at;
    for (; at != kNone; at = nodes_[at].before) places.push_back(nodes_[at].at);
    std::ranges::reverse(places);
    return places;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  static constexpr double kSameCost = 1e-6;
  // A place is passed there and back, and by an axis that turns to and fro; of more ways than that
  // the worst are given up.
  static constexpr std::size_t kMost = 8;

  struct Node {
    OtherPlace at{};
    double cost = 0.0;  // mm^2
    std::size_t before = kNone;
  };

  [[nodiscard]] static double cost_of(const OtherPlace& at) {
    const double apart = std::max(0.0, at.distance - kSamePlace);
    return apart * apart;
  }

  void keep_the_best() {
    std::ranges::stable_sort(found_, [](const Node& a, const Node& b) {
      if (a.at.is_before(b.at)) return true;
      return !b.at.is_before(a.at) && a.cost < b.cost;
    });
    double least = std::numeric_limits<double>::infinity();
    std::erase_if(found_, [&](const Node& node) {
      if (node.cost >= least) return true;
      least = node.cost;
      return false;
    });
    if (found_.size() > kMost) {
      found_.erase(found_.begin(), found_.end() - static_cast<std::ptrdiff_t>(kMost));
    }
  }

  const OtherPath& other_;
  std::vector<Node> nodes_{};  // of all steps
  std::size_t first_ = 0;      // of the last step
  std::vector<Node> found_{};
  std::vector<OtherPlace> near_{};
};

}  // namespace

PathMatches match_paths(const ToolPath& reference, const ToolPath& other,
                        const MatchOptions& options) {
  const std::vector<PathPlace> places = feed_places(reference);
  const std::vector<PathPlace> others = feed_places(other);
  PathMatches result;
  if (places.empty() || others.empty()) return result;
  const OtherPath line(others, options);
  Walks walks(line);
  Point6 before = weighed(places.front().pose, options.reach);
  for (const PathPlace& place : places) {
    const Point6 now = weighed(place.pose, options.reach);
    if (!walks.step({std::exchange(before, now), now}, options.stop_beyond)) break;
  }
  const std::vector<OtherPlace> best = walks.best();
  for (std::size_t i = 0; i < best.size(); ++i) {
    result.matches.push_back({places[i], line.place(best[i])});
  }
  result.left_over = line.left_after(best.back());
  return result;
}

}  // namespace frustum::kinematics
