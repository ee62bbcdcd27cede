// Where the rotary axes of a machine really are: the vectors by which a control corrects its
// kinematics.
//
// Model    : with all axes at zero, location errors in. The line of each rotary axis: a point of it
//            and its direction; +q of an axis of the tool turns the tool about the direction by the
//            right-hand rule, of an axis of the work the table the other way (ISO 841). The point
//            of an axis of the work is given as the machine coordinates X, Y, Z at which the gauge
//            point of the spindle is there; that of an axis of the tool by how far it is from the
//            gauge point. Points are those of the nominal one nearest to them: along an axis
//            nothing is known
// Units    : mm, unit vectors; frame: bed
// Shape    : one entry a rotary axis: work chain, then tool chain, each bed outwards
// Errors   : none; a machine without rotary axes has none
// Accuracy : a table that turns about these lines moves as the actual one does, from where it is
//            with all axes at zero on (tests/kinematics/axis_vectors_test.cpp)
// Source   : ours; the vectors are what controls call kinematic offsets and axis directions
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

struct AxisLineVectors {
  Vec3 point = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();
};

struct AxisVectors {
  AxisLetter axis = AxisLetter::A;
  int side = +1;  // as of Joint
  AxisLineVectors nominal{};
  AxisLineVectors actual{};
  // From the axis before it on the same side, zero for the first: actual.
  Vec3 from_previous = Vec3::Zero();
  AxisLineVectors in_bed{};  // actual, all axes at zero
};

[[nodiscard]] std::vector<AxisVectors> axis_vectors(const Machine& machine,
                                                    const GeometricErrors& errors);

}  // namespace frustum::kinematics
