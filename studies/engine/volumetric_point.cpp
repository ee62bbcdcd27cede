#include "studies/engine/volumetric_point.hpp"

#include "kinematics/errors/error_gain.hpp"

namespace frustum::studies {

double VolumetricPoint::length(std::span<const double> weights) const {
  Vec3 error = fixed;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    error += weights[j] * gains.col(static_cast<Eigen::Index>(j));
  }
  return error.norm();
}

VolumetricPoint volumetric_point(const kinematics::Machine& machine, const FactorSet& set,
                                 const kinematics::AxisPositions& at, double tool_length) {
  const auto displacement = [&](const kinematics::GeometricErrors& errors) -> Vec3 {
    return kUmPerMm * kinematics::first_order_displacement(machine, errors, {at}, tool_length).tip;
  };
  VolumetricPoint point{displacement(set.fixed())};
  point.gains.resize(3, static_cast<Eigen::Index>(set.columns().size()));
  for (std::size_t j = 0; j < set.columns().size(); ++j) {
    point.gains.col(static_cast<Eigen::Index>(j)) = displacement(set.columns()[j].unit);
  }
  return point;
}

std::optional<NormalLength> exact_length(const VolumetricPoint& point, const FactorSet& set) {
  if (!set.nonlinear().empty()) return std::nullopt;
  for (const Variable& v : set.variables()) {
    if (v.law.kind != Law::Kind::normal || v.law.limit) return std::nullopt;
  }
  for (const Column& column : set.columns()) {
    const auto& parts = set.amounts()[column.amount].parts;
    const bool is_normal = column.wave == Wave::none && parts.size() == 1 &&
                           parts.front().function == kinematics::DrawnFactor::Function::itself;
    if (!is_normal) return std::nullopt;
  }
  const WeightMoments moments = set.weight_moments();
  return NormalLength(point.fixed + point.gains * moments.mean,
                      point.gains * moments.covariance * point.gains.transpose());
}

}  // namespace frustum::studies
