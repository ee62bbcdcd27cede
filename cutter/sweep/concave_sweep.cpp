#include "cutter/sweep/concave_sweep.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/constants.hpp"
#include "core/lowest_place.hpp"
#include "cutter/sweep/meridian_clearance.hpp"

namespace frustum::cutter {
namespace {

// A hull's end that is this near to the body's surface (mm) is on it: above rounding.
constexpr double kSameSurface = 1e-11;
// Steps along a ray are no shorter than this (mm): what begins and ends within one enters by half
// of it.
constexpr double kLeastStep = 2.0 * kMissedDepth;
// Where the ray slides along the surface the least step doubles after so many steps, up to this
// (mm).
constexpr int kSlid = 64;
constexpr double kLongestLeastStep = 1e-3;
// Of what is sampled of phi nothing is farther from the truth (mm); and moments that bracket one
// minimum of the distance are at most, and need not be less than, this much motion apart.
constexpr double kSampledWithin = 1e-5;
constexpr double kLongestSample = 0.02, kShortestSample = 1e-4;
// What is less deep than this (mm) is on the surface: else rounding covers a ray that slides along
// it.
constexpr double kOnSurface = 1e-10;
// Clearances are no more than the truth but for this (mm).
constexpr double kClearanceRounding = 1e-12;
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
      step_(motion.at(1.0).tip - motion.at(0.0).tip),
      run_(step_.norm()),
      pivot_(motion.at(0.0).axis.cross(motion.at(1.0).axis).stableNormalized()),
      sample_(sample_motion(body)),
      steps_(1 + static_cast<int>(motion.travel() / sample_)) {}

ConcaveSweep::Look ConcaveSweep::look(double s, double t) const {
  ++looks_;
  const ToolPose pose = motion_.at(t);
  const Vec3 m = ray_.at(s) - pose.tip;
  const double z = m.dot(pose.axis), r = (m - z * pose.axis).norm();
  return {t,
          body_.generatrix().distance(r, z) + kOnSurface,
          {r, z},
          (m - m.dot(pivot_) * pivot_).norm(),
          std::abs(ray_.direction.dot(pose.axis))};
}

// A body of revolution is between the planes of its ends, so that no distance is less than the
// height in front of one of them, nor of a place behind one the depth more than its height. The
// height is linear along the ray, and within bend dt^2 / 8 of a straight line in time. A place
// moves against the body no faster than the tip, and as the tool turns about that: so does its
// radius, whose second derivative is no more than speed^2 / r, and the acceleration.
double ConcaveSweep::least_between(const Look& a, const Look& b, double reach,
                                   double enough) const {
  const double dt = b.t - a.t, turn = motion_.turn() * dt;
  const double far = std::max(a.away, b.away) + reach, run = run_ * dt;
  const double bulge = turn * (turn * far + 2.0 * run) / 8.0, moved = run + turn * far;
  const double climb = reach * std::max(a.climb, b.climb);
  const double highest = std::max(a.place.z, b.place.z) + climb + bulge;
  const double lowest = std::min(a.place.z, b.place.z) - climb - bulge;
  const double least = std::max(0.5 * (a.distance + b.distance - moved) - reach,
                                std::max(-highest, lowest - body_.height()) + kOnSurface);
  if (least >= enough || !(std::min(a.distance, b.distance) > kOnSurface)) return least;
  const double radius = std::min(a.place.r, b.place.r) - 0.5 * moved;
  if (!(radius > 0.0)) return least;
  const double aside = std::min(moved, moved * moved / (8.0 * radius) + bulge) + reach;
  const double clear = clearance_along(body_.generatrix(), a.place, b.place, aside);
  if (!(clear > kClearanceRounding)) return least;  // it may pass the surface
  return std::max(least, clear - climb - bulge + kOnSurface);
}
double ConcaveSweep::least_beside(const Look& at, double reach) const {
  return least_between(at, at, reach, -kInfinity);
}

bool ConcaveSweep::is_of_body(const SweptEnd& end) const {
  return std::abs(body_.distance(motion_.at(end.t), ray_.at(end.s))) <= kSameSurface;
}

bool ConcaveSweep::slides() const {
  constexpr double kLevel = 0.1, kNear = 1.0;  // the sine against the end; mm
  if (motion_.turn() == 0.0) return false;
  bool is_near = false;
  for (const double t : {0.0, 0.5, 1.0}) {
    const ToolPose pose = motion_.at(t);
    if (std::abs(ray_.direction.dot(pose.axis)) > kLevel) return false;
    const Vec3 nearest = ray_.at((pose.tip - ray_.origin).dot(ray_.direction));
    is_near = is_near || std::abs((nearest - pose.tip).dot(pose.axis)) < kNear;
  }
  return is_near;
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

// Whether no moment covers anything from lo to hi, by halves of the motion. `likely`: a moment to
// begin with; and then one that speaks against it.
bool ConcaveSweep::is_outside(double lo, double hi, double& likely) const {
  constexpr std::size_t kMostParts = 200;
  struct Part {
    Look from, to;
  };
  const double s = 0.5 * (lo + hi), reach = 0.5 * (hi - lo);
  const auto is_hopeless = [&](const Look& at) {
    if (least_beside(at, reach) >= 0.0) return false;
    likely = at.t;
    return true;
  };
  const Look begin = look(s, 0.0), middle = look(s, likely), end = look(s, 1.0);
  if (is_hopeless(middle) || is_hopeless(begin) || is_hopeless(end)) return false;
  std::array<Part, kMostParts + 2> open;
  open[0] = {begin, middle};
  open[1] = {middle, end};
  std::size_t count = 2;
  for (std::size_t looks = 0; count > 0;) {
    const Part part = open[--count];
    if (least_between(part.from, part.to, reach, 0.0) >= 0.0) continue;
    if (++looks == kMostParts) return false;
    const Look half = look(s, 0.5 * (part.from.t + part.to.t));
    if (is_hopeless(half)) return false;
    open[count++] = {part.from, half};
    open[count++] = {half, part.to};
  }
  return true;
}

// From a place where it is not covered to how far it surely is not; the place itself where that is
// nearby. `stretch`: how long to try, and how long to try the next time.
double ConcaveSweep::outside_until(double s, double hi, double& likely, double& stretch) const {
  constexpr double kLess = 0.25;
  for (stretch = std::min(stretch, hi - s); stretch > kLeastStep; stretch *= kLess) {
    if (!is_outside(s, s + stretch, likely)) continue;
    const double until = s + stretch;
    stretch /= kLess;
    return until;
  }
  stretch = kLeastStep / kLess;
  return s;
}

// The body at one moment goes on until the ray crosses its surface: for straight pieces of the
// generatrix that is known, to arcs it is at least the distance.
double ConcaveSweep::covered_until(double s, double t, double hi) const {
  constexpr double kBefore = 1e-9;  // mm, above rounding
  const ToolPose pose = motion_.at(t);
  const double dz = ray_.direction.dot(pose.axis);
  const Vec3 v = ray_.direction - dz * pose.axis;
  // A land of the end is met at a slant that arcs far from it do not care about: again and again.
  constexpr int kMostSteps = 20;
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

// Moments that cover the place follow each other; as the body moves on, so does where it ends.
ConcaveSweep::Covered ConcaveSweep::covered_around(double s, double t, double hi) const {
  Covered best{covered_until(s, t, hi), t};
  for (const double sense : {1.0, -1.0}) {
    for (double step = sense / steps_; best.until < hi; step *= 2.0) {
      const double at = std::clamp(t + step, 0.0, 1.0);
      if (at == t || !(distance(s, at) < 0.0)) break;
      if (const double until = covered_until(s, at, hi); until > best.until) best = {until, at};
      if (at == 0.0 || at == 1.0) break;
    }
  }
  return best;
}

// From s, which it covers at t, to a place farther on: at moments that follow the place evenly, so
// that it stays inside.
bool ConcaveSweep::covers_along(double s, double t, double next, double next_t) const {
  const Look a = look(s, t), b = look(next, next_t);
  if (!(a.distance < 0.0 && b.distance < 0.0)) return false;
  const double turn = motion_.turn() * std::abs(next_t - t), far = std::max(a.away, b.away);
  const double run = ((next - s) * ray_.direction - (next_t - t) * step_).norm();
  const double bulge = turn * (turn * far + 2.0 * run) / 8.0, moved = run + turn * far;
  const double radius = std::min(a.place.r, b.place.r) - 0.5 * moved;
  if (!(radius > 0.0)) return false;
  const double aside = std::min(moved, moved * moved / (8.0 * radius) + bulge);
  return clearance_along(body_.generatrix(), a.place, b.place, aside) - bulge > kOnSurface;
}

// How moments follow the place depends on where the body passes it: as fast as that goes, or some
// times faster.
ConcaveSweep::Covered ConcaveSweep::covered_along(double s, double t, double hi,
                                                  Following& last) const {
  constexpr double kLess = 0.25, kMore = 2.0, kAsFast = 16.0;
  double& stretch = last.stretch;
  constexpr double kSameState = 1e-9, kSameDepth = 0.0;  // mm of motion; mm
  const Look here = look(s, t);
  const double speed = run_ + motion_.turn() * here.away;
  for (stretch = std::min(stretch, hi - s); stretch > kLeastStep; stretch *= kLess) {
    const double next = s + stretch;
    const double window = (kAsFast / speed + 2.0 * std::abs(last.pace)) * stretch;
    const LowestPlace deepest =
        lowest_place([&](double at) { return distance(next, at); }, std::max(0.0, t - window),
                     std::min(1.0, t + window), kSameState / motion_.travel(), kSameDepth);
    if (!covers_along(s, t, next, deepest.at)) continue;
    last.pace = (deepest.at - t) / stretch;
    stretch *= kMore;
    return {next, deepest.at};
  }
  stretch = kLeastStep / kLess;
  return {s, t};
}

// Either way; the one that was longer the last time is taken first.
ConcaveSweep::Covered ConcaveSweep::covered_from(double s, Nearest& here, double hi,
                                                 Following& last) const {
  constexpr double kShort = 0.02;  // mm: not worth while
  if (last.is_longer) {
    const Covered along = covered_along(s, here.t, hi, last);
    if (along.until > s) return along;
  }
  const Covered around = covered_around(s, here.t, hi);
  last.is_longer = false;
  if (around.until >= std::min(hi, s + kShort)) return around;
  here = nearest(s, here.t, Want::least);
  const Covered along = covered_along(s, here.t, hi, last);
  last.is_longer = along.until > around.until;
  return last.is_longer ? along : around;
}

void ConcaveSweep::walk(double lo, double hi, SegmentIntervals& found, double begins_by) const {
  LeastStep least;
  double s = lo, stretch = hi - lo;
  Following follow{hi - lo};
  double likely = 0.5;
  if (begins_by < hi && is_outside(lo, std::max(lo, begins_by), likely)) return;
  Nearest here = nearest(s, likely, Want::side);
  if (!(here.distance < 0.0) && begins_by < hi) {
    // A piece that begins before that is wanted if it goes on beyond.
    s = std::max(lo, begins_by);
    here = nearest(s, here.t, Want::side);
    if (!(here.distance < 0.0)) return;
  }
  bool is_known = true;  // how far it is there
  std::optional<SweptEnd> begin;
  if (here.distance < 0.0) begin = SweptEnd{s, here.t};
  while (s < hi && (begin || s <= begins_by)) {
    if (begin) {
      const Covered covered = covered_from(s, here, hi, follow);
      if (covered.until > s + kLeastStep) {
        s = covered.until;
        here = nearest(s, covered.t, Want::side);
        if (here.distance < 0.0) continue;
        // Within rounding of the surface.
        found.push_back({*begin, {s, covered.t}});
        begin.reset();
        is_known = true;
        continue;
      }
    } else {
      if (const double next = outside_until(s, hi, here.t, stretch); next > s) {
        s = next;
        is_known = false;
        continue;
      }
      if (!is_known) here = nearest(s, here.t, Want::side);
      is_known = true;
      if (here.distance < 0.0) {
        begin = SweptEnd{s, here.t};
        continue;
      }
    }
    const double away = std::abs(here.distance);
    const double sure = std::max(away, least.at(away));
    double next = std::min(hi, s + 1.8 * sure);
    Nearest there = nearest(next, here.t, Want::side);
    const bool flips = (there.distance < 0.0) != (here.distance < 0.0);
    if (!flips && std::abs(there.distance) + sure < next - s) {  // an end may be between
      next = std::min(hi, s + sure);
      there = nearest(next, here.t, Want::side);
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

ConcaveSweep::Nearest ConcaveSweep::nearest(double s, double likely, Want want) const {
  thread_local std::vector<Look> looked;  // kept for its memory
  looked.clear();
  constexpr double kSameDepth = 1e-12;  // mm, above rounding
  struct Part {
    int i, j;
    Look from, to;
  };
  constexpr std::size_t kMostOpen = 80;  // twice the halvings of an int, and two
  std::array<Part, kMostOpen> open;
  std::size_t count = 0;
  const double dt = 1.0 / steps_, way = motion_.travel() * dt;
  Nearest best{kInfinity, 0.0};
  const auto look_at = [&](int i) {
    const Look here = look(s, i == steps_ ? 1.0 : i * dt);
    looked.push_back(here);
    if (here.distance < best.distance) best = {here.distance, here.t};
    return here;
  };
  const auto is_settled = [&] { return want == Want::side && best.distance < 0.0; };
  const Look there = look(s, likely);
  best = {there.distance, there.t};
  if (is_settled()) return best;
  looked.push_back(there);
  const int middle = std::clamp(static_cast<int>(std::lround(likely * steps_)), 0, steps_);
  const Look first = look_at(middle);
  if (is_settled()) return best;
  if (middle > 0) open[count++] = {0, middle, look_at(0), first};
  if (middle < steps_) open[count++] = {middle, steps_, first, look_at(steps_)};
  while (count > 0 && !is_settled()) {
    const Part part = open[--count];
    // Far from the surface it is enough to know how far at least.
    const double enough =
        best.distance > 2.0 * way ? 0.5 * best.distance : best.distance - kSameDepth;
    if (part.j - part.i == 1) continue;
    if (least_between(part.from, part.to, 0.0, enough) >= enough) continue;
    const int half = part.i + (part.j - part.i) / 2;
    const Look at = look_at(half);
    Part before{part.i, half, part.from, at}, after{half, part.j, at, part.to};
    if (part.from.distance < part.to.distance) std::swap(before, after);
    open[count++] = before;
    open[count++] = after;
  }
  if (is_settled() || motion_.travel() == 0.0) return best;
  if (best.distance > way) return {0.5 * best.distance, best.t};
  // The bottom of every valley that may go deeper than the best.
  std::ranges::sort(looked, {}, &Look::t);
  const double may_win = best.distance + way;
  for (std::size_t k = 0; k < looked.size() && !is_settled(); ++k) {
    const Look& here = looked[k];
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
  constexpr double kSameDepth = 1e-14;  // mm
  const LowestPlace bottom = lowest_place([&](double t) { return distance(s, t); }, lo, hi,
                                          kSameState / motion_.travel(), kSameDepth);
  return {bottom.value, bottom.at};
}

SweptEnd ConcaveSweep::close_in(double a, Nearest at_a, double b, Nearest at_b) const {
  if (at_a.distance == 0.0) return {a, at_a.t};
  if (at_b.distance == 0.0) return {b, at_b.t};
  std::uintmax_t looks = 100;
  const bool from_inside = at_a.distance < 0.0;
  SweptEnd inside = from_inside ? SweptEnd{a, at_a.t} : SweptEnd{b, at_b.t};
  const auto distance_at = [&](double x) {
    const Nearest at_x = nearest(x, inside.t, Want::least);
    if (at_x.distance <= 0.0 && (from_inside ? x > inside.s : x < inside.s)) inside = {x, at_x.t};
    return at_x.distance;
  };
  static_cast<void>(boost::math::tools::toms748_solve(
      distance_at, a, b, at_a.distance, at_b.distance,
      [](double lo, double hi) { return hi - lo <= kEndTolerance; }, looks));
  return inside;
}

}  // namespace frustum::cutter
