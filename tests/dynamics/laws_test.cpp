// Closed forms and laws that hold for every machine.
#include <rapidcheck/gtest.h>

#include <numbers>

#include "core/general_algebra.hpp"
#include "core/linear_algebra.hpp"
#include "dynamics/inertial_load.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/response.hpp"
#include "dynamics/static_chain.hpp"
#include "dynamics/workspace_map.hpp"
#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using kinematics::AxisLetter;
using kinematics::AxisPositions;

RigidBody body_from(const json& numbers) {
  RigidBody body{numbers["mass"], Vec3::Zero(), Mat3::Zero()};
  for (Index i = 0; i < 3; ++i) {
    body.centre[i] = 1e-3 * numbers["com"][static_cast<std::size_t>(i)].get<double>();
    body.inertia(i, i) = numbers["inertia"][static_cast<std::size_t>(i)];
  }
  return body;
}

Vec3 vector_from(const json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

std::vector<Mount> mounts_from(const json& list) {
  std::vector<Mount> mounts;
  for (const json& m : list) {
    mounts.push_back({1e-3 * vector_from(m["at"]), 1e6 * vector_from(m["stiffness"]),
                      1e3 * vector_from(m["damping"])});
  }
  return mounts;
}

TEST(BlockOnFeetLaws, HasTheFrequenciesOfTheClosedForm) {
  const json& block = expected()["closed_forms"]["block"];
  DynamicModel model;
  model.bed = body_from(block["machine"]["bodies"]["bed"]);
  model.mounts = mounts_from(block["machine"]["mounts"]);
  model.workpiece_on_ground = true;
  const VectorXd found = natural_frequencies(structure_at(model, {}, 0.0));
  expect_near(first(found, 6), block["undamped_hz"], 1e-9, "frequencies");
  // Bounce and yaw: sqrt(4 kv / m), sqrt(4 kh (a^2 + b^2) / Iz).
  const Mount& foot = model.mounts.front();
  const double bounce = std::sqrt(4.0 * foot.stiffness.z() / model.bed.mass);
  const double yaw = std::sqrt(4.0 * foot.stiffness.x() * foot.at.head<2>().squaredNorm() /
                               model.bed.inertia(2, 2));
  for (const double w : {bounce, yaw}) {
    EXPECT_LT((found.array() - w / (2.0 * std::numbers::pi)).abs().minCoeff(), 1e-10);
  }
}

// One carriage axis on either side of the machine: tool_side +1, -1.
DynamicModel carriage_machine(int side) {
  const json& numbers = expected()["closed_forms"]["carriage"]["machine"];
  const json& x = numbers["axes"]["X"];
  DynamicModel model;
  model.bed = body_from(numbers["bodies"]["bed"]);
  model.mounts = mounts_from(numbers["mounts"]);
  AxisModel axis;
  axis.joint.letter = AxisLetter::X;
  axis.joint.side = side;
  axis.body = body_from(numbers["bodies"]["X"]);
  for (const json& c : x["carriages"]) {
    axis.carriages.push_back({1e-3 * vector_from(c["at"]),
                              vector_from(c["normal"]),
                              {1e6 * c["stiffness"][0].get<double>(), 0.0},
                              {1e6 * c["stiffness"][1].get<double>(), 0.0}});
  }
  axis.drive = {1e-3 * vector_from(x["drive"]["at"]),
                {1e6 * x["drive"]["stiffness"].get<double>(), 0.0}};
  model.axes.push_back(axis);
  model.tool_axes = side > 0 ? 1 : 0;
  model.spindle_offset = vector_from(numbers["spindle_offset"]);
  return model;
}

TEST(CarriageLaws, TiltsByTheClosedFormOnBothSides) {
  for (const int side : {+1, -1}) {
    DynamicModel model = carriage_machine(side);
    for (const double softer : {1.0, 0.01}) {  // the mounts do not matter
      for (Mount& mount : model.mounts) mount.stiffness *= softer;
      const Structure s = structure_at(model, {}, 0.0);
      const Vec3 found =
          static_response(model, s).inertial.col(0) * inertial_scale(model.axes[0].joint);
      expect_near(as_json(found), expected()["closed_forms"]["carriage"]["inertial_um_per_gn"],
                  1e-9, "inertial compliance");
      const AxisModel& x = model.axes[0];
      const double kd = x.drive.spring.stiffness, hd = x.drive.at.z();
      const double kn = x.carriages[0].along_normal.stiffness, ac = x.carriages[0].at.x();
      const double h = x.body.centre.z(), tip = 1e-3 * model.spindle_offset.z();
      const double closed =
          -x.body.mass / kd - x.body.mass * (h - hd) * (tip - hd) / (4.0 * kn * ac * ac);
      EXPECT_NEAR(found.x(), closed * kGravity * 1e6, 1e-6);
    }
  }
}

AxisPositions any_position() {
  AxisPositions q;
  q[AxisLetter::X] = *rc::gen::inRange(-400, 401);
  q[AxisLetter::Y] = *rc::gen::inRange(-300, 301);
  q[AxisLetter::Z] = *rc::gen::inRange(-100, 501);
  q[AxisLetter::B] = *rc::gen::inRange(-110, 111) * kRadPerDeg;
  q[AxisLetter::C] = *rc::gen::inRange(-180, 181) * kRadPerDeg;
  return q;
}

RC_GTEST_PROP(ResponseLaws, IsReciprocalAndTheSumOverTheModes, ()) {
  const DynamicModel model = model_named("iwf-bc");
  const Structure s = structure_at(model, any_position(), 150.0);
  const MatrixXcd g = tip_compliance(harmonic_system(s, *rc::gen::inRange(1, 400)));
  RC_ASSERT((g - g.transpose()).norm() < 1e-12 * g.norm());
  const UndampedModes modes = undamped_modes(s);
  const VectorXd w2 = (modes.frequencies * 2.0 * std::numbers::pi).cwiseAbs2();
  const Mat3 sum = modes.tip * w2.cwiseInverse().asDiagonal() * modes.tip.transpose();
  const Mat3 rest = static_response(model, s).compliance;
  RC_ASSERT((sum - rest).norm() < 1e-11 * rest.norm());
}

RC_GTEST_PROP(ResponseLaws, TheChainAtRestIsTheInverseOfTheMatrix, ()) {
  for (const char* name : {"iwf-bc", "cantilever-original"}) {
    const DynamicModel model = model_named(name);
    const Structure s = structure_at(model, any_position(), 150.0);
    VectorXd load(s.coordinates());
    for (double& f : load) f = *rc::gen::inRange(-1000, 1001);
    load[0] += 1.0;
    const VectorXd wanted = s.tip * SymmetricFactors(s.stiffness).solve(load);
    const Row6 found = static_tip(model, s, load);
    RC_ASSERT((found - wanted).head(3).norm() < 1e-10 * wanted.head(3).norm());
    RC_ASSERT((found - wanted).tail(3).norm() < 1e-10 * wanted.tail(3).norm());
  }
}

RC_GTEST_PROP(ResponseLaws, HasTheMassLineAndGoesOverToRest, ()) {
  const DynamicModel model = model_named("iwf-bc");
  const Structure s = structure_at(model, any_position(), 150.0);
  const MatrixXd tip = s.tip_displacement();
  const MatrixXd line = tip * s.mass.inverse() * tip.transpose();
  const double high = 1e6;  // Hz
  const MatrixXcd g =
      tip_compliance(harmonic_system(s, high)) * factor_of(Quantity::accelerance, high);
  RC_ASSERT((g.real() - line).norm() < 1e-5 * line.norm());
  const MatrixXd loads = unit_acceleration_loads(model, s);
  const MatrixXcd slow = tip_response(harmonic_system(s, 1e-4), loads.cast<std::complex<double>>());
  const MatrixXd rest = static_response(model, s).inertial;
  RC_ASSERT((slow.real() - rest).norm() < 1e-9 * rest.norm());
}

RC_GTEST_PROP(InertialLoadLaws, ARigidShiftLoadsOnlyTheMountsWithTheWholeMass, ()) {
  const DynamicModel model = model_named("iwf-bc");
  const Structure s = structure_at(model, any_position(), 150.0);
  VectorXd shift = VectorXd::Zero(s.coordinates());
  const Vec3 by = Vec3(1.0, -2.0, 0.5);
  double mass = 0.0;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    shift.segment<3>(6 * static_cast<Index>(b)) = by;
    mass += s.bodies[b].mass;
  }
  const VectorXd force = s.stiffness * shift;
  RC_ASSERT(force.tail(s.coordinates() - 6).norm() < 1e-9 * force.norm());
  RC_ASSERT(std::abs(shift.dot(s.mass * shift) - mass * by.squaredNorm()) < 1e-9 * mass);
}

RC_GTEST_PROP(InertialLoadLaws, IsTheColumnOfTheMassMatrixInRelativeCoordinates, ()) {
  const DynamicModel model = model_named("iwf-bc");
  const AxisPositions q = any_position();
  const Structure s = structure_at(model, q, 150.0);
  const MatrixXd loads = unit_acceleration_loads(model, s);
  constexpr double kStep = 1e-4;  // mm, rad: central differences of the chain
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const kinematics::Joint& joint = model.axes[k].joint;
    // Velocities of all bodies for unit velocity of the axis.
    AxisPositions ahead = q, behind = q;
    ahead[joint.letter] += kStep;
    behind[joint.letter] -= kStep;
    const Structure a = structure_at(model, ahead, 150.0), b = structure_at(model, behind, 150.0);
    const double unit = joint.rotary() ? 2.0 * kStep : 2.0 * kStep * 1e-3;
    VectorXd direction = VectorXd::Zero(s.coordinates());
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
      const auto at = 6 * static_cast<Index>(i);
      direction.segment<3>(at) = (a.bodies[i].centre - b.bodies[i].centre) / unit;
      const bool carried =
          i > 0 && (i - 1 >= k) && ((i - 1 < model.tool_axes) == (k < model.tool_axes));
      if (joint.rotary() && carried) {
        direction.segment<3>(at + 3) = joint.side * s.joints[k].direction;
      }
    }
    const VectorXd wanted = -s.mass * direction;
    RC_ASSERT((loads.col(static_cast<Index>(k)) - wanted).norm() < 1e-6 * wanted.norm());
  }
}

// Joints in any order and direction on both sides, bodies of any kind.
DynamicModel any_machine() {
  const auto share = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const auto vector = [&] { return Vec3(share(), share(), share()); };
  DynamicModel model;
  std::vector<AxisLetter> letters{AxisLetter::X, AxisLetter::Y, AxisLetter::Z, AxisLetter::B,
                                  AxisLetter::C};
  for (std::size_t i = letters.size(); i > 1; --i) {
    std::swap(letters[i - 1], letters[*rc::gen::inRange<std::size_t>(0, i)]);
  }
  model.tool_axes = *rc::gen::inRange<std::size_t>(0, letters.size() + 1);
  model.spindle_offset = 100.0 * vector();
  for (std::size_t k = 0; k < letters.size(); ++k) {
    const bool first = k == 0 || k == model.tool_axes;
    AxisModel axis;
    axis.joint.letter = letters[k];
    axis.joint.side = k < model.tool_axes ? 1 : -1;
    axis.joint.direction = (vector() + Vec3(0.0, 0.0, 2.0)).normalized();
    axis.joint.offset = 300.0 * vector();
    axis.previous = first ? -1 : static_cast<int>(k) - 1;
    axis.body = {200.0 + 100.0 * share(), 0.3 * vector(), Mat3::Zero()};
    const Vec3 arm = vector();
    axis.body.inertia = Mat3(Vec3(10.0, 12.0, 15.0).asDiagonal()) +
                        arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    model.axes.push_back(axis);
  }
  return model;
}

RC_GTEST_PROP(InertialLoadLaws, IsTheChangeOfMomentumOfEveryBodyOfAnyMachine, ()) {
  const DynamicModel model = any_machine();
  AxisPositions start, velocity, acceleration;
  for (const AxisModel& axis : model.axes) {
    const auto letter = axis.joint.letter;
    const double unit = axis.joint.rotary() ? 1e-3 : 0.1;  // rad, mm
    start[letter] = *rc::gen::inRange(-2000, 2001) * unit;
    velocity[letter] = *rc::gen::inRange(-3000, 3001) * unit;
    acceleration[letter] = *rc::gen::inRange(-9000, 9001) * unit;
  }
  const auto at = [&](double t) {
    AxisPositions q;
    for (const auto letter : kinematics::kAxisLetters) {
      q[letter] = start[letter] + velocity[letter] * t + 0.5 * acceleration[letter] * t * t;
    }
    return layout_at(model, q, 120.0);
  };
  constexpr double kStep = 1e-3;  // s
  const auto turning = [&](double t, std::size_t joint) {
    const auto rotation = [&](double time) {
      return at(time).joints[joint].machine_from_moving.rotation;
    };
    // Central differences of the fourth order.
    const Mat3 rate = (8.0 * (rotation(t + kStep) - rotation(t - kStep)) -
                       (rotation(t + 2 * kStep) - rotation(t - 2 * kStep))) /
                      (12.0 * kStep);
    const Mat3 skew = rate * rotation(t).transpose();
    return Vec3(skew(2, 1), skew(0, 2), skew(1, 0));
  };
  const VectorXd load = inertial_load(model, at(0.0), velocity, acceleration);
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const std::size_t b = k + 1;
    const auto centre = [&](double t) { return at(t).bodies[b].centre; };
    const Vec3 faster = (16.0 * (centre(kStep) + centre(-kStep)) -
                         (centre(2 * kStep) + centre(-2 * kStep)) - 30.0 * centre(0.0)) /
                        (12.0 * kStep * kStep);
    const auto momentum = [&](double t) { return Vec3(at(t).bodies[b].inertia * turning(t, k)); };
    const Vec3 change = (8.0 * (momentum(kStep) - momentum(-kStep)) -
                         (momentum(2 * kStep) - momentum(-2 * kStep))) /
                        (12.0 * kStep);
    const auto row = 6 * static_cast<Index>(b);
    const Vec3 force = load.segment<3>(row), moment = load.segment<3>(row + 3);
    RC_ASSERT((force + model.axes[k].body.mass * faster).norm() < 1e-4 * (1.0 + force.norm()));
    RC_ASSERT((moment + change).norm() < 1e-4 * (1.0 + moment.norm()));
  }
}

RC_GTEST_PROP(ModesLaws, AStifferSpringLowersNoFrequency, ()) {
  const DynamicModel model = model_named("iwf-bc");
  Structure s = structure_at(model, any_position(), 150.0);
  const VectorXd before = natural_frequencies(s);
  const auto element = *rc::gen::inRange<std::size_t>(0, s.elements.size());
  const VectorXd row = s.elements[element].row.dense(s.coordinates());
  s.stiffness += *rc::gen::inRange(1, 1000) * 1e6 * row * row.transpose();
  const VectorXd after = natural_frequencies(s);
  RC_ASSERT(((after - before).array() >= -1e-9 * before.maxCoeff()).all());
}

TEST(ModesLaws, FreeUndampedMotionKeepsItsEnergyFor2000Steps) {
  const DynamicModel model = model_named("iwf-bc");
  const Structure s = structure_at(model, {}, 150.0);
  const MatrixXd root = mass_root(s);
  const MatrixXd k = mass_normalised(root, s.stiffness);
  const Index n = k.rows();
  const double scale = 500.0;  // 1/s
  MatrixXd system = MatrixXd::Zero(2 * n, 2 * n);
  system.topRightCorner(n, n) = scale * MatrixXd::Identity(n, n);
  system.bottomLeftCorner(n, n) = -k / scale;
  const MatrixXd step = matrix_exponential(system * 5e-4);
  VectorXd x = VectorXd::LinSpaced(2 * n, -1.0, 1.0);
  const auto energy = [&](const VectorXd& y) {
    return 0.5 * scale * scale * y.tail(n).squaredNorm() + 0.5 * y.head(n).dot(k * y.head(n));
  };
  const double before = energy(x);
  for (int i = 0; i < 2000; ++i) x = step * x;
  EXPECT_NEAR(energy(x) / before, 1.0, 1e-12);
}

}  // namespace
}  // namespace frustum::dynamics
