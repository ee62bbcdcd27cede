#include "trials/population/edge_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustum::trials {
namespace {

// Points that planes cover by less are not covered (mm): a tenth of what the contact is good for.
constexpr double kCovered = 1e-11;

// A surface near a place: the distance of the place from the cutter, and the way out of it.
struct TangentPlane {
  double gap = 0.0, height = 0.0;
  Vec3 out = Vec3::Zero();
};

TangentPlane plane_at(const LaneFace& face, const PoseParabola& piece, const LanePiece& known,
                      const Vec3& place) {
  // Steps that leave less of the distance than this are the last (mm).
  constexpr double kRest = 1e-12;
  constexpr int kMostSteps = 8;
  double tau = known.tau;
  PointOffFace off;
  for (int i = 0; i < kMostSteps; ++i) {
    off = off_face(face, piece.at(tau), place);
    const double next =
        std::clamp(tau - rate_off_face(face, piece, tau, place, off) / known.bend, 0.0, 1.0);
    const double step = next - tau;
    if (0.5 * known.bend * step * step < kRest) break;
    tau = next;
  }
  return {off.distance, off.height, off.out};
}

// What planes leave of the material, and a ball on it.
class BallOnPlanes {
 public:
  BallOnPlanes(std::span<const TangentPlane> planes, const Vec3& place, const CentreLine& line)
      : planes_(planes), place_(place), line_(line) {
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const double slope = planes[k].out.dot(line.normal);
      const double above = planes[k].gap + planes[k].out.dot(line.touching - place);
      sides_[k] = {slope, -(line.ball + above) / slope};
    }
  }

  struct Rest {
    double travel = 0.0;
    Vec3 touched = Vec3::Zero();
    std::array<std::size_t, 2> on{};  // the same twice: a plane
  };
  [[nodiscard]] std::optional<Rest> rest() const {
    std::size_t deepest = 0;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      if (!(sides_[k].slope < -1e-3)) return std::nullopt;  // hardly in the way
      if (sides_[k].travel < sides_[deepest].travel) deepest = k;
    }
    Rest found = on_plane(deepest);
    for (std::size_t i = 0; i <= planes_.size(); ++i) {
      const auto covering = covering_most(found.touched);
      if (!covering) return found;
      const auto first = on_edge(found.on[0], *covering);
      const auto second = on_edge(found.on[1], *covering);
      if (!first && !second) return std::nullopt;
      const Rest& next = !second || (first && first->travel < second->travel) ? *first : *second;
      if (!(next.travel < found.travel)) return std::nullopt;
      found = next;
    }
    return std::nullopt;
  }

 private:
  struct Side {
    double slope = 0.0, travel = 0.0;  // of the ball on this plane alone
  };

  [[nodiscard]] Vec3 centre(double travel) const { return line_.touching + travel * line_.normal; }
  [[nodiscard]] Rest on_plane(std::size_t k) const {
    const double travel = sides_[k].travel;
    return {travel, centre(travel) + line_.ball * planes_[k].out, {k, k}};
  }
  [[nodiscard]] std::optional<std::size_t> covering_most(const Vec3& point) const {
    std::optional<std::size_t> most;
    double least = -kCovered;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const double off = planes_[k].gap + planes_[k].out.dot(point - place_);
      if (off < least) {
        least = off;
        most = k;
      }
    }
    return most;
  }

  // As lane_contact_kernel.inc has it: both planes are a and b off the centre, and
  // (a^2 + b^2 - 2 a b cos) / sin^2 = ball^2.
  [[nodiscard]] std::optional<Rest> on_edge(std::size_t i, std::size_t k) const {
    const bool is_deeper = sides_[i].travel <= sides_[k].travel;
    const std::size_t deep = is_deeper ? i : k, other = is_deeper ? k : i;
    const double ball = line_.ball;
    const double a = -sides_[deep].slope, b = -sides_[other].slope;
    const double lost = 0.5 * (planes_[deep].out - planes_[other].out).squaredNorm();  // 1 - cos
    const double gap = (sides_[other].travel - sides_[deep].travel) * b;
    const double e = ball * lost - gap;
    if (!(e > 0.0)) return std::nullopt;
    const double half = a * (ball * lost + gap * (1.0 - lost)) + b * e;
    const double square = (a - b) * (a - b) + 2.0 * a * b * lost;
    const double inside = half * half - square * e * e;
    if (!(inside >= 0.0)) return std::nullopt;
    const double deeper = e * e / (half + std::sqrt(inside));
    const double from_deep = ball - deeper * a, from_other = ball - gap - deeper * b;
    const double apart = gap + deeper * (b - a);
    const double sine_squared = lost * (2.0 - lost);
    const double along_deep = (apart + from_other * lost) / sine_squared;
    const double along_other = (from_deep * lost - apart) / sine_squared;
    const double travel = sides_[deep].travel - deeper;
    return Rest{travel,
                centre(travel) + along_deep * planes_[deep].out + along_other * planes_[other].out,
                {deep, other}};
  }

  std::span<const TangentPlane> planes_;
  const Vec3& place_;
  const CentreLine& line_;
  std::array<Side, kMostWindowPieces> sides_{};
};

struct EdgeContact {
  double travel = 0.0;
  Vec3 touched = Vec3::Zero();
};

std::optional<EdgeContact> settled(const EdgeSurroundings& near, const CentreLine& line) {
  // Tangent planes at a place nearer than this (mm) are off by a millionth of a nanometre.
  constexpr double kSame = 2e-6;
  constexpr int kMostTurns = 12;
  const LaneFace& face = near.tables.faces[near.window.face];
  std::array<TangentPlane, kMostWindowPieces> room;
  const std::span<TangentPlane> planes(room.data(), near.pieces.size());
  Vec3 place = line.touching + (near.window.travel - line.ball) * line.normal;
  for (int i = 0; i < kMostTurns; ++i) {
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const LanePiece& known = near.tables.pieces[near.window.first_piece + k];
      planes[k] = plane_at(face, {near.pieces[k]}, known, place);
    }
    const auto rest = BallOnPlanes(planes, place, line).rest();
    if (!rest) return std::nullopt;
    const bool is_settled = (rest->touched - place).norm() < kSame;
    place = rest->touched;
    if (!is_settled) continue;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      // A round face ends where another one goes on; a cone continued holds all of its cutter.
      const bool is_on = k == rest->on[0] || k == rest->on[1];
      const bool is_on_face = planes[k].height > face.z_lo && planes[k].height < face.z_hi;
      if ((is_on || face.is_round) && !is_on_face) return std::nullopt;
    }
    return EdgeContact{rest->travel, place};
  }
  return std::nullopt;
}

bool stretches_keep_away(const EdgeSurroundings& near, const Vec3& touched, double drift) {
  const LaneFace& face = near.tables.faces[near.window.face];
  const auto nearer = [&](double before, const kinematics::ToolPose& end) {
    const PointOffFace off = off_face(face, end, touched);
    return before - off.distance + 0.5 * drift * drift / off.rho;
  };
  for (std::uint32_t i = 0; i < near.window.stretches; ++i) {
    const WindowStretch& stretch = near.tables.stretches[near.window.first_stretch + i];
    const auto its =
        near.pieces.subspan(stretch.first_piece - near.window.first_piece, stretch.pieces);
    if (!keeps_away(stretch.before, near.scale, drift,
                    nearer(stretch.at_first, its.front().front())) ||
        !keeps_away(stretch.after, near.scale, drift, nearer(stretch.at_last, its.back().back()))) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<double> edge_travel(const EdgeSurroundings& near, const CentreLine& line) {
  const auto contact = settled(near, line);
  if (!contact) return std::nullopt;
  const double drift = (contact->touched - carried(near.origin, near.own)).norm();
  const double moved = (contact->touched - near.origin.touched).norm();
  if (!keeps_away(near.window.others, near.scale, drift, moved) ||
      !stretches_keep_away(near, contact->touched, drift)) {
    return std::nullopt;
  }
  return contact->travel;
}

}  // namespace frustum::trials
