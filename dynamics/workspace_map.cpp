#include "dynamics/workspace_map.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/inertial_load.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/static_chain.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kUmPerMetre = 1e6;
constexpr Index kRangedModes = 3;

// All that is asked for in one position.
class PositionValues {
 public:
  PositionValues(const DynamicModel& model, const Structure& structure, VectorXd frequencies)
      : model_(model), s_(structure), frequencies_(std::move(frequencies)) {}

  double operator()(const InertialQuantity& h) const {
    const std::size_t axis = *model_.axis(h.axis);
    const VectorXd load = unit_acceleration_loads(model_, s_).col(static_cast<Index>(axis));
    return std::abs(tip_of(h.direction, load)) * inertial_scale(model_.axes[axis].joint);
  }
  double operator()(const FrequencyQuantity& f) const { return frequencies_[f.mode]; }
  double operator()(const ComplianceQuantity& g) const {
    return std::abs(tip_of(g.motion, s_.tip.row(g.force).transpose())) * kUmPerMetre;
  }

 private:
  [[nodiscard]] double tip_of(Index direction, const VectorXd& load) const {
    return static_tip(model_, s_, load)[direction];
  }
  const DynamicModel& model_;
  const Structure& s_;
  VectorXd frequencies_;
};

void widen(std::vector<std::array<double, 2>>& ranges, const VectorXd& frequencies) {
  const Index modes = std::min(kRangedModes, frequencies.size());
  if (ranges.empty()) {
    for (Index m = 0; m < modes; ++m) ranges.push_back({frequencies[m], frequencies[m]});
  }
  for (Index m = 0; m < modes; ++m) {
    auto& [least, most] = ranges[static_cast<std::size_t>(m)];
    least = std::min(least, frequencies[m]);
    most = std::max(most, frequencies[m]);
  }
}

// Between the values of neighbouring ranks 0 .. n - 1.
double between_ranks(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  return std::lerp(sorted[below], sorted[below + 1], place - static_cast<double>(below));
}

}  // namespace

double MapAxis::at(int i) const {
  return count < 2 ? from : std::lerp(from, to, static_cast<double>(i) / (count - 1));
}

BoxOfValues box_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  return {values.front(), between_ranks(values, 0.25), between_ranks(values, 0.5),
          between_ranks(values, 0.75), values.back()};
}

double inertial_scale(const kinematics::Joint& joint) {
  return joint.rotary() ? kUmPerMetre : kUmPerMetre * kGravity;
}

Result<WorkspaceMap> map_workspace(const DynamicModel& model, const kinematics::AxisPositions& held,
                                   double tool_length, const MapAxis& rows, const MapAxis& columns,
                                   const MapQuantity& quantity, Frequencies frequencies) {
  WorkspaceMap map{Eigen::MatrixXd(rows.count, columns.count), {}, {}};
  std::vector<double> values;
  const bool wants_modes =
      frequencies == Frequencies::ranges || std::holds_alternative<FrequencyQuantity>(quantity);
  const bool needs_matrices = wants_modes || std::holds_alternative<ComplianceQuantity>(quantity);
  for (int r = 0; r < rows.count; ++r) {
    for (int c = 0; c < columns.count; ++c) {
      kinematics::AxisPositions q = held;
      q[rows.letter] = rows.at(r);
      q[columns.letter] = columns.at(c);
      const Structure structure =
          needs_matrices ? structure_at(model, q, tool_length) : layout_at(model, q, tool_length);
      VectorXd found;
      if (wants_modes) {
        found = natural_frequencies(structure);
        if (!(found[0] > 0.0)) {
          if (const auto loose = loose_body(model, structure)) return loose->problem;
        }
        widen(map.frequency_ranges, found);
      }
      map.values(r, c) = std::visit(PositionValues(model, structure, std::move(found)), quantity);
      values.push_back(map.values(r, c));
    }
  }
  map.box = box_of(std::move(values));
  return map;
}

}  // namespace frustum::dynamics
