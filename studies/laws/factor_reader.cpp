#include "studies/laws/factor_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "core/constants.hpp"
#include "core/spelling.hpp"
#include "kinematics/errors/error_draw.hpp"
#include "studies/laws/correlation.hpp"
#include "studies/laws/random_field.hpp"

namespace frustum::studies {
namespace {

using kinematics::Amount;
using kinematics::ErrorEntry;
using kinematics::ErrorShape;
using Kind = ErrorShape::Kind;

bool is_wave(const ErrorShape& shape) {
  return shape.kind == Kind::harmonic || shape.kind == Kind::cyclic;
}

bool has_drawn(const ErrorShape& shape) {
  const auto drawn = [](const Amount& amount) { return !amount.drawn.empty(); };
  return drawn(shape.amount) || drawn(shape.phase) || drawn(shape.peak) ||
         std::any_of(shape.coefficients.begin(), shape.coefficients.end(), drawn);
}

std::string shape_text(const ErrorShape& shape) {
  std::string text(kinematics::name_of(shape.kind));
  if (shape.kind == Kind::harmonic) text += fmt::format(" {}", shape.order);
  return text;
}

Amount one_of(UnitKind kind) { return {.value = 1.0, .kind = kind}; }

bool is_correlatable(const ErrorEntry& entry) {
  const auto is_factor = [](const ErrorShape& s) { return s.kind == Kind::field || has_drawn(s); };
  const auto factor = std::ranges::find_if(entry.terms, is_factor);
  if (factor == entry.terms.end() || std::ranges::count_if(entry.terms, is_factor) != 1)
    return false;
  const std::vector<kinematics::DrawnFactor>& drawn = factor->amount.drawn;
  return factor->kind == Kind::constant && drawn.size() == 1 && drawn.front().name.empty();
}

}  // namespace

std::optional<Diagnostic> uncorrelatable(std::span<const ErrorEntry> entries,
                                         const std::string& name) {
  std::vector<std::string> constants;
  for (const ErrorEntry& entry : entries) {
    if (!is_correlatable(entry)) continue;
    if (entry.name == name) return std::nullopt;
    constants.push_back(entry.name);
  }
  return error("correlated-name"_id,
               fmt::format("{} is not a constant error with one drawn amount", name),
               suggestion(name, constants));
}

FactorReader::FactorReader(const kinematics::Machine& machine, const FactorOptions& options)
    : machine_(machine), options_(options) {
  set_.spans_ = options.spans;
}

void FactorReader::read_scale() {
  for (const ScaleRule& rule : options_.scale) {
    auto pattern = ErrorPattern::parse(rule.pattern);
    if (!pattern) {
      problems_.push_back(pattern.error().front());
      continue;
    }
    scale_.push_back({*std::move(pattern), rule.pattern, rule.factor});
  }
}

double FactorReader::scale_of(const std::string& name, const ErrorShape& shape) {
  double factor = 1.0;
  const std::string iso = iso_name(machine_, name);
  for (Scaling& scaling : scale_) {
    if (!scaling.pattern.matches(iso, shape) && !scaling.pattern.matches(name, shape)) continue;
    scaling.matched = true;
    factor = scaling.factor;
  }
  return factor;
}

std::size_t FactorReader::variable(const kinematics::DrawnFactor& factor,
                                   const std::string& place) {
  const std::string key = factor.name.empty() ? place : "drawn " + factor.name;
  const auto [found, is_new] = variable_at_.try_emplace(key, set_.variables_.size());
  if (is_new) {
    set_.variables_.push_back({key, kinematics::stream_of(key), factor.distribution});
  }
  return found->second;
}

std::optional<std::size_t> FactorReader::add_amount(Amount& amount, const std::string& place,
                                                    const std::string& name, double scale,
                                                    std::vector<std::size_t>& variables) {
  if (amount.drawn.empty()) return std::nullopt;
  amount.value *= scale;
  DrawnAmount drawn{.name = name, .unit = amount.kind, .value = amount.value};
  for (std::size_t i = 0; i < amount.drawn.size(); ++i) {
    kinematics::DrawnFactor& factor = amount.drawn[i];
    factor.distribution = factor.distribution.read_as(options_.read_as);
    const std::size_t at = variable(factor, fmt::format("{}/{}", place, i));
    drawn.parts.push_back({at, factor.shift, factor.function});
    variables.push_back(at);
  }
  set_.written_.push_back(set_.amounts_.size());
  set_.amounts_.push_back(std::move(drawn));
  return set_.written_.back();
}

std::optional<kinematics::GeometricErrors> FactorReader::unit_of(const ErrorEntry& entry,
                                                                 ErrorShape shape) {
  std::vector<ErrorEntry> alone = datum_;
  alone.push_back({.name = entry.name, .written = entry.written, .file = entry.file});
  alone.back().terms.push_back(std::move(shape));
  auto unit = kinematics::resolve(machine_, alone, options_.spans);
  if (unit) return *std::move(unit);
  // What is wrong with an error is wrong with all its terms: once.
  if (!refused_.insert(entry.name).second) return std::nullopt;
  for (Diagnostic& problem : std::move(unit).error()) problems_.push_back(std::move(problem));
  return std::nullopt;
}

void FactorReader::add_column(const ErrorEntry& entry, ErrorShape shape, std::string name,
                              std::size_t amount) {
  auto unit = unit_of(entry, std::move(shape));
  if (!unit) return;
  const std::size_t factor = set_.factors_.size() - 1;
  set_.factors_.back().columns.push_back(set_.columns_.size());
  set_.columns_.push_back(
      {.name = std::move(name), .factor = factor, .amount = amount, .unit = *std::move(unit)});
}

void FactorReader::add_waves(const ErrorEntry& entry, const ErrorShape& shape,
                             const std::string& number, std::optional<std::size_t> amount,
                             std::optional<std::size_t> phase) {
  if (!amount) {  // a fixed amplitude with a drawn phase
    set_.amounts_.push_back({.unit = shape.amount.kind, .value = shape.amount.value});
    amount = set_.amounts_.size() - 1;
  }
  for (const Wave wave : {Wave::cosine, Wave::sine}) {
    ErrorShape unit = shape;
    unit.amount = one_of(shape.amount.kind);
    unit.phase = {.value = wave == Wave::cosine ? 0.0 : -0.25 * kTurn, .kind = UnitKind::angle};
    const std::size_t before = set_.columns_.size();
    add_column(entry, std::move(unit),
               fmt::format("{}/{} {}", entry.name, number, wave == Wave::cosine ? "cos" : "sin"),
               *amount);
    if (set_.columns_.size() == before) continue;
    set_.columns_.back().wave = wave;
    set_.columns_.back().phase = phase;
  }
}

void FactorReader::add_term(const ErrorEntry& entry, const ErrorShape& shape,
                            const std::string& number) {
  const double scale = scale_of(entry.name, shape);
  const std::string place = fmt::format("{}/{}", entry.name, number);
  ErrorShape kept = shape;
  std::vector<std::size_t> variables;
  const auto amount =
      add_amount(kept.amount, place + "/amount", "amounts/" + place, scale, variables);
  const auto phase = add_amount(kept.phase, place + "/phase", "phases/" + place, 1.0, variables);
  const auto peak = add_amount(kept.peak, place + "/peak", "peaks/" + place, 1.0, variables);
  std::vector<std::optional<std::size_t>> coefficients;
  for (std::size_t c = 0; c < kept.coefficients.size(); ++c) {
    coefficients.push_back(add_amount(kept.coefficients[c], fmt::format("{}/{}", place, c),
                                      fmt::format("coefficients/{}/{}", place, c), scale,
                                      variables));
  }
  set_.entries_.back().terms.push_back(kept);
  set_.factors_.push_back({.name = place, .entries = {entry.name}, .shape = shape_text(shape)});
  set_.factors_.back().variables = variables;

  if (peak) {
    set_.nonlinear_.push_back(fmt::format("{}: the place of its peak is drawn", place));
  } else if (shape.kind == Kind::polynomial) {
    for (std::size_t c = 0; c < coefficients.size(); ++c) {
      ErrorShape unit = shape;
      for (Amount& other : unit.coefficients) other = {.kind = shape.amount.kind};
      if (!coefficients[c]) {
        unit.coefficients[c] = shape.coefficients[c];
        fixed_.back().terms.push_back(std::move(unit));
        continue;
      }
      unit.coefficients[c] = one_of(shape.amount.kind);
      add_column(entry, std::move(unit), fmt::format("{}/{}", place, c), *coefficients[c]);
    }
  } else if (is_wave(shape) && phase) {
    add_waves(entry, shape, number, amount, phase);
  } else {
    ErrorShape unit = shape;
    unit.amount = one_of(shape.amount.kind);
    add_column(entry, std::move(unit), place, *amount);
  }
}

void FactorReader::add_entry(const ErrorEntry& entry) {
  set_.entries_.push_back(entry);
  if (!entry.datum.empty()) {
    datum_.push_back(entry);
    return;
  }
  fixed_.push_back(entry);
  if (entry.grid != nullptr) return;
  set_.entries_.back().terms.clear();
  fixed_.back().terms.clear();
  for (std::size_t t = 0; t < entry.terms.size(); ++t) {
    const ErrorShape& shape = entry.terms[t];
    if (shape.kind == Kind::field) {
      const auto name = kinematics::ErrorName::parse(iso_name(machine_, entry.name));
      const kinematics::Joint* joint = name ? machine_.joint(name->axis) : nullptr;
      if (joint == nullptr) {
        problems_.push_back(*kinematics::unknown_error(machine_, entry.name));
        continue;
      }
      const auto given = options_.spans.find(joint->letter);
      const bool is_given = given != options_.spans.end() && given->second.width() > 0.0;
      const kinematics::AxisRange span = shape.span ? *shape.span
                                         : is_given ? given->second
                                                    : joint->travel;
      ErrorShape scaled = shape;
      scaled.amount.value *= scale_of(entry.name, shape);
      const std::string place = fmt::format("{}/{}", entry.name, t);
      auto terms = field_terms(scaled, span, place);
      if (!terms) {
        problems_.push_back(terms.error().front());
        continue;
      }
      const std::size_t first = set_.factors_.size();
      for (std::size_t k = 0; k < terms->size(); ++k) {
        add_term(entry, (*terms)[k], fmt::format("{}/field/{}", t, k));
      }
      // One error, one factor.
      Factor field{.name = place, .entries = {entry.name}, .shape = "field"};
      for (std::size_t f = first; f < set_.factors_.size(); ++f) {
        const Factor& part = set_.factors_[f];
        field.variables.insert(field.variables.end(), part.variables.begin(), part.variables.end());
        for (const std::size_t c : part.columns) {
          set_.columns_[c].factor = first;
          field.columns.push_back(c);
        }
      }
      set_.factors_.resize(first);
      set_.factors_.push_back(std::move(field));
    } else if (has_drawn(shape)) {
      add_term(entry, shape, fmt::format("{}", t));
    } else {
      fixed_.back().terms.push_back(shape);
      set_.entries_.back().terms.push_back(shape);
    }
  }
  if (fixed_.back().terms.empty()) fixed_.pop_back();
}

void FactorReader::correlate() {
  std::set<std::string> taken;
  for (const CorrelatedGroup& group : options_.correlated) {
    auto factors = cholesky_of(group.correlation, group.names.size());
    if (!factors) {
      problems_.push_back(factors.error().front());
      continue;
    }
    FactorSet::Copula copula{.correlation = group.correlation, .cholesky = *std::move(factors)};
    for (const std::string& name : group.names) {
      if (!taken.insert(name).second) {
        problems_.push_back(error("correlated-twice"_id, fmt::format("{} is named twice", name),
                                  "an error is in one correlated group, once"));
        continue;
      }
      if (const auto problem = uncorrelatable(set_.entries_, name)) {
        problems_.push_back(*problem);
        continue;
      }
      const auto member = std::find_if(
          set_.factors_.begin(), set_.factors_.end(),
          [&](const Factor& f) { return f.entries.front() == name && f.shape == "constant"; });
      if (member == set_.factors_.end()) continue;  // its column was refused
      copula.variables.push_back(member->variables.front());
    }
    set_.copulas_.push_back(std::move(copula));
  }
}

// Factors that share a variable, or whose variables are correlated, become one.
void FactorReader::join_factors() {
  std::vector<std::size_t> parent(set_.factors_.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t f) {
    while (parent[f] != f) f = parent[f];
    return f;
  };
  std::vector<std::size_t> owner(set_.variables_.size(), set_.factors_.size());
  const auto join = [&](std::size_t a, std::size_t b) {
    const std::size_t one = root(a), other = root(b);
    parent[std::max(one, other)] = std::min(one, other);
  };
  for (std::size_t f = 0; f < set_.factors_.size(); ++f) {
    for (const std::size_t v : set_.factors_[f].variables) {
      if (owner[v] < set_.factors_.size()) join(owner[v], f);
      owner[v] = root(f);
    }
  }
  for (const FactorSet::Copula& copula : set_.copulas_) {
    for (const std::size_t v : copula.variables) join(owner[copula.variables.front()], owner[v]);
  }
  std::vector<Factor> joined;
  std::vector<std::size_t> place(set_.factors_.size());
  for (std::size_t f = 0; f < set_.factors_.size(); ++f) {
    Factor& part = set_.factors_[f];
    if (root(f) == f) {
      place[f] = joined.size();
      joined.push_back(std::move(part));
    } else {
      place[f] = place[root(f)];
      Factor& whole = joined[place[f]];
      whole.name += " + " + part.name;
      if (std::find(whole.entries.begin(), whole.entries.end(), part.entries.front()) ==
          whole.entries.end())
        whole.entries.push_back(part.entries.front());
      whole.variables.insert(whole.variables.end(), part.variables.begin(), part.variables.end());
      whole.columns.insert(whole.columns.end(), part.columns.begin(), part.columns.end());
    }
  }
  for (Factor& factor : joined) {
    std::sort(factor.variables.begin(), factor.variables.end());
    factor.variables.erase(std::unique(factor.variables.begin(), factor.variables.end()),
                           factor.variables.end());
    std::sort(factor.columns.begin(), factor.columns.end());
  }
  for (Column& column : set_.columns_) column.factor = place[column.factor];
  set_.factors_ = std::move(joined);
}

Result<FactorSet> FactorReader::read(std::span<const ErrorEntry> entries) {
  read_scale();
  for (const ErrorEntry& entry : entries) {
    if (!entry.datum.empty()) add_entry(entry);
  }
  for (const ErrorEntry& entry : entries) {
    if (entry.datum.empty()) add_entry(entry);
  }
  for (const Scaling& scaling : scale_) {
    if (scaling.matched) continue;
    problems_.push_back(error(
        "scale-pattern"_id, fmt::format("scale pattern '{}' matches no drawn error", scaling.text),
        "* is any letters, ? is one: \"E?X:harmonic 2\""));
  }
  correlate();
  std::vector<ErrorEntry> all_fixed = datum_;
  all_fixed.insert(all_fixed.end(), fixed_.begin(), fixed_.end());
  auto fixed = kinematics::resolve(machine_, all_fixed, options_.spans);
  if (!fixed) {
    for (Diagnostic& d : std::move(fixed).error()) problems_.push_back(std::move(d));
  } else {
    set_.fixed_ = *std::move(fixed);
  }
  set_.has_fixed_ = !fixed_.empty();
  if (problems_.empty() && set_.variables_.empty()) {
    problems_.push_back(error("nothing-drawn"_id, "no error has a drawn amount",
                              "write a distribution: EX0C = \"uniform -10um..10um\""));
  }
  if (!problems_.empty()) return problems_;
  join_factors();
  return std::move(set_);
}

Result<FactorSet> FactorSet::make(const kinematics::Machine& machine,
                                  std::span<const ErrorEntry> entries,
                                  const FactorOptions& options) {
  return FactorReader(machine, options).read(entries);
}

}  // namespace frustum::studies
