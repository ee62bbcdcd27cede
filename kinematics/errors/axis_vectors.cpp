#include "kinematics/errors/axis_vectors.hpp"

#include <Eigen/LU>

#include "kinematics/model/chain.hpp"
#include "kinematics/model/joint_motion.hpp"
#include "kinematics/model/small_rotation.hpp"

namespace frustum::kinematics {
namespace {

// The lines of one chain with all axes at zero, in the frame of the bed.
std::vector<AxisVectors> lines_of(const Machine& machine, const std::vector<Joint>& chain,
                                  const GeometricErrors& errors) {
  std::vector<AxisVectors> lines;
  Pose at;
  for (const Joint& joint : chain) {
    at = at * Pose::translated(joint.offset);
    const AxisErrors& own = errors[joint.letter];
    if (!joint.rotary()) {
      // Where a tilted line has its functional point.
      const Mat3 tilt = small_rotation(location_turn(own), machine.rotation_order());
      const Vec3 leant = (tilt - Mat3::Identity()) * joint.functional_point.point;
      at = at * Pose::translated(location_shift(own) + leant);
      if (!own.carried_tilt.isZero(0.0)) {
        at = at * Pose{small_rotation(own.carried_tilt, machine.rotation_order()), Vec3::Zero()};
      }
      continue;
    }
    at = at *
         Pose{small_rotation(location_turn(own), machine.rotation_order()), location_shift(own)};
    AxisVectors found{.axis = joint.letter, .side = joint.side};
    found.in_bed = {at.translation, at.rotation * joint.direction};
    lines.push_back(found);
  }
  return lines;
}

// Of the line the point nearest to another.
Vec3 nearest_on(const AxisLineVectors& line, const Vec3& to) {
  return line.point + line.direction.dot(to - line.point) * line.direction;
}

}  // namespace

std::vector<AxisVectors> axis_vectors(const Machine& machine, const GeometricErrors& errors) {
  const Vec3 gauge = machine.spindle_offset();
  Vec3 gauge_in_bed = gauge;
  for (auto joint = machine.tool_chain().rbegin(); joint != machine.tool_chain().rend(); ++joint) {
    gauge_in_bed += joint->offset;
  }
  // Displacements of the tool from the work for a unit of X, Y and Z.
  Mat3 directions = Mat3::Identity();
  for (const Joint& joint : machine.joints()) {
    if (!joint.rotary()) directions.col(static_cast<Eigen::Index>(joint.letter)) = joint.direction;
  }
  const Mat3 positions = directions.inverse();
  std::vector<AxisVectors> all;
  for (const auto* chain : {&machine.work_chain(), &machine.tool_chain()}) {
    const auto nominal = lines_of(machine, *chain, {});
    auto actual = lines_of(machine, *chain, errors);
    for (std::size_t k = 0; k < actual.size(); ++k) {
      AxisVectors& axis = actual[k];
      axis.in_bed.point = nearest_on(axis.in_bed, nominal[k].in_bed.point);
      const auto seen = [&](const Vec3& point) -> Vec3 {
        return axis.side < 0 ? Vec3(positions * (point - gauge_in_bed))
                             : Vec3(gauge_in_bed - point);
      };
      axis.nominal = {seen(nominal[k].in_bed.point), nominal[k].in_bed.direction};
      axis.actual = {seen(axis.in_bed.point), axis.in_bed.direction};
      if (k > 0) axis.from_previous = axis.in_bed.point - actual[k - 1].in_bed.point;
    }
    all.insert(all.end(), actual.begin(), actual.end());
  }
  return all;
}

}  // namespace frustum::kinematics
