#include "studies/laws/factors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/random.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "studies/laws/turn.hpp"

namespace frustum::studies {

using kinematics::DrawnFactor;

double DrawnAmount::operator()(std::span<const double> variables) const {
  double amount = value;
  for (const Part& part : parts) {
    const double x = variables[part.variable] + part.shift;
    amount *= part.function == DrawnFactor::Function::cosine ? std::cos(x)
              : part.function == DrawnFactor::Function::sine ? std::sin(x)
                                                             : x;
  }
  return amount;
}

std::vector<std::uint64_t> FactorSet::streams() const {
  std::vector<std::uint64_t> streams;
  for (const Variable& v : variables_) streams.push_back(v.stream);
  return streams;
}

void FactorSet::correlate(const Copula& copula, std::span<double> uniform_to_value) const {
  const auto n = static_cast<Eigen::Index>(copula.variables.size());
  Eigen::VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    z[i] = normal_quantile(uniform_to_value[copula.variables[static_cast<std::size_t>(i)]]);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    double y = 0.0;
    for (Eigen::Index k = 0; k <= i; ++k) y += copula.cholesky(i, k) * z[k];
    const std::size_t variable = copula.variables[static_cast<std::size_t>(i)];
    const Law& law = variables_[variable].law;
    // Of a normal law the normal itself: no digits go through the distribution function.
    uniform_to_value[variable] = law.kind == Law::Kind::normal && !law.limit
                                     ? law.mean + law.deviation * y
                                     : quantile(law, normal_probability(y));
  }
}

void FactorSet::draw(std::uint64_t seed, std::uint32_t index, std::span<double> values) const {
  assert(values.size() == variables_.size());
  const RandomKey key{seed, index, RandomPurpose::error_amount};
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    values[i] = kinematics::drawn_from(variables_[i].law, key, variables_[i].stream);
  }
  for (const Copula& copula : copulas_) {
    for (const std::size_t i : copula.variables) values[i] = uniform(key, variables_[i].stream);
    correlate(copula, values);
  }
}

void FactorSet::from_uniform(std::span<const double> u, std::span<double> values) const {
  assert(u.size() == variables_.size() && values.size() == variables_.size());
  for (std::size_t i = 0; i < variables_.size(); ++i) values[i] = quantile(variables_[i].law, u[i]);
  for (const Copula& copula : copulas_) {
    for (const std::size_t i : copula.variables) values[i] = u[i];
    correlate(copula, values);
  }
}

void FactorSet::weights(std::span<const double> values, std::span<double> weights) const {
  assert(weights.size() == columns_.size());
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const Column& column = columns_[j];
    double weight = amounts_[column.amount](values);
    if (column.wave != Wave::none) {
      const CosineSine at = cosine_sine(amounts_[*column.phase](values));
      weight *= column.wave == Wave::cosine ? at.cosine : -at.sine;
    }
    weights[j] = weight;
  }
}

std::vector<double> FactorSet::largest_weights() const {
  std::vector<double> bounds;
  bounds.reserve(columns_.size());
  for (const Column& column : columns_) {
    const DrawnAmount& amount = amounts_[column.amount];
    double bound = std::abs(amount.value);
    for (const DrawnAmount::Part& part : amount.parts) {
      if (part.function != DrawnFactor::Function::itself) continue;
      bound *= largest(variables_[part.variable].law) + std::abs(part.shift);
    }
    bounds.push_back(bound);
  }
  return bounds;
}

std::vector<kinematics::ErrorEntry> FactorSet::entries_at(std::span<const double> values) const {
  std::vector<kinematics::ErrorEntry> entries = entries_;
  std::size_t next = 0;
  const auto fix = [&](kinematics::Amount& amount) {
    if (amount.drawn.empty()) return;
    amount.value = amounts_[written_[next++]](values);
    amount.drawn.clear();
  };
  for (kinematics::ErrorEntry& entry : entries) {
    const std::size_t before = next;
    for (kinematics::ErrorShape& shape : entry.terms) {
      fix(shape.amount);
      fix(shape.phase);
      fix(shape.peak);
      for (kinematics::Amount& c : shape.coefficients) fix(c);
    }
    if (next != before) entry.written = kinematics::written(entry.terms);
  }
  return entries;
}

Result<kinematics::GeometricErrors> FactorSet::errors_at(const kinematics::Machine& machine,
                                                         std::span<const double> values) const {
  return kinematics::resolve(machine, entries_at(values), spans_);
}

}  // namespace frustum::studies
