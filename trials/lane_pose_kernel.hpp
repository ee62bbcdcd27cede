// The chains of eight machines at one place. Included inside the namespaces of lane_kernel.cpp:
// hence no #pragma once.
//
// Model  : chain.hpp, from the tool to the bed and on to the table with the inverses of its joints
// Units  : mm, rad
// Errors : none

struct LaneTurn {
  Number sine, cosine;
};

// As kinematics/model/small_rotation.hpp, number by number. The library takes the angles for which
// the series is not exact, in a second walk: they are rare.
static inline LaneTurn by_series(const Number& angle) {
  const Number s = angle * angle;
  return {angle - angle * s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0))),
          1.0 - s * (0.5 - s * (1.0 / 24.0 - s * (1.0 / 720.0)))};
}
static inline Mask is_large(const Number& angle) { return ~(size_of(angle) < 0.01); }
static LaneTurn by_library(const Number& angle) {
  LaneTurn turn = by_series(angle);
  for (std::size_t i = 0; i < kWidth; ++i) {
    if (__builtin_fabs(angle[i]) < 0.01) continue;
    turn.sine[i] = __builtin_sin(angle[i]);
    turn.cosine[i] = __builtin_cos(angle[i]);
  }
  return turn;
}

static inline void turn_pair(Number& first, Number& second, const Number& sine,
                             const Number& cosine) {
  const Number turned = cosine * first - sine * second;
  second = sine * first + cosine * second;
  first = turned;
}
static inline void turn_x(Vector& v, const Number& s, const Number& c) {
  turn_pair(v.y, v.z, s, c);
}
static inline void turn_y(Vector& v, const Number& s, const Number& c) {
  turn_pair(v.z, v.x, s, c);
}
static inline void turn_z(Vector& v, const Number& s, const Number& c) {
  turn_pair(v.x, v.y, s, c);
}

static inline Vector product(const Number* m, const Vector& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
          m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
static inline Vector transposed_product(const Number* m, const Vector& v) {
  return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
          m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

class PoseWalk {
 public:
  PoseWalk(const LaneChainTables& chain, const LaneMachines& machines, std::size_t first,
           const double* numbers)
      : chain_(chain), machines_(machines), first_(first), numbers_(numbers) {}

  Place walk() {
    const Place place = walk_by<by_series>();
    return any(large_) ? walk_by<by_library>() : place;
  }

 private:
  template <LaneTurn (*Turn)(const Number&)>
  Place walk_by() {
    tip_ = all(numbers_ + chain_.start_at);
    axis_ = {all(0.0), all(0.0), all(1.0)};
    for (std::size_t i = 0; i < chain_.joints.size(); ++i) {
      const LaneJoint& joint = chain_.joints[i];
      find_errors<Turn>(joint);
      if (joint.on_work) {
        through_work_joint(joint, machines_.joints[i]);
      } else {
        through_tool_joint(joint, machines_.joints[i]);
      }
    }
    tip_ = difference(tip_, all(chain_.table.data()));
    Number m[9];
    for (int k = 0; k < 9; ++k)
      m[k] = all(chain_.workpiece_from_table[static_cast<std::size_t>(k)]);
    return {sum(product(m, tip_), all(chain_.workpiece_origin.data())), product(m, axis_)};
  }

  Number component(std::int32_t index) const {
    if (index < 0) return all(0.0);
    const auto c = static_cast<std::size_t>(index);
    Number value = all(numbers_[chain_.base_at + c]);
    for (std::uint32_t e = chain_.first_entry[c]; e < chain_.first_entry[c + 1]; ++e) {
      value +=
          numbers_[chain_.entries_at + e] * load(machines_.weights[chain_.column_of[e]], first_);
    }
    return value;
  }

  template <LaneTurn (*Turn)(const Number&)>
  void find_errors(const LaneJoint& joint) {
    if (joint.shifts) {
      shift_ = {component(joint.component[0]), component(joint.component[1]),
                component(joint.component[2])};
    }
    if (joint.turns) {
      const Number x = component(joint.component[3]), y = component(joint.component[4]),
                   z = component(joint.component[5]);
      large_ |= is_large(x) | is_large(y) | is_large(z);
      about_x_ = Turn(x);
      about_y_ = Turn(y);
      about_z_ = Turn(z);
    }
  }

  struct Matrix {
    Number of[9];
  };
  Matrix matrix(const std::array<Lanes, 9>& lanes) const {
    Matrix m;
    for (std::size_t k = 0; k < 9; ++k) m.of[k] = load(lanes[k], first_);
    return m;
  }

  Vector pivot_of(const LaneJoint& joint) const {
    return joint.pivot == LaneJoint::Pivot::end ? all(numbers_ + joint.pivot_at)
                                                : all(joint.point.data());
  }

  void turn_by_errors(Vector& v) const {
    if (chain_.zyx) {
      turn_x(v, about_x_.sine, about_x_.cosine);
      turn_y(v, about_y_.sine, about_y_.cosine);
      turn_z(v, about_z_.sine, about_z_.cosine);
    } else {
      turn_z(v, about_z_.sine, about_z_.cosine);
      turn_y(v, about_y_.sine, about_y_.cosine);
      turn_x(v, about_x_.sine, about_x_.cosine);
    }
  }
  void turn_back_by_errors(Vector& v) const {
    if (chain_.zyx) {
      turn_z(v, -about_z_.sine, about_z_.cosine);
      turn_y(v, -about_y_.sine, about_y_.cosine);
      turn_x(v, -about_x_.sine, about_x_.cosine);
    } else {
      turn_x(v, -about_x_.sine, about_x_.cosine);
      turn_y(v, -about_y_.sine, about_y_.cosine);
      turn_z(v, -about_z_.sine, about_z_.cosine);
    }
  }
  void turn_about_pivot(const LaneJoint& joint) {
    if (!joint.turns) return;
    const Vector pivot = pivot_of(joint);
    tip_ = difference(tip_, pivot);
    turn_by_errors(tip_);
    tip_ = sum(tip_, pivot);
    turn_by_errors(axis_);
  }
  void turn_back_about_pivot(const LaneJoint& joint) {
    if (!joint.turns) return;
    const Vector pivot = pivot_of(joint);
    tip_ = difference(tip_, pivot);
    turn_back_by_errors(tip_);
    tip_ = sum(tip_, pivot);
    turn_back_by_errors(axis_);
  }

  // By the joint's own angle, or back.
  void rotate(const LaneJoint& joint, bool back) {
    const double* motion = numbers_ + joint.motion_at;
    if (joint.about == 3) {
      Number m[9];
      for (int k = 0; k < 9; ++k) m[k] = all(motion[k]);
      tip_ = back ? transposed_product(m, tip_) : product(m, tip_);
      axis_ = back ? transposed_product(m, axis_) : product(m, axis_);
      return;
    }
    const Number s = all(back ? -motion[0] : motion[0]), c = all(motion[1]);
    for (Vector* v : {&tip_, &axis_}) {
      if (joint.about == 0) turn_x(*v, s, c);
      if (joint.about == 1) turn_y(*v, s, c);
      if (joint.about == 2) turn_z(*v, s, c);
    }
  }

  Vector way_of(const LaneJoint& joint, const LaneJointErrors& errors) const {
    const Vector motion = all(numbers_ + joint.motion_at);
    if (!joint.tilted) return motion;
    const Vector pivot = pivot_of(joint);
    return difference(product(matrix(errors.line).of, sum(motion, pivot)), pivot);
  }

  void through_tool_joint(const LaneJoint& joint, const LaneJointErrors& errors) {
    if (!joint.rotary) {
      turn_about_pivot(joint);
      if (joint.shifts) tip_ = sum(tip_, shift_);
      tip_ = sum(tip_, way_of(joint, errors));
    } else if (joint.rotor) {
      if (joint.shifts) tip_ = sum(tip_, shift_);
      turn_about_pivot(joint);
      rotate(joint, false);
    } else {
      rotate(joint, false);
      turn_about_pivot(joint);
      if (joint.shifts) tip_ = sum(tip_, shift_);
    }
    if (joint.carries) {
      tip_ = product(matrix(errors.carried).of, tip_);
      axis_ = product(matrix(errors.carried).of, axis_);
    }
    tip_ = sum(tip_, load(errors.place, first_));
  }

  void through_work_joint(const LaneJoint& joint, const LaneJointErrors& errors) {
    tip_ = difference(tip_, load(errors.place, first_));
    if (joint.carries) {
      tip_ = transposed_product(matrix(errors.carried).of, tip_);
      axis_ = transposed_product(matrix(errors.carried).of, axis_);
    }
    if (!joint.rotary) {
      tip_ = difference(tip_, way_of(joint, errors));
      if (joint.shifts) tip_ = difference(tip_, shift_);
      turn_back_about_pivot(joint);
    } else if (joint.rotor) {
      rotate(joint, true);
      turn_back_about_pivot(joint);
      if (joint.shifts) tip_ = difference(tip_, shift_);
    } else {
      if (joint.shifts) tip_ = difference(tip_, shift_);
      turn_back_about_pivot(joint);
      rotate(joint, true);
    }
  }

  const LaneChainTables& chain_;
  const LaneMachines& machines_;
  std::size_t first_;
  const double* numbers_;
  Mask large_{};
  Vector tip_{}, axis_{}, shift_{};
  LaneTurn about_x_{}, about_y_{}, about_z_{};
};

static void find_poses_here(const LaneChainTables& chain, const LaneMachines& machines,
                            std::span<const std::uint32_t> places, std::span<LanePose> poses) {
  for (const std::uint32_t place : places) {
    const double* numbers = chain.numbers.data() + place * chain.stride;
    for (std::size_t first = 0; first < kLanes; first += kWidth) {
      const Place found = PoseWalk(chain, machines, first, numbers).walk();
      store(poses[place].tip, first, found.tip);
      store(poses[place].axis, first, found.axis);
    }
  }
}
