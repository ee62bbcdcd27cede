#include "calibration/identify/information.hpp"

#include <algorithm>

namespace frustum::calibration {
namespace {

std::vector<std::string> groups_of(const Observations& observations) {
  std::vector<std::string> groups;
  for (const Row& row : observations.rows) {
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) {
      groups.push_back(row.group);
    }
  }
  return groups;
}

double share(const Estimate& all, const Estimate* without) {
  if (all.fixed || !all.standard_uncertainty) return 0.0;
  if (without == nullptr || !without->standard_uncertainty) return 1.0;
  const double ratio = *all.standard_uncertainty / *without->standard_uncertainty;
  return std::clamp(1.0 - ratio * ratio, 0.0, 1.0);
}

}  // namespace

Result<InformationShares> information_shares(const Observations& observations,
                                             const IdentifyOptions& options) {
  const auto all = identify(observations, options);
  if (!all) return all.error();
  InformationShares result{groups_of(observations), {}};
  const std::size_t unknowns = observations.unknowns.size();
  result.shares = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns),
                                        static_cast<Eigen::Index>(result.groups.size()));
  for (std::size_t g = 0; g < result.groups.size(); ++g) {
    std::vector<Eigen::Index> others;
    for (std::size_t i = 0; i < observations.rows.size(); ++i) {
      if (observations.rows[i].group != result.groups[g]) {
        others.push_back(static_cast<Eigen::Index>(i));
      }
    }
    std::vector<Estimate> without;
    if (!others.empty()) {
      auto rest = identify(observations.selected(others), options);
      if (!rest) return rest.error();
      without = std::move(rest->estimates);
    }
    for (std::size_t j = 0; j < unknowns; ++j) {
      result.shares(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(g)) =
          share(all->estimates[j], without.empty() ? nullptr : &without[j]);
    }
  }
  return result;
}

}  // namespace frustum::calibration
