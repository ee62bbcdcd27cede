#include "calibration/design/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/counted.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::calibration {
namespace {

using Set = unsigned;  // bit i: block i

bool holds(Set set, std::size_t block) { return (set >> block & 1U) != 0; }

std::vector<std::size_t> blocks_of(Set set) {
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b < kMostBlocks; ++b) {
    if (holds(set, b)) blocks.push_back(b);
  }
  return blocks;
}

Diagnostics wrong_blocks(const Observations& observations, std::span<const DesignBlock> blocks,
                         const DesignOptions& options) {
  if (blocks.empty()) return {error("unknown-pattern"_id, "no patterns to choose from")};
  if (blocks.size() > kMostBlocks) {
    return {error("too-many"_id,
                  fmt::format("{} blocks; at most {} can be combined", blocks.size(), kMostBlocks),
                  "leave out what the machine or the workpiece does not allow")};
  }
  Diagnostics found;
  std::vector<std::string> owner(observations.rows.size());
  for (const DesignBlock& block : blocks) {
    if (block.rows.empty())
      found.push_back(error("unknown-characteristic"_id, block.name + " has no characteristics"));
    for (const Eigen::Index row : block.rows) {
      if (row < 0 || row >= static_cast<Eigen::Index>(owner.size())) {
        found.push_back(error("inconsistent-design"_id,
                              fmt::format("{} names row {} of {}", block.name, row, owner.size())));
        continue;
      }
      std::string& name = owner[static_cast<std::size_t>(row)];
      if (!name.empty()) {
        found.push_back(error(
            "inconsistent-design"_id,
            fmt::format("{} belongs to {} and to {}",
                        observations.rows[static_cast<std::size_t>(row)].name, name, block.name)));
      }
      name = block.name;
    }
  }
  const auto known = [&](std::size_t b) { return b < blocks.size(); };
  const bool required = std::all_of(options.required.begin(), options.required.end(), known);
  const bool exclusive =
      std::all_of(options.exclusive.begin(), options.exclusive.end(),
                  [&](const auto& p) { return known(p.first) && known(p.second); });
  const bool needs = std::all_of(options.needs.begin(), options.needs.end(),
                                 [&](const auto& p) { return known(p.first) && known(p.second); });
  if (!required || !exclusive || !needs) {
    found.push_back(
        error("inconsistent-design"_id,
              "a required, exclusive or needed pattern is not among those to choose from"));
  }
  if (!options.limits.empty() && options.limits.size() != observations.unknowns.size()) {
    found.push_back(error("inconsistent-design"_id,
                          fmt::format("{} limits for {} unknowns", options.limits.size(),
                                      observations.unknowns.size())));
  }
  const bool is_priced = std::all_of(options.costs.begin(), options.costs.end(), [](double cost) {
    return std::isfinite(cost) && cost >= 0.0;
  });
  if (!is_priced || (!options.costs.empty() && options.costs.size() != blocks.size())) {
    found.push_back(
        error("inconsistent-design"_id,
              fmt::format("{} for {}, each 0 or more", counted(options.costs.size(), "cost"),
                          counted(blocks.size(), "block"))));
  }
  return found;
}

// Blocks that share noise are taken together: the information of a set is a sum over these groups.
std::vector<Set> correlated_groups(const Observations& observations,
                                   std::span<const DesignBlock> blocks) {
  const Eigen::VectorXd sd = observations.covariance.diagonal().cwiseSqrt();
  const auto correlated = [&](const DesignBlock& a, const DesignBlock& b) {
    for (const Eigen::Index i : a.rows) {
      for (const Eigen::Index j : b.rows) {
        // Below 1e-9 a covariance that should be zero is rounding.
        if (std::abs(observations.covariance(i, j)) > 1e-9 * sd[i] * sd[j]) return true;
      }
    }
    return false;
  };
  std::vector<Set> groups;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Set group = 1U << b;
    for (std::size_t a = 0; a < b; ++a) {
      if (!correlated(blocks[a], blocks[b])) continue;
      const auto hit =
          std::find_if(groups.begin(), groups.end(), [&](Set g) { return holds(g, a); });
      if (hit == groups.end()) continue;  // joined already
      group |= *hit;
      groups.erase(hit);
    }
    groups.push_back(group);
  }
  return groups;
}

class Enumeration {
 public:
  Enumeration(const Observations& observations, std::span<const DesignBlock> blocks,
              const DesignOptions& options)
      : observations_(observations), blocks_(blocks), options_(options) {}

  // Information of every subset of every group.
  Diagnostics prepare() {
    for (const Set group : correlated_groups(observations_, blocks_)) {
      Group entry{group, {}};
      const std::vector<std::size_t> members = blocks_of(group);
      for (Set local = 0; local < (1U << members.size()); ++local) {
        auto information = information_of(members, local);
        if (!information) return std::move(information).error();
        entry.information.push_back(*std::move(information));
      }
      groups_.push_back(std::move(entry));
    }
    return {};
  }

  DesignResult run() const {
    DesignResult result;
    result.unknowns = static_cast<int>(places(true).size());
    for (int size = 1; size <= static_cast<int>(blocks_.size()); ++size) add_size(size, result);
    for (std::size_t b = 0; b < blocks_.size(); ++b) result.alone.push_back(judged(1U << b));
    for (std::vector<DesignChoice>* choices : {&result.best_of_size, &result.alone}) {
      for (DesignChoice& choice : *choices) choice.bits = bits_of(choice);
    }
    for (std::optional<DesignChoice>* choice : {&result.smallest, &result.within_budget}) {
      if (*choice) (*choice)->bits = bits_of(**choice);
    }
    return result;
  }

 private:
  struct Group {
    Set members = 0;
    std::vector<Eigen::MatrixXd> information{};  // by subset of the members, lowest bit first
  };

  Result<Eigen::MatrixXd> information_of(const std::vector<std::size_t>& members, Set local) {
    std::vector<Eigen::Index> rows;
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (!holds(local, m)) continue;
      const std::vector<Eigen::Index>& own = blocks_[members[m]].rows;
      rows.insert(rows.end(), own.begin(), own.end());
    }
    if (rows.empty()) return Eigen::MatrixXd();  // nothing measured, nothing added
    const auto system = weighted_system(observations_.selected(rows), options_.floor);
    if (!system) return system.error();
    if (size_.size() == 0) {
      size_ = system->size;
      free_ = system->free;
      const Eigen::MatrixXd priors =
          system->matrix.bottomRows(static_cast<Eigen::Index>(system->priors.size()));
      priors_ = priors.transpose() * priors;
    }
    const Eigen::MatrixXd measured = system->matrix.topRows(system->whitened_rows);
    return Eigen::MatrixXd(measured.transpose() * measured);
  }

  [[nodiscard]] Eigen::MatrixXd information_of(Set set) const {
    Eigen::MatrixXd sum = priors_;
    for (const Group& group : groups_) {
      Set local = 0;
      std::size_t bit = 0;
      for (std::size_t b = 0; b < blocks_.size(); ++b) {
        if (!holds(group.members, b)) continue;
        if (holds(set, b)) local |= 1U << bit;
        ++bit;
      }
      if (local != 0) sum += group.information[local];
    }
    return sum;
  }

  [[nodiscard]] bool allowed(Set set) const {
    return std::all_of(options_.required.begin(), options_.required.end(),
                       [&](std::size_t b) { return holds(set, b); }) &&
           std::none_of(
               options_.exclusive.begin(), options_.exclusive.end(),
               [&](const auto& p) { return holds(set, p.first) && holds(set, p.second); }) &&
           std::none_of(options_.needs.begin(), options_.needs.end(), [&](const auto& p) {
             return holds(set, p.first) && !holds(set, p.second);
           });
  }

  void add_size(int size, DesignResult& result) const {
    std::optional<DesignChoice> best;
    std::optional<DesignChoice> within;
    std::size_t identifying = 0;
    const bool first_to_identify = result.smallest_identifying.empty();
    for (Set set = 0; set < (1U << blocks_.size()); ++set) {
      if (std::popcount(set) != size || !allowed(set)) continue;
      const DesignChoice choice = judged(set);
      if (choice.identifies_all) {
        ++identifying;
        if (first_to_identify) result.smallest_identifying.push_back(choice.blocks);
      }
      if (options_.budget && choice.cost <= *options_.budget) {
        auto& within_budget = result.within_budget;
        const bool is_first = !within_budget;
        const bool is_better = !is_first && (choice.meets_limits == within_budget->meets_limits
                                                 ? better(choice, *within_budget)
                                                 : choice.meets_limits);
        if (is_first || is_better) within_budget = choice;
      }
      if (!best || better(choice, *best)) best = choice;
      if (choice.meets_limits && (!within || better(choice, *within))) within = choice;
    }
    if (!best) return;
    std::sort(result.smallest_identifying.begin(), result.smallest_identifying.end());
    result.best_of_size.push_back(*best);
    result.identifying_sets.push_back(identifying);
    if (!result.smallest) result.smallest = within;
  }

  // Places among the free unknowns: those of interest, or the others.
  [[nodiscard]] std::vector<Eigen::Index> places(bool of_interest) const {
    std::vector<Eigen::Index> found;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const auto unknown = static_cast<std::size_t>(free_[k]);
      const bool is_other = std::ranges::count(options_.no_interest, unknown) > 0;
      if (is_other != of_interest) found.push_back(static_cast<Eigen::Index>(k));
    }
    return found;
  }

  [[nodiscard]] double bits_of(const DesignChoice& choice) const {
    Set set = 0;
    for (const std::size_t block : choice.blocks) set |= 1U << block;
    const std::vector<Eigen::Index> wanted = places(true);
    Eigen::MatrixXd information = information_of(set);
    information(wanted, wanted) -= priors_(wanted, wanted);
    for (const Eigen::Index k : wanted) information(k, k) += 1.0;  // each within its size before
    double bits = 0.0;
    for (const double after : symmetric_eigenvalues(of_interest(information))) {
      bits += 0.5 * std::log2(std::max(after, 1.0));
    }
    return bits;
  }

  // What is left of the information for the unknowns of interest, the others being unknown too.
  [[nodiscard]] Eigen::MatrixXd of_interest(const Eigen::MatrixXd& information) const {
    const std::vector<Eigen::Index> others = places(false), wanted = places(true);
    if (others.empty()) return information;
    const SymmetricEigen eigen = symmetric_eigen(information(others, others));
    const Eigen::MatrixXd cross = information(wanted, others) * eigen.vectors;
    Eigen::MatrixXd left = information(wanted, wanted);
    // Rounding: of products within the others' own block, and of gains (1e-10 of the largest one)
    // in rows that see none of the others.
    const double nothing =
        std::max({1e-12 * eigen.values.maxCoeff(), 1e-20 * information.diagonal().maxCoeff(), 0.0});
    for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
      if (eigen.values[k] <= nothing) continue;  // no row answers to it
      left -= cross.col(k) * cross.col(k).transpose() / eigen.values[k];
    }
    return left;
  }

  // Directions that are identified, and the variances that they leave.
  struct Judgement {
    int rank = 0;
    Eigen::MatrixXd unidentified{};  // directions, columns
    Eigen::VectorXd variances{};
    double log_det = 0.0;
  };
  [[nodiscard]] static Judgement judgement(const Eigen::MatrixXd& information) {
    const SymmetricEigen eigen = symmetric_eigen(information);
    const Eigen::VectorXd singular = eigen.values.reverse().cwiseMax(0.0).cwiseSqrt();
    Judgement found{.rank = rank_of(singular)};
    const Eigen::VectorXd identified = eigen.values.tail(found.rank);
    const Eigen::MatrixXd v = eigen.vectors.rightCols(found.rank);
    found.unidentified = eigen.vectors.leftCols(eigen.values.size() - found.rank);
    found.variances = v.cwiseAbs2() * identified.cwiseInverse();
    found.log_det = identified.array().log().sum();
    return found;
  }

  [[nodiscard]] DesignChoice judged(Set set) const {
    const Eigen::MatrixXd information = information_of(set);
    const Judgement all = judgement(information);
    const Judgement own = options_.no_interest.empty() ? all : judgement(of_interest(information));
    DesignChoice choice;
    choice.blocks = blocks_of(set);
    if (!options_.costs.empty()) {
      for (const std::size_t block : choice.blocks) choice.cost += options_.costs[block];
    }
    choice.rank = own.rank;
    choice.identifies_all = own.rank == own.variances.size();
    if (choice.identifies_all) choice.log_det = own.log_det;
    choice.criterion = criterion(own.log_det, own.variances);

    choice.standard_deviations.assign(observations_.unknowns.size(), 0.0);
    const std::vector<bool> seen = identified_by(all.unidentified, all.variances);
    for (Eigen::Index j = 0; j < size_.size(); ++j) {
      const auto k = static_cast<std::size_t>(j);
      auto& sd = choice.standard_deviations[static_cast<std::size_t>(free_[k])];
      sd.reset();
      if (seen[k]) sd = size_[j] * std::sqrt(all.variances[j]);
    }
    choice.meets_limits = choice.identifies_all && within_limits(choice);
    return choice;
  }

  [[nodiscard]] double criterion(double log_det, const Eigen::VectorXd& variances) const {
    switch (options_.criterion) {
      case DesignCriterion::d_optimal:
        return -log_det;
      case DesignCriterion::a_optimal:
        return variances.sum();
      case DesignCriterion::worst_unknown:
        return std::sqrt(variances.maxCoeff());
    }
    return 0.0;
  }

  [[nodiscard]] bool within_limits(const DesignChoice& choice) const {
    for (std::size_t j = 0; j < options_.limits.size(); ++j) {
      const auto& sd = choice.standard_deviations[j];
      if (options_.limits[j] && !(sd && *sd <= *options_.limits[j])) {
        return false;
      }
    }
    return true;
  }

  const Observations& observations_;
  std::span<const DesignBlock> blocks_;
  const DesignOptions& options_;
  std::vector<Group> groups_{};
  std::vector<Eigen::Index> free_{};
  Eigen::VectorXd size_{};
  Eigen::MatrixXd priors_{};
};

}  // namespace

bool better(const DesignChoice& a, const DesignChoice& b) {
  if (a.rank != b.rank) return a.rank > b.rank;
  const double tie = 1e-9 * std::max(std::abs(a.criterion), std::abs(b.criterion));
  if (std::abs(a.criterion - b.criterion) > tie) return a.criterion < b.criterion;
  if (a.cost != b.cost) return a.cost < b.cost;
  return a.blocks < b.blocks;
}

Result<DesignResult> design(const Observations& observations, std::span<const DesignBlock> blocks,
                            const DesignOptions& options) {
  // Values play no part; a plan has none yet.
  Observations planned = observations;
  planned.values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.rows.size()));
  const auto whole = weighted_system(planned, options.floor);
  if (!whole) return whole.error();
  Diagnostics wrong = wrong_blocks(planned, blocks, options);
  if (!wrong.empty()) return wrong;
  Enumeration enumeration(planned, blocks, options);
  wrong = enumeration.prepare();
  if (!wrong.empty()) return wrong;
  return enumeration.run();
}

}  // namespace frustum::calibration
