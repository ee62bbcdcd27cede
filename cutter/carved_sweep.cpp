#include "cutter/carved_sweep.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <optional>

namespace frustum::cutter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Distances below this are on the surface (mm).
constexpr double kOnSurface = 1e-8;
// Moments that are this near (mm of motion) bracket one minimum of the distance.
constexpr double kSampleMotion = 0.02;
// Ends are closed in to this along the ray (mm).
constexpr double kEndTolerance = 1e-11;

double distance_at(const Outline& outline, const ToolPose& pose, const Vec3& point) {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  return outline.distance((m - z * pose.axis).norm(), z);
}

// The least signed distance over the stretch, and when.
struct Nearest {
  double distance = kInfinity;
  double t = 0.0;
};

class CarvedSearch {
 public:
  CarvedSearch(const Body& body, const StretchMotion& motion, const Ray& ray)
      : outline_(body.outline()), motion_(motion), ray_(ray) {
    steps_ = 1 + static_cast<int>(motion.travel() / kSampleMotion);
  }

  // Walks from lo to hi and appends the covered pieces.
  void walk(double lo, double hi, std::vector<SweptInterval>& found) const {
    double s = lo;
    Nearest here = nearest(s);
    std::optional<SweptEnd> begin;
    if (here.distance < 0.0) begin = SweptEnd{s, here.t};
    while (s < hi) {
      const double sure = std::max(std::abs(here.distance), kOnSurface);
      double next = std::min(hi, s + 1.8 * sure);
      Nearest there = nearest(next);
      const bool flips = (there.distance < 0.0) != (here.distance < 0.0);
      if (!flips && std::abs(there.distance) + sure < next - s) {  // an end may lie between
        next = std::min(hi, s + sure);
        there = nearest(next);
      }
      if ((there.distance < 0.0) != (here.distance < 0.0)) {
        const SweptEnd end = close_in(s, here, next, there);
        if (begin) {
          found.push_back({*begin, end});
          begin.reset();
        } else {
          begin = end;
        }
      }
      s = next;
      here = there;
    }
    if (begin) found.push_back({*begin, {hi, here.t}});
  }

  [[nodiscard]] Nearest nearest(double s) const {
    const double dt = 1.0 / steps_;
    const double way = motion_.travel() * dt;
    Nearest best;
    looked_.clear();
    for (int i = 0; i <= steps_;) {
      const Nearest here{distance(s, i * dt), i * dt};
      looked_.push_back(here);
      if (here.distance < best.distance) best = here;
      // Until then it stays above the best that is known.
      const int skipped =
          way > 0.0 ? static_cast<int>((here.distance - best.distance) / way) : steps_;
      i += std::max(1, skipped);
    }
    if (motion_.travel() == 0.0) return best;
    // The bottom of every valley that may go deeper than the best.
    const double may_win = best.distance + way;
    for (std::size_t k = 0; k < looked_.size(); ++k) {
      const Nearest& here = looked_[k];
      if (here.distance > may_win) continue;
      if (k > 0 && looked_[k - 1].distance <= here.distance) continue;
      if (k + 1 < looked_.size() && looked_[k + 1].distance < here.distance) continue;
      const double lo = std::max(0.0, here.t - dt), hi = std::min(1.0, here.t + dt);
      const auto [t, d] = boost::math::tools::brent_find_minima(
          [&](double time) { return distance(s, time); }, lo, hi, 40);
      if (d < best.distance) best = {d, t};
    }
    return best;
  }

 private:
  [[nodiscard]] double distance(double s, double t) const {
    return distance_at(outline_, motion_.at(t), ray_.at(s));
  }

  [[nodiscard]] SweptEnd close_in(double a, Nearest at_a, double b, Nearest at_b) const {
    for (int i = 0; i < 100 && b - a > kEndTolerance; ++i) {
      double x = a + (b - a) * at_a.distance / (at_a.distance - at_b.distance);
      if (i % 3 == 2 || !(x > a && x < b)) x = 0.5 * (a + b);
      const Nearest at_x = nearest(x);
      if (at_x.distance == 0.0) return {x, at_x.t};
      if ((at_x.distance < 0.0) == (at_a.distance < 0.0)) {
        a = x;
        at_a = at_x;
      } else {
        b = x;
        at_b = at_x;
      }
    }
    return at_a.distance < 0.0 ? SweptEnd{a, at_a.t} : SweptEnd{b, at_b.t};
  }

  const Outline& outline_;
  const StretchMotion& motion_;
  const Ray& ray_;
  int steps_ = 1;
  mutable std::vector<Nearest> looked_{};  // of one call: kept for its memory
};

}  // namespace

double carved_accuracy(const Body& body) {
  constexpr double kEnds = 1e-7;  // mm
  double smallest = body.max_radius();
  for (const OutlineSegment& s : body.outline().segments()) {
    if (s.arc_radius > 0.0) smallest = std::min(smallest, s.arc_radius);
  }
  return kEnds + kSampleMotion * kSampleMotion / (8.0 * smallest);
}

Vec3 outline_normal(const Outline& outline, const ToolPose& pose, const Vec3& point) {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  const double rho = across.norm();
  constexpr double kStep = 1e-6;  // mm
  const double dr = outline.distance(rho + kStep, z) - outline.distance(std::abs(rho - kStep), z);
  const double dz = outline.distance(rho, z + kStep) - outline.distance(rho, z - kStep);
  const double length = std::hypot(dr, dz);
  if (!(length > 0.0)) return -pose.axis;
  const Vec3 side = rho > 0.0 ? Vec3(across / rho) : perpendicular_to(pose.axis);
  return dr / length * side + dz / length * pose.axis;
}

void append_carved_intervals(const Body& body, const StretchMotion& motion, const Ray& ray,
                             std::span<const Chord> known, std::vector<SweptInterval>& found) {
  double lo = kInfinity, hi = -kInfinity;
  for (const Profile& hull : body.carved()) {
    if (const auto all = hull.chord(motion.at(0.5), ray, 0.5 * motion.travel())) {
      lo = std::min(lo, all->lo);
      hi = std::max(hi, all->hi);
    }
  }
  const CarvedSearch search(body, motion, ray);
  while (lo < hi) {
    // The next stretch of ray that is not known yet.
    double until = hi, then = hi;
    for (const Chord& k : known) {
      if (k.hi <= lo || k.lo >= until) continue;
      until = std::max(lo, k.lo);
      then = k.hi;
    }
    if (until > lo) search.walk(lo, until, found);
    lo = then;
  }
}

double nearest_moment(const Body& body, const StretchMotion& motion, const Ray& ray, double s) {
  return CarvedSearch(body, motion, ray).nearest(s).t;
}

}  // namespace frustum::cutter
