#include "metrology/fit/point_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::metrology {

PointBlocks PointBlocks::of(const NormalisedPoints& local) {
  PointBlocks result;
  result.count = local.points.size();
  result.weighted = !local.weights.empty();
  const std::size_t blocks = (result.count + kSize - 1) / kSize;
  for (auto* column : {&result.x, &result.y, &result.z, &result.root_weight})
    column->resize(blocks);
  for (std::size_t i = 0; i < blocks * kSize; ++i) {
    const std::size_t from = std::min(i, result.count - 1);
    const Vec3& p = local.points[from];
    const auto at = static_cast<Eigen::Index>(i % kSize);
    result.x[i / kSize][at] = p.x();
    result.y[i / kSize][at] = p.y();
    result.z[i / kSize][at] = p.z();
    const double weight = result.weighted ? std::sqrt(local.weights[from]) : 1.0;
    result.root_weight[i / kSize][at] = i < result.count ? weight : 0.0;
  }
  return result;
}

}  // namespace frustum::metrology
