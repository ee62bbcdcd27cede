#include "dynamics/structure.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/linear_algebra.hpp"
#include "dynamics/body_reader.hpp"
#include "kinematics/model/joint_motion.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kGround = -1;

int body_of_axis(int axis) { return axis + 1; }

Pose in_metres(const Pose& pose) { return {pose.rotation, pose.translation * kMetresPerMm}; }

Row6 displacement_row(const Structure& s, int body, const Vec3& point, const Vec3& along) {
  Row6 row = Row6::Zero();
  if (body == kGround) return row;
  // n.(t x r) = t.(r x n)
  row << along, (point - s.bodies[static_cast<std::size_t>(body)].centre).cross(along);
  return row;
}

ElementRow elongation(const Structure& s, int outer, int inner, const Vec3& point,
                      const Vec3& along) {
  return {outer, inner, displacement_row(s, outer, point, along),
          displacement_row(s, inner, point, along)};
}

ElementRow twist(int outer, int inner, const Vec3& about) {
  Row6 row;
  row << Vec3::Zero(), about;
  return {outer, inner, row, inner == kGround ? Row6(Row6::Zero()) : row};
}

void add_block(MatrixXd& matrix, int row, int column, const Row6& a, const Row6& b, double k) {
  if (row == kGround || column == kGround) return;
  matrix.block<6, 6>(6 * row, 6 * column) += k * a * b.transpose();
}

void add(MatrixXd& matrix, const ElementRow& e, double k) {
  if (k == 0.0) return;
  add_block(matrix, e.outer, e.outer, e.of_outer, e.of_outer, k);
  add_block(matrix, e.inner, e.inner, e.of_inner, e.of_inner, k);
  add_block(matrix, e.outer, e.inner, e.of_outer, -e.of_inner, k);
  add_block(matrix, e.inner, e.outer, -e.of_inner, e.of_outer, k);
}

void place(Structure& s, const RigidBody& body, const Pose& machine_from_body) {
  const Mat3& r = machine_from_body.rotation;
  s.bodies.push_back(
      {machine_from_body.point(body.centre), r * body.inertia * r.transpose(), body.mass});
}

void place_bodies(Structure& s, const DynamicModel& model, const kinematics::AxisPositions& q) {
  place(s, model.bed, Pose{});
  for (const AxisModel& axis : model.axes) {
    const Pose before = axis.previous < 0
                            ? Pose{}
                            : s.joints[static_cast<std::size_t>(axis.previous)].machine_from_moving;
    JointPlace joint;
    joint.machine_from_fixed = before * Pose::translated(axis.joint.offset * kMetresPerMm);
    joint.machine_from_moving =
        before * in_metres(kinematics::nominal_joint(axis.joint, q[axis.joint.letter]));
    joint.direction = before.direction(axis.joint.direction);
    place(s, axis.body, joint.machine_from_moving);
    s.joints.push_back(joint);
  }
}

// The elements of one axis, as they are in this position.
class AxisElements {
 public:
  AxisElements(Structure& structure, const DynamicModel& model, std::size_t axis)
      : s_(structure),
        joint_(structure.joints[axis]),
        outer_(body_of_axis(static_cast<int>(axis))),
        inner_(body_of_axis(model.axes[axis].previous)) {}

  void add(const Carriage& carriage) {
    const Vec3 p = point(carriage.at, carriage.on);
    const Vec3 normal = joint_.machine_from_moving.direction(carriage.normal);
    straight(p, normal, carriage.along_normal);
    straight(p, joint_.direction.cross(normal), carriage.lateral);
  }

  void add(const Bearing& bearing) {
    const Vec3 p = point(bearing.at, bearing.on);
    const Vec3& e = joint_.direction;
    const Vec3 across = perpendicular_to(e);
    straight(p, e, bearing.axial);
    for (const Vec3& n : {across, Vec3(e.cross(across))}) {
      straight(p, n, bearing.radial);
      keep(twist(outer_, inner_, n), bearing.tilt);
    }
  }

  [[nodiscard]] ElementRow along_axis(bool rotary, const Vec3& at, Attached on) const {
    if (rotary) return twist(outer_, inner_, joint_.direction);
    return elongation(s_, outer_, inner_, point(at, on), joint_.direction);
  }

 private:
  [[nodiscard]] Vec3 point(const Vec3& at, Attached on) const {
    return (on == Attached::moving ? joint_.machine_from_moving : joint_.machine_from_fixed)
        .point(at);
  }
  void straight(const Vec3& p, const Vec3& along, const SpringDamper& spring) {
    keep(elongation(s_, outer_, inner_, p, along), spring);
  }
  void keep(const ElementRow& row, const SpringDamper& spring) {
    if (spring.stiffness != 0.0 || spring.damping != 0.0) s_.elements.push_back({row, spring});
  }

  Structure& s_;
  const JointPlace joint_;
  int outer_;
  int inner_;
};

void collect_elements(Structure& s, const DynamicModel& model, Drives drives) {
  for (const Mount& mount : model.mounts) {
    for (Index i = 0; i < 3; ++i) {
      s.elements.push_back({elongation(s, 0, kGround, mount.at, Vec3::Unit(i)),
                            {mount.stiffness[i], mount.damping[i]}});
    }
  }
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const AxisModel& axis = model.axes[k];
    AxisElements of_axis(s, model, k);
    for (const Carriage& carriage : axis.carriages) of_axis.add(carriage);
    for (const Bearing& bearing : axis.bearings) of_axis.add(bearing);
    if (axis.control && drives == Drives::none) continue;
    s.elements.push_back({of_axis.along_axis(axis.joint.rotary(), axis.drive.at, axis.drive.on),
                          axis.drive.spring, true});
  }
}

void assemble(Structure& s) {
  const Index n = s.coordinates();
  s.mass = MatrixXd::Zero(n, n);
  s.stiffness = s.damping = s.mass;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const auto at = 6 * static_cast<Index>(b);
    s.mass.block<3, 3>(at, at) = s.bodies[b].mass * Mat3::Identity();
    s.mass.block<3, 3>(at + 3, at + 3) = s.bodies[b].inertia;
  }
  for (const Element& e : s.elements) {
    add(s.stiffness, e.row, e.spring.stiffness);
    add(s.damping, e.row, e.spring.damping);
  }
}

Pose tool_frame(const Structure& s, const DynamicModel& model) {
  return model.tool_axes == 0 ? Pose{} : s.joints[model.tool_axes - 1].machine_from_moving;
}

void find_tip_rows(Structure& s, const DynamicModel& model) {
  const int tool = static_cast<int>(model.tool_axes);
  const int work = model.has_work_chain() ? static_cast<int>(model.axes.size())
                                          : (model.workpiece_on_ground ? kGround : 0);
  s.tip = MatrixXd::Zero(6, s.coordinates());
  for (Index i = 0; i < 3; ++i) {
    const Vec3 n = Vec3::Unit(i);
    s.tip.row(i) =
        elongation(s, tool, work, s.tip_in_machine, n).dense(s.coordinates()).transpose();
    s.tip.row(3 + i) = twist(tool, work, n).dense(s.coordinates()).transpose();
  }
}

}  // namespace

double ElementRow::of(const VectorXd& x) const {
  double sum = of_outer.dot(x.segment<6>(6 * outer));
  if (inner != kGround) sum -= of_inner.dot(x.segment<6>(6 * inner));
  return sum;
}

VectorXd ElementRow::dense(Index coordinates) const {
  VectorXd row = VectorXd::Zero(coordinates);
  row.segment<6>(6 * outer) += of_outer;
  if (inner != kGround) row.segment<6>(6 * inner) -= of_inner;
  return row;
}

Structure layout_at(const DynamicModel& model, const kinematics::AxisPositions& q,
                    double tool_length, Drives drives) {
  Structure s;
  place_bodies(s, model, q);
  collect_elements(s, model, drives);
  const Vec3 tip = (model.spindle_offset - tool_length * Vec3::UnitZ()) * kMetresPerMm;
  s.tip_in_machine = tool_frame(s, model).point(tip);
  if (model.has_work_chain()) s.machine_from_table = s.joints.back().machine_from_moving.rotation;
  return s;
}

Structure structure_at(const DynamicModel& model, const kinematics::AxisPositions& q,
                       double tool_length, Drives drives) {
  Structure s = layout_at(model, q, tool_length, drives);
  assemble(s);
  find_tip_rows(s, model);
  return s;
}

ElementRow row_along_axis(const DynamicModel& model, const Structure& structure, std::size_t axis,
                          const Vec3& at, Attached on) {
  Structure copy_of_places;
  copy_of_places.bodies = structure.bodies;
  copy_of_places.joints = structure.joints;
  return AxisElements(copy_of_places, model, axis)
      .along_axis(model.axes[axis].joint.rotary(), at, on);
}

MatrixXd mass_root(const Structure& structure) {
  MatrixXd root = MatrixXd::Zero(structure.coordinates(), structure.coordinates());
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    const auto at = 6 * static_cast<Index>(b);
    const BodyPlace& body = structure.bodies[b];
    root.block<3, 3>(at, at) = std::sqrt(body.mass) * Mat3::Identity();
    root.block<3, 3>(at + 3, at + 3) = Eigen::LLT<Mat3>(body.inertia).matrixL();
  }
  return root;
}

MatrixXd mass_normalised(const MatrixXd& root, const MatrixXd& matrix) {
  const auto lower = root.triangularView<Eigen::Lower>();
  const MatrixXd half = lower.solve(matrix);
  return lower.solve(half.transpose());
}

std::optional<LooseBody> loose_body(const DynamicModel& model, const Structure& structure) {
  const MatrixXd root = mass_root(structure);
  const SymmetricEigen modes = symmetric_eigen(mass_normalised(root, structure.stiffness));
  // Squares of frequencies: what is below 1e-12 of the largest is rounding of a sum of springs.
  constexpr double kNothing = 1e-12;
  if (modes.values[0] > kNothing * modes.values[modes.values.size() - 1]) return std::nullopt;
  const VectorXd free = root.transpose().triangularView<Eigen::Upper>().solve(modes.vectors.col(0));
  // The connection that lets it go: where body and predecessor move apart most.
  std::size_t loosest = 0;
  Row6 apart = Row6::Zero();
  double most = -1.0;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    const int inner = b == 0 ? kGround : body_of_axis(model.axes[b - 1].previous);
    const Vec3& centre = structure.bodies[b].centre;
    Row6 motion;
    for (Index i = 0; i < 3; ++i) {
      motion[i] = elongation(structure, static_cast<int>(b), inner, centre, Vec3::Unit(i)).of(free);
      motion[3 + i] = twist(static_cast<int>(b), inner, Vec3::Unit(i)).of(free);
    }
    const double energy = structure.bodies[b].mass * motion.head<3>().squaredNorm() +
                          motion.tail<3>().dot(structure.bodies[b].inertia * motion.tail<3>());
    if (energy <= most) continue;
    most = energy;
    loosest = b;
    apart = motion;
  }
  const double rotation_energy =
      apart.tail<3>().dot(structure.bodies[loosest].inertia * apart.tail<3>());
  const bool turns = rotation_energy > 0.5 * most;
  Vec3 way = (turns ? apart.tail<3>() : apart.head<3>()).normalized();
  Index largest = 0;
  way.cwiseAbs().maxCoeff(&largest);
  if (way[largest] < 0.0) way = -way;
  for (double& part : way) part = std::abs(part) < 5e-4 ? 0.0 : part;  // as printed
  const std::string name = model.body_name(loosest);
  return LooseBody{
      loosest == 0 ? "mount" : "axis",
      error("free-direction"_id,
            fmt::format("nothing holds the body {} {} [{:.3f}, {:.3f}, {:.3f}] of the machine",
                        name, turns ? "in rotation about" : "along", way.x(), way.y(), way.z()),
            loosest == 0
                ? "give mounts with stiffness in every direction, three not on a line"
                : fmt::format("give the axis {} a drive, and {} that hold the rest", name,
                              model.axes[loosest - 1].joint.rotary() ? "bearings" : "carriages"))};
}

}  // namespace frustum::dynamics
