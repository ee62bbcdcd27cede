#include "calibration/identify/observability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/identify/combination_text.hpp"
#include "calibration/identify/sparse_basis.hpp"
#include "core/linear_algebra.hpp"
#include "core/units.hpp"

namespace frustum::calibration {
namespace {

std::optional<double> condition(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd values = singular_values(matrix).values;
  const double smallest = values[values.size() - 1];
  if (matrix.rows() < matrix.cols() || !(smallest > 0.0)) return std::nullopt;
  return values[0] / smallest;
}

// Column scale that turns units of expected size into um and urad.
Eigen::VectorXd per_micro_unit(const Observations& observations, const WeightedSystem& system) {
  Eigen::VectorXd scale(system.size.size());
  for (Eigen::Index j = 0; j < scale.size(); ++j) {
    const auto unknown = static_cast<std::size_t>(system.free[static_cast<std::size_t>(j)]);
    const double unit = observations.unknowns[unknown].angular ? kUradPerRad : kUmPerMm;
    scale[j] = 1.0 / (system.size[j] * unit);
  }
  return scale;
}

// Orthonormal basis of the vectors on the touched entries that are orthogonal to the null space.
Eigen::MatrixXd complement(const Eigen::MatrixXd& null_space,
                           const std::vector<Eigen::Index>& touched) {
  const Eigen::MatrixXd part = null_space(touched, Eigen::all);
  const Eigen::MatrixXd left = singular_values(part, SingularVectors::full_left).left;
  const auto rest = static_cast<Eigen::Index>(touched.size()) - part.cols();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(null_space.rows(), rest);
  for (std::size_t i = 0; i < touched.size(); ++i) {
    all.row(touched[i]) = left.row(static_cast<Eigen::Index>(i)).tail(rest);
  }
  return all;
}

// Non-zero entries of a vector over the free unknowns, as terms over all unknowns.
std::vector<Term> terms_of(const Eigen::VectorXd& vector, const WeightedSystem& system) {
  std::vector<Term> terms;
  for (Eigen::Index j = 0; j < vector.size(); ++j) {
    if (vector[j] == 0.0) continue;
    terms.push_back({system.free[static_cast<std::size_t>(j)], vector[j]});
  }
  return terms;
}

// The null space on the touched unknowns alone: what leaks into the others is below notice.
Eigen::MatrixXd restricted(const Eigen::MatrixXd& null_space,
                           const std::vector<Eigen::Index>& touched) {
  const Eigen::MatrixXd part = null_space(touched, Eigen::all);
  const Eigen::MatrixXd orthonormal = orthonormal_columns(part);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(null_space.rows(), null_space.cols());
  for (std::size_t i = 0; i < touched.size(); ++i) {
    all.row(touched[i]) = orthonormal.row(static_cast<Eigen::Index>(i));
  }
  return all;
}

void describe(const Observations& observations, const WeightedSystem& system,
              const Eigen::MatrixXd& null_space, const Eigen::VectorXd& variances,
              Observability& result) {
  const std::vector<bool> identified = identified_by(null_space, variances);
  std::vector<Eigen::Index> touched;
  for (std::size_t j = 0; j < identified.size(); ++j) {
    if (identified[j]) continue;
    touched.push_back(static_cast<Eigen::Index>(j));
    result.identified[static_cast<std::size_t>(system.free[j])] = false;
  }
  const Eigen::MatrixXd unseen_part = restricted(null_space, touched);
  const Eigen::MatrixXd directions = sparse_basis(unseen_part, kUntouched);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    // A change of the scaled unknown is a change of size times it.
    const Eigen::VectorXd change = system.size.cwiseProduct(directions.col(k));
    result.null_space.push_back(unseen(terms_of(change, system), observations.unknowns));
  }
  const Eigen::MatrixXd quantities = sparse_basis(complement(unseen_part, touched), kUntouched);
  for (Eigen::Index k = 0; k < quantities.cols(); ++k) {
    const Eigen::VectorXd quantity = quantities.col(k).cwiseQuotient(system.size);
    result.estimable.push_back(readable(terms_of(quantity, system), observations.unknowns));
  }
}

// The pair's other combination, if it can be identified, belongs into the sentence.
void complete_sentences(Observability& result) {
  for (NullDirection& direction : result.null_space) {
    if (direction.terms.size() != 2) continue;
    for (const Combination& other : result.estimable) {
      if (other.terms.size() != 2 || other.terms[0].unknown != direction.terms[0].unknown ||
          other.terms[1].unknown != direction.terms[1].unknown) {
        continue;
      }
      direction.text += fmt::format("; {} can", other.text);
    }
  }
}

Eigen::MatrixXd information_of(const WeightedSystem& system) {
  return system.matrix.transpose() * system.matrix;
}

// Singular values (largest first) of a matrix by its information.
Eigen::VectorXd roots(const Eigen::MatrixXd& information) {
  return symmetric_eigenvalues(information).reverse().cwiseMax(0.0).cwiseSqrt();
}

Result<Eigen::MatrixXd> information_of(const Candidate& candidate, const Observations& base,
                                       const Floor& floor) {
  Observations alone;
  alone.unknowns = base.unknowns;
  alone.rows = candidate.rows;
  alone.gain = candidate.gain;
  alone.values = Eigen::VectorXd::Zero(candidate.gain.rows());
  alone.covariance = candidate.covariance;
  const auto system = weighted_system(alone, floor);
  if (!system) return system.error();
  // Without the priors: they are in the base.
  const Eigen::MatrixXd rows = system->matrix.topRows(system->whitened_rows);
  return Eigen::MatrixXd(rows.transpose() * rows);
}

struct Addition {
  std::vector<std::size_t> candidates{};
  double weakest = 0.0;
};

// The best set of exactly `count` candidates that removes the null space.
std::optional<Addition> best_addition(const Eigen::MatrixXd& base,
                                      std::span<const Eigen::MatrixXd> added, int count) {
  std::optional<Addition> best;
  const unsigned sets = 1U << added.size();
  for (unsigned set = 0; set < sets; ++set) {
    Addition addition;
    Eigen::MatrixXd sum = base;
    for (std::size_t c = 0; c < added.size(); ++c) {
      if ((set >> c & 1U) == 0) continue;
      addition.candidates.push_back(c);
    }
    if (static_cast<int>(addition.candidates.size()) != count) continue;
    for (const std::size_t c : addition.candidates) sum += added[c];
    const Eigen::VectorXd values = roots(sum);
    if (rank_of(values) < base.cols()) continue;
    addition.weakest = values[values.size() - 1];
    // Equal to nine digits: the set that comes first.
    const bool first = best && addition.weakest <= best->weakest * (1.0 + 1e-9) &&
                       addition.weakest >= best->weakest * (1.0 - 1e-9) &&
                       addition.candidates < best->candidates;
    if (!best || addition.weakest > best->weakest * (1.0 + 1e-9) || first) best = addition;
  }
  return best;
}

}  // namespace

std::vector<bool> identified_by(const Eigen::MatrixXd& null_space,
                                const Eigen::VectorXd& variances) {
  std::vector<bool> identified;
  for (Eigen::Index j = 0; j < null_space.rows(); ++j) {
    const double moved = null_space.row(j).norm();
    const double unnoticed = kFaintest * std::sqrt(variances[j]);
    identified.push_back(moved <= std::clamp(unnoticed, kUntouched, kHardlyTouched));
  }
  return identified;
}

int rank_of(const Eigen::VectorXd& singular_values) {
  if (singular_values.size() == 0) return 0;
  const double faintest = std::max(kFaintest, kGainAccuracy * singular_values[0]);
  return static_cast<int>((singular_values.array() >= faintest).count());
}

Observability observability(const Observations& observations, const WeightedSystem& system) {
  const SingularValues svd = singular_values(system.matrix, SingularVectors::full_right);
  const Eigen::Index free = system.matrix.cols();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(free);
  values.head(svd.values.size()) = svd.values;

  Observability result;
  result.singular_values.assign(values.data(), values.data() + values.size());
  result.unknowns = static_cast<int>(free);
  result.rank = rank_of(values);
  result.identified.assign(observations.unknowns.size(), true);
  if (result.complete()) {
    const Eigen::MatrixXd micro = system.matrix * per_micro_unit(observations, system).asDiagonal();
    result.condition_weighted = condition(micro);
    const Eigen::VectorXd lengths = micro.colwise().norm().transpose();
    result.condition_columns = condition(micro * lengths.cwiseInverse().asDiagonal());
    return result;
  }
  const Eigen::VectorXd told_values = values.head(result.rank);
  const Eigen::VectorXd variances =
      svd.right.leftCols(result.rank).cwiseAbs2() * told_values.cwiseAbs2().cwiseInverse();
  describe(observations, system, svd.right.rightCols(free - result.rank), variances, result);
  complete_sentences(result);
  return result;
}

Result<Observability> observability(const Observations& observations, const Floor& floor) {
  const auto system = weighted_system(observations, floor);
  if (!system) return system.error();
  return observability(observations, *system);
}

Result<Separation> separating(const Observations& observations,
                              std::span<const Candidate> candidates, const Floor& floor) {
  if (candidates.size() > kMostCandidates) {
    return error("too-many"_id,
                 fmt::format("{} candidates; at most {} can be compared", candidates.size(),
                             kMostCandidates),
                 "leave out patterns that the machine cannot cut");
  }
  const auto system = weighted_system(observations, floor);
  if (!system) return system.error();
  const Eigen::MatrixXd base = information_of(*system);
  Separation result;
  result.unknowns = static_cast<int>(base.cols());
  result.rank_before = rank_of(roots(base));

  std::vector<Eigen::MatrixXd> added;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    auto information = information_of(candidates[c], observations, floor);
    if (!information) {
      Diagnostics failure = std::move(information).error();
      for (Diagnostic& d : failure) d.message = candidates[c].name + ": " + d.message;
      return failure;
    }
    result.by_rank.push_back({c, rank_of(roots(base + *information))});
    added.push_back(*std::move(information));
  }
  std::stable_sort(result.by_rank.begin(), result.by_rank.end(),
                   [](const auto& a, const auto& b) { return a.rank > b.rank; });
  for (int count = 0; count <= static_cast<int>(added.size()) && !result.smallest; ++count) {
    if (auto best = best_addition(base, added, count)) result.smallest = best->candidates;
  }
  return result;
}

Result<std::vector<Eigen::Index>> independent_unknowns(const Observations& observations,
                                                       const Floor& floor) {
  const auto system = weighted_system(observations, floor);
  if (!system) return system.error();
  std::vector<Eigen::Index> kept;
  std::vector<Eigen::VectorXd> directions;  // orthonormal, of what is kept
  for (Eigen::Index k = 0; k < system->matrix.cols(); ++k) {
    Eigen::VectorXd rest = system->matrix.col(k);
    const double all = rest.norm();
    // Twice, since one pass leaves rounding of the size of what it took away.
    for (int pass = 0; pass < 2; ++pass) {
      for (const Eigen::VectorXd& d : directions) rest -= d.dot(rest) * d;
    }
    if (rest.norm() < std::max(kFaintest, kGainAccuracy * all)) continue;
    directions.push_back(rest.normalized());
    kept.push_back(system->free[static_cast<std::size_t>(k)]);
  }
  return kept;
}

}  // namespace frustum::calibration
