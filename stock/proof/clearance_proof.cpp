#include "stock/proof/clearance_proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace frustum::stock {
namespace {

// Beyond the rounding of any double computation here, for coordinates below 1e5 mm.
constexpr double kClearanceRounding = 1e-9;  // mm
constexpr double kLargest = 1e5;             // mm
// A halved direction is off by the rounding of a sum, a norm and a quotient: below 4 units of
// 1.1e-16.
constexpr double kHalving = 1e-15;
// Halving goes on no deeper than instants can be separated.
constexpr int kDeepest = 48;

// Radius and height of a point in the tool's terms, and the direction across.
struct InTool {
  double r, z;
  Vec3 side;
};
InTool in_tool(const Vec3& tip, const Vec3& axis, const Vec3& point) {
  const Vec3 m = point - tip;
  const double z = m.dot(axis);
  const Vec3 across = m - z * axis;
  const double r = across.norm();
  return {r, z, r > 0.0 ? Vec3(across / r) : perpendicular_to(axis)};
}

// One end or the middle of a span: where a supporting plane is put.
struct Place {
  double t;
  double x;  // -1, 0, 1 in the span
  UnitBall axis;
};

// The greatest length of a vector in the enclosure.
double longest(const Enclosure3& v) { return length(v).upper(); }

class ZoneProof {
 public:
  ZoneProof(const BodyGeneratrix& body, const MeridianZone& zone, const Vec3& point, double margin,
            std::size_t most_spans)
      : body_(body), zone_(zone), point_(point), margin_(margin), most_(most_spans) {}

  [[nodiscard]] ClearanceProof over(const PoseSpan& segment) {
    std::vector<std::pair<PoseSpan, int>> open{{segment, 0}};
    ClearanceProof answer;
    while (!open.empty()) {
      const auto [span, depth] = open.back();
      open.pop_back();
      if (++answer.spans > most_) {
        answer.clearance = Clearance::open;
        return answer;
      }
      const auto covered = look_at(span);
      if (apart_) continue;
      if (covered) {
        answer.clearance = Clearance::covered;
        answer.t = *covered;
        return answer;
      }
      if (depth >= kDeepest) {
        answer.clearance = Clearance::open;
        answer.t = span.middle();
        return answer;
      }
      open.push_back({span.second_half(), depth + 1});
      open.push_back({span.first_half(), depth + 1});
    }
    return answer;
  }

 private:
  // Sets apart_; returns an instant when the body covers the point, if one of those looked at is.
  std::optional<double> look_at(const PoseSpan& span) {
    apart_ = false;
    const UnitBall axis = halfway(span.axis0, span.axis1);
    std::array<Place, 3> places{Place{span.middle(), 0.0, axis}, Place{span.t0, -1.0, span.axis0},
                                Place{span.t1, 1.0, span.axis1}};
    std::array<double, 3> distances{};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3 tip = span.tip(places[i].t);
      const InTool at = in_tool(tip, places[i].axis.middle, point_);
      const auto touching = zone_.touching(at.r, at.z);
      distances[i] = touching ? touching->distance : -1.0;
      if (distances[i] > margin_) continue;
      if (distance_from(body_, tip, places[i].axis.middle, point_) <= margin_) return places[i].t;
    }
    if (!body_.filled && too_far_to_come(span, places[0])) {
      apart_ = true;
      return std::nullopt;
    }
    // The nearest first: what moves away from there is done with at once.
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
    for (const std::size_t i : order) {
      if (distances[i] <= margin_) continue;
      apart_ = plane_clears(span, places[i]);
      if (apart_) break;
    }
    return std::nullopt;
  }

  // The whole body, concave faces included: the distance changes by no more than its points move.
  [[nodiscard]] bool too_far_to_come(const PoseSpan& span, const Place& middle) const {
    const double half_way = 0.5 * (span.t1 - span.t0) * (span.end - span.begin).norm();
    // No point of a cutter that turns by an angle moves more than that times its reach; the chord
    // is shorter than the arc by less than an eighth up to a radian and a half.
    const double chord = (span.axis1.middle - span.axis0.middle).norm();
    if (chord > 1.0) return false;
    const double turned = 0.5 * chord * 1.125 * body_.generatrix->reach();
    const double distance = distance_from(body_, span.tip(middle.t), middle.axis.middle, point_);
    return distance - margin_ > half_way + turned + kClearanceRounding;
  }

  [[nodiscard]] bool plane_clears(const PoseSpan& span, const Place& place) const {
    const InTool at = in_tool(span.tip(place.t), place.axis.middle, point_);
    const auto touching = zone_.touching(at.r, at.z);
    if (!touching) return false;
    const Enclosure3 axis = place.axis.enclosure();
    const Enclosure3 side = enclose(at.side);
    const Enclosure3 m = enclose(point_) - span.enclosed_tip(place.t);
    const Enclosure across = touching->across, along = touching->along;
    const Enclosure3 n = across * side + along * axis;
    // `side` is a unit vector across the axis but for rounding: what that may add to the support.
    const Enclosure lean = boost::numeric::abs(dot(side, axis)) * zone_.largest_height();
    const Enclosure longer =
        boost::numeric::max(Enclosure(0.0), dot(side, side) - 1.0) * zone_.largest_radius();
    const Enclosure free = dot(n, m) - zone_.support(*touching) - across * (lean + longer);
    if (!(free.lower() > margin_)) return false;

    // Turning vector of half the span: the cross product of the end axes has the sine of twice
    // that.
    const Enclosure3 ends = cross(span.axis0.enclosure(), span.axis1.enclosure());
    const double chord = (span.axis1.middle - span.axis0.middle).norm() + span.axis0.radius +
                         span.axis1.radius + kHalving;
    if (chord > 0.8) return false;
    // angle <= chord (1 + chord^2 / 20) and angle / sin(angle) <= 1 + angle^2 / 5, both below 1
    // rad.
    const double angle = chord * (1.0 + 0.05 * chord * chord);
    const Enclosure3 turn =
        Enclosure(0.5, 0.5 * (1.0 + 0.2 * angle * angle) * (1.0 + 1e-15)) * ends;
    const Enclosure3 step =
        (0.5 * (Enclosure(span.t1) - span.t0)) * (enclose(span.end) - enclose(span.begin));
    const Enclosure slope = dot(cross(turn, n), m) - dot(n, step);

    const double w = std::min(longest(turn), 0.5 * angle * (1.0 + 1e-12) + 1e-14);
    const double v = longest(step), reach = longest(m);
    const auto stays = [&](double x) {
      const Enclosure X = x, far = std::abs(x);
      const Enclosure bend =
          Enclosure(0.5) * w * w * (Enclosure(reach) + far * v) + Enclosure(w) * v;
      // The plane's normal is a unit vector within rounding.
      return (free + X * slope - X * X * bend * Enclosure(1.0, 1.0 + 1e-9)).lower() > margin_;
    };
    // Concave to either side, so that the ends are the worst.
    return (place.x == -1.0 || stays(-1.0 - place.x)) && (place.x == 1.0 || stays(1.0 - place.x));
  }

  const BodyGeneratrix& body_;
  const MeridianZone& zone_;
  const Vec3& point_;
  double margin_;
  std::size_t most_;
  bool apart_ = false;
};

bool small_enough(const PoseSpan& segment, const Vec3& point) {
  const double largest = std::max({segment.begin.cwiseAbs().maxCoeff(),
                                   segment.end.cwiseAbs().maxCoeff(), point.cwiseAbs().maxCoeff()});
  return largest < kLargest;  // and a number
}

}  // namespace

UnitBall UnitBall::of(const Vec3& axis) {
  return {axis, std::abs(axis.squaredNorm() - 1.0) + kHalving};
}

UnitBall halfway(const UnitBall& a, const UnitBall& b) {
  const Vec3 sum = a.middle + b.middle;
  const double moved = a.radius + b.radius;
  const double length = sum.norm();
  // Of a vector of that length the direction turns by no more than it is moved over what is left.
  if (!(length > 2.0 * moved)) return {a.middle, 2.0};
  return {sum / length, moved / (length - moved) * (1.0 + 1e-12) + kHalving};
}

PoseSpan PoseSpan::of(const kinematics::ToolPose& from, const kinematics::ToolPose& to) {
  return {from.tip, to.tip, 0.0, 1.0, UnitBall::of(from.axis), UnitBall::of(to.axis)};
}

PoseSpan PoseSpan::first_half() const {
  return {begin, end, t0, middle(), axis0, halfway(axis0, axis1)};
}
PoseSpan PoseSpan::second_half() const {
  return {begin, end, middle(), t1, halfway(axis0, axis1), axis1};
}

Enclosure3 PoseSpan::enclosed_tip(double t) const {
  return enclose(begin) + Enclosure(t) * (enclose(end) - enclose(begin));
}

double distance_from(const BodyGeneratrix& body, const Vec3& tip, const Vec3& axis,
                     const Vec3& point) {
  const InTool at = in_tool(tip, axis, point);
  return body.generatrix->distance(at.r, at.z);
}

bool surely_inside(const BodyGeneratrix& body, const PoseSpan& segment, double t, const Vec3& point,
                   double margin) {
  if (!small_enough(segment, point)) return false;
  PoseSpan span = segment;
  for (int depth = 0; depth < kDeepest && span.t0 != t && span.t1 != t; ++depth) {
    span = t < span.middle() ? span.first_half() : span.second_half();
  }
  const bool at_end = span.t1 == t;
  const Enclosure3 axis = (at_end ? span.axis1 : span.axis0).enclosure();
  const Enclosure3 m = enclose(point) - span.enclosed_tip(at_end ? span.t1 : span.t0);
  const Enclosure z = dot(m, axis);
  const Enclosure r = length(m - z * axis);
  // The distance changes by no more than radius and height do; Generatrix promises 1e-12 mm.
  const double middle = body.generatrix->distance(median(r), median(z));
  return middle + width(r) + width(z) + 1e-12 < -margin;
}

ClearanceProof prove_clearance(const BodyGeneratrix& body, const PoseSpan& segment,
                               const Vec3& point, double margin, std::size_t most_spans) {
  ClearanceProof all;
  if (!small_enough(segment, point)) {
    all.clearance = Clearance::open;
    return all;
  }
  for (const MeridianZone& zone : body.zones) {
    ZoneProof proof(body, zone, point, margin, most_spans - std::min(most_spans, all.spans));
    const ClearanceProof one = proof.over(segment);
    all.spans += one.spans;
    if (one.clearance == Clearance::apart) continue;
    all.clearance = one.clearance;
    all.t = one.t;
    return all;
  }
  return all;
}

}  // namespace frustum::stock
