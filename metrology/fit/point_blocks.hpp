// Points of a fit by blocks of coordinates, which the processor works on several at a time.
//
// Units  : local frame of size one (normalised_points.hpp)
// Shape  : the last block is filled up with its last point; root_weight of the filling is zero
// Errors : none
#pragma once

#include <Eigen/Core>
#include <vector>

#include "metrology/fit/normalised_points.hpp"

namespace frustum::metrology {

struct PointBlocks {
  static constexpr int kSize = 32;
  using Block = Eigen::Array<double, kSize, 1>;
  std::vector<Block> x{};
  std::vector<Block> y{};
  std::vector<Block> z{};
  std::vector<Block> root_weight{};
  std::size_t count = 0;
  bool weighted = false;

  [[nodiscard]] static PointBlocks of(const NormalisedPoints& local);
  // Blocks whose weights are not all 1.
  [[nodiscard]] bool weighs(std::size_t block) const {
    return weighted || (block + 1 == x.size() && count % kSize != 0);
  }
  [[nodiscard]] double root_weight_of(std::size_t i) const {
    return root_weight[i / kSize][static_cast<Eigen::Index>(i % kSize)];
  }
  [[nodiscard]] Vec3 point(std::size_t i) const {
    const auto at = static_cast<Eigen::Index>(i % kSize);
    return {x[i / kSize][at], y[i / kSize][at], z[i / kSize][at]};
  }
};

}  // namespace frustum::metrology
