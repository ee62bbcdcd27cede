#include "kinematics/errors/error_ranking.hpp"

#include <algorithm>
#include <cassert>

namespace frustum::kinematics {
namespace {

std::vector<RankedError> largest_first(std::vector<RankedError> ranking) {
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const RankedError& a, const RankedError& b) { return a.weight > b.weight; });
  return ranking;
}

double displacement(const GainMatrix& gains, std::size_t column) {
  return gains.col(static_cast<Eigen::Index>(column)).head(3).norm();
}

}  // namespace

double gain_length(const MachineError& error, const GainMatrix& gains, std::size_t column) {
  constexpr double kMetresPerMm = 1e-3;
  return displacement(gains, column) * (is_rotation(error.error.direction) ? kMetresPerMm : 1.0);
}

std::vector<RankedError> rank_by_gain(std::span<const MachineError> errors,
                                      const GainMatrix& gains) {
  std::vector<RankedError> ranking;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    ranking.push_back({errors[i].name, gain_length(errors[i], gains, i)});
  }
  return largest_first(std::move(ranking));
}

std::vector<RankedError> rank_by_share(std::span<const MachineError> errors,
                                       const GainMatrix& gains,
                                       std::span<const double> tolerances) {
  assert(tolerances.size() == errors.size());
  std::vector<RankedError> ranking;
  double sum = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double spread = displacement(gains, i) * tolerances[i];
    ranking.push_back({errors[i].name, spread * spread});
    sum += spread * spread;
  }
  for (RankedError& error : ranking) error.weight = sum > 0.0 ? error.weight / sum : 0.0;
  return largest_first(std::move(ranking));
}

}  // namespace frustum::kinematics
