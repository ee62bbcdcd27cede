// Which test pieces to cut: the smallest set that identifies every machine error, the best set of a
// size.
//
// Model    : information of a set = G^T S^+ G of its rows (joint covariance S, so that shared
//            references count once) + priors, unknowns in units of their expected size
//              d_optimal      largest log det, smallest volume of the joint uncertainty
//              a_optimal      smallest sum of variances over expected sizes squared
//              worst_unknown  smallest of the largest standard deviations over expected sizes
//            Sets of higher rank go first; with a short rank only the directions identified count
// Units    : mm, rad; criteria dimensionless (log det a natural logarithm)
// Shape    : every subset of at most kMostBlocks blocks
// Errors   : those of weighted_system; too many blocks, rows outside the observations or in two
//            blocks, unknown block in `required` or `exclusive`, limits of another size
// Accuracy : exhaustive; sets equal to nine digits: the one whose blocks come first
// Source   : Pukelsheim, Optimal Design of Experiments, chapter 6
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibration/identify/observability.hpp"
#include "calibration/identify/observations.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

constexpr std::size_t kMostBlocks = 16;

// What is cut and measured as one: a pattern with its rows of the observations.
struct DesignBlock {
  std::string name{};
  std::vector<Eigen::Index> rows{};
};

enum class DesignCriterion : std::uint8_t { d_optimal, a_optimal, worst_unknown };

struct DesignOptions {
  DesignCriterion criterion = DesignCriterion::d_optimal;
  Floor floor{};
  std::vector<std::size_t> required{};                           // in every set: cut already
  std::vector<std::pair<std::size_t, std::size_t>> exclusive{};  // never together in a set
  std::vector<std::pair<std::size_t, std::size_t>> needs{};      // the first only with the second
  // How many unknowns, from the first on, have to be identified; others, as of set-ups, need not.
  std::optional<std::size_t> asked{};
  // Largest standard deviation wanted, one an unknown; empty: none.
  std::vector<std::optional<double>> limits{};
};

struct DesignChoice {
  std::vector<std::size_t> blocks{};
  int rank = 0;
  bool identifies_all = false;      // that is asked for
  bool meets_limits = false;        // and identifies all
  std::optional<double> log_det{};  // only if it identifies all
  double criterion = 0.0;           // of the directions identified; smaller is better
  // fixed unknowns 0; empty: not identified
  std::vector<std::optional<double>> standard_deviations{};
};

struct DesignResult {
  int unknowns = 0;                             // free ones
  std::vector<DesignChoice> best_of_size{};     // for each size that has an allowed set, ascending
  std::vector<std::size_t> identifying_sets{};  // of each of those sizes: how many identify all
  std::optional<DesignChoice> smallest{};  // fewest blocks that identify all and meet the limits
  // All sets with the fewest blocks that identify all, limits or not, in the order of their blocks.
  std::vector<std::vector<std::size_t>> smallest_identifying{};
};

// Rank, then criterion (equal to nine digits counts as equal), then the order of the blocks.
[[nodiscard]] bool better(const DesignChoice& a, const DesignChoice& b);

// The values of the observations are not used.
[[nodiscard]] Result<DesignResult> design(const Observations& observations,
                                          std::span<const DesignBlock> blocks,
                                          const DesignOptions& options = {});

}  // namespace frustum::calibration
