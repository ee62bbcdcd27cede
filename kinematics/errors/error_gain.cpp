#include "kinematics/errors/error_gain.hpp"

#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/joint_motion.hpp"

namespace frustum::kinematics {
namespace {

// A rotation about `pivot` moves `point`.
PoseDisplacement turned(const Vec3& turn, const Vec3& pivot, const Vec3& point) {
  return {turn.cross(point - pivot), turn};
}

PoseDisplacement& operator+=(PoseDisplacement& sum, const PoseDisplacement& more) {
  sum.tip += more.tip;
  sum.turn += more.turn;
  return sum;
}

// Tilting the line along which the functional point runs, about the joint's origin, shifts what the
// axis carries.
Vec3 tilt_of_line(const ErrorFrames& f, const Vec3& tilt) {
  return (f.place.rotation * tilt).cross(f.pivot - f.place.translation);
}

// Displacement, in the bed frame, of `point` (bed frame) carried by the end of the chain.
PoseDisplacement displacement(const ChainFrames& chain, const GeometricErrors& errors,
                              const AxisState& at, const Vec3& point) {
  PoseDisplacement sum;
  for (const ErrorFrames& f : chain.joints()) {
    const AxisErrors& axis = errors[f.joint->letter];
    const ComponentErrors e = component_errors(axis, f.joint->letter, at);
    sum.tip += f.act * e.shift + f.place.rotation * location_shift(axis);
    sum += turned(f.act * e.turn, f.pivot, point);
    const Vec3 carried = f.joint->rotary() ? location_turn(axis) : axis.carried_tilt;
    sum += turned(f.place.rotation * carried, f.place.translation, point);
    if (!f.joint->rotary()) sum.tip += tilt_of_line(f, location_turn(axis));
  }
  return sum;
}

// By a unit of one error.
PoseDisplacement displacement(const ErrorFrames& f, const MachineError& error, const Vec3& point) {
  const Vec3 unit = error.scale * Vec3::Unit(static_cast<Eigen::Index>(error.error.direction) % 3);
  if (!is_rotation(error.error.direction))
    return {(error.error.location ? f.place.rotation : f.act) * unit, Vec3::Zero()};
  if (!error.error.location) return turned(f.act * unit, f.pivot, point);
  if (f.joint->rotary() || error.carries)
    return turned(f.place.rotation * unit, f.place.translation, point);
  return {tilt_of_line(f, unit), Vec3::Zero()};
}

void add_gains(GainMatrix& gains, const ChainFrames& chain, std::span<const MachineError> errors,
               const Vec3& point, const Mat3& seen) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (const ErrorFrames& f : chain.joints()) {
      if (f.joint->letter != errors[i].error.axis) continue;
      const PoseDisplacement d = displacement(f, errors[i], point);
      gains.col(static_cast<Eigen::Index>(i)) << seen * d.tip, seen * d.turn;
    }
  }
}

GainMatrix no_gains(std::span<const MachineError> errors) {
  return GainMatrix::Zero(6, static_cast<Eigen::Index>(errors.size()));
}

}  // namespace

PoseDisplacement first_order_displacement(const Machine& machine, const GeometricErrors& errors,
                                          const AxisState& at, double tool_length) {
  const ChainFrames tool = tool_side_frames(machine, at.q, tool_length);
  const ChainFrames work = work_side_frames(machine, at.q);
  const Vec3 tip = tool.bed_from_end.translation;
  PoseDisplacement of_tool = displacement(tool, errors, at, tip);
  if (errors.has_grid()) {
    const GridErrors grid = errors.grid_at(at.q);
    of_tool.tip += grid.shift;
    of_tool += turned(grid.turn, grid_pivot(tool), tip);
  }
  const PoseDisplacement of_table = displacement(work, errors, at, tip);
  const Mat3 table_from_bed = work.bed_from_end.rotation.transpose();
  return {table_from_bed * (of_tool.tip - of_table.tip),
          table_from_bed * (of_tool.turn - of_table.turn)};
}

std::vector<MachineError> every_error(const Machine& machine) {
  std::vector<MachineError> errors;
  for (const ErrorName& e : machine.error_names()) errors.push_back({.name = e.text(), .error = e});
  return errors;
}

Result<std::vector<MachineError>> errors_named(const Machine& machine,
                                               std::span<const std::string> names) {
  std::vector<MachineError> errors;
  Diagnostics problems;
  for (const std::string& name : names) {
    if (const auto alias = machine.aliases().find(name); alias != machine.aliases().end()) {
      const ErrorAlias& a = alias->second;
      errors.push_back({name, a.error, a.scale, a.carries});
      continue;
    }
    // An error without terms is refused for its name alone.
    const ErrorEntry entry{.name = name};
    if (auto resolved = resolve(machine, {&entry, 1}); !resolved) {
      problems.insert(problems.end(), resolved.error().begin(), resolved.error().end());
    } else {
      errors.push_back({.name = name, .error = *ErrorName::parse(name)});
    }
  }
  if (!problems.empty()) return problems;
  return errors;
}

GainMatrix gain_matrix(const Machine& machine, std::span<const MachineError> errors,
                       const AxisPositions& at, double tool_length) {
  const ChainFrames tool = tool_side_frames(machine, at, tool_length);
  const ChainFrames work = work_side_frames(machine, at);
  const Vec3 tip = tool.bed_from_end.translation;
  const Mat3 table_from_bed = work.bed_from_end.rotation.transpose();
  GainMatrix gains = no_gains(errors);
  add_gains(gains, tool, errors, tip, table_from_bed);
  add_gains(gains, work, errors, tip, -table_from_bed);
  return gains;
}

GainMatrix tool_side_gain(const Machine& machine, std::span<const MachineError> errors,
                          const AxisPositions& at, double tool_length, const Vec3& from_tip) {
  const ChainFrames tool = tool_side_frames(machine, at, tool_length);
  GainMatrix gains = no_gains(errors);
  add_gains(gains, tool, errors, tool.bed_from_end.point(from_tip), Mat3::Identity());
  return gains;
}

GainMatrix work_side_gain(const Machine& machine, std::span<const MachineError> errors,
                          const AxisPositions& at, const Vec3& on_table) {
  const ChainFrames work = work_side_frames(machine, at);
  GainMatrix gains = no_gains(errors);
  add_gains(gains, work, errors, work.bed_from_end.point(on_table), Mat3::Identity());
  return gains;
}

}  // namespace frustum::kinematics
