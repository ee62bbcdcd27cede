#include "kinematics/errors/volumetric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/quantile.hpp"
#include "kinematics/model/chain.hpp"

namespace frustum::kinematics {
namespace {

std::optional<Diagnostic> problem_of(const Machine& machine, const VolumetricOptions& options) {
  if (options.grid < 2)
    return error(
        "volumetric-grid"_id,
        fmt::format("a grid of {} point{} an axis", options.grid, options.grid == 1 ? "" : "s"),
        "2 or more");
  if (options.positions.empty()) return error("volumetric-grid"_id, "no position to look at");
  for (const HeldAxes& held : options.positions) {
    for (const auto& [letter, q] : held) {
      const Joint* joint = machine.joint(letter);
      if (joint == nullptr) {
        return error("unknown-axis"_id,
                     fmt::format("machine {} ({}) has no axis {}", machine.name(),
                                 machine.structure(), to_char(letter)));
      }
      if (!joint->endless && !joint->travel.contains(q)) {
        const double unit = joint->rotary() ? kDegPerRad : 1.0;
        return error("outside-travel"_id,
                     fmt::format("{} = {} is outside its travel {} .. {} {}", to_char(letter),
                                 q * unit, joint->travel.lo * unit, joint->travel.hi * unit,
                                 joint->rotary() ? "deg" : "mm"));
      }
    }
    for (const AxisLetter letter : kLinearAxes) {
      if (held.contains(letter) != options.positions.front().contains(letter)) {
        return error(
            "volumetric-grid"_id,
            fmt::format("axis {} is held in one position and not in another", to_char(letter)),
            "all positions are looked at on the same grid");
      }
    }
  }
  return std::nullopt;
}

std::vector<double> positions_along(const Joint& joint, const HeldAxes& held, int grid) {
  if (const auto at = held.find(joint.letter); at != held.end()) return {at->second};
  std::vector<double> positions;
  for (int i = 0; i < grid; ++i) {
    const double t = static_cast<double>(i) / (grid - 1);
    positions.push_back((1.0 - t) * joint.travel.lo + t * joint.travel.hi);
  }
  return positions;
}

VolumetricStatistics statistics(const std::vector<VolumetricPoint>& points,
                                Vec3 VolumetricPoint::*vector) {
  std::vector<double> lengths;
  double sum = 0.0;
  for (const VolumetricPoint& p : points) {
    lengths.push_back((p.*vector).norm());
    sum += lengths.back();
  }
  const double most = *std::max_element(lengths.begin(), lengths.end());
  return {most, sum / static_cast<double>(lengths.size()), nearest_rank(lengths, 0.95)};
}

}  // namespace

const VolumetricPoint& VolumetricErrors::worst() const {
  return *std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.relative.squaredNorm() < b.relative.squaredNorm();
  });
}

Result<VolumetricErrors> volumetric_errors(const Machine& machine, const GeometricErrors& errors,
                                           const VolumetricOptions& options) {
  if (const auto problem = problem_of(machine, options)) return *problem;
  const GeometricErrors none;
  const ForwardChain nominal(machine, none, options.tool_length);
  const ForwardChain actual(machine, errors, options.tool_length);
  VolumetricErrors volume;
  volume.position_count = options.positions.size();
  for (const HeldAxes& held : options.positions) {
    AxisPositions q = machine.home();
    for (const auto& [letter, value] : held) q[letter] = value;
    std::array<std::vector<double>, 3> along;
    for (std::size_t i = 0; i < 3; ++i) {
      along[i] = positions_along(*machine.joint(kLinearAxes[i]), held, options.grid);
      volume.counts[i] = static_cast<int>(along[i].size());
    }
    for (const double z : along[2]) {
      for (const double y : along[1]) {
        for (const double x : along[0]) {
          q[AxisLetter::X] = x, q[AxisLetter::Y] = y, q[AxisLetter::Z] = z;
          AxisPositions unturned;
          for (const AxisLetter letter : kLinearAxes) unturned[letter] = q[letter];
          const Vec3 tip = nominal.bed_from_tool(q).translation;
          const Vec3 on_table = nominal.bed_from_table(q).inverse().point(tip);
          VolumetricPoint point{.axes = q};
          point.place = nominal.table_from_tool(unturned).translation;
          point.tool = actual.bed_from_tool(q).translation - tip;
          point.workpiece = actual.bed_from_table(q).point(on_table) - tip;
          point.relative = point.tool - point.workpiece;
          volume.points.push_back(point);
        }
      }
    }
  }
  volume.tool = statistics(volume.points, &VolumetricPoint::tool);
  volume.workpiece = statistics(volume.points, &VolumetricPoint::workpiece);
  volume.relative = statistics(volume.points, &VolumetricPoint::relative);
  return volume;
}

GainMatrix mean_gains(const Machine& machine, std::span<const MachineError> errors,
                      const VolumetricErrors& volume, double tool_length) {
  GainMatrix mean = GainMatrix::Zero(6, static_cast<Eigen::Index>(errors.size()));
  for (const VolumetricPoint& point : volume.points) {
    const GainMatrix gains = gain_matrix(machine, errors, point.axes, tool_length);
    mean.row(0) += gains.topRows(3).colwise().squaredNorm();
  }
  mean.row(0) = (mean.row(0) / static_cast<double>(volume.points.size())).cwiseSqrt();
  return mean;
}

}  // namespace frustum::kinematics
