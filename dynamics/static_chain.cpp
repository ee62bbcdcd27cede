#include "dynamics/static_chain.hpp"

#include <Eigen/Cholesky>

namespace frustum::dynamics {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Row6 static_tip(const DynamicModel& model, const Structure& structure,
                const Eigen::VectorXd& load) {
  const std::size_t count = structure.bodies.size();
  // About the centre of the outer body.
  std::vector<Matrix6> stiffness(count, Matrix6::Zero());
  for (const Element& e : structure.elements) {
    stiffness[static_cast<std::size_t>(e.row.outer)].noalias() +=
        e.spring.stiffness * e.row.of_outer * e.row.of_outer.transpose();
  }
  std::vector<Row6> borne(count);
  for (std::size_t b = 0; b < count; ++b) {
    borne[b] = load.segment<6>(6 * static_cast<Eigen::Index>(b));
  }
  // On the same ground, bed and workpiece move alike.
  const bool bed_counts = model.workpiece_on_ground && !model.has_work_chain();
  Row6 tip = Row6::Zero();
  for (std::size_t b = count; b-- > (bed_counts ? 0U : 1U);) {
    const Row6 yields = stiffness[b].llt().solve(borne[b]);
    const double sign = b <= model.tool_axes ? 1.0 : -1.0;
    const Vec3 to_tip = structure.tip_in_machine - structure.bodies[b].centre;
    tip.head<3>() += sign * (yields.head<3>() + Vec3(yields.tail<3>()).cross(to_tip));
    tip.tail<3>() += sign * yields.tail<3>();
    if (b == 0) break;
    const auto before = static_cast<std::size_t>(model.axes[b - 1].previous + 1);
    const Vec3 arm = structure.bodies[b].centre - structure.bodies[before].centre;
    borne[before].head<3>() += borne[b].head<3>();
    borne[before].tail<3>() += borne[b].tail<3>() + arm.cross(Vec3(borne[b].head<3>()));
  }
  return tip;
}

}  // namespace frustum::dynamics
