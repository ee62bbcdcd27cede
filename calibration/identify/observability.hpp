// Which machine errors the measurements identify, which only together, and what would separate
// them.
//
// Model    : singular values of the whitened matrix with unknowns in units of their expected size.
//            One below max(kFaintest, kGainAccuracy * largest) is a direction of the null space: a
//            change along it by its expected size changes the measurements by less than that many
//            standard deviations
// Units    : singular values dimensionless; terms of combinations in mm and rad
// Shape    : one singular value a free unknown, largest first
// Errors   : those of weighted_system; candidates whose sizes do not fit
// Accuracy : what is said is said of the directions as a whole; entries below kUntouched are not
//            listed
// Source   : Golub, Van Loan, Matrix Computations, section 5.5 (rank deficiency)
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/identify/observations.hpp"
#include "calibration/identify/weighted_system.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

// Below a tenth of a standard deviation an estimate would be ten times coarser than what one
// expects of the error anyway.
constexpr double kFaintest = 0.1;
// Central differences give sensitivities to 1e-6: smaller singular values are theirs.
constexpr double kGainAccuracy = 1e-6;
// An unknown that the null space, moved by its expected size, moves by less than this part of its
// own expected size (0.03 urad, 0.015 um) counts as identified; also if by less than kFaintest of
// its standard uncertainty, up to the second limit.
constexpr double kUntouched = 1e-3;
constexpr double kHardlyTouched = 1e-2;

struct Term {
  Eigen::Index unknown = 0;  // index into Observations::unknowns
  double coefficient = 0.0;
};

// sum of coefficient * unknown. With lengths and angles together an estimable one has the unit mm.
struct Combination {
  std::vector<Term> terms{};
  std::string text{};  // "beta_AY + beta_CA"
};

// A change of unknowns that no measurement sees.
struct NullDirection {
  std::vector<Term> terms{};
  std::string text{};  // a sentence
};

struct Observability {
  std::vector<double> singular_values{};
  int unknowns = 0;  // free ones
  int rank = 0;
  // Largest over smallest singular value of the whitened matrix with unknowns in um and urad, and
  // with its columns at length one; nothing when the rank is short.
  std::optional<double> condition_weighted{};
  std::optional<double> condition_columns{};
  std::vector<bool> identified{};  // one an unknown; fixed ones are
  std::vector<NullDirection> null_space{};
  std::vector<Combination> estimable{};  // of the unknowns that are not identified one by one

  [[nodiscard]] bool complete() const { return rank == unknowns; }
};

[[nodiscard]] Observability observability(const Observations& observations,
                                          const WeightedSystem& system);
[[nodiscard]] Result<Observability> observability(const Observations& observations,
                                                  const Floor& floor = {});

// Whether each free unknown is identified, by an orthonormal basis of the null space and the
// variances of the rest (both in expected sizes).
[[nodiscard]] std::vector<bool> identified_by(const Eigen::MatrixXd& null_space,
                                              const Eigen::VectorXd& variances);

// Unknowns that can be identified one after the other: in their order, each that the measurements
// separate from all those kept before it. The others only move what these do.
[[nodiscard]] Result<std::vector<Eigen::Index>> independent_unknowns(
    const Observations& observations, const Floor& floor = {});

// How many singular values (largest first) count.
[[nodiscard]] int rank_of(const Eigen::VectorXd& singular_values);

// Something that could be cut and measured besides, independent of what is there.
struct Candidate {
  std::string name{};
  std::vector<Row> rows{};
  Eigen::MatrixXd gain{};        // its rows x all unknowns
  Eigen::MatrixXd covariance{};  // of its rows
};

struct Separation {
  struct Gain {
    std::size_t candidate = 0;
    int rank = 0;  // with this candidate alone
  };
  int rank_before = 0;
  int unknowns = 0;
  std::vector<Gain> by_rank{};  // highest rank first, then in the order given
  // The fewest candidates that remove the null space; among equals the one whose weakest direction
  // is identified best. Nothing when all together do not. Empty when nothing is missing.
  std::optional<std::vector<std::size_t>> smallest{};
};

// At most kMostCandidates candidates.
constexpr std::size_t kMostCandidates = 16;
[[nodiscard]] Result<Separation> separating(const Observations& observations,
                                            std::span<const Candidate> candidates,
                                            const Floor& floor = {});

}  // namespace frustum::calibration
