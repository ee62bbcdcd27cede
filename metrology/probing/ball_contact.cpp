#include "metrology/probing/ball_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/golden_section.hpp"

namespace frustum::metrology {
namespace {

// Travels that are apart by less are the same (mm): to smooth surfaces, and where surfaces that
// scatter meet, such as the ends of sweeps.
constexpr double kSame = 1e-12;
constexpr double kScatter = 4e-10;

class Descent {
 public:
  Descent(const SurfaceProbeRef& part, const BallApproach& approach)
      : part_(part),
        approach_(approach),
        start_(approach.target +
               (approach.ball_radius + approach.clearance) * approach.outward.vec()) {}

  // How far the centre travels until the ball's point in direction -m meets the surface.
  std::optional<Touch> ray(const Vec3& m) {
    const Vec3 from = start_ - approach_.ball_radius * m;
    auto touch = part_.touch(from, -approach_.outward, approach_.clearance + approach_.reach);
    if (!touch) return std::nullopt;
    last_ = (from - touch->point).dot(approach_.outward.vec());
    before_ = std::exchange(latest_, {m, *touch});
    if (last_ < travel_) {
      travel_ = last_;
      resting_on_ = *touch;
    }
    return touch;
  }
  [[nodiscard]] double last() const { return last_; }
  [[nodiscard]] BallContact contact() const {
    BallContact found{ContactState::contact, start_ - travel_ * approach_.outward.vec(),
                      resting_on_};
    found.touch.normal = (found.centre - found.touch.point).normalized();
    return found;
  }

  // Whether the ball rests on an edge whose two sides the last two rays have met. Along the arc
  // between both directions the travel falls to the edge and rises after it; the planes that rays
  // touch say where that is. A ray on each side as long as its plane says proves it.
  bool search_edge() {
    const Arc arc(before_.m, latest_.m);
    Cut falling = cut(arc, 0.0, before_.touch), rising = cut(arc, arc.length, latest_.touch);
    if (!falling.falls || rising.falls) return false;
    bool falling_holds = false, rising_holds = false;
    constexpr double kBeside = 1e-3;  // of the way to the next ray on a side
    double beside = kBeside;
    constexpr int kMost = 24;
    for (int i = 0; i < kMost; ++i) {
      double angle = crossing(arc, falling, rising);
      if (!(falling.angle <= angle && angle <= rising.angle))
        angle = 0.5 * (falling.angle + rising.angle);
      if (falling_holds) angle += beside * (rising.angle - angle);
      if (rising_holds) angle -= beside * (angle - falling.angle);
      const auto touch = ray(arc.at(angle));
      if (!touch) return false;
      const Cut next = cut(arc, angle, *touch);
      Cut& side = next.falls ? falling : rising;
      bool& side_holds = next.falls ? falling_holds : rising_holds;
      const bool holds = std::abs(last_ - travel_to(side, arc.at(angle))) < kScatter;
      beside = holds && side_holds ? 8.0 * beside : kBeside;  // the same side once more
      if (!holds) falling_holds = rising_holds = false;
      side_holds = holds;
      side = next;
      if (falling_holds && rising_holds) return true;
      const double apart = (rising.slope - falling.slope).norm();
      if (approach_.ball_radius * apart * (rising.angle - falling.angle) < kScatter) return true;
    }
    return false;
  }

  // The part of the travel that no ray has shortened yet, along the arc from a to b.
  void search_arc(const Vec3& a, const Vec3& b) {
    const auto travel_at = [&](const Vec3& m) {
      return ray(m.normalized()) ? last_ : approach_.clearance + approach_.reach;
    };
    // 40 steps shrink an arc of 1 rad to 4e-9 rad; near the minimum the travel then is exact to
    // rounding.
    static_cast<void>(golden_section([&](double share) { return travel_at(a + share * (b - a)); },
                                     0.0, 1.0, 0.0, 40));
  }

 private:
  struct Shot {
    Vec3 m = Vec3::Zero();
    Touch touch{};
  };
  // Of directions, from a to b.
  struct Arc {
    Arc(const Vec3& a, const Vec3& b)
        : from(a.normalized()),
          across((b - from.dot(b) * from).normalized()),
          length(std::atan2(across.dot(b), from.dot(b))) {}
    [[nodiscard]] Vec3 at(double angle) const {
      return std::cos(angle) * from + std::sin(angle) * across;
    }
    Vec3 from, across;
    double length;
  };
  // The plane that a ray of an arc touched: the travel to it is offset - r m . slope.
  struct Cut {
    double angle, offset;
    Vec3 slope;
    bool falls;  // the travel, along the arc
  };

  [[nodiscard]] Cut cut(const Arc& arc, double angle, const Touch& touch) const {
    const Vec3 slope = touch.normal / approach_.outward.vec().dot(touch.normal);
    const Vec3 onward = std::cos(angle) * arc.across - std::sin(angle) * arc.from;
    return {angle, (start_ - touch.point).dot(slope), slope, slope.dot(onward) > 0.0};
  }
  [[nodiscard]] double travel_to(const Cut& cut, const Vec3& m) const {
    return cut.offset - approach_.ball_radius * m.dot(cut.slope);
  }
  // Where the travel to the rising plane overtakes; not a number where it never does.
  [[nodiscard]] double crossing(const Arc& arc, const Cut& falling, const Cut& rising) const {
    const Vec3 apart = rising.slope - falling.slope;
    const double along = arc.from.dot(apart), beside = arc.across.dot(apart);
    const double cosine =
        (rising.offset - falling.offset) / (approach_.ball_radius * std::hypot(along, beside));
    return std::atan2(beside, along) + std::acos(cosine);
  }

  const SurfaceProbeRef& part_;
  const BallApproach& approach_;
  Vec3 start_;
  Shot before_{}, latest_{};  // the last two that met something
  double last_ = 0.0;
  double travel_ = HUGE_VAL;
  Touch resting_on_{};
};

// The ray from farther out tells a start inside the material from a surface out of reach. In a bore
// it meets the wall opposite: that one is seen from the start, too, if the start is in the open.
BallContact why_missed(const SurfaceProbeRef& part, const BallApproach& approach) {
  constexpr double kFarther = 1000.0;  // mm: outside any part that fits a machine
  const UnitVec3& outward = approach.outward;
  const Vec3 start = approach.target + approach.clearance * outward.vec();
  const bool is_under_surface =
      part.touch(start + kFarther * outward.vec(), -outward, kFarther).has_value();
  if (is_under_surface && !part.touch(start, outward, kFarther)) {
    return {.state = ContactState::starts_inside};
  }
  BallContact missed{.state = ContactState::no_surface};
  if (const auto past = part.touch(start, -outward, kFarther)) {
    missed.surface_past = (approach.target - past->point).dot(outward.vec());
  }
  return missed;
}

}  // namespace

BallContact touch_with_ball(const SurfaceProbeRef& part, const BallApproach& approach) {
  Descent descent(part, approach);
  // A direction off by d changes the centre by r d^2: the bound keeps that below kSame.
  const double close = std::sqrt(kSame / approach.ball_radius);
  const double blunt = std::sqrt(kScatter / approach.ball_radius);
  std::array<Vec3, 3> continuation{approach.outward, approach.outward, approach.outward};
  constexpr int kMost = 30;  // extrapolation every third step makes it two or three rounds
  for (int i = 0; i < kMost; ++i) {
    const auto touch = descent.ray(continuation[2]);
    if (!touch) {
      if (i == 0) return why_missed(part, approach);
      break;  // a shifted ray left the part: the ball rests on its edge
    }
    const Vec3 next = touch->normal;
    const double turn = (next - continuation[2]).norm();
    // An edge that turns by so little is none.
    if (turn < close || (i > 2 && turn < blunt)) return descent.contact();
    continuation = {continuation[1], continuation[2], next};
    if (i % 3 != 2) continue;
    // Linear convergence has a constant ratio; sum the rest of the series.
    const Vec3 before = continuation[1] - continuation[0];
    const Vec3 after = continuation[2] - continuation[1];
    const double ratio = after.dot(before) / std::max(before.squaredNorm(), 1e-300);
    if (std::abs(ratio) < 0.98)
      continuation[2] = (continuation[2] + ratio / (1.0 - ratio) * after).normalized();
    if ((i > 2 || ratio <= -0.98) && descent.search_edge()) return descent.contact();
  }
  descent.search_arc(continuation[1], continuation[2]);
  return descent.contact();
}

}  // namespace frustum::metrology
