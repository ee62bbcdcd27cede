// Mean and covariance of the columns' weights, from the laws: see FactorSet::weight_moments.
//
// A weight is a product of functions of variables, so the mean of a product of two weights is a
// product of means over one variable each, which quadrature gives to rounding. Correlated members
// are constants: their covariance is a double sum over the two normals.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "studies/laws/factors.hpp"
#include "studies/laws/quadrature.hpp"

namespace frustum::studies {
namespace {

using kinematics::DrawnFactor;

// A hundred nodes see a phase turn ten times and more; beyond 9 sd a normal law has 1e-19.
constexpr int kNodes = 100;
constexpr double kNormalReach = 9.0;

// Nodes and weights of the law itself.
Quadrature nodes_of(const Law& law) {
  static const Quadrature kRule = gauss_legendre(kNodes);
  Quadrature nodes;
  const auto add = [&](double lo, double hi, const std::function<double(double)>& density) {
    for (const QuadratureNode& node : over(kRule, lo, hi)) {
      nodes.push_back({node.x, node.weight * density(node.x)});
    }
  };
  if (law.kind == Law::Kind::normal) {
    const double reach =
        std::min(kNormalReach * law.deviation, law.limit.value_or(kNormalReach * law.deviation));
    const auto density = [&](double x) {
      const double z = (x - law.mean) / law.deviation;
      return std::exp(-0.5 * z * z);
    };
    add(law.mean - reach, law.mean, density);
    add(law.mean, law.mean + reach, density);
  } else if (law.kind == Law::Kind::triangular) {
    const double middle = 0.5 * (law.lo + law.hi);
    add(law.lo, middle, [&](double x) { return x - law.lo; });
    add(middle, law.hi, [&](double x) { return law.hi - x; });
  } else {
    add(law.lo, law.hi, [](double) { return 1.0; });
  }
  double sum = 0.0;
  for (const QuadratureNode& node : nodes) sum += node.weight;
  for (QuadratureNode& node : nodes) node.weight /= sum;
  return nodes;
}

// A function of one variable that is a factor of a weight.
struct Elementary {
  std::size_t variable = 0;
  std::function<double(double)> value{};
};

// Those of one column's weight, and its constant. Phases that several variables make have no
// product form: nothing is returned.
std::optional<std::vector<Elementary>> elementary_of(const FactorSet& set, const Column& column,
                                                     double& constant) {
  std::vector<Elementary> parts;
  const DrawnAmount& amount = set.amounts()[column.amount];
  constant *= amount.value;
  for (const DrawnAmount::Part& part : amount.parts) {
    parts.push_back({part.variable, [part](double v) {
                       const double x = v + part.shift;
                       return part.function == DrawnFactor::Function::cosine ? std::cos(x)
                              : part.function == DrawnFactor::Function::sine ? std::sin(x)
                                                                             : x;
                     }});
  }
  if (column.wave == Wave::none) return parts;
  const DrawnAmount& phase = set.amounts()[*column.phase];
  if (phase.parts.size() != 1 || phase.parts.front().function != DrawnFactor::Function::itself)
    return std::nullopt;
  const DrawnAmount::Part part = phase.parts.front();
  const bool is_cosine = column.wave == Wave::cosine;
  parts.push_back({part.variable, [part, is_cosine, value = phase.value](double v) {
                     const double angle = value * (v + part.shift);
                     return is_cosine ? std::cos(angle) : -std::sin(angle);
                   }});
  return parts;
}

double mean_of_product(const std::vector<Quadrature>& nodes, std::vector<Elementary> parts) {
  std::stable_sort(parts.begin(), parts.end(), [](const Elementary& a, const Elementary& b) {
    return a.variable < b.variable;
  });
  double mean = 1.0;
  for (std::size_t i = 0; i < parts.size();) {
    std::size_t end = i;
    while (end < parts.size() && parts[end].variable == parts[i].variable) ++end;
    double sum = 0.0;
    for (const QuadratureNode& node : nodes[parts[i].variable]) {
      double product = node.weight;
      for (std::size_t k = i; k < end; ++k) product *= parts[k].value(node.x);
      sum += product;
    }
    mean *= sum;
    i = end;
  }
  return mean;
}

// Covariance of two members whose normals have this correlation: the trapezoidal rule over both
// normals, whose error falls faster than any power of the step.
double copula_covariance(const Law& a, const Law& b, double correlation) {
  if (a.kind == Law::Kind::normal && b.kind == Law::Kind::normal && !a.limit && !b.limit)
    return correlation * a.deviation * b.deviation;
  constexpr int kSteps = 90;
  constexpr double kStep = 0.1;
  const double rest = std::sqrt(1.0 - correlation * correlation);
  double sum = 0.0, weight = 0.0;
  const auto value = [](const Law& law, double z) {
    return quantile(law, std::clamp(normal_probability(z), 1e-300, 1.0 - 1e-16)) - mean(law);
  };
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int k = -kSteps; k <= kSteps; ++k) {
      const double z = kStep * i, y = kStep * k;
      const double w = std::exp(-0.5 * (z * z + y * y));
      sum += w * value(a, z) * value(b, correlation * z + rest * y);
      weight += w;
    }
  }
  return sum / weight;
}

// What only sampling gives: 65,536 draws of their own, to a hundredth.
WeightMoments sampled_moments(const FactorSet& set) {
  constexpr std::uint32_t kDraws = 65536;
  const auto n = static_cast<Eigen::Index>(set.columns().size());
  WeightMoments moments{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  std::vector<double> values(set.variables().size());
  Eigen::VectorXd w(n);
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    set.draw(0, d, values);
    set.weights(values, {w.data(), static_cast<std::size_t>(n)});
    moments.mean += w / kDraws;
    moments.covariance += w * w.transpose() / kDraws;
  }
  moments.covariance -= moments.mean * moments.mean.transpose();
  return moments;
}

}  // namespace

WeightMoments FactorSet::weight_moments() const {
  std::vector<Quadrature> nodes;
  nodes.reserve(variables_.size());
  for (const Variable& v : variables_) nodes.push_back(nodes_of(v.law));
  const std::size_t n = columns_.size();
  std::vector<std::vector<Elementary>> parts(n);
  std::vector<double> constants(n, 1.0);
  WeightMoments moments{
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n)),
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n))};
  for (std::size_t j = 0; j < n; ++j) {
    auto elementary = elementary_of(*this, columns_[j], constants[j]);
    if (!elementary) return sampled_moments(*this);
    parts[j] = *std::move(elementary);
    moments.mean[static_cast<Eigen::Index>(j)] = constants[j] * mean_of_product(nodes, parts[j]);
  }
  std::map<std::size_t, std::pair<const Copula*, std::size_t>> member;
  for (const Copula& copula : copulas_) {
    for (std::size_t i = 0; i < copula.variables.size(); ++i) {
      member[copula.variables[i]] = {&copula, i};
    }
  }
  const auto correlated = [&](std::size_t j) {
    const DrawnAmount& amount = amounts_[columns_[j].amount];
    const auto found =
        amount.parts.empty() ? member.end() : member.find(amount.parts.front().variable);
    return found == member.end() ? std::pair<const Copula*, std::size_t>{} : found->second;
  };
  for (const Factor& factor : factors_) {
    for (const std::size_t i : factor.columns) {
      for (const std::size_t j : factor.columns) {
        if (j > i) continue;
        const auto [copula, row] = correlated(i);
        const auto [other, column] = correlated(j);
        double covariance = 0.0;
        if (copula != nullptr && copula == other && i != j) {
          const double rho = copula->correlation(static_cast<Eigen::Index>(row),
                                                 static_cast<Eigen::Index>(column));
          covariance = constants[i] * constants[j] *
                       copula_covariance(variables_[copula->variables[row]].law,
                                         variables_[copula->variables[column]].law, rho);
        } else {
          std::vector<Elementary> both = parts[i];
          both.insert(both.end(), parts[j].begin(), parts[j].end());
          covariance = constants[i] * constants[j] * mean_of_product(nodes, std::move(both)) -
                       moments.mean[static_cast<Eigen::Index>(i)] *
                           moments.mean[static_cast<Eigen::Index>(j)];
        }
        moments.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = covariance;
        moments.covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = covariance;
      }
    }
  }
  return moments;
}

}  // namespace frustum::studies
