#include "cutter/search/sweep_contact.hpp"

#include <boost/container/static_vector.hpp>
#include <cmath>
#include <optional>

#include "cutter/sweep/concave_sweep.hpp"

namespace frustum::cutter {
namespace {

// A direction in the meridian through a point: across the axis, and along it.
struct MeridianNormal {
  double across, along;
};

// Outward normals of the generatrix's pieces that end or pass within rounding of a point on the
// body: the first three of them.
using FewNormals = boost::container::static_vector<MeridianNormal, 3>;
FewNormals normals_at(const Generatrix& generatrix, double r, double z) {
  constexpr double kNear = 1e-7;  // mm
  FewNormals normals;
  const auto add = [&](const GeneratrixSegment& s) {
    if (normals.size() == normals.capacity()) return;
    const MeridianPoint along{s.to.r - s.from.r, s.to.z - s.from.z};
    const double length = std::hypot(along.r, along.z);
    MeridianNormal n{along.z / length, -along.r / length};
    double off = (r - s.from.r) * n.across + (z - s.from.z) * n.along;
    const double share = ((r - s.from.r) * along.r + (z - s.from.z) * along.z) / (length * length);
    if (s.arc_radius > 0.0) {
      const double dr = r - s.centre.r, dz = z - s.centre.z, away = std::hypot(dr, dz);
      if (!(away > 0.0)) return;
      const double outwards = s.bulges ? 1.0 : -1.0;
      n = {outwards * dr / away, outwards * dz / away};
      off = away - s.arc_radius;
    }
    const double beyond = kNear / length;
    if (std::abs(off) <= kNear && share >= -beyond && share <= 1.0 + beyond) normals.push_back(n);
  };
  for (const GeneratrixSegment& s : generatrix.segments()) add(s);
  const MeridianPoint rim = generatrix.segments().back().to;
  if (rim.r > 0.0) add(line(rim, {0.0, rim.z}));
  return normals;
}

// Between the normals of two faces that meet at a rim: across the motion of the rim there, or, if
// that is outside of them, the nearer of both.
std::optional<MeridianNormal> rim_normal(const Generatrix& generatrix, double r, double z,
                                         const MeridianNormal& motion) {
  constexpr double kSmooth = 1e-5;  // rad, where arcs and lines go on into each other
  const FewNormals faces = normals_at(generatrix, r, z);
  if (faces.size() != 2) return std::nullopt;
  const MeridianNormal &a = faces.front(), &b = faces.back();
  const double kink = a.across * b.along - a.along * b.across;
  const double speed = std::hypot(motion.across, motion.along);
  if (!(kink > kSmooth) || !(speed > 0.0)) return std::nullopt;
  const double side =
      motion.across * (a.along + b.along) - motion.along * (a.across + b.across) > 0.0 ? 1.0 : -1.0;
  const MeridianNormal n{-side * motion.along / speed, side * motion.across / speed};
  if (a.across * n.along - a.along * n.across < 0.0) return a;
  if (n.across * b.along - n.along * b.across < 0.0) return b;
  return n;
}

}  // namespace

SweepContact sweep_contact(const Body& body, const SegmentMotion& motion, const Ray& ray,
                           const SweptIntervalEnd& end) {
  const ToolPose pose = motion.at(end.t);
  const Vec3 point = ray.at(end.s);
  Vec3 normal = end.section != kConcaveSurface
                    ? body.sections()[end.section].normal_of(end.face, pose, point)
                    : generatrix_normal(body.generatrix(), pose, point);
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  if (const double r = across.norm(); r > 0.0) {
    const Vec3 side = across / r;
    const Vec3 moving = motion.velocity(point, end.t);
    const auto rim = rim_normal(body.generatrix(), r, z, {moving.dot(side), moving.dot(pose.axis)});
    if (rim) normal = rim->across * side + rim->along * pose.axis;
  }
  return {end.s, end.segment, end.section, end.face, end.t, pose, normal};
}

}  // namespace frustum::cutter
