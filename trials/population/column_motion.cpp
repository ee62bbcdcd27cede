#include "trials/population/column_motion.hpp"

#include <cmath>

namespace frustum::trials {

using kinematics::AxisErrors;
using kinematics::ErrorDirection;
using kinematics::ErrorName;

kinematics::AxisState state_between(const kinematics::AxisState& from,
                                    const kinematics::AxisState& to, double share) {
  kinematics::AxisState state = from;
  for (const auto letter : kinematics::kAxisLetters) {
    state.q[letter] += share * (to.q[letter] - from.q[letter]);
    state.heading[letter] += share * (to.heading[letter] - from.heading[letter]);
  }
  return state;
}

ColumnMotion::ColumnMotion(const kinematics::Machine& machine, const PopulationLaws& laws,
                           const Pose& table_from_workpiece)
    : machine_(&machine), workpiece_from_table_(table_from_workpiece.inverse().rotation) {
  const auto columns = laws.columns();
  for (const ErrorColumn& column : columns) {
    limits_.push_back(column.most - std::abs(column.middle));
  }
  for (const auto letter : kinematics::kAxisLetters) {
    for (std::size_t k = 0; k < 6; ++k) {
      const auto direction = static_cast<ErrorDirection>(k);
      const auto share = [&](bool location, bool carries, const auto& add) {
        const std::size_t before = shares_.size();
        for (std::size_t c = 0; c < columns.size(); ++c) add(c, columns[c].unit[letter]);
        if (shares_.size() == before) return;
        for (std::size_t i = before; i < shares_.size(); ++i) shares_[i].error = errors_.size();
        errors_.push_back({"", ErrorName{direction, letter, location}, 1.0, carries});
      };
      share(false, false, [&](std::size_t c, const AxisErrors& unit) {
        if (!unit.component[k].is_zero())
          shares_.push_back({c, 0, 0.0, &unit.component[k], letter});
      });
      share(true, false, [&](std::size_t c, const AxisErrors& unit) {
        if (unit.location[k] != 0.0) shares_.push_back({c, 0, unit.location[k], nullptr, letter});
      });
      if (k < 3) continue;
      share(true, true, [&](std::size_t c, const AxisErrors& unit) {
        const double tilt = unit.carried_tilt[static_cast<Eigen::Index>(k) - 3];
        if (tilt != 0.0) shares_.push_back({c, 0, tilt, nullptr, letter});
      });
    }
  }
}

std::vector<kinematics::PoseDisplacement> ColumnMotion::at(const kinematics::AxisState& state,
                                                           double tool_length) const {
  std::vector<kinematics::PoseDisplacement> motions(limits_.size());
  if (shares_.empty()) return motions;
  const kinematics::GainMatrix gains =
      kinematics::gain_matrix(*machine_, errors_, state.q, tool_length);
  for (const Share& share : shares_) {
    const double by =
        share.function != nullptr ? (*share.function)(share.axis, state) : share.constant;
    const auto column = gains.col(static_cast<Eigen::Index>(share.error));
    motions[share.column].tip += by * column.head<3>();
    motions[share.column].turn += by * column.tail<3>();
  }
  for (auto& motion : motions) {
    motion.tip = workpiece_from_table_ * motion.tip;
    motion.turn = workpiece_from_table_ * motion.turn;
  }
  return motions;
}

}  // namespace frustum::trials
