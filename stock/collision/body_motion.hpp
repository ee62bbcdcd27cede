// How bodies of a machine move with its axes, and how much nearer two of them can come.
//
// Model    : two bodies are seen from the last part of the machine that carries both. From there a
//            body hangs on a branch of joints. Let the axes go from q0 to q, the outermost joint of
//            a branch first: each joint then moves while those nearer to the bed are still where
//            they were. A linear joint moves the body by dq along the direction that it has at q0;
//            a rotary one moves no point by more than |dq| times its distance from the axis, and
//            along a plane's normal n by no more than |n x axis| of that. The sum over both
//            branches bounds what is lost of the distance along n, or of any distance, for every
//            way from q0 to q; it is a convex function of q
// Units    : mm, rad; frame: that of the common part
// Errors   : none
// Accuracy : upper bounds; exact where only linear joints move
// Source   : Mirtich 1996, Impulse-based Dynamic Simulation of Rigid Body Systems, section 2.3
//            (conservative advancement); Quinlan 1994, Real-Time Modification of Collision-Free
//            Paths, chapter 3 (bubbles)
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/pose.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/machine_body.hpp"

namespace frustum::stock {

using kinematics::AxisPositions;

// Of the nominal machine.
[[nodiscard]] Pose bed_from_part(const kinematics::Machine& machine,
                                 const kinematics::MachinePart& part, const AxisPositions& q);

// The joints that carry a body, from a part of the machine outwards.
class BodyBranch {
 public:
  BodyBranch() = default;
  // `from`: of the same chain as `part`, or the bed. `bounds` is a box around the body, in its
  // frame.
  BodyBranch(const kinematics::Machine& machine, std::size_t from,
             const kinematics::MachinePart& part, const Pose& part_from_body, const Box& bounds);

  [[nodiscard]] Pose common_from_body(const AxisPositions& q) const;

  struct Mover {
    kinematics::AxisLetter axis = kinematics::AxisLetter::X;
    bool rotary = false;
    Vec3 direction = Vec3::Zero();  // of the body's motion for +q, in the common frame
    double reach = 0.0;             // rotary: no point of the body is farther from the axis
  };
  // As they are at q.
  [[nodiscard]] std::vector<Mover> movers(const AxisPositions& q) const;
  [[nodiscard]] bool empty() const { return links_.empty(); }

 private:
  struct Link {
    kinematics::Joint joint{};
    double reach = 0.0;
  };
  std::vector<Link> links_{};
  Pose last_from_body_{};
};

// How much of the distance of two bodies is lost at most between q0 and q.
class ClosingBound {
 public:
  ClosingBound() = default;
  // Along the unit normal, from body A to body B; nothing: in any direction.
  ClosingBound(const AxisPositions& q0, std::span<const BodyBranch::Mover> a,
               std::span<const BodyBranch::Mover> b, const Vec3* normal);

  [[nodiscard]] double at(const AxisPositions& q) const;

 private:
  AxisPositions q0_{};
  bool is_directed_ = false;
  std::array<double, 3> closing_{};  // of X, Y, Z along the normal
  std::array<Vec3, 3> moving_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // of A against B
  std::array<double, 3> turning_{};                                       // of A, B, C
};

}  // namespace frustum::stock
