#include "dynamics/inertial_load.hpp"

#include "dynamics/body_reader.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the origin of a body's frame.
struct Motion {
  Vec3 acceleration = Vec3::Zero();
  Vec3 turning = Vec3::Zero();         // omega
  Vec3 turning_faster = Vec3::Zero();  // alpha

  [[nodiscard]] Vec3 acceleration_at(const Vec3& r) const {
    return acceleration + turning_faster.cross(r) + turning.cross(turning.cross(r));
  }
};

Motion moved(const Motion& before, const Vec3& to_joint, const JointPlace& joint, bool rotary,
             double velocity, double acceleration) {
  Motion m = before;
  m.acceleration = before.acceleration_at(to_joint);
  const Vec3 v = velocity * joint.direction, a = acceleration * joint.direction;
  if (rotary) {
    m.turning_faster += a + before.turning.cross(v);
    m.turning += v;
    return m;
  }
  const Vec3 travelled =
      joint.machine_from_moving.translation - joint.machine_from_fixed.translation;
  m.acceleration = m.acceleration_at(travelled) + a + 2.0 * before.turning.cross(v);
  return m;
}

void put(VectorXd& load, const Structure& s, std::size_t body, const Vec3& origin,
         const Motion& motion) {
  const BodyPlace& b = s.bodies[body];
  const auto at = 6 * static_cast<Index>(body);
  load.segment<3>(at) = -b.mass * motion.acceleration_at(b.centre - origin);
  load.segment<3>(at + 3) =
      -(b.inertia * motion.turning_faster + motion.turning.cross(b.inertia * motion.turning));
}

// Rates of each axis in SI, with the sign of its side.
VectorXd load_of(const DynamicModel& model, const Structure& s, const VectorXd& velocity,
                 const VectorXd& acceleration) {
  VectorXd load = VectorXd::Zero(s.coordinates());
  std::vector<Motion> motions;
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const AxisModel& axis = model.axes[k];
    Motion before;
    Vec3 origin = Vec3::Zero();
    if (axis.previous >= 0) {
      const auto p = static_cast<std::size_t>(axis.previous);
      before = motions[p];
      origin = s.joints[p].machine_from_moving.translation;
    }
    const JointPlace& joint = s.joints[k];
    const auto i = static_cast<Index>(k);
    motions.push_back(moved(before, joint.machine_from_fixed.translation - origin, joint,
                            axis.joint.rotary(), velocity[i], acceleration[i]));
    put(load, s, k + 1, joint.machine_from_moving.translation, motions.back());
  }
  return load;
}

VectorXd signed_rates(const DynamicModel& model, const kinematics::AxisPositions& rates) {
  VectorXd si(static_cast<Index>(model.axes.size()));
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const kinematics::Joint& joint = model.axes[k].joint;
    const double unit = joint.rotary() ? 1.0 : kMetresPerMm;
    si[static_cast<Index>(k)] = joint.side * rates[joint.letter] * unit;
  }
  return si;
}

}  // namespace

MatrixXd unit_acceleration_loads(const DynamicModel& model, const Structure& structure) {
  const auto count = static_cast<Index>(model.axes.size());
  MatrixXd loads(structure.coordinates(), count);
  for (Index k = 0; k < count; ++k) {
    const double side = model.axes[static_cast<std::size_t>(k)].joint.side;
    loads.col(k) =
        load_of(model, structure, VectorXd::Zero(count), side * VectorXd::Unit(count, k));
  }
  return loads;
}

VectorXd inertial_load(const DynamicModel& model, const Structure& structure,
                       const kinematics::AxisPositions& velocity,
                       const kinematics::AxisPositions& acceleration) {
  return load_of(model, structure, signed_rates(model, velocity),
                 signed_rates(model, acceleration));
}

VectorXd weight(const Structure& structure) {
  VectorXd load = VectorXd::Zero(structure.coordinates());
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    load[6 * static_cast<Index>(b) + 2] = -structure.bodies[b].mass * kGravity;
  }
  return load;
}

}  // namespace frustum::dynamics
