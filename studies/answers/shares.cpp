#include "studies/answers/shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/spelling.hpp"
#include "studies/laws/error_pattern.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::studies {
namespace {

// Draws that are evaluated at a time: enough for the lanes of any engine.
constexpr std::uint32_t kBatch = 1024;
// The other set of draws has the seed with these bits turned: no study draws from both.
constexpr std::uint64_t kOtherSeed = 0x6a09e667f3bcc908ULL;

double sum_over(std::span<const double> a, const std::function<double(std::size_t)>& term) {
  std::vector<double> terms(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) terms[i] = term(i);
  return ordered_sum(terms);
}

struct Estimate {
  double value = 0.0;
  double se = 0.0;
};

Estimate estimate_of(std::span<const double> a, const std::function<double(std::size_t)>& term) {
  const auto n = static_cast<double>(a.size());
  const double mean = sum_over(a, term) / n;
  const double squares = sum_over(a, [&](std::size_t i) {
    const double d = term(i) - mean;
    return d * d;
  });
  return {mean, std::sqrt(squares / (n - 1.0) / n)};
}

}  // namespace

std::vector<FactorGroup> groups_by_entry(const FactorSet& set) {
  std::vector<FactorGroup> groups;
  for (std::size_t f = 0; f < set.factors().size(); ++f) {
    const std::string& name = set.factors()[f].entries.front();
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const FactorGroup& g) { return g.name == name; });
    if (group == groups.end()) {
      groups.push_back({name, {}});
      group = std::prev(groups.end());
    }
    group->factors.push_back(f);
  }
  return groups;
}

Result<std::vector<FactorGroup>> groups_named(
    const kinematics::Machine& machine, const FactorSet& set,
    const std::map<std::string, std::vector<std::string>>& patterns) {
  std::vector<FactorGroup> groups;
  Diagnostics problems;
  std::vector<std::string> owner(set.factors().size());
  std::vector<std::string> known;
  for (const Factor& factor : set.factors()) {
    known.insert(known.end(), factor.entries.begin(), factor.entries.end());
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  // What a pattern asks of a shape: its kind and order, which a factor has in words.
  const auto shape_of = [](const Factor& factor) {
    kinematics::ErrorShape shape;
    for (int k = 0; k <= static_cast<int>(kinematics::ErrorShape::Kind::surface); ++k) {
      const auto kind = static_cast<kinematics::ErrorShape::Kind>(k);
      if (factor.shape.starts_with(kinematics::name_of(kind))) shape.kind = kind;
    }
    if (factor.shape.starts_with("harmonic ")) shape.order = std::stoi(factor.shape.substr(9));
    return shape;
  };
  for (const auto& [name, texts] : patterns) {
    FactorGroup group{name, {}};
    for (const std::string& text : texts) {
      const auto pattern = ErrorPattern::parse(text);
      if (!pattern) {
        problems.push_back(pattern.error().front());
        continue;
      }
      bool matched = false;
      for (std::size_t f = 0; f < set.factors().size(); ++f) {
        const Factor& factor = set.factors()[f];
        const bool is_meant = std::any_of(
            factor.entries.begin(), factor.entries.end(), [&](const std::string& entry) {
              return pattern->matches(entry, shape_of(factor)) ||
                     pattern->matches(iso_name(machine, entry), shape_of(factor));
            });
        if (!is_meant) continue;
        matched = true;
        if (owner[f] == name) continue;
        if (!owner[f].empty()) {
          problems.push_back(
              error("group-twice"_id,
                    fmt::format("error {} is in the groups {} and {}", factor.name, owner[f], name),
                    "an error is in one group"));
          continue;
        }
        owner[f] = name;
        group.factors.push_back(f);
      }
      if (!matched) {
        problems.push_back(error("group-error"_id,
                                 fmt::format("group {}: '{}' matches no drawn error", name, text),
                                 suggestion(text, known)));
      }
    }
    std::sort(group.factors.begin(), group.factors.end());
    groups.push_back(std::move(group));
  }
  if (!problems.empty()) return problems;
  FactorGroup rest{"rest", {}};
  for (std::size_t f = 0; f < owner.size(); ++f) {
    if (owner[f].empty()) rest.factors.push_back(f);
  }
  if (!rest.factors.empty()) groups.push_back(std::move(rest));
  return groups;
}

MeanSquareShares mean_square_shares(const Eigen::MatrixXd& gains, const FactorSet& set,
                                    std::span<const FactorGroup> groups) {
  const WeightMoments moments = set.weight_moments();
  const Eigen::MatrixXd second = moments.covariance + moments.mean * moments.mean.transpose();
  const Eigen::MatrixXd squares = gains.transpose() * gains;
  const auto points = static_cast<double>(gains.rows());
  MeanSquareShares result;
  for (const FactorGroup& group : groups) {
    double sum = 0.0;
    for (const std::size_t f : group.factors) {
      for (const std::size_t i : set.factors()[f].columns) {
        for (const std::size_t j : set.factors()[f].columns) {
          sum += squares(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                 second(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / points;
        }
      }
    }
    result.shares.push_back(sum);
    result.mean_square += sum;
  }
  if (result.mean_square > 0.0) {
    for (double& share : result.shares) share /= result.mean_square;
  }
  return result;
}

SobolIndices sobol_indices(std::size_t variable_count,
                           std::span<const std::vector<std::size_t>> variables, std::uint32_t draws,
                           const PairedDraw& draw, const DrawFunction& function) {
  assert(draws >= 2);
  std::vector<double> f_a(draws), f_b(draws);
  std::vector<std::vector<double>> f_ab(variables.size(), std::vector<double>(draws));
  std::vector<double> a(kBatch * variable_count), b(a.size()), mixed(a.size());
  for (std::uint32_t first = 0; first < draws; first += kBatch) {
    const std::uint32_t count = std::min(kBatch, draws - first);
    const std::size_t size = count * variable_count;
    for (std::uint32_t d = 0; d < count; ++d) {
      draw(false, first + d, std::span(a).subspan(d * variable_count, variable_count));
      draw(true, first + d, std::span(b).subspan(d * variable_count, variable_count));
    }
    function(std::span(a).first(size), std::span(f_a).subspan(first, count));
    function(std::span(b).first(size), std::span(f_b).subspan(first, count));
    for (std::size_t g = 0; g < variables.size(); ++g) {
      std::copy(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(size), mixed.begin());
      for (std::uint32_t d = 0; d < count; ++d) {
        for (const std::size_t v : variables[g]) {
          mixed[d * variable_count + v] = b[d * variable_count + v];
        }
      }
      function(std::span(mixed).first(size), std::span(f_ab[g]).subspan(first, count));
    }
  }
  SobolIndices indices;
  const auto n = static_cast<double>(draws);
  indices.mean = 0.5 * (ordered_sum(f_a) + ordered_sum(f_b)) / n;
  const auto squared = [&](double v) { return (v - indices.mean) * (v - indices.mean); };
  indices.variance = (ordered_sum(f_a, squared) + ordered_sum(f_b, squared)) / (2.0 * n - 1.0);
  for (const std::vector<double>& f_g : f_ab) {
    // Centred on the mean, which changes no expectation and takes most of the scatter away.
    const Estimate first = estimate_of(
        f_a, [&](std::size_t i) { return (f_b[i] - indices.mean) * (f_g[i] - f_a[i]); });
    const Estimate total = estimate_of(f_a, [&](std::size_t i) {
      const double d = f_a[i] - f_g[i];
      return 0.5 * d * d;
    });
    indices.groups.push_back({first.value / indices.variance, first.se / indices.variance,
                              total.value / indices.variance, total.se / indices.variance});
  }
  return indices;
}

SobolIndices sobol_indices(const FactorSet& set, std::span<const FactorGroup> groups,
                           std::uint64_t seed, std::uint32_t draws, const DrawFunction& function) {
  std::vector<std::vector<std::size_t>> variables;
  for (const FactorGroup& group : groups) {
    std::vector<std::size_t> of_group;
    for (const std::size_t f : group.factors) {
      const std::vector<std::size_t>& v = set.factors()[f].variables;
      of_group.insert(of_group.end(), v.begin(), v.end());
    }
    variables.push_back(std::move(of_group));
  }
  return sobol_indices(
      set.variables().size(), variables, draws,
      [&](bool b, std::uint32_t d, std::span<double> values) {
        set.draw(b ? seed ^ kOtherSeed : seed, d, values);
      },
      function);
}

}  // namespace frustum::studies
