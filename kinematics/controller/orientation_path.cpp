#include "kinematics/controller/orientation_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "core/constants.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::kinematics {
namespace {

constexpr double kPi = std::numbers::pi;
// Two tool axes nearer than this are one: a step below the rounding of the direction.
constexpr double kNoTurn = 1e-12;  // rad
// Two tool axes this near to opposite leave the plane of their great circle to rounding.
constexpr double kOpposite = 1e-6;  // rad
// As in the inverse: directions are written to nine digits or so.
constexpr double kReachSlack = 1e-8;  // rad

double distance(const RotaryAngles& a, const RotaryAngles& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
}

bool all_within(const RotaryAxes& axes, const RotaryAngles& q) {
  for (std::size_t i = 0; i < axes.count(); ++i) {
    if (!within_travel(axes.joint(i), q[i])) return false;
  }
  return true;
}

Diagnostic beyond_travel(const RotaryAxes& axes, const RotaryAngles& q) {
  std::string text;
  for (std::size_t i = 0; i < axes.count(); ++i) {
    const Joint& joint = axes.joint(i);
    if (within_travel(joint, q[i])) continue;
    text += fmt::format("{}{} = {:.4f} deg, travel {:g} .. {:g}", text.empty() ? "" : "; ",
                        to_char(joint.letter), q[i] * kDegPerRad, joint.travel.lo * kDegPerRad,
                        joint.travel.hi * kDegPerRad);
  }
  return error("axis-over-travel"_id, "over-travel: " + text,
               "turn the workpiece on the table, or begin from the other axis solution");
}

}  // namespace

Result<AxisPositions> nearest_orientation(const Machine& machine, const AxisPositions& from,
                                          const Vec3& to_tool_axis, double pole_tolerance) {
  const RotaryAxes axes(machine);
  const Vec3 u = to_tool_axis.normalized();
  const auto solutions = axes.solve(u);
  if (!solutions) return solutions.error();
  const RotaryAngles now = axes.angles(from);
  if (axes.count() == 2 && axes.triangle(u).from_pole < pole_tolerance) {
    const RotaryAngles held{now[0],
                            best_turn(axes.joint(1), axes.second_for(u, now[0], now[1]), now[1])};
    if (all_within(axes, held)) return axes.with(from, held);
  }
  RotaryAngles best{};
  double least = std::numeric_limits<double>::infinity();
  bool within = false;
  for (const OrientationSolution& s : *solutions) {
    RotaryAngles q = now;
    for (std::size_t i = 0; i < axes.count(); ++i) {
      if (!s.free[i]) q[i] = best_turn(axes.joint(i), s.angle[i], now[i]);
    }
    const bool q_within = all_within(axes, q);
    // 1e-9: a tie within rounding keeps the order of the closed form.
    if ((q_within && !within) || (q_within == within && distance(q, now) < least - 1e-9)) {
      best = q;
      least = distance(q, now);
      within = q_within;
    }
  }
  if (!within) return beyond_travel(axes, best);
  return axes.with(from, best);
}

Vec3 OrientationPath::axis_at(double arc) const {
  return std::cos(arc) * start_ + std::sin(arc) * tangent_;
}

Vec3 OrientationPath::tool_axis(double t) const { return axis_at(t * arc_); }

RotaryAngles OrientationPath::angles(const Piece& piece, double arc) const {
  if (arc == piece.start || axes_.count() == 0) return piece.at_start;
  const Vec3 u = axis_at(arc);
  if (axes_.count() == 1) return {piece.at_start[0] + (arc - piece.start) * piece.sign, 0.0};
  if (piece.in_cone) {
    const double part = (arc - piece.start) / (piece.end - piece.start);
    const double first = piece.at_start[0] + part * (piece.at_end[0] - piece.at_start[0]);
    return {first, axes_.second_for(u, first, piece.at_start[1])};
  }
  const RotaryTriangle now = axes_.triangle(u);
  double turned = std::remainder(now.azimuth - piece.triangle.azimuth, kTurn);
  // Less than half a great circle turns the azimuth by less than pi, always in one sense; beside
  // the pole the remainder cannot tell which.
  const double sense = axes_.first_axis().dot(start_.cross(tangent_)) < 0.0 ? -1.0 : 1.0;
  if (turned * sense < -1.0) turned += sense * kTurn;
  return {piece.at_start[0] + turned - piece.sign * (now.psi - piece.triangle.psi),
          piece.at_start[1] - piece.sign * (now.eta - piece.triangle.eta)};
}

AxisPositions OrientationPath::at(double t) const {
  if (t <= 0.0) return from_;
  const double arc = std::min(t, 1.0) * arc_;
  const auto piece =
      std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return arc <= p.end; });
  return axes_.with(from_, angles(piece == pieces_.end() ? pieces_.back() : *piece, arc));
}

// Cuts the great circle at the pole's cone and chains the parts.
class OrientationPathMaker {
 public:
  OrientationPathMaker(const Machine& machine, const AxisPositions& from, double pole_tolerance)
      // A cone that rounding can still see, even if none was asked for.
      : tolerance_(std::max(pole_tolerance, 10.0 * kPole)), path_(machine) {
    path_.from_ = from;
  }

  Result<OrientationPath> make(const Vec3& to) {
    const RotaryAxes& axes = path_.axes_;
    const RotaryAngles now = axes.angles(path_.from_);
    path_.start_ = axes.tool_axis(now);
    if (const auto end = axes.solve(to); !end) return end.error();
    path_.arc_ = angle_between(path_.start_, to);
    if (path_.arc_ < kNoTurn || axes.count() == 0) {
      path_.arc_ = 0.0;
      path_.pieces_.push_back({.at_start = now, .at_end = now});
      return path_;
    }
    if (path_.arc_ > kPi - kOpposite) {
      return error("off-great-circle"_id,
                   "the tool axis is to turn to the opposite direction: no great circle is given",
                   "put a tool axis between the two");
    }
    path_.tangent_ = path_.start_.cross(to).cross(path_.start_).normalized();
    if (axes.count() == 1) return with_one_axis(now);
    along_first_axis_ =
        std::atan2(axes.first_axis().dot(path_.tangent_), axes.first_axis().dot(path_.start_));
    beside_pole_ = axes.first_axis().dot(path_.start_.cross(path_.tangent_));
    if (const auto off = out_of_reach()) return *off;
    chain(now);
    if (!all_within(axes, last())) return beyond_travel(axes, last());
    mark_breaks();
    return path_;
  }

 private:
  using Piece = OrientationPath::Piece;
  struct Cone {
    double start = 0.0, end = 0.0;  // rad along the great circle
  };

  [[nodiscard]] const RotaryAngles& last() const { return path_.pieces_.back().at_end; }
  // Where the great circle comes nearest to the first axis's line, both ends of it.
  [[nodiscard]] std::array<double, 2> nearest_points() const {
    const double other =
        along_first_axis_ > 0.0 ? along_first_axis_ - kPi : along_first_axis_ + kPi;
    return {std::min(along_first_axis_, other), std::max(along_first_axis_, other)};
  }

  Result<OrientationPath> with_one_axis(const RotaryAngles& now) {
    const RotaryAxes& axes = path_.axes_;
    const Vec3 normal = path_.start_.cross(path_.tangent_);
    if (angle_between(normal, axes.first_axis()) > kReachSlack &&
        angle_between(normal, -axes.first_axis()) > kReachSlack) {
      return error("unreachable-orientation"_id,
                   fmt::format("the great circle leaves the cone that the one rotary axis {} "
                               "turns the tool through",
                               to_char(axes.joint(0).letter)),
                   "turn the rotary axis linearly instead");
    }
    Piece piece{.end = path_.arc_,
                .sign = normal.dot(axes.first_axis()) < 0.0 ? -1.0 : 1.0,
                .at_start = now};
    piece.at_end = {now[0] + piece.sign * path_.arc_, 0.0};
    path_.pieces_.push_back(piece);
    if (!all_within(axes, last())) return beyond_travel(axes, last());
    return path_;
  }

  // The ends are in reach; what is between has its extreme where it passes the first axis.
  [[nodiscard]] std::optional<Diagnostic> out_of_reach() const {
    for (const double arc : nearest_points()) {
      if (arc <= 0.0 || arc >= path_.arc_) continue;
      const Vec3 u = path_.axis_at(arc);
      if (const double off = path_.axes_.shortfall(u); off > kReachSlack) {
        return error("unreachable-orientation"_id,
                     fmt::format("on the great circle the tool axis would leave the reach of the "
                                 "rotary axes by {:.6f} deg",
                                 off * kDegPerRad),
                     "turn the rotary axes linearly instead, or put a tool axis between the two");
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Cone> cones() const {
    std::vector<Cone> cones;
    const double outside = std::sin(tolerance_);
    if (std::abs(beside_pole_) >= outside) return cones;
    const double half = std::asin(std::sqrt((outside - beside_pole_) * (outside + beside_pole_)) /
                                  std::sqrt(1.0 - beside_pole_ * beside_pole_));
    for (const double centre : nearest_points()) {
      const Cone cone{std::max(centre - half, 0.0), std::min(centre + half, path_.arc_)};
      if (cone.start < cone.end) cones.push_back(cone);
    }
    return cones;
  }

  void chain(const RotaryAngles& now) {
    const auto all = cones();
    RotaryAngles q = now;
    double arc = 0.0, sign = path_.axes_.sign_at(now);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].start > arc) q = add_regular(arc, all[i].start, sign, q);
      arc = all[i].end;
      const double next = i + 1 < all.size() ? all[i + 1].start : path_.arc_;
      std::tie(q, sign) = add_cone(all[i], q, next);
    }
    if (arc < path_.arc_) add_regular(arc, path_.arc_, sign, q);
  }

  [[nodiscard]] Piece regular(double start, double end, double sign, const RotaryAngles& q) const {
    Piece piece{.start = start,
                .end = end,
                .sign = sign,
                .at_start = q,
                .triangle = path_.axes_.triangle(path_.axis_at(start))};
    piece.at_end = path_.angles(piece, end);
    return piece;
  }

  RotaryAngles add_regular(double start, double end, double sign, const RotaryAngles& q) {
    path_.pieces_.push_back(regular(start, end, sign, q));
    return last();
  }

  // Out of the cone on the solution that turns the first axis least and ends within travel.
  std::pair<RotaryAngles, double> add_cone(const Cone& cone, const RotaryAngles& q, double next) {
    const RotaryAxes& axes = path_.axes_;
    Piece piece{.start = cone.start, .end = cone.end, .in_cone = true, .at_start = q};
    const Vec3 u = path_.axis_at(cone.end);
    if (cone.end >= path_.arc_) {
      piece.at_end = {q[0], axes.second_for(u, q[0], q[1])};
      path_.pieces_.push_back(piece);
      return {piece.at_end, 1.0};
    }
    double best_sign = 1.0, least = std::numeric_limits<double>::infinity();
    bool found_within = false;
    const RotaryTriangle triangle = axes.triangle(u);
    for (const double sign : {+1.0, -1.0}) {
      const RotaryAngles out = axes.angles(triangle, sign);
      const double first = nearest_turn(out[0], q[0]), second = nearest_turn(out[1], q[1]);
      for (const double turn : {0.0, kTurn, -kTurn}) {
        const RotaryAngles exit{first + turn, second};
        const double cost = distance(exit, q);
        const bool within =
            all_within(axes, exit) && all_within(axes, regular(cone.end, next, sign, exit).at_end);
        if ((within && !found_within) || (within == found_within && cost < least - 1e-9)) {
          piece.at_end = exit;
          best_sign = sign;
          least = cost;
          found_within = within;
        }
      }
    }
    path_.pieces_.push_back(piece);
    return {piece.at_end, best_sign};
  }

  void mark_breaks() {
    std::vector<double> arcs;
    for (const Piece& piece : path_.pieces_) {
      arcs.push_back(piece.start);
      if (!piece.in_cone) continue;
      const double turn = std::abs(piece.at_end[0] - piece.at_start[0]);
      const int parts = 2 + static_cast<int>(turn / kBreakTurn);
      for (int i = 1; i < parts; ++i) {
        arcs.push_back(piece.start + (piece.end - piece.start) * i / parts);
      }
    }
    // Beside the pole the azimuth goes like atan(arc / distance).
    const double distance_to_pole = std::abs(beside_pole_);
    for (const double centre : nearest_points()) {
      for (int i = -5; i <= 5 && distance_to_pole < kFastTurn; ++i) {
        arcs.push_back(centre + std::atan(std::tan(i * kBreakTurn) * distance_to_pole));
      }
    }
    std::sort(arcs.begin(), arcs.end());
    for (const double arc : arcs) {
      const double t = arc / path_.arc_;
      const double previous = path_.breaks_.empty() ? 0.0 : path_.breaks_.back();
      if (t > previous + kLeastStep && t < 1.0 - kLeastStep) path_.breaks_.push_back(t);
    }
  }

  static constexpr double kBreakTurn = 15.0 * kRadPerDeg;
  // Beyond this sine of the distance the azimuth turns no faster than twice the tool axis.
  static constexpr double kFastTurn = 0.5;
  static constexpr double kLeastStep = 1e-12;  // of t: neighbours that rounding still distinguish

  double tolerance_;
  double along_first_axis_ = 0.0;  // rad along the great circle, nearest to +w1
  double beside_pole_ = 0.0;       // sine of the distance at which it passes, signed
  OrientationPath path_;
};

Result<OrientationPath> orientation_path(const Machine& machine, const AxisPositions& from,
                                         const Vec3& to_tool_axis, double pole_tolerance) {
  return OrientationPathMaker(machine, from, pole_tolerance).make(to_tool_axis.normalized());
}

}  // namespace frustum::kinematics
