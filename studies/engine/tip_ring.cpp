#include "studies/engine/tip_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::studies {
namespace {

using kinematics::AxisPositions;
using kinematics::Machine;

// Between two points the axes are followed in this many steps, so that ranges are right to 1e-6 of
// their width and the turn nearest to the last position is the right one.
constexpr std::size_t kSteps = 20;
// An axis that moves less between two steps rests.
constexpr double kRests = 1e-9;

Result<RingPath> ring_path(const Machine& machine, const ConeRing& ring, double half_angle) {
  const Mat3 table_from_ring = rotation_y(ring.inclination);
  const double s = std::sin(half_angle), c = std::cos(half_angle);
  const std::size_t steps = kSteps * ring.points;
  std::vector<AxisPositions> axes;
  axes.reserve(steps + 1);
  for (std::size_t k = 0; k <= steps; ++k) {
    const double angle = kTurn * static_cast<double>(k) / static_cast<double>(steps);
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    const kinematics::ToolPose pose{table_from_ring * (ring.radius * out) + ring.center,
                                    table_from_ring * (-s * out + c * Vec3::UnitZ())};
    const AxisPositions before = axes.empty() ? AxisPositions{} : axes.back();
    const auto solutions = kinematics::inverse(machine, pose, ring.tool_length, before);
    if (!solutions) return solutions.error();
    // The branch on which the first rotary axis is negative, as the thesis has it.
    std::size_t chosen = 0;
    if (axes.empty() && solutions->size() > 1) {
      for (const auto letter : {kinematics::AxisLetter::A, kinematics::AxisLetter::B}) {
        if ((*solutions)[0].axes[letter] > (*solutions)[1].axes[letter]) chosen = 1;
      }
    }
    axes.push_back((*solutions)[chosen].axes);
  }
  RingPath path;
  for (const auto letter : kinematics::kAxisLetters) {
    if (machine.joint(letter) == nullptr) continue;
    kinematics::AxisRange range{axes.front()[letter], axes.front()[letter]};
    for (const AxisPositions& q : axes) {
      range.lo = std::min(range.lo, q[letter]);
      range.hi = std::max(range.hi, q[letter]);
    }
    if (range.width() > kRests) path.spans[letter] = range;
  }
  for (std::size_t i = 0; i < ring.points; ++i) {
    const std::size_t k = kSteps * i + kSteps / 2;
    const double angle = kTurn * static_cast<double>(k) / static_cast<double>(steps);
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    path.angles.push_back(angle);
    path.normals.emplace_back(table_from_ring * (c * out + s * Vec3::UnitZ()));
    path.tangents.emplace_back(table_from_ring * Vec3(-out.y(), out.x(), 0.0));
    AxisPositions heading;
    for (const auto letter : kinematics::kAxisLetters) {
      const double motion = axes[k + 1][letter] - axes[k - 1][letter];
      heading[letter] = motion > kRests ? 1.0 : motion < -kRests ? -1.0 : 0.0;
    }
    path.axes.push_back({axes[k], heading});
  }
  return path;
}

Eigen::VectorXd angles_of(const RingPath& path) {
  return Eigen::Map<const Eigen::VectorXd>(path.angles.data(),
                                           static_cast<Eigen::Index>(path.angles.size()));
}

// What a function of the first-order displacement is at each point (rows) for each column; the
// last column is that of the fixed errors.
template <typename F>
Eigen::MatrixXd at_points(const Machine& machine, const RingPath& path, const FactorSet& set,
                          double tool_length, const F& value) {
  const auto points = static_cast<Eigen::Index>(path.axes.size());
  const auto columns = static_cast<Eigen::Index>(set.columns().size());
  Eigen::MatrixXd values(points, columns + 1);
  for (Eigen::Index j = 0; j <= columns; ++j) {
    const kinematics::GeometricErrors& errors =
        j < columns ? set.columns()[static_cast<std::size_t>(j)].unit : set.fixed();
    for (Eigen::Index i = 0; i < points; ++i) {
      const auto at = static_cast<std::size_t>(i);
      values(i, j) = value(
          at, kinematics::first_order_displacement(machine, errors, path.axes[at], tool_length));
    }
  }
  return values;
}

Eigen::MatrixXd motions_of(const Machine& machine, const RingPath& path, const FactorSet& set,
                           double tool_length) {
  const Eigen::MatrixXd along_normals = at_points(
      machine, path, set, tool_length, [&](std::size_t i, const kinematics::PoseDisplacement& d) {
        return path.normals[i].dot(d.tip);
      });
  return centred(along_normals, circle_motions(angles_of(path)));
}

LinearCharacteristic form(std::string name, const Eigen::MatrixXd& motions) {
  const Eigen::Index columns = motions.cols() - 1;
  return {std::move(name), "um",
          LinearRange{kUmPerMm * motions.col(columns), kUmPerMm * motions.leftCols(columns)}};
}

}  // namespace

Result<RingPath> cone_path(const Machine& machine, const ConeRing& ring) {
  return ring_path(machine, ring, ring.half_angle);
}

Result<RingPath> cylinder_path(const Machine& machine, const ConeRing& ring) {
  return ring_path(machine, ring, 0.0);
}

Eigen::MatrixXd ring_gains(const Machine& machine, const RingPath& path, const FactorSet& set,
                           double tool_length) {
  const Eigen::MatrixXd motions = motions_of(machine, path, set, tool_length);
  return motions.leftCols(motions.cols() - 1);
}

LinearModel cone_model(const Machine& machine, const RingPath& path, const FactorSet& set,
                       const ConeRing& ring) {
  LinearModel model;
  model.characteristics.push_back(
      form("cone.equivalent_form", motions_of(machine, path, set, ring.tool_length)));
  // Turning about the tangent tilts the generatrix; the mean over the ring is what the axis of the
  // cone cannot take up.
  const Eigen::RowVectorXd tilt =
      at_points(machine, path, set, ring.tool_length,
                [&](std::size_t i, const kinematics::PoseDisplacement& d) {
                  return -path.tangents[i].dot(d.turn);
                })
          .colwise()
          .mean();
  const Eigen::Index columns = tilt.size() - 1;
  model.characteristics.push_back(
      {"cone.half_angle", "urad",
       LinearSum{kUradPerRad * tilt[columns], kUradPerRad * tilt.head(columns).transpose()}});
  return model;
}

LinearModel cylinder_model(const Machine& machine, const RingPath& path, const FactorSet& set,
                           const ConeRing& ring) {
  LinearModel model;
  model.characteristics.push_back(
      form("cylinder.roundness", motions_of(machine, path, set, ring.tool_length)));
  return model;
}

}  // namespace frustum::studies
