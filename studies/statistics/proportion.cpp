#include "studies/statistics/proportion.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <cassert>

namespace frustum::studies {

std::array<double, 2> clopper_pearson(std::uint64_t k, std::uint64_t n, double confidence) {
  assert(n >= 1 && k <= n);
  const double tail = 0.5 * (1.0 - confidence);
  const auto successes = static_cast<double>(k);
  const auto failures = static_cast<double>(n - k);
  return {k == 0 ? 0.0 : boost::math::ibeta_inv(successes, failures + 1.0, tail),
          k == n ? 1.0 : boost::math::ibetac_inv(successes + 1.0, failures, tail)};
}

Proportion proportion(std::uint64_t k, std::uint64_t n) {
  return {k, n, static_cast<double>(k) / static_cast<double>(n), clopper_pearson(k, n)};
}

}  // namespace frustum::studies
