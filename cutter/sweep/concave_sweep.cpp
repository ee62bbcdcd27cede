#include "cutter/sweep/concave_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/constants.hpp"
#include "core/golden_section.hpp"

namespace frustum::cutter {
namespace {

// A hull's end that is this near to the body's surface (mm) is on it: above rounding.
constexpr double kSameSurface = 1e-11;
// Steps along a ray are no shorter than this (mm): what begins and ends within one enters by half
// of it.
constexpr double kLeastStep = 2.0 * kMissedDepth;
// After so many steps it is seen whether the ray is in front of an end, and where it slides along
// the surface the least step doubles, up to this (mm).
constexpr int kSlid = 64;
constexpr double kLongestLeastStep = 1e-3;
// Of what is sampled of phi nothing is farther from the truth (mm); and moments that bracket one
// minimum of the distance are at most, and need not be less than, this much motion apart.
constexpr double kSampledWithin = 1e-5;
constexpr double kLongestSample = 0.02, kShortestSample = 1e-4;
// What is less deep than this (mm) is on the surface: else rounding covers a ray that slides along
// it.
constexpr double kOnSurface = 1e-10;
// Ends are closed in to this along the ray (mm).
constexpr double kEndTolerance = 1e-11;

// Two valleys that are h apart are taken for one: of circles of radius f, h^2 / 8f is lost.
double sample_motion(const Body& body) {
  return std::clamp(std::sqrt(8.0 * kSampledWithin * body.finest_concave()), kShortestSample,
                    kLongestSample);
}

// How far a walk may go at least, the longer the longer it slides along the surface.
class LeastStep {
 public:
  // From a place that is so far from the surface.
  double at(double distance) {
    if (distance > step_) {
      step_ = kLeastStep;
      slid_ = 0;
    } else if (++slid_ % kSlid == 0) {
      step_ = std::min(2.0 * step_, kLongestLeastStep);
    }
    return step_;
  }

 private:
  double step_ = kLeastStep;
  int slid_ = 0;
};

}  // namespace

double concave_accuracy(const Body& body) {
  const double h = sample_motion(body);
  return kOnSurface + std::min(h, h * h / (8.0 * body.finest_concave()));
}

Vec3 generatrix_normal(const Generatrix& generatrix, const ToolPose& pose, const Vec3& point) {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  const double rho = across.norm();
  constexpr double kStep = 1e-6;  // mm
  const double dr =
      generatrix.distance(rho + kStep, z) - generatrix.distance(std::abs(rho - kStep), z);
  const double dz = generatrix.distance(rho, z + kStep) - generatrix.distance(rho, z - kStep);
  const double length = std::hypot(dr, dz);
  if (!(length > 0.0)) return -pose.axis;
  const Vec3 side = rho > 0.0 ? Vec3(across / rho) : perpendicular_to(pose.axis);
  return dr / length * side + dz / length * pose.axis;
}

ConcaveSweep::ConcaveSweep(const Body& body, const SegmentMotion& motion, const Ray& ray)
    : body_(body),
      motion_(motion),
      ray_(ray),
      sample_(sample_motion(body)),
      steps_(1 + static_cast<int>(motion.travel() / sample_)) {}

// Counted from just below the surface.
double ConcaveSweep::distance(double s, double t) const {
  ++looks_;
  return body_.distance(motion_.at(t), ray_.at(s)) + kOnSurface;
}

bool ConcaveSweep::is_of_body(const SweptEnd& end) const {
  return std::abs(body_.distance(motion_.at(end.t), ray_.at(end.s))) <= kSameSurface;
}

bool ConcaveSweep::covers_from(double from, const SweptEnd& end) const {
  const double towards = end.s > from ? 1.0 : -1.0;
  const ToolPose pose = motion_.at(end.t);
  double s = from;
  while (towards * (end.s - s) > kLeastStep) {
    const double depth = -body_.distance(pose, ray_.at(s));
    if (!(depth > 0.1 * kLeastStep)) return false;
    s += towards * depth;
  }
  return true;
}

// A body of revolution is between the planes of its ends: what is in front of one of them, but for
// what counts as on the surface, is not covered. The height over such a plane is linear along the
// ray, and within bend dt^2 / 8 of a straight line in time.
bool ConcaveSweep::is_in_front(double lo, double hi) const {
  struct Part {
    double t0, height0, t1, height1;
  };
  constexpr std::size_t kMostParts = 200;
  const ToolPose from = motion_.at(0.0);
  const Vec3 a = ray_.at(lo), b = ray_.at(hi);
  const double run = (motion_.at(1.0).tip - from.tip).norm();
  const double far = std::max((a - from.tip).norm(), (b - from.tip).norm()) + run;
  const double bend = motion_.turn() * (motion_.turn() * far + 2.0 * run);
  const auto in_front = [&](double up, double end) {
    const auto height = [&](double t) {
      const ToolPose pose = motion_.at(t);
      return std::max(up * (a - pose.tip).dot(pose.axis), up * (b - pose.tip).dot(pose.axis)) - end;
    };
    std::array<Part, kMostParts + 1> open;
    open[0] = {0.0, height(0.0), 1.0, height(1.0)};
    std::size_t count = 1;
    for (std::size_t looks = 0; count > 0;) {
      const Part part = open[--count];
      const double upper = std::max(part.height0, part.height1), dt = part.t1 - part.t0;
      if (upper > kOnSurface) return false;
      if (upper + bend * dt * dt / 8.0 <= kOnSurface) continue;
      if (++looks == kMostParts) return false;
      const double t = 0.5 * (part.t0 + part.t1), middle = height(t);
      open[count++] = {part.t0, part.height0, t, middle};
      open[count++] = {t, middle, part.t1, part.height1};
    }
    return true;
  };
  return in_front(1.0, 0.0) || in_front(-1.0, -body_.height());
}

// From a place where it is not covered to how far it surely is not, because it is in front of an
// end; the place itself where that is nearby.
double ConcaveSweep::in_front_from(double s, double hi) const {
  if (is_in_front(s, hi)) return hi;
  double sure = s;
  for (double step = 0.5 * (hi - s); step > kLongestLeastStep; step *= 0.5) {
    if (is_in_front(sure, sure + step)) sure += step;
  }
  return sure;
}

// The body at one moment goes on until the ray crosses its surface: for straight pieces of the
// generatrix that is known, to arcs it is at least the distance.
double ConcaveSweep::covered_until(double s, double t, double hi) const {
  constexpr double kBefore = 1e-9;  // mm, above rounding
  const ToolPose pose = motion_.at(t);
  const double dz = ray_.direction.dot(pose.axis);
  const Vec3 v = ray_.direction - dz * pose.axis;
  // A land of the end is met at a slant that arcs far from it do not care about: again and again.
  constexpr int kMostSteps = 100;
  double sure = s;
  for (int i = 0; i < kMostSteps && sure < hi; ++i) {
    const Vec3 m = ray_.at(sure) - pose.tip;
    const double z = m.dot(pose.axis);
    const Vec3 w = m - z * pose.axis;
    double next = hi - sure;
    const auto offer = [&](const GeneratrixSegment& piece) {
      if (is_arc(piece)) {
        next = std::min(next, std::abs(std::hypot(w.norm() - piece.centre.r, z - piece.centre.z) -
                                       piece.arc_radius));
        return;
      }
      const double rise = piece.to.z - piece.from.z, out = piece.to.r - piece.from.r;
      // (rise rho)^2 = (rise r + out (z - z_from))^2 on the cone through it; twice the plane.
      const double r = rise * piece.from.r + out * (z - piece.from.z), e = out * dz;
      const double a = rise * rise * v.squaredNorm() - e * e;
      const double b = rise * rise * w.dot(v) - r * e;
      const double c = rise * rise * w.squaredNorm() - r * r;
      const double root2 = b * b - a * c;
      if (root2 < 0.0) return;
      const double q = -(b + std::copysign(std::sqrt(root2), b));
      for (const double u : {q / a, c / q}) {
        if (u > 0.0) next = std::min(next, u);
      }
    };
    for (const GeneratrixSegment& piece : body_.generatrix().segments()) offer(piece);
    const MeridianPoint rim = body_.generatrix().segments().back().to;
    offer(line(rim, {0.0, rim.z}));
    next -= kBefore;
    if (next < kLeastStep || !(distance(sure + next, t) < 0.0)) break;
    sure += next;
  }
  return sure;
}

void ConcaveSweep::walk(double lo, double hi, std::vector<SegmentInterval>& found) const {
  LeastStep least;
  double s = lo;
  Nearest here = nearest(s);
  std::optional<SweptEnd> begin;
  if (here.distance < 0.0) begin = SweptEnd{s, here.t};
  for (int step = 0; s < hi; ++step) {
    const double away = std::abs(here.distance);
    const double sure = std::max(away, least.at(away));
    if (!begin && step % kSlid == 0) {
      if (const double next = in_front_from(s, hi); next > s) {
        s = next;
        here = {kOnSurface, here.t};
        continue;
      }
    }
    double next = std::min(hi, s + 1.8 * sure);
    if (begin) {
      if (const double covered = covered_until(s, here.t, hi); covered > next) {
        s = covered;
        here = nearest(s);
        continue;
      }
    }
    Nearest there = nearest(next);
    const bool flips = (there.distance < 0.0) != (here.distance < 0.0);
    if (!flips && std::abs(there.distance) + sure < next - s) {  // an end may be between
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

ConcaveSweep::Nearest ConcaveSweep::nearest(double s) const {
  thread_local std::vector<Nearest> looked;  // kept for its memory
  looked.clear();
  const double dt = 1.0 / steps_;
  const double way = motion_.travel() * dt;
  Nearest best{kInfinity, 0.0};
  for (int i = 0; i <= steps_;) {
    const Nearest here{distance(s, i * dt), i * dt};
    looked.push_back(here);
    if (here.distance < best.distance) best = here;
    // Until then it stays above the best that is known.
    const int skipped =
        way > 0.0 ? static_cast<int>((here.distance - best.distance) / way) : steps_;
    i += std::max(1, skipped);
  }
  if (motion_.travel() == 0.0) return best;
  // Far from the surface it is enough to know how far at least.
  if (best.distance > 4.0 * way) return {best.distance - 0.5 * way, best.t};
  if (best.distance < -4.0 * way) return best;
  // The bottom of every valley that may go deeper than the best.
  const double may_win = best.distance + way;
  for (std::size_t k = 0; k < looked.size(); ++k) {
    const Nearest& here = looked[k];
    if (here.distance > may_win) continue;
    if (k > 0 && looked[k - 1].distance <= here.distance) continue;
    if (k + 1 < looked.size() && looked[k + 1].distance < here.distance) continue;
    const Nearest bottom = lowest(s, std::max(0.0, here.t - dt), std::min(1.0, here.t + dt));
    if (bottom.distance < best.distance) best = bottom;
  }
  return best;
}

// Bottoms may be as sharp as the rims that make them.
ConcaveSweep::Nearest ConcaveSweep::lowest(double s, double lo, double hi) const {
  constexpr double kSameState = 1e-13;  // mm of motion
  const GoldenBracket bottom = golden_section([&](double t) { return distance(s, t); }, lo, hi,
                                              kSameState / motion_.travel());
  return {bottom.value, bottom.at};
}

SweptEnd ConcaveSweep::close_in(double a, Nearest at_a, double b, Nearest at_b) const {
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

}  // namespace frustum::cutter
