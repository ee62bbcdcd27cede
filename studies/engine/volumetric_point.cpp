#include "studies/engine/volumetric_point.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

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

std::vector<double> volumetric_lengths(const VolumetricPoint& point, const FactorSet& set,
                                       const Scheme& scheme, std::uint64_t seed,
                                       std::uint32_t first, std::uint32_t count) {
  constexpr std::uint32_t kBlock = 1024;
  std::vector<double> lengths(count);
  tbb::parallel_for(std::uint32_t{0}, (count + kBlock - 1) / kBlock, [&](std::uint32_t block) {
    std::vector<double> u(set.variables().size()), values(u.size()), weights(set.columns().size());
    const std::uint32_t end = std::min(count, (block + 1) * kBlock);
    for (std::uint32_t d = block * kBlock; d < end; ++d) {
      if (scheme.kind() == SchemeKind::random) {
        set.draw(seed, first + d, values);
      } else {
        scheme.point(first + d, u);
        set.from_uniform(u, values);
      }
      set.weights(values, weights);
      lengths[d] = point.length(weights);
    }
  });
  return lengths;
}

}  // namespace frustum::studies
