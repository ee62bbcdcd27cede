#include "kinematics/inverse.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace frustum::kinematics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Nearer to the pole than this the first rotary axis cannot be told from the direction's own rounding.
constexpr double kPole = 1e-10;  // rad
// Written programs round directions to nine digits or so; an excess below this is rounding.
constexpr double kReachSlack = 1e-8;

// The rotary joints in the order in which they turn the tool axis as seen from the table: the work
// chain from the table inwards, then the tool chain outwards. Each turns by +q.
std::vector<const Joint*> rotary_sequence(const Machine& machine) {
  std::vector<const Joint*> sequence;
  const auto& work = machine.work_chain();
  for (auto joint = work.rbegin(); joint != work.rend(); ++joint) {
    if (joint->rotary()) sequence.push_back(&*joint);
  }
  for (const Joint& joint : machine.tool_chain()) {
    if (joint.rotary()) sequence.push_back(&joint);
  }
  return sequence;
}

// Angle that turns `from` into `to` about w, both seen along w; nothing when either is parallel to w.
std::optional<double> turn_about(const Vec3& w, const Vec3& from, const Vec3& to) {
  const Vec3 a = from - w * w.dot(from);
  const Vec3 b = to - w * w.dot(to);
  if (a.norm() < kPole || b.norm() < kPole) return std::nullopt;
  return std::atan2(w.dot(a.cross(b)), a.dot(b));
}

double wrapped_near(double angle, double previous) {
  return angle + kTurn * std::round((previous - angle) / kTurn);
}

// The full turn within travel that is nearest to `previous`; the nearest of all if none is within.
double best_turn(const Joint& joint, double angle, double previous) {
  const double nearest = wrapped_near(angle, previous);
  // Half a nanoradian: a position on the limit, reached with rounding, counts as within.
  constexpr double kLimitSlack = 5e-10;
  const auto within = [&](double q) {
    return q >= joint.travel.lo - kLimitSlack && q <= joint.travel.hi + kLimitSlack;
  };
  if (joint.endless || within(nearest)) return nearest;
  std::optional<double> best;
  const double first = angle + kTurn * std::ceil((joint.travel.lo - kLimitSlack - angle) / kTurn);
  for (double q = first; within(q); q += kTurn) {
    if (!best || std::abs(q - previous) < std::abs(*best - previous)) best = q;
  }
  return best.value_or(nearest);
}

Vec3 direction_at(const std::vector<const Joint*>& sequence, const Vec3& v, const double* q) {
  Vec3 u = v;
  for (std::size_t i = sequence.size(); i-- > 0;) {
    u = rotation_about(sequence[i]->direction, q[i]) * u;
  }
  return u;
}

// Gauss-Newton on the direction: the closed form loses digits where the two solutions meet.
void polish(const std::vector<const Joint*>& sequence, const Vec3& v, const Vec3& u, double* q) {
  const Vec3& w1 = sequence[0]->direction;
  for (int step = 0; step < 3; ++step) {
    const Vec3 now = direction_at(sequence, v, q);
    Eigen::Matrix<double, 3, 2> jacobian;
    jacobian.col(0) = w1.cross(now);
    jacobian.col(1) = (rotation_about(w1, q[0]) * sequence[1]->direction).cross(now);
    // A direction in which the tool axis cannot move (the pole) is left alone by the pseudo-inverse.
    Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 3, 2>> solver;
    solver.setThreshold(kPole);
    solver.compute(jacobian);
    const Eigen::Vector2d change = solver.solve(u - now);
    q[0] += change[0];
    q[1] += change[1];
  }
}

// On the cone of w2 about v the angle to w1 has limits; by how much `theta` misses them.
double shortfall(const Vec3& w1, const Vec3& w2, const Vec3& v, double theta) {
  const double to_v = angle_between(w2, v);
  const double between = angle_between(w1, w2);
  const double lowest = std::abs(between - to_v);
  const double highest = std::min(between + to_v, kTurn - between - to_v);
  return theta < lowest ? lowest - theta : theta - highest;
}

std::string in_words(const Vec3& u) {
  return fmt::format("({:.6f}, {:.6f}, {:.6f})", u.x(), u.y(), u.z());
}

Result<std::vector<InverseSolution>> without_rotary(const Vec3& u, const AxisPositions& previous) {
  const double off = angle_between(u, Vec3::UnitZ());
  if (off > kReachSlack) {
    return error(
        fmt::format("tool direction {} is {:.6f} deg off the spindle, and the machine has no "
                    "rotary axis",
                    in_words(u), off * kDegPerRad),
        "use a five-axis machine, or keep the tool parallel to the spindle");
  }
  return std::vector<InverseSolution>{{.axes = previous}};
}

Result<std::vector<InverseSolution>> with_one(const Joint& joint, const Vec3& v, const Vec3& u,
                                              const AxisPositions& previous) {
  const Vec3& w = joint.direction;
  const double off = std::abs(std::acos(std::clamp(w.dot(u), -1.0, 1.0)) -
                              std::acos(std::clamp(w.dot(v), -1.0, 1.0)));
  if (off > kReachSlack) {
    return error(
        fmt::format("tool direction {} cannot be reached with the one rotary axis {}: it is "
                    "{:.6f} deg off",
                    in_words(u), to_char(joint.letter), off * kDegPerRad),
        "directions must lie on the cone that the axis turns through");
  }
  InverseSolution solution{.axes = previous};
  if (const auto angle = turn_about(w, v, u)) {
    solution.axes[joint.letter] = best_turn(joint, *angle, previous[joint.letter]);
  } else {
    solution.singular = true;
  }
  return std::vector<InverseSolution>{solution};
}

}  // namespace

Result<std::vector<InverseSolution>> orient(const Machine& machine, const Vec3& tool_axis,
                                            const AxisPositions& previous) {
  const Vec3 u = tool_axis.normalized();
  const Vec3 v = Vec3::UnitZ();
  const std::vector<const Joint*> sequence = rotary_sequence(machine);
  if (sequence.empty()) return without_rotary(u, previous);
  if (sequence.size() == 1) return with_one(*sequence[0], v, u, previous);

  const Joint& first = *sequence[0];
  const Joint& second = *sequence[1];
  const Vec3& w1 = first.direction;
  const Vec3& w2 = second.direction;
  // z = exp(w2 q2) v lies at u's angle from w1 and at v's angle from w2: a spherical triangle with the
  // sides theta = (w1, u), (w1, w2) and (w2, v). Its angle psi at w1 follows from the cosine rule, written
  // from the nearer pole +-w1 so that nothing cancels there.
  const double theta = angle_between(w1, u);
  const double pole = theta < 0.5 * std::numbers::pi ? 1.0 : -1.0;
  const double from_pole = pole > 0.0 ? theta : std::numbers::pi - theta;
  const double half = std::sin(0.5 * from_pole);
  const Vec3 across = (w2 - w1 * w1.dot(w2)).normalized();
  const Vec3 normal = w1.cross(across);
  const double rise = w2.dot(v - pole * w1) + pole * w1.dot(w2) * 2.0 * half * half;
  const double reach = w2.dot(across) * std::sin(from_pole);
  const double off_reach = std::abs(rise) - reach;
  if (off_reach > kReachSlack) {
    return error(
        fmt::format(
            "tool direction {} cannot be reached with axes {} and {}: it is {:.4f} deg from "
            "the nearest direction they reach",
            in_words(u), to_char(first.letter), to_char(second.letter),
            shortfall(w1, w2, v, theta) * kDegPerRad),
        "choose another machine or another setup of the workpiece");
  }
  const double cosine = reach > 0.0 ? std::clamp(rise / reach, -1.0, 1.0) : 0.0;
  const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));

  std::vector<InverseSolution> solutions;
  for (const double sign : {+1.0, -1.0}) {
    if (sign < 0.0 && (sine == 0.0 || from_pole < kPole)) break;
    const Vec3 z = pole * std::cos(from_pole) * w1 +
                   std::sin(from_pole) * (cosine * across + sign * sine * normal);
    const auto q2 = turn_about(w2, v, z);
    const auto q1 = turn_about(w1, z, u);
    double q[2] = {q1.value_or(previous[first.letter]), q2.value_or(previous[second.letter])};
    polish(sequence, v, u, q);
    InverseSolution solution{.axes = previous, .singular = !q1 || !q2};
    solution.axes[first.letter] = best_turn(first, q[0], previous[first.letter]);
    solution.axes[second.letter] = best_turn(second, q[1], previous[second.letter]);
    solutions.push_back(solution);
  }
  return solutions;
}

AxisPositions place_tip(const Machine& machine, const Vec3& tip, double tool_length,
                        AxisPositions q) {
  const Mat3 directions = linear_axis_directions(machine, q);
  const Eigen::PartialPivLU<Mat3> solver(directions);
  q[AxisLetter::X] = q[AxisLetter::Y] = q[AxisLetter::Z] = 0.0;
  // The second pass removes what rounding left of the first.
  for (int pass = 0; pass < 2; ++pass) {
    const Vec3 missing = tip - nominal_pose(machine, q, tool_length).translation;
    const Vec3 step = solver.solve(missing);
    q[AxisLetter::X] += step.x();
    q[AxisLetter::Y] += step.y();
    q[AxisLetter::Z] += step.z();
  }
  return q;
}

Result<std::vector<InverseSolution>> inverse(const Machine& machine, const ToolPose& pose,
                                             double tool_length, const AxisPositions& previous) {
  auto solutions = orient(machine, pose.axis, previous);
  if (!solutions) return solutions;
  const auto distance = [&](const InverseSolution& s) {
    double sum = 0.0;
    for (const AxisLetter letter : {AxisLetter::A, AxisLetter::B, AxisLetter::C}) {
      sum += std::abs(s.axes[letter] - previous[letter]);
    }
    return sum;
  };
  for (InverseSolution& solution : *solutions) {
    solution.axes = place_tip(machine, pose.tip, tool_length, solution.axes);
    solution.within_travel = travel_violations(machine, solution.axes).empty();
  }
  std::stable_sort(solutions->begin(), solutions->end(), [&](const auto& a, const auto& b) {
    if (a.within_travel != b.within_travel) return a.within_travel;
    // 1e-9: a tie within rounding keeps the order of the closed form.
    return distance(a) < distance(b) - 1e-9;
  });
  return solutions;
}

std::vector<std::string> travel_violations(const Machine& machine, const AxisPositions& q) {
  // Half a nanometre or nanoradian: a position on the limit, reached with rounding, counts as within.
  constexpr double kLimitSlack = 5e-10;
  std::vector<std::string> violations;
  for (const Joint& joint : machine.joints()) {
    const double position = q[joint.letter];
    if (joint.endless) continue;
    if (position >= joint.travel.lo - kLimitSlack && position <= joint.travel.hi + kLimitSlack)
      continue;
    const double scale = joint.rotary() ? kDegPerRad : 1.0;
    violations.push_back(fmt::format("{} = {:.4f} {}, travel {:g} .. {:g}", to_char(joint.letter),
                                     position * scale, joint.rotary() ? "deg" : "mm",
                                     joint.travel.lo * scale, joint.travel.hi * scale));
  }
  return violations;
}

}  // namespace frustum::kinematics
