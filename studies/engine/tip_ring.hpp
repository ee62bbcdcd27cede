// A cone as the tool tip alone writes it on a machine with errors: a ring of points.
//
// Model    : the tip follows the base circle of the cone, the tool axis its generatrix
//            (tip (r cos, r sin, 0), axis (-sin a cos, -sin a sin, cos a), inclined by b about Y).
//            The nominal machine gives the axis positions; every axis has the direction of approach
//            of its motion along phi. A column moves a point by its first-order displacement along
//            the outward normal. Angles are midpoints of equal steps
//              cone form      range of what the mean and both first harmonics leave
//              half angle     mean of the rotation that tilts the generatrix outward
//              roundness      the cylinder about the cone's axis: the same range, radially
// Units    : mm, rad; values um and urad
// Shape    : as many points as asked for (360); columns of the set
// Errors   : a ring that the machine cannot reach
// Accuracy : first order; 1e-3 um against an independent computation
//            (tests/studies/tip_ring_test.cpp)
// Source   : Bossoni 2010, sections 3.2 and 3.9
#pragma once

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/machine.hpp"
#include "studies/engine/linear_model.hpp"
#include "studies/laws/factors.hpp"

namespace frustum::studies {

struct ConeRing {
  double half_angle = 0.0;     // rad
  double inclination = 0.0;    // rad
  double radius = 0.0;         // mm, of the tip's circle
  Vec3 center = Vec3::Zero();  // of the circle, in the table's frame
  double tool_length = 0.0;
  std::size_t points = 360;
};

// The nominal machine's way round: places, normals and axis states.
struct RingPath {
  std::vector<double> angles{};
  std::vector<Vec3> normals{};   // outward, table frame
  std::vector<Vec3> tangents{};  // the way of rising angles
  std::vector<kinematics::AxisState> axes{};
  kinematics::AxisSpans spans{};  // travelled by each axis
};

[[nodiscard]] Result<RingPath> cone_path(const kinematics::Machine& machine, const ConeRing& ring);
// The cylinder that is finished with the table turned so that the cone's axis is parallel to Z.
[[nodiscard]] Result<RingPath> cylinder_path(const kinematics::Machine& machine,
                                             const ConeRing& ring);

// Motion of each point along its normal by a unit of each column, mm; centred: less what a circle
// that moves takes up.
[[nodiscard]] Eigen::MatrixXd ring_gains(const kinematics::Machine& machine, const RingPath& path,
                                         const FactorSet& set, double tool_length);
// "cone.equivalent_form" (um) and "cone.half_angle" (urad); or "cylinder.roundness" (um).
[[nodiscard]] LinearModel cone_model(const kinematics::Machine& machine, const RingPath& path,
                                     const FactorSet& set, const ConeRing& ring);
[[nodiscard]] LinearModel cylinder_model(const kinematics::Machine& machine, const RingPath& path,
                                         const FactorSet& set, const ConeRing& ring);

}  // namespace frustum::studies
