// Which test pieces to cut: the smallest set that identifies every machine error, the best set of a
// size.
//
// Model    : information of a set = G^T S^+ G of its rows (joint covariance S, so that shared
//            references count once) + priors, unknowns in units of their expected size
//              d_optimal      largest log det, smallest volume of the joint uncertainty
//              a_optimal      smallest sum of variances over expected sizes squared
//              worst_unknown  smallest of the largest standard deviations over expected sizes
//            of the unknowns of interest, the others being unknown beside them.
//            Sets of higher rank go first; with a short rank only the directions identified count.
//            What a set gives, whatever its rank, is bits = log2 det(1 + I) / 2, I the information
//            about the unknowns of interest in sizes of theirs (priors or expected ones), the
//            others being unknown beside them but for their priors: by how much it shrinks what is
//            expected of them
// Units    : mm, rad; criteria dimensionless (log det a natural logarithm)
// Shape    : every subset of at most kMostBlocks blocks
// Errors   : those of weighted_system; too many blocks, rows outside the observations or in two
//            blocks, unknown block in `required` or `exclusive`, limits or costs of another size
// Accuracy : exhaustive; sets equal to nine digits: the one that costs less, then the one whose
//            blocks come first
// Source   : Pukelsheim, Optimal Design of Experiments, chapter 6; bits: Lindley 1956, Ann. Math.
//            Statist. 27(4)
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
  // Largest standard deviation wanted, one an unknown; empty: none.
  std::vector<std::optional<double>> limits{};
  std::vector<std::size_t> no_interest{};  // unknowns that nobody asks for: tool radii, balls
  std::vector<double> costs{};     // of each block, 0 or more; empty: nothing costs anything
  std::optional<double> budget{};  // that a set may cost
};

struct DesignChoice {
  std::vector<std::size_t> blocks{};
  int rank = 0;
  double cost = 0.0;  // the sum of its blocks'
  double bits = 0.0;
  bool identifies_all = false;
  bool meets_limits = false;        // and identifies all
  std::optional<double> log_det{};  // only if it identifies all
  double criterion = 0.0;           // of the directions identified; smaller is better
  // fixed unknowns 0; empty: not identified
  std::vector<std::optional<double>> standard_deviations{};
};

struct DesignResult {
  int unknowns = 0;                             // free ones of interest
  std::vector<DesignChoice> best_of_size{};     // for each size that has an allowed set, ascending
  std::vector<std::size_t> identifying_sets{};  // of each of those sizes: how many identify all
  std::optional<DesignChoice> smallest{};  // fewest blocks that identify all and meet the limits
  std::vector<DesignChoice> alone{};       // each block by itself, whatever is allowed
  // Of the sets that cost no more than the budget the best that meets the limits, else the best;
  // nothing: no budget, or nothing that it allows.
  std::optional<DesignChoice> within_budget{};
  // All sets with the fewest blocks that identify all, limits or not, in the order of their blocks.
  std::vector<std::vector<std::size_t>> smallest_identifying{};
};

// Rank, then criterion (equal to nine digits counts as equal), then cost, then the order of the
// blocks.
[[nodiscard]] bool better(const DesignChoice& a, const DesignChoice& b);

// The values of the observations are not used.
[[nodiscard]] Result<DesignResult> design(const Observations& observations,
                                          std::span<const DesignBlock> blocks,
                                          const DesignOptions& options = {});

}  // namespace frustum::calibration
