#include "tests/cutter/sweep_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::proof {

using cutter::SweptCutter;

namespace {

constexpr double kFar = 300.0;  // mm: outside everything the paths reach

Vec3L point_at(const Ray& ray, double s) {
  return ray.origin.cast<Real>() + static_cast<Real>(s) * ray.direction.cast<Real>();
}

}  // namespace

void Judgement::add(const Judgement& other) {
  rays += other.rays;
  ends += other.ends;
  if (other.worst_end > worst_end) {
    worst_end = other.worst_end;
    where = other.where;
  }
  worst_covered = std::max(worst_covered, other.worst_covered);
  worst_void = std::max(worst_void, other.worst_void);
  worst_contact = std::max(worst_contact, other.worst_contact);
  worst_normal = std::max(worst_normal, other.worst_normal);
}

SweepJudge::SweepJudge(const Kind& kind, const kinematics::ToolPath& path)
    : swept_(SweptCutter::sweep(path, {{1, kind.cutter}}).value()),
      standing_(kind.meridian, kind.is_convex, path),
      is_convex_(kind.is_convex) {}

Ray SweepJudge::random_ray(Draw& draw) const {
  const auto& motions = standing_.motions();
  const auto& motion =
      motions[static_cast<std::size_t>(draw.below(static_cast<int>(motions.size())))];
  const double t = draw.between(0.0, 1.0);
  const Vec3 axis =
      (std::cos(motion.turn * t) * motion.axis + std::sin(motion.turn * t) * motion.across)
          .cast<double>()
          .normalized();
  const Vec3 tip = (motion.tip + t * motion.travel).cast<double>();
  const Vec3 e1 = perpendicular_to(axis);
  const double around = draw.between(0.0, 2.0 * std::numbers::pi);
  const Vec3 out = std::cos(around) * e1 + std::sin(around) * axis.cross(e1);
  const auto spot = standing_.body().spot(draw.between(0.0, 1.0));
  const Vec3 on_body = tip + static_cast<double>(spot.z) * axis + static_cast<double>(spot.r) * out;
  if (draw.chance(0.5)) {
    const Vec3 size = Vec3::Constant(static_cast<double>(standing_.body().max_radius()));
    return {on_body + draw.point(-size, size), draw.direction()};
  }
  // In the tangent plane, moved in or out a little.
  const auto gradient = [&](const Vec3& at) {
    Vec3 g;
    for (int d = 0; d < 3; ++d) {
      const Vec3L step = Vec3L::Unit(d) * 1e-6L;
      const Vec3L p = at.cast<Real>();
      g[d] = static_cast<double>(motion.distance(standing_.body(), p + step, t) -
                                 motion.distance(standing_.body(), p - step, t));
    }
    return g.norm() > 1e-12 ? Vec3(g.normalized()) : Vec3(axis);
  };
  const Vec3 normal = gradient(on_body);
  const double depth = draw.decades(1e-7, 1.0) * (draw.chance(0.7) ? -1.0 : 1.0);
  const Vec3 along = normal.cross(draw.direction()).normalized();
  return {on_body + depth * normal, along};
}

void SweepJudge::judge_point(const Ray& ray, double s, bool reported_covered,
                             Judgement& judged) const {
  const Vec3L point = point_at(ray, s);
  if (reported_covered) {
    const Real depth = standing_.depth(point, 1e-5L, -1e-9L);
    judged.worst_covered = std::max(judged.worst_covered, static_cast<double>(depth));
  } else {
    const Real depth = standing_.depth(point, -1e-9L, -1e-5L);
    judged.worst_void = std::max(judged.worst_void, -static_cast<double>(depth));
  }
}

void SweepJudge::judge_end(const Ray& ray, double s, EndTag tag, Judgement& judged) const {
  const Vec3L point = point_at(ray, s);
  const double error = std::abs(static_cast<double>(standing_.depth(point)));
  ++judged.ends;
  if (error > judged.worst_end) {
    judged.worst_end = error;
    judged.where = fmt::format("s = {}, path segment {}", s, tag);
  }
  if (tag < 0) return;
  const auto segment = static_cast<std::uint32_t>(tag);
  const cutter::SweepContact contact = swept_.contact(ray, s, segment);
  const double off = static_cast<double>(standing_.distance_at(contact.segment, contact.t, point));
  judged.worst_contact = std::max(judged.worst_contact, std::abs(off));
  // Of a hollow body a step along the normal may come near another wall.
  constexpr double kAside = 1e-3;
  const double away = static_cast<double>(standing_.distance_at(
                          contact.segment, contact.t,
                          point + static_cast<Real>(kAside) * contact.normal.cast<Real>())) -
                      off;
  if (is_convex_) judged.worst_normal = std::max(judged.worst_normal, (kAside - away) / kAside);
}

Judgement SweepJudge::along(const Ray& ray, Draw& draw) const {
  Judgement judged;
  judged.rays = 1;
  const IntervalSet met = swept_.along(ray, {-kFar, kFar});
  double before = -kFar;
  // Beside an end, within this, the end itself is judged.
  constexpr double kBeside = 1e-9;
  const auto between = [&](double lo, double hi, bool covered) {
    if (hi - lo < 2.0 * kBeside) return;
    judge_point(ray, draw.between(lo + kBeside, hi - kBeside), covered, judged);
    if (lo < 0.0 && hi > 0.0) judge_point(ray, 0.0, covered, judged);
  };
  for (const Interval& interval : met.intervals()) {
    between(std::max(before, interval.lo - 20.0), interval.lo, false);
    judge_end(ray, interval.lo, interval.lo_tag, judged);
    between(interval.lo, interval.hi, true);
    between(interval.lo, interval.hi, true);
    judge_end(ray, interval.hi, interval.hi_tag, judged);
    before = interval.hi;
  }
  between(std::max(before, -20.0), std::max(before, -20.0) + 40.0, false);
  return judged;
}

}  // namespace frustum::proof
