#include "trials/population/population_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "kinematics/errors/error_gain.hpp"

namespace frustum::trials {
namespace {

using kinematics::Amount;
using kinematics::AxisSpans;
using kinematics::Distribution;
using kinematics::DrawnFactor;
using kinematics::ErrorEntry;
using kinematics::ErrorShape;
using kinematics::GeometricErrors;
using kinematics::Machine;

// Of a normal amount no draw is farther from the mean: one in 1e15 would be.
constexpr double kDeviations = 8.0;

bool is_drawn(const Amount& amount) { return !amount.drawn.empty(); }

// The middle of a law, and the most that it gives.
struct Extent {
  double middle = 0.0, most = 0.0;
};

Extent extent_of(const DrawnFactor& factor) {
  if (factor.function != DrawnFactor::Function::itself) return {0.0, 1.0};
  const Distribution& d = factor.distribution;
  const bool is_uniform = d.kind == Distribution::Kind::uniform;
  const double middle = factor.shift + (is_uniform ? 0.5 * (d.lo + d.hi) : d.mean);
  const double half =
      is_uniform ? 0.5 * std::abs(d.hi - d.lo)
                 : std::min(kDeviations * d.deviation, d.limit.value_or(kDeviations * d.deviation));
  return {middle, std::abs(middle) + half};
}

Extent extent_of(const Amount& amount) {
  Extent all{amount.value, std::abs(amount.value)};
  for (const DrawnFactor& factor : amount.drawn) {
    const Extent one = extent_of(factor);
    all.middle *= one.middle;
    all.most *= one.most;
  }
  return all;
}

Amount fixed_at(Amount amount, double value) {
  amount.value = value;
  amount.drawn.clear();
  return amount;
}

// The shape with all its amounts fixed in the middle.
ErrorShape in_the_middle(ErrorShape shape) {
  const auto fix = [](Amount& amount) {
    if (is_drawn(amount)) amount = fixed_at(amount, extent_of(amount).middle);
  };
  fix(shape.amount);
  fix(shape.phase);
  fix(shape.peak);
  for (Amount& coefficient : shape.coefficients) fix(coefficient);
  return shape;
}

// Entries whose errors are stated again further down count for nothing.
std::vector<bool> replaced(const Machine& machine, std::span<const ErrorEntry> entries) {
  const auto same = [&](const ErrorEntry& a, const ErrorEntry& b) {
    if (a.name == b.name) return true;
    const std::vector<std::string> names{a.name, b.name};
    const auto found = kinematics::errors_named(machine, names);
    return found && (*found)[0].error.text() == (*found)[1].error.text() &&
           (*found)[0].carries == (*found)[1].carries;
  };
  const auto states_an_error = [](const ErrorEntry& e) { return e.datum.empty() && !e.grid; };
  std::vector<bool> gone(entries.size(), false);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!states_an_error(entries[i])) continue;
    for (std::size_t k = i + 1; k < entries.size() && !gone[i]; ++k) {
      gone[i] = states_an_error(entries[k]) && same(entries[i], entries[k]);
    }
  }
  return gone;
}

// Takes the entries apart: what is fixed, and a column for each drawn amount.
class Separation {
 public:
  Separation(const Machine& machine, std::span<const ErrorEntry> entries, const AxisSpans& spans)
      : machine_(machine), entries_(entries), spans_(spans) {
    for (const ErrorEntry& entry : entries) {
      if (!entry.datum.empty()) stated_for_.push_back(entry);
    }
  }

  void separate() {
    const std::vector<bool> gone = replaced(machine_, entries_);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (gone[i]) continue;
      ErrorEntry rest = entries_[i];
      rest.terms.clear();
      for (std::size_t t = 0; t < entries_[i].terms.size(); ++t) separate(i, t, rest);
      if (!rest.terms.empty() || entries_[i].terms.empty()) fixed_.push_back(std::move(rest));
    }
  }

  [[nodiscard]] Result<GeometricErrors> fixed() const {
    return kinematics::resolve(machine_, fixed_, spans_);
  }
  [[nodiscard]] std::vector<ErrorColumn> columns() && { return std::move(columns_); }
  [[nodiscard]] const Diagnostics& problems() const { return problems_; }

 private:
  void separate(std::size_t entry, std::size_t term, ErrorEntry& rest) {
    const ErrorShape& shape = entries_[entry].terms[term];
    if (is_drawn(shape.peak)) {
      problems_.push_back(error(
          "population-law"_id,
          fmt::format("error {} = {}: where a tent stands is drawn, which is not linear in what is "
                      "drawn",
                      entries_[entry].name, entries_[entry].written),
          "fix its place, or draw and try the machines one by one"));
      return;
    }
    if (shape.kind == ErrorShape::Kind::polynomial) {
      separate_polynomial(entry, term, rest);
    } else if (is_drawn(shape.phase)) {
      const Extent amount = extent_of(shape.amount);
      for (const ColumnPart part : {ColumnPart::cosine, ColumnPart::sine}) {
        ErrorShape unit = shape;
        unit.amount = fixed_at(shape.amount, 1.0);
        unit.phase =
            fixed_at(shape.phase, part == ColumnPart::cosine ? 0.0 : -0.5 * std::numbers::pi);
        add({entry, term, {}, part, 0, false, 0.0, amount.most, {}}, std::move(unit));
      }
    } else if (is_drawn(shape.amount)) {
      const Extent amount = extent_of(shape.amount);
      ErrorShape unit = shape;
      unit.amount = fixed_at(shape.amount, 1.0);
      add({entry, term, {}, ColumnPart::amount, 0, false, amount.middle, amount.most, {}},
          std::move(unit));
    } else {
      rest.terms.push_back(shape);
    }
  }

  void separate_polynomial(std::size_t entry, std::size_t term, ErrorEntry& rest) {
    const ErrorShape& shape = entries_[entry].terms[term];
    ErrorShape fixed = shape;
    for (std::size_t c = 0; c < shape.coefficients.size(); ++c) {
      if (!is_drawn(shape.coefficients[c])) continue;
      const Extent amount = extent_of(shape.coefficients[c]);
      fixed.coefficients[c] = fixed_at(shape.coefficients[c], 0.0);
      ErrorShape unit = shape;
      for (Amount& other : unit.coefficients) other = fixed_at(other, 0.0);
      unit.coefficients[c].value = 1.0;
      add({entry, term, {}, ColumnPart::coefficient, c, false, amount.middle, amount.most, {}},
          std::move(unit));
    }
    rest.terms.push_back(std::move(fixed));
  }

  void add(ErrorColumn column, ErrorShape unit) {
    ErrorEntry alone = entries_[column.entry];
    column.error = alone.name;
    column.angular =
        unit.amount.kind == UnitKind::angle ||
        (!unit.coefficients.empty() && unit.coefficients.front().kind == UnitKind::angle);
    alone.terms = {std::move(unit)};
    std::vector<ErrorEntry> stated = stated_for_;
    stated.push_back(std::move(alone));
    auto errors = kinematics::resolve(machine_, stated, spans_);
    if (!errors) {
      for (const Diagnostic& d : errors.error()) problems_.push_back(d);
      return;
    }
    column.unit = *std::move(errors);
    columns_.push_back(std::move(column));
  }

  const Machine& machine_;
  std::span<const ErrorEntry> entries_;
  const AxisSpans& spans_;
  std::vector<ErrorEntry> stated_for_{};  // reference axes, which every column is stated for
  std::vector<ErrorEntry> fixed_{};
  std::vector<ErrorColumn> columns_{};
  Diagnostics problems_{};
};

double weight_of(const ErrorColumn& column, const ErrorShape& shape) {
  assert(!is_drawn(shape.amount) && !is_drawn(shape.phase));
  switch (column.part) {
    case ColumnPart::cosine:
      return shape.amount.value * std::cos(shape.phase.value);
    case ColumnPart::sine:
      return -shape.amount.value * std::sin(shape.phase.value);
    case ColumnPart::coefficient:
      return shape.coefficients[column.coefficient].value;
    case ColumnPart::amount:
      break;
  }
  return shape.amount.value;
}

}  // namespace

Result<PopulationLaws> PopulationLaws::of(const Machine& machine,
                                          std::span<const ErrorEntry> entries,
                                          const AxisSpans& spans) {
  std::vector<ErrorEntry> middle(entries.begin(), entries.end());
  for (ErrorEntry& entry : middle) {
    for (ErrorShape& shape : entry.terms) shape = in_the_middle(shape);
  }
  // All that is wrong with them at once.
  if (auto resolved = kinematics::resolve(machine, middle, spans); !resolved) {
    return std::move(resolved).error();
  }
  Separation separation(machine, entries, spans);
  separation.separate();
  if (!separation.problems().empty()) return separation.problems();
  auto fixed = separation.fixed();
  if (!fixed) return std::move(fixed).error();
  PopulationLaws laws;
  laws.fixed_ = *std::move(fixed);
  laws.columns_ = std::move(separation).columns();
  return laws;
}

Result<PopulationLaws> PopulationLaws::of(const Machine& machine,
                                          std::span<const ErrorEntry> entries,
                                          const programs::TestPiece& piece,
                                          const CommandedPiece& commanded) {
  if (piece.error_span.empty()) return of(machine, entries, AxisSpans{});
  for (const OperationTrace& trace : commanded.operations) {
    if (trace.name == piece.error_span) return of(machine, entries, trace.ranges);
  }
  // Says what is wrong with the span.
  auto unspanned = errors_for(machine, std::span<const ErrorEntry>{}, piece, commanded);
  assert(!unspanned);
  return std::move(unspanned).error();
}

PopulationLaws PopulationLaws::of(GeometricErrors fixed, std::vector<ErrorColumn> columns) {
  PopulationLaws laws;
  laws.fixed_ = std::move(fixed);
  laws.columns_ = std::move(columns);
  return laws;
}

Weights PopulationLaws::weights(std::span<const ErrorEntry> drawn) const {
  Weights weights;
  weights.reserve(columns_.size());
  for (const ErrorColumn& column : columns_) {
    weights.push_back(weight_of(column, drawn[column.entry].terms[column.term]));
  }
  return weights;
}

Weights PopulationLaws::middle() const {
  Weights weights;
  for (const ErrorColumn& column : columns_) weights.push_back(column.middle);
  return weights;
}

GeometricErrors PopulationLaws::errors(std::span<const double> weights) const {
  assert(weights.size() == columns_.size());
  GeometricErrors errors = fixed_;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    errors = errors.plus(columns_[j].unit, weights[j]);
  }
  return errors;
}

}  // namespace frustum::trials
