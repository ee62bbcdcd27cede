#include "metrology/probing/ball_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/golden_section.hpp"
#include "metrology/probing/ball_on_planes.hpp"

namespace frustum::metrology {
namespace {

// Travels that are apart by less are the same (mm).
constexpr double kSame = 1e-12;
// What a part's surface may scatter by, such as the ends of a sweep (mm).
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
    if (approach_.outward.vec().dot(touch->normal) > 0.0) {
      planes_[met_++ % planes_.size()] = {touch->point, touch->normal};
    }
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

  // Whether the ball rests on an edge or a corner between planes that rays have met. Convex
  // material is inside them all, so that a ray to where the ball would rest on them, and that gets
  // as far, proves it. One that gets farther brings another plane; one that gets less far disproves
  // that the material is convex.
  bool search_planes() {
    constexpr int kMost = 6;
    for (int i = 0; i < kMost && met_ > 0; ++i) {
      const auto rest = ball_on_planes({start_, approach_.outward, approach_.ball_radius},
                                       std::span(planes_).first(std::min(met_, planes_.size())));
      if (!ray(rest.toward_centre) || last_ < rest.travel - kScatter) return false;
      if (last_ < rest.travel + kSame) return true;
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
  const SurfaceProbeRef& part_;
  const BallApproach& approach_;
  Vec3 start_;
  std::array<MaterialPlane, 6> planes_{};  // the last that rays met
  std::size_t met_ = 0;                    // planes so far
  double last_ = 0.0;
  double travel_ = HUGE_VAL;
  Touch resting_on_{};
};

// The ray from farther out tells a start inside the material from a surface out of reach.
ContactState why_missed(const SurfaceProbeRef& part, const BallApproach& approach) {
  constexpr double kFarther = 1000.0;  // mm: outside any part that fits a machine
  const Vec3 start = approach.target + (approach.clearance + kFarther) * approach.outward.vec();
  return part.touch(start, -approach.outward, kFarther) ? ContactState::starts_inside
                                                        : ContactState::no_surface;
}

}  // namespace

BallContact touch_with_ball(const SurfaceProbeRef& part, const BallApproach& approach) {
  Descent descent(part, approach);
  // A direction off by d changes the centre by r d^2: the bound keeps that below 1e-12 mm.
  const double close = std::sqrt(kSame / approach.ball_radius);
  std::array<Vec3, 3> continuation{approach.outward, approach.outward, approach.outward};
  constexpr int kMost = 30;  // extrapolation every third step makes it two or three rounds
  for (int i = 0; i < kMost; ++i) {
    const auto touch = descent.ray(continuation[2]);
    if (!touch) {
      if (i == 0) return {.state = why_missed(part, approach)};
      break;  // a shifted ray left the part: the ball rests on its edge
    }
    const Vec3 next = touch->normal;
    if ((next - continuation[2]).norm() < close) {
      return descent.contact();
    }
    continuation = {continuation[1], continuation[2], next};
    if (i % 3 != 2) continue;
    // Linear convergence has a constant ratio; sum the rest of the series.
    const Vec3 before = continuation[1] - continuation[0];
    const Vec3 after = continuation[2] - continuation[1];
    const double ratio = after.dot(before) / std::max(before.squaredNorm(), 1e-300);
    if (std::abs(ratio) < 0.98)
      continuation[2] = (continuation[2] + ratio / (1.0 - ratio) * after).normalized();
    if ((i > 2 || ratio <= -0.98) && descent.search_planes()) return descent.contact();
  }
  descent.search_arc(continuation[1], continuation[2]);
  return descent.contact();
}

}  // namespace frustum::metrology
