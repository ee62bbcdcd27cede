#include "kinematics/path/approach_direction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustum::kinematics {
namespace {

// mm or rad, of the place where an axis leaves: far above the rounding of an inverse solution.
double rounding(AxisLetter axis) { return is_rotary(axis) ? 1e-11 : 1e-9; }

struct Sample {
  double u = 0.0;
  AxisPositions q{};
};

// Equal parts, and a short one at either end, where a turn would hide behind the end.
std::vector<Sample> samples_of(const AxisMotion& motion, int parts) {
  constexpr double kShort = 1.0 / 64.0;
  const int n = std::max(1, parts);
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(n) + 3);
  const auto add = [&](double u) { samples.push_back({u, motion(u)}); };
  add(0.0);
  add(kShort / n);
  for (int k = 1; k < n; ++k) add(static_cast<double>(k) / n);
  add(1.0 - kShort / n);
  add(1.0);
  return samples;
}

// One axis of a motion.
class AxisCourse {
 public:
  AxisCourse(const AxisMotion& motion, AxisLetter axis) : motion_(motion), axis_(axis) {}

  [[nodiscard]] double operator()(double u) const { return motion_(u)[axis_]; }

  // Where it turns back between lo and hi, having come in `sense`: golden section, until the
  // position no longer tells two places apart.
  [[nodiscard]] double turn_between(double lo, double hi, double sense) const {
    constexpr double kGolden = 0.6180339887498949;
    double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo);
    double at_a = sense * (*this)(a), at_b = sense * (*this)(b);
    for (int step = 0; step < 60 && b - a > 1e-13; ++step) {
      if (at_a >= at_b) {
        hi = b;
        b = std::exchange(a, b - kGolden * (b - lo));
        at_b = std::exchange(at_a, sense * (*this)(a));
      } else {
        lo = a;
        a = std::exchange(b, a + kGolden * (hi - a));
        at_a = std::exchange(at_b, sense * (*this)(b));
      }
    }
    return 0.5 * (lo + hi);
  }

  // The last u between lo and hi before the axis has gone further than `reach` from its place at
  // `origin`.
  [[nodiscard]] double leaves(double origin, double reach, double lo, double hi) const {
    for (int step = 0; step < 60 && hi - lo > 1e-15; ++step) {
      const double middle = 0.5 * (lo + hi);
      (std::abs((*this)(middle)-origin) > reach ? hi : lo) = middle;
    }
    return lo;
  }

 private:
  const AxisMotion& motion_;
  AxisLetter axis_;
};

// A segment in one direction.
struct AxisRun {
  double from_u = 0.0, from_q = 0.0;
  double to_u = 1.0, to_q = 0.0;
  double sense = 0.0;
};

// `furthest`: before the motion, and after it.
std::vector<AxisRun> runs_of(const AxisCourse& course, AxisLetter axis,
                             std::span<const Sample> samples, std::optional<double>& furthest) {
  const double least = least_motion(axis);
  const auto q = [&](std::size_t k) { return samples[k].q[axis]; };
  // Two samples at one place may as well be the same way before and after a turn between them.
  const auto stood = [&](std::size_t first, std::size_t last) {
    if (last == first || std::abs(q(last) - q(first)) > rounding(axis)) return false;
    const double between = 0.5 * (samples[last - 1].u + samples[last].u);
    return std::abs(q(last - 1) - q(first)) <= rounding(axis) &&
           std::abs(course(between) - q(first)) <= rounding(axis);
  };
  std::vector<AxisRun> segments;
  if (!furthest || std::abs(q(0) - *furthest) > least) furthest = q(0);
  std::size_t first = 0, last = 0;  // samples that are at the furthest place so far
  double sense = 0.0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double moved = q(k) - *furthest;
    if (std::abs(moved) <= least) {
      last = k;
      continue;
    }
    const double now = moved > 0.0 ? 1.0 : -1.0;
    if (now != sense) {
      double u = samples[last].u;
      if (stood(first, last)) {
        u = course.leaves(q(last), rounding(axis), samples[last].u, samples[k].u);
      } else if (sense != 0.0 || last > first) {
        const std::size_t before = first > 0 ? first - 1 : 0;
        u = course.turn_between(samples[before].u, samples[k].u, -now);
        // One that turns as the motion begins does so at 0.
        if (before == 0 && std::abs(course(u) - q(0)) <= rounding(axis)) u = samples[0].u;
      }
      if (!segments.empty()) {
        segments.back().to_u = u;
        segments.back().to_q = course(u);
      }
      segments.push_back({.from_u = u, .from_q = course(u), .sense = now});
      sense = now;
    }
    furthest = q(k);
    first = last = k;
  }
  if (!segments.empty()) segments.back().to_q = q(samples.size() - 1);
  return segments;
}

}  // namespace

AxisPositions ApproachProfile::approach_directions(double u, bool leaving,
                                                   const AxisPositions* q) const {
  AxisPositions heading = before_;
  AxisPositions computed;
  for (const Axis& axis : axes_) {
    const auto after = std::partition_point(
        axis.pieces.begin(), axis.pieces.end(),
        [&](const Piece& piece) { return leaving ? piece.u <= u : piece.u < u; });
    if (after == axis.pieces.begin()) continue;
    const Piece& piece = *std::prev(after);
    heading[axis.letter] = piece.heading;
    if (piece.rate == 0.0) continue;
    if (q == nullptr) {
      computed = motion_(u);
      q = &computed;
    }
    const double taken_up = piece.rate * ((*q)[axis.letter] - piece.q);
    heading[axis.letter] = std::clamp(piece.heading + taken_up, -1.0, 1.0);
  }
  return heading;
}

ApproachTracker::ApproachTracker(const GeometricErrors& errors) {
  for (const AxisLetter axis : kAxisLetters) {
    if (errors[axis].depends_on_direction()) {
      lost_motion_[static_cast<std::size_t>(axis)] = errors[axis].lost_motion;
    }
  }
}

bool ApproachTracker::follows_any() const {
  return std::any_of(lost_motion_.begin(), lost_motion_.end(),
                     [](const auto& s) { return s.has_value(); });
}

ApproachProfile ApproachTracker::follow(const AxisMotion& motion, int parts) {
  ApproachProfile profile;
  profile.before_ = heading_;
  if (!follows_any()) return profile;
  const std::vector<Sample> samples = samples_of(motion, parts);
  for (const AxisLetter letter : kAxisLetters) {
    const auto lost_motion = lost_motion_[static_cast<std::size_t>(letter)];
    if (!lost_motion) continue;
    const AxisCourse course(motion, letter);
    std::optional<double>& furthest = furthest_[static_cast<std::size_t>(letter)];
    ApproachProfile::Axis axis{letter, {}};
    double heading = heading_[letter];
    for (const AxisRun& s : runs_of(course, letter, samples, furthest)) {
      if (heading == s.sense) continue;
      profile.turning_points_.push_back(s.from_u);
      // Travel until the play is taken up.
      const double needed = 0.5 * *lost_motion * std::abs(s.sense - heading);
      const double travel = std::abs(s.to_q - s.from_q);
      if (needed > 0.0) {
        axis.pieces.push_back({s.from_u, s.from_q, heading, 2.0 / *lost_motion});
        if (travel <= needed) {
          heading = std::clamp(heading + 2.0 / *lost_motion * (s.to_q - s.from_q), -1.0, 1.0);
          axis.pieces.push_back({s.to_u, s.to_q, heading, 0.0});
          continue;
        }
      }
      const double settled =
          needed > 0.0 ? course.leaves(s.from_q, needed, s.from_u, s.to_u) : s.from_u;
      heading = s.sense;
      axis.pieces.push_back({settled, course(settled), heading, 0.0});
      if (settled > s.from_u && settled < 1.0) profile.turning_points_.push_back(settled);
    }
    heading_[letter] = heading;
    if (axis.pieces.empty()) continue;
    const bool settles = std::any_of(axis.pieces.begin(), axis.pieces.end(),
                                     [](const auto& piece) { return piece.rate != 0.0; });
    if (settles) profile.motion_ = motion;
    profile.axes_.push_back(std::move(axis));
  }
  auto& points = profile.turning_points_;
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return profile;
}

}  // namespace frustum::kinematics
