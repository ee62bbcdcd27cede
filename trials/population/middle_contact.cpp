#include "trials/population/middle_contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/golden_section.hpp"

namespace frustum::trials {

using kinematics::ToolPose;

std::optional<LaneFace> face_at(const cutter::Body& body, double height, double ball) {
  // From an edge, where another face begins (mm): more than a contact moves along the face by
  // rounding.
  constexpr double kOnEdge = 1e-6;
  if (!body.is_convex()) return std::nullopt;
  for (const cutter::Zone& zone : body.parts().front().zones()) {
    if (height < zone.z_lo + kOnEdge || height > zone.z_hi - kOnEdge) continue;
    LaneFace face;
    face.z_lo = zone.z_lo;
    face.z_hi = zone.z_hi;
    face.radius = zone.radius;
    if (zone.kind == cutter::ZoneKind::cone) {
      face.slope = zone.slope;
      face.cosine = 1.0 / std::sqrt(1.0 + zone.slope * zone.slope);
      face.sine = zone.slope * face.cosine;
      return face;
    }
    face.is_round = true;
    face.major = zone.kind == cutter::ZoneKind::torus ? zone.major : 0.0;
    face.centre = zone.centre;
    if (face.major < 0.0 || face.radius < 1.01 * ball) return std::nullopt;
    return face;
  }
  return std::nullopt;
}

PointOffFace off_face(const LaneFace& face, const ToolPose& pose, const Vec3& point) {
  const Vec3 m = point - pose.tip;
  PointOffFace off;
  off.height = m.dot(pose.axis);
  const Vec3 across = m - off.height * pose.axis;
  off.rho = across.norm();
  double lateral = face.cosine, axial = -face.sine;
  if (face.is_round) {
    const double beside = off.rho - face.major, above = off.height - face.centre;
    const double away = std::hypot(beside, above);
    lateral = beside / away;
    axial = above / away;
    off.distance = away - face.radius;
  } else {
    off.distance = (off.rho - (face.radius + face.slope * (off.height - face.z_lo))) * face.cosine;
  }
  off.out = (lateral / off.rho) * across + axial * pose.axis;
  return off;
}

ToolPose PoseParabola::at(double tau) const {
  const double a = (1.0 - tau) * (1.0 - 2.0 * tau), b = 4.0 * tau * (1.0 - tau),
               c = tau * (2.0 * tau - 1.0);
  return {a * poses[0].tip + b * poses[1].tip + c * poses[2].tip,
          (a * poses[0].axis + b * poses[1].axis + c * poses[2].axis).normalized()};
}

double rate_off_face(const LaneFace& face, const PoseParabola& piece, double tau, const Vec3& point,
                     const PointOffFace& off) {
  const auto rate = [tau](const Vec3& a, const Vec3& b, const Vec3& c) -> Vec3 {
    return (4.0 * tau - 3.0) * a + (4.0 - 8.0 * tau) * b + (4.0 * tau - 1.0) * c;
  };
  const auto& [a, b, c] = piece.poses;
  const ToolPose pose = piece.at(tau);
  const Vec3 m = point - pose.tip;
  const double axial = off.out.dot(pose.axis);
  const double lateral =
      face.is_round ? (off.rho - face.major) / (off.distance + face.radius) : face.cosine;
  return m.dot(rate(a.axis, b.axis, c.axis)) * (axial - lateral * off.height / off.rho) -
         off.out.dot(rate(a.tip, b.tip, c.tip));
}

std::optional<PieceSolution> solve_piece(const LaneFace& face, const PoseParabola& piece,
                                         const CentreLine& line, double travel) {
  const auto off = [&](double tau, double v) {
    return off_face(face, piece.at(tau), line.touching + v * line.normal);
  };
  bool meets = true;
  const auto deepest = [&](double tau) {
    double v = travel;
    for (int i = 0; i < 8; ++i) {
      const PointOffFace at = off(tau, v);
      const double slope = at.out.dot(line.normal);
      if (!(slope < -1e-3)) meets = false;
      v -= (at.distance + line.ball) / slope;
    }
    return v;
  };
  constexpr int kLooks = 8;
  int best = 0;
  double least = deepest(0.0);
  for (int i = 1; i <= kLooks; ++i) {
    const double v = deepest(static_cast<double>(i) / kLooks);
    if (v < least) {
      least = v;
      best = i;
    }
  }
  const double lo = std::max(0.0, (best - 1.0) / kLooks), hi = std::min(1.0, (best + 1.0) / kLooks);
  const GoldenBracket bracket = golden_section(deepest, lo, hi, 1e-7);
  PieceSolution found{bracket.value, bracket.at, 0.0, {}};
  for (const double end : {lo, hi}) {
    if (const double v = deepest(end); v <= found.travel) {
      found.travel = v;
      found.tau = end;
    }
  }
  if (!meets) return std::nullopt;
  // A tenth of a piece sees the bend to the digits that Newton's steps need.
  constexpr double kStep = 0.1;
  found.centre = off(found.tau, found.travel);
  found.bend = (off(found.tau + kStep, found.travel).distance - 2.0 * found.centre.distance +
                off(found.tau - kStep, found.travel).distance) /
               (kStep * kStep);
  return found;
}

Vec3 carried(const ContactOrigin& origin, const PosesOfPiece& own) {
  const ToolPose now = PoseParabola{own}.at(origin.tau);
  const ToolPose& before = origin.pose;
  const Vec3 m = origin.touched - before.tip, turn = now.axis - before.axis;
  return origin.touched + now.tip - before.tip + m.dot(before.axis) * turn -
         m.dot(turn) * before.axis;
}

bool keeps_away(const Closeness& from, double scale, double drift, double nearer) {
  return from.per_scale * scale + from.per_drift * drift + from.per_nearer * std::max(nearer, 0.0) <
         1.0;
}

}  // namespace frustum::trials
