// Which errors make the scatter of a characteristic.
//
// Model    : mean-square shares, exact of a linear model: deviations of points x = G w, weights
//            with second moments M_f = E w_f w_f^T of each factor; the share of a factor is
//              trace(G_f M_f G_f^T) / sum over all factors
//            Sobol indices of any function of independent factors, by two independent sets of draws
//            A and B, and A with one group of factors from B:
//              first order  mean(f_B (f_AB - f_A)) / var       (Saltelli 2010)
//              total        mean((f_A - f_AB)^2) / 2 var       (Jansen 1999)
//            A form is a norm: its first-order indices nearly vanish, so rank by mean-square share
//            and by total index
// Units    : none
// Shape    : one share a group of factors
// Errors   : none
// Accuracy : mean squares to rounding; indices have standard errors, from the scatter of the terms
//            (tests/studies/shares_test.cpp)
// Source   : Saltelli et al. 2010, Comput. Phys. Commun. 181(2); Jansen 1999, Comput. Phys. Commun.
//            117
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "studies/laws/factors.hpp"

namespace frustum::studies {

// Factors by group, in the order of the groups' names.
struct FactorGroup {
  std::string name{};
  std::vector<std::size_t> factors{};
};
// Every entry a group of its own. Factors of several entries have the name of the first.
[[nodiscard]] std::vector<FactorGroup> groups_by_entry(const FactorSet& set);
// Groups as people write them: patterns of errors such as "E*B", "EX?:harmonic 2"; what no pattern
// names is in the group `rest`.
// Errors: a pattern without a match, with the nearest name; a factor in two groups.
[[nodiscard]] Result<std::vector<FactorGroup>> groups_named(
    const kinematics::Machine& machine, const FactorSet& set,
    const std::map<std::string, std::vector<std::string>>& patterns);

struct MeanSquareShares {
  double mean_square = 0.0;      // of all points and draws: the factors' own, added
  std::vector<double> shares{};  // by group; sum to 1
};
// Gains: points x columns of the set, in any unit.
[[nodiscard]] MeanSquareShares mean_square_shares(const Eigen::MatrixXd& gains,
                                                  const FactorSet& set,
                                                  std::span<const FactorGroup> groups);

struct SobolIndex {
  double first = 0.0, first_se = 0.0;
  double total = 0.0, total_se = 0.0;
};
struct SobolIndices {
  double mean = 0.0;
  double variance = 0.0;
  std::vector<SobolIndex> groups{};
};

// The function of one draw's values of all variables, many draws at a time: `values` has a row of
// variables a draw.
using DrawFunction = std::function<void(std::span<const double> values, std::span<double> results)>;
// Values of all variables of draw d in the set of draws A (false) or B (true).
using PairedDraw = std::function<void(bool b, std::uint32_t d, std::span<double> values)>;

// `variables`: of each group, the variables that come from B.
[[nodiscard]] SobolIndices sobol_indices(std::size_t variable_count,
                                         std::span<const std::vector<std::size_t>> variables,
                                         std::uint32_t draws, const PairedDraw& draw,
                                         const DrawFunction& function);
// A: the draws of the study. B: draws of a seed of their own that the study's seed determines.
[[nodiscard]] SobolIndices sobol_indices(const FactorSet& set, std::span<const FactorGroup> groups,
                                         std::uint64_t seed, std::uint32_t draws,
                                         const DrawFunction& function);

}  // namespace frustum::studies
