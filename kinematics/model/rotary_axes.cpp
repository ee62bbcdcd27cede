#include "kinematics/model/rotary_axes.hpp"
#include "core/constants.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::kinematics {
namespace {

constexpr double kPi = std::numbers::pi;
// Written programs round directions to nine digits or so; an excess below this is rounding.
constexpr double kReachSlack = 1e-8;  // rad

Vec3 turned(const Vec3& v, const Vec3& about, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  return c * v + s * about.cross(v) + (1.0 - c) * about.dot(v) * about;
}

std::string in_words(const Vec3& u) {
  return fmt::format("({:.6f}, {:.6f}, {:.6f})", u.x(), u.y(), u.z());
}

// Gauss-Newton on the direction.
RotaryAngles polished(const RotaryAxes& rotary, const Vec3& u, RotaryAngles q) {
  const Vec3& w1 = rotary.joint(0).direction;
  for (int step = 0; step < 3; ++step) {
    const Vec3 now = rotary.tool_axis(q);
    Eigen::Matrix<double, 3, 2> jacobian;
    jacobian.col(0) = w1.cross(now);
    jacobian.col(1) = (rotation_about(w1, q[0]) * rotary.joint(1).direction).cross(now);
    // A direction in which the tool axis cannot move (the pole) is left alone by the
    // pseudo-inverse.
    Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 3, 2>> solver;
    solver.setThreshold(kPole);
    solver.compute(jacobian);
    const Eigen::Vector2d change = solver.solve(u - now);
    q[0] += change[0];
    q[1] += change[1];
  }
  return q;
}

}  // namespace

double nearest_turn(double angle, double near) {
  return angle + kTurn * std::round((near - angle) / kTurn);
}

bool within_travel(const Joint& joint, double position) {
  // Half a nanometre or nanoradian: a position on the limit, reached with rounding, counts as
  // within.
  constexpr double kLimitSlack = 5e-10;
  if (joint.endless) return std::abs(position) <= kMostTurned;
  return position >= joint.travel.lo - kLimitSlack && position <= joint.travel.hi + kLimitSlack;
}

double best_turn(const Joint& joint, double angle, double near) {
  const double nearest = nearest_turn(angle, near);
  if (within_travel(joint, nearest)) return nearest;
  const double inside = nearest_turn(angle, std::clamp(near, joint.travel.lo, joint.travel.hi));
  // The nearest turn to a limit may stand just outside it.
  for (const double q : {inside, inside + kTurn, inside - kTurn}) {
    if (within_travel(joint, q)) return q;
  }
  return nearest;
}

double turn_to(const Joint& joint, double word, double near, parser::RotaryPath path) {
  // What a position in degrees with six decimals may be off, and no rotary axis resolves.
  constexpr double kThere = 1e-8;
  switch (path) {
    case parser::RotaryPath::as_programmed:
      return word;
    case parser::RotaryPath::shortest:
      return best_turn(joint, word, near);
    case parser::RotaryPath::positive:
      return near - kThere + std::fmod(std::fmod(word - near + kThere, kTurn) + kTurn, kTurn);
    case parser::RotaryPath::negative:
      return near + kThere - std::fmod(std::fmod(near + kThere - word, kTurn) + kTurn, kTurn);
  }
  return word;
}

RotaryAxes::RotaryAxes(const Machine& machine) {
  // In the order in which they turn the tool axis as seen from the table, each by +q: the work
  // chain from the table inwards, then the tool chain outwards.
  const auto& work = machine.work_chain();
  for (auto joint = work.rbegin(); joint != work.rend(); ++joint) {
    if (joint->rotary()) joints_[count_++] = &*joint;
  }
  for (const Joint& joint : machine.tool_chain()) {
    if (joint.rotary()) joints_[count_++] = &joint;
  }
  const Vec3 v = Vec3::UnitZ();
  if (count_ == 0) return;
  w1_ = joints_[0]->direction;
  if (count_ == 1) {
    across_ = perpendicular_to(w1_);
    normal_ = w1_.cross(across_);
    azimuth_of_v_ = std::atan2(v.dot(normal_), v.dot(across_));
    v_off_axis_ = w1_.cross(v).norm();
    return;
  }
  w2_ = joints_[1]->direction;
  const Vec3 upright = w1_.cross(w2_);
  cos_between_ = w1_.dot(w2_);
  sin_between_ = upright.norm();
  normal_ = upright / sin_between_;
  across_ = normal_.cross(w1_);
  rise_[0] = w2_.dot(v - w1_);
  rise_[1] = w2_.dot(v + w1_);
  const double along = v.dot((w1_ - cos_between_ * w2_) / sin_between_);
  const double beside = -v.dot(normal_);
  azimuth_of_v_ = std::atan2(beside, along);
  v_off_axis_ = std::hypot(beside, along);
  // The closed form loses as many digits as these sines are small: one here, of the three it has to
  // spare.
  needs_polish_ = v_off_axis_ < 0.1 || sin_between_ < 0.1;
}

RotaryAngles RotaryAxes::angles(const AxisPositions& q) const {
  RotaryAngles angles{};
  for (std::size_t i = 0; i < count_; ++i) angles[i] = q[joints_[i]->letter];
  return angles;
}

AxisPositions RotaryAxes::with(AxisPositions q, const RotaryAngles& angles) const {
  for (std::size_t i = 0; i < count_; ++i) q[joints_[i]->letter] = angles[i];
  return q;
}

Vec3 RotaryAxes::tool_axis(const RotaryAngles& q) const {
  Vec3 u = Vec3::UnitZ();
  if (count_ == 2) u = turned(u, w2_, q[1]);
  if (count_ >= 1) u = turned(u, w1_, q[0]);
  return u;
}

RotaryTriangle RotaryAxes::triangle(const Vec3& u) const {
  RotaryTriangle t;
  const double along = u.dot(across_), beside = u.dot(normal_), height = u.dot(w1_);
  t.from_pole = std::sqrt(along * along + beside * beside);
  if (t.from_pole >= kPole) t.azimuth = std::atan2(beside, along);
  // Cosine rule for psi: cos(w2, v) - cos(w1, w2) cos(theta) over the product of the sines.
  const double pole = height < 0.0 ? -1.0 : 1.0;
  const double below = t.from_pole * t.from_pole / (1.0 + std::abs(height));  // 1 - |cos(theta)|
  const double rise = rise_[height < 0.0 ? 1 : 0] + pole * cos_between_ * below;
  const double reach = sin_between_ * t.from_pole;
  t.beyond_reach = std::abs(rise) > reach;
  double cosine = reach > 0.0 ? std::clamp(rise / reach, -1.0, 1.0) : 0.0;
  double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  if (v_off_axis_ < kPole) {  // z is v whatever the second axis does: the triangle is flat
    cosine = cosine < 0.0 ? -1.0 : 1.0;
    sine = 0.0;
  }
  t.psi = std::atan2(sine, cosine);
  t.eta =
      std::atan2(sine * t.from_pole, height * sin_between_ - cos_between_ * t.from_pole * cosine);
  return t;
}

RotaryAngles RotaryAxes::angles(const RotaryTriangle& t, double sign) const {
  return {t.azimuth - sign * t.psi, -sign * t.eta - azimuth_of_v_};
}

double RotaryAxes::second_for(const Vec3& u, double first, double near) const {
  const Vec3 z = turned(u, w1_, -first);
  const double along = z.dot((w1_ - cos_between_ * w2_) / sin_between_);
  const double beside = -z.dot(normal_);
  if (v_off_axis_ < kPole || std::hypot(along, beside) < kPole) return near;
  return nearest_turn(std::atan2(beside, along) - azimuth_of_v_, near);
}

double RotaryAxes::sign_at(const RotaryAngles& q) const {
  return std::sin(q[1] + azimuth_of_v_) > 0.0 ? -1.0 : 1.0;
}

double RotaryAxes::shortfall(const Vec3& u) const {
  const Vec3 v = Vec3::UnitZ();
  if (count_ == 0) return angle_between(u, v);
  const double theta = angle_between(w1_, u);
  if (count_ == 1) return std::abs(theta - angle_between(w1_, v));
  const double to_v = angle_between(w2_, v);
  const double between = angle_between(w1_, w2_);
  const double lowest = std::abs(between - to_v);
  const double highest = std::min(between + to_v, kTurn - between - to_v);
  return std::max(lowest - theta, theta - highest);
}

Result<OrientationSolutions> RotaryAxes::solve(const Vec3& u) const {
  OrientationSolutions solutions;
  if (count_ == 2) {
    const RotaryTriangle t = triangle(u);
    if (t.beyond_reach) {
      if (const double off = shortfall(u); off > kReachSlack) {
        return error("unreachable-orientation"_id,
                     fmt::format("tool direction {} cannot be reached with axes {} and {}: it is "
                                 "{:.6f} deg from the nearest direction they reach",
                                 in_words(u), to_char(joint(0).letter), to_char(joint(1).letter),
                                 off * kDegPerRad),
                     "choose another machine or another setup of the workpiece");
      }
    }
    const bool one = t.from_pole < kPole || v_off_axis_ < kPole || t.psi == 0.0 || t.psi == kPi;
    for (const double sign : {+1.0, -1.0}) {
      if (sign < 0.0 && one) break;
      OrientationSolution s{angles(t, sign), {t.from_pole < kPole, v_off_axis_ < kPole}, sign};
      for (std::size_t i = 0; i < 2; ++i) {
        if (s.free[i]) s.angle[i] = 0.0;
      }
      if (needs_polish_ || t.beyond_reach) s.angle = polished(*this, u, s.angle);
      solutions.push_back(s);
    }
    return solutions;
  }
  const double off = shortfall(u);
  if (count_ == 0) {
    if (off > kReachSlack) {
      return error("unreachable-orientation"_id,
                   fmt::format("tool direction {} is {:.6f} deg off the spindle, and the machine "
                               "has no rotary axis",
                               in_words(u), off * kDegPerRad),
                   "use a five-axis machine, or keep the tool parallel to the spindle");
    }
    solutions.push_back({});
    return solutions;
  }
  if (off > kReachSlack) {
    return error("unreachable-orientation"_id,
                 fmt::format("tool direction {} cannot be reached with the one rotary axis {}: it "
                             "is {:.6f} deg off",
                             in_words(u), to_char(joint(0).letter), off * kDegPerRad),
                 "directions must be on the cone that the axis turns through");
  }
  OrientationSolution s;
  if (v_off_axis_ < kPole) {
    s.free[0] = true;
  } else {
    s.angle[0] = std::atan2(u.dot(normal_), u.dot(across_)) - azimuth_of_v_;
  }
  solutions.push_back(s);
  return solutions;
}

}  // namespace frustum::kinematics
