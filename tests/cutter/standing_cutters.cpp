#include "tests/cutter/standing_cutters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::proof {
namespace {

constexpr Real kStep = 0.5e-3L;        // mm of motion between neighbouring times
constexpr Real kIndifferent = 1e-10L;  // mm: a deeper moment by less is not looked for
constexpr Real kSliding = 0.05L;       // mm
constexpr Real kEqual = 1e-13L;        // mm
constexpr Real kHair = 1e-6L;          // of a span of times
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

Real cross(Real ar, Real az, Real br, Real bz) { return ar * bz - az * br; }

}  // namespace

Meridian& Meridian::line_to(Real r, Real z) {
  if (r != last_r_ || z != last_z_) pieces_.push_back({last_r_, last_z_, r, z});
  last_r_ = r;
  last_z_ = z;
  max_radius_ = std::max(max_radius_, r);
  return *this;
}

Meridian& Meridian::arc_to(Real r, Real z, Real centre_r, Real centre_z) {
  const Real radius = std::hypot(last_r_ - centre_r, last_z_ - centre_z);
  const auto push = [&](Real to_r, Real to_z) {
    if (to_r == last_r_ && to_z == last_z_) return;
    pieces_.push_back({last_r_, last_z_, to_r, to_z, radius, centre_r, centre_z});
    last_r_ = to_r;
    last_z_ = to_z;
    max_radius_ = std::max(max_radius_, to_r);
  };
  // Cut where the circle turns round in height and in radius: each piece then has one r at each z.
  const Real turn = cross(last_r_ - centre_r, last_z_ - centre_z, r - centre_r, z - centre_z);
  struct Pole {
    Real angle, r, z;
  };
  const Real start = std::atan2(last_z_ - centre_z, last_r_ - centre_r);
  std::vector<Pole> poles;
  for (const auto& [dr, dz] :
       {std::pair{1, 0}, std::pair{0, 1}, std::pair{-1, 0}, std::pair{0, -1}}) {
    const Real pr = centre_r + static_cast<Real>(dr) * radius;
    const Real pz = centre_z + static_cast<Real>(dz) * radius;
    const Real after =
        cross(last_r_ - centre_r, last_z_ - centre_z, static_cast<Real>(dr), static_cast<Real>(dz));
    const Real before =
        cross(static_cast<Real>(dr), static_cast<Real>(dz), r - centre_r, z - centre_z);
    if (after * turn <= 0 || before * turn <= 0) continue;
    poles.push_back(
        {std::abs(std::remainder(std::atan2(static_cast<Real>(dz), static_cast<Real>(dr)) - start,
                                 8 * std::atan(Real{1}))),
         pr, pz});
  }
  std::sort(poles.begin(), poles.end(),
            [](const Pole& a, const Pole& b) { return a.angle < b.angle; });
  for (const Pole& pole : poles) push(pole.r, pole.z);
  push(r, z);
  return *this;
}

Real Meridian::piece_distance(const Piece& p, Real r, Real z) {
  if (p.arc == 0) {
    const Real dr = p.r1 - p.r0, dz = p.z1 - p.z0;
    const Real t =
        std::clamp(((r - p.r0) * dr + (z - p.z0) * dz) / (dr * dr + dz * dz), Real{0}, Real{1});
    return std::hypot(r - p.r0 - t * dr, z - p.z0 - t * dz);
  }
  const Real vr = r - p.centre_r, vz = z - p.centre_z;
  const Real ar = p.r0 - p.centre_r, az = p.z0 - p.centre_z;
  const Real br = p.r1 - p.centre_r, bz = p.z1 - p.centre_z;
  const Real turn = cross(ar, az, br, bz);
  if (cross(ar, az, vr, vz) * turn >= 0 && cross(vr, vz, br, bz) * turn >= 0) {
    return std::abs(std::hypot(vr, vz) - p.arc);
  }
  return std::min(std::hypot(r - p.r0, z - p.z0), std::hypot(r - p.r1, z - p.z1));
}

// Does the horizontal line outwards from (r, z) cross the piece?
bool Meridian::crosses(const Piece& p, Real r, Real z) {
  if (z < std::min(p.z0, p.z1) || z >= std::max(p.z0, p.z1)) return false;
  if (p.arc == 0) return p.r0 + (z - p.z0) / (p.z1 - p.z0) * (p.r1 - p.r0) > r;
  const Real half =
      std::sqrt(std::max(Real{0}, p.arc * p.arc - (z - p.centre_z) * (z - p.centre_z)));
  return p.centre_r + (p.r0 + p.r1 > 2 * p.centre_r ? half : -half) > r;
}

Real Meridian::distance(Real r, Real z) const {
  // The top face.
  Real nearest = std::hypot(std::max(Real{0}, r - last_r_), z - last_z_);
  bool inside = false;
  for (const Piece& piece : pieces_) {
    nearest = std::min(nearest, piece_distance(piece, r, z));
    if (crosses(piece, r, z)) inside = !inside;
  }
  return inside ? -nearest : nearest;
}

Meridian::Spot Meridian::spot(Real u) const {
  const Real place = u * static_cast<Real>(pieces_.size());
  const auto i = std::min(pieces_.size() - 1, static_cast<std::size_t>(place));
  const Piece& p = pieces_[i];
  const Real t = place - static_cast<Real>(i);
  Real r = p.r0 + t * (p.r1 - p.r0), z = p.z0 + t * (p.z1 - p.z0);
  if (p.arc != 0) {
    const Real length = std::hypot(r - p.centre_r, z - p.centre_z);
    r = p.centre_r + (r - p.centre_r) * p.arc / length;
    z = p.centre_z + (z - p.centre_z) * p.arc / length;
  }
  return {r, z};
}

StandingMotion::StandingMotion(const kinematics::ToolPose& from, const kinematics::ToolPose& to)
    : tip(from.tip.cast<Real>()),
      travel(to.tip.cast<Real>() - from.tip.cast<Real>()),
      axis(from.axis.cast<Real>().normalized()),
      across(Vec3L::Zero()),
      turn(0) {
  const Vec3L end = to.axis.cast<Real>().normalized();
  const Vec3L aside = end - end.dot(axis) * axis;
  // Axes that differ by the rounding of a unit vector are one axis.
  if (aside.norm() < 1e-15L) return;
  turn = std::atan2(aside.norm(), end.dot(axis));
  across = aside.normalized();
}

Real StandingMotion::distance(const Meridian& body, const Vec3L& point, Real t) const {
  const Vec3L a = std::cos(turn * t) * axis + std::sin(turn * t) * across;
  const Vec3L m = point - tip - t * travel;
  const Real z = m.dot(a);
  return body.distance((m - z * a).norm(), z);
}

StandingCutters::StandingCutters(Meridian body, bool is_convex, const kinematics::ToolPath& path)
    : body_(std::move(body)), is_convex_(is_convex) {
  for (const kinematics::PathSegment& segment : path.segments) {
    motions_.emplace_back(path.from(segment), path.to(segment));
  }
}

struct StandingCutters::Search {
  Search(const StandingCutters& standing, const Vec3L& at, Real interest, Real enough)
      : all(standing), point(at), of_interest(interest), deep_enough(enough) {}
  const StandingCutters& all;
  const Vec3L& point;
  Real of_interest;
  Real deep_enough;
  Real best = kInfinity;

  void over(const StandingMotion& motion) {
    const Real reach =
        std::max((point - motion.tip).norm(), (point - motion.tip - motion.travel).norm());
    const Real straight = motion.travel.norm();
    speed_ = straight + reach * motion.turn;
    bend_ = 2 * motion.turn * straight + motion.turn * motion.turn * reach;
    motion_ = &motion;
    halve(0, 1, at(0), at(1));
  }

 private:
  Real at(Real t) {
    const Real value = motion_->distance(all.body_, point, t);
    best = std::min(best, value);
    return value;
  }

  // The least value between a and b can be no lower than this, from values at both ends and
  // between.
  [[nodiscard]] Real bound(Real span, Real fa, Real fm, Real fb) const {
    const Real by_speed = (std::min(fa, fb) + fm) / 2 - speed_ * span / 4;
    if (!all.is_convex_) return by_speed;
    // Along a straight way the distance to a convex body is a convex function; the true way bends
    // off it.
    const Real off = bend_ * span * span / 8;
    return std::max(by_speed, std::min({fm, 2 * fm - fa, 2 * fm - fb}) - 3 * off);
  }

  void halve(Real a, Real b, Real fa, Real fb) {
    if (best < deep_enough) return;
    const Real m = (a + b) / 2;
    const Real fm = at(m);
    if (bound(b - a, fa, fm, fb) > std::min(best - kIndifferent, of_interest)) return;
    const Real motion = speed_ * (b - a) / 2;
    if (motion < 1e-11L) return;
    // A wall that slides along itself: three equal distances within a twentieth of a millimetre.
    if (!all.is_convex_ && motion < kSliding &&
        std::max(std::abs(fm - fa), std::abs(fm - fb)) < kEqual)
      return;
    if (!all.is_convex_ && motion < kStep) {
      // A valley between the ends, or one that begins at the lower of them.
      const Real hair = kHair * (b - a);
      if (fm <= fa && fm <= fb) {
        descend(a, b);
      } else if (fa < fb ? at(a + hair) < fa : at(b - hair) < fb) {
        fa < fb ? descend(a, m) : descend(m, b);
      }
      return;
    }
    if (fa <= fb) {
      halve(a, m, fa, fm);
      halve(m, b, fm, fb);
    } else {
      halve(m, b, fm, fb);
      halve(a, m, fa, fm);
    }
  }

  // Golden section in one valley.
  void descend(Real a, Real b) {
    constexpr Real kGolden = 0.6180339887498948482L;
    Real x1 = b - kGolden * (b - a), x2 = a + kGolden * (b - a);
    Real f1 = at(x1), f2 = at(x2);
    while (speed_ * (b - a) > kIndifferent) {
      if (f1 < f2) {
        b = x2, x2 = x1, f2 = f1, x1 = b - kGolden * (b - a), f1 = at(x1);
      } else {
        a = x1, x1 = x2, f1 = f2, x2 = a + kGolden * (b - a), f2 = at(x2);
      }
    }
  }

  const StandingMotion* motion_ = nullptr;
  Real speed_ = 0;
  Real bend_ = 0;
};

Real StandingCutters::depth(const Vec3L& point, Real of_interest, Real deep_enough) const {
  Search search(*this, point, of_interest, deep_enough);
  for (const StandingMotion& motion : motions_) search.over(motion);
  return search.best;
}

}  // namespace frustum::proof
