#include "kinematics/model/error_function.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace frustum::kinematics {
namespace {

double value(const ConstantTerm& term, AxisLetter /*axis*/, const AxisState& /*at*/) {
  return term.value;
}
double value(const LinearTerm& term, AxisLetter axis, const AxisState& at) {
  return term.slope * (at.q[axis] - term.zero);
}
double value(const PolynomialTerm& term, AxisLetter axis, const AxisState& at) {
  const double t = std::clamp((at.q[axis] - term.middle) / term.reach, -1.0, 1.0);
  double sum = 0.0;
  for (auto c = term.coefficients.rbegin(); c != term.coefficients.rend(); ++c) sum = sum * t + *c;
  return sum;
}
double value(const HarmonicTerm& term, AxisLetter axis, const AxisState& at) {
  return term.amplitude *
         std::cos(term.angular_frequency * (at.q[axis] - term.origin) + term.phase);
}
double value(const ReversalTerm& term, AxisLetter axis, const AxisState& at) {
  return term.at_plus * at.heading[axis];
}

double value(const TriangularTerm& term, AxisLetter axis, const AxisState& at) {
  const double q = std::clamp(at.q[axis], term.lo, term.hi);
  if (q == term.peak) return term.amplitude;
  const double foot = q < term.peak ? term.lo : term.hi;
  return term.amplitude * (q - foot) / (term.peak - foot);
}

double wrapped(double q, double lo, double hi) {
  const double turns = std::floor((q - lo) / (hi - lo));
  return q - turns * (hi - lo);
}

double value(const TableTerm& term, AxisLetter axis, const AxisState& at) {
  const auto& points = term.points;
  double q = at.q[axis];
  if (term.periodic) q = wrapped(q, points.front().position, points.back().position);
  const auto after = std::upper_bound(points.begin(), points.end(), q,
                                      [](double x, const TablePoint& p) { return x < p.position; });
  if (after == points.begin()) return points.front().value;
  if (after == points.end()) return points.back().value;
  const TablePoint& a = *std::prev(after);
  const TablePoint& b = *after;
  const double width = b.position - a.position;
  const double t = (q - a.position) / width;
  const double straight = a.value + t * (b.value - a.value);
  if (term.kind == TableKind::linear) return straight;
  const double rise = b.value - a.value;
  return straight +
         t * (1.0 - t) * ((1.0 - t) * (a.slope * width - rise) - t * (b.slope * width - rise));
}

// Where a position lies among increasing ones: the interval's first index and the share beyond it.
struct PlaceInTable {
  std::size_t index = 0;
  double share = 0.0;
};
PlaceInTable place_in(std::span<const double> positions, double q) {
  if (q <= positions.front()) return {0, 0.0};
  if (q >= positions.back()) return {positions.size() - 2, 1.0};
  const auto after = std::upper_bound(positions.begin(), positions.end(), q);
  const auto index = static_cast<std::size_t>(after - positions.begin()) - 1;
  return {index, (q - positions[index]) / (positions[index + 1] - positions[index])};
}

double value(const SurfaceTerm& term, AxisLetter /*axis*/, const AxisState& at) {
  const PlaceInTable i = place_in(term.first_positions, at.q[term.first]);
  const PlaceInTable j = place_in(term.second_positions, at.q[term.second]);
  const double* row = term.values.data() + i.index * term.second_positions.size() + j.index;
  const double* next = row + term.second_positions.size();
  const double here = row[0] + j.share * (row[1] - row[0]);
  const double there = next[0] + j.share * (next[1] - next[0]);
  return here + i.share * (there - here);
}

double value(const ModulatedTerm& term, AxisLetter axis, const AxisState& at) {
  return value(term.factor, term.axis, at) *
         std::visit([&](const auto& t) { return value(t, axis, at); }, term.term);
}

ErrorTerm scaled(ConstantTerm term, double factor) {
  term.value *= factor;
  return term;
}
ErrorTerm scaled(LinearTerm term, double factor) {
  term.slope *= factor;
  return term;
}
ErrorTerm scaled(PolynomialTerm term, double factor) {
  for (double& c : term.coefficients) c *= factor;
  return term;
}
ErrorTerm scaled(HarmonicTerm term, double factor) {
  term.amplitude *= factor;
  return term;
}
ErrorTerm scaled(ReversalTerm term, double factor) {
  term.at_plus *= factor;
  return term;
}
ErrorTerm scaled(TriangularTerm term, double factor) {
  term.amplitude *= factor;
  return term;
}
ErrorTerm scaled(TableTerm term, double factor) {
  for (TablePoint& point : term.points) {
    point.value *= factor;
    point.slope *= factor;
  }
  return term;
}
ErrorTerm scaled(SurfaceTerm term, double factor) {
  for (double& v : term.values) v *= factor;
  return term;
}

ErrorTerm scaled(ModulatedTerm term, double factor) {
  for (TablePoint& point : term.factor.points) point.value *= factor;
  return term;
}

// Slope between two secants: none at an extreme, else a mean that cannot overshoot.
double monotone_slope(double secant_before, double width_before, double secant_after,
                      double width_after) {
  if (secant_before * secant_after <= 0.0) return 0.0;
  const double w_before = 2.0 * width_after + width_before;
  const double w_after = width_after + 2.0 * width_before;
  return (w_before + w_after) / (w_before / secant_before + w_after / secant_after);
}

}  // namespace

TableTerm TableTerm::of(std::vector<std::pair<double, double>> points, TableKind kind,
                        bool periodic) {
  TableTerm term{.kind = kind, .periodic = periodic};
  for (const auto& [position, value] : points) term.points.push_back({position, value, 0.0});
  if (kind == TableKind::linear) return term;
  const std::size_t last = term.points.size() - 1;
  const auto width = [&](std::size_t i) {
    return term.points[i + 1].position - term.points[i].position;
  };
  const auto secant = [&](std::size_t i) {
    return (term.points[i + 1].value - term.points[i].value) / width(i);
  };
  for (std::size_t i = 1; i < last; ++i) {
    term.points[i].slope = monotone_slope(secant(i - 1), width(i - 1), secant(i), width(i));
  }
  if (periodic) {
    const double slope = monotone_slope(secant(last - 1), width(last - 1), secant(0), width(0));
    term.points.front().slope = term.points.back().slope = slope;
  } else {
    term.points.front().slope = secant(0);
    term.points.back().slope = secant(last - 1);
  }
  return term;
}

bool ErrorFunction::depends_on_direction() const {
  return std::any_of(terms_.begin(), terms_.end(), [](const ErrorTerm& term) {
    const auto* modulated = std::get_if<ModulatedTerm>(&term);
    return std::holds_alternative<ReversalTerm>(term) ||
           (modulated != nullptr && std::holds_alternative<ReversalTerm>(modulated->term));
  });
}

ErrorFunction ErrorFunction::plus(const ErrorFunction& other, double factor) const {
  std::vector<ErrorTerm> terms = terms_;
  for (const ErrorTerm& term : other.terms_) {
    terms.push_back(std::visit([factor](const auto& t) { return scaled(t, factor); }, term));
  }
  return ErrorFunction(std::move(terms));
}

ErrorFunction::ErrorFunction(std::vector<ErrorTerm> terms) {
  std::vector<ErrorTerm> bent;
  for (ErrorTerm& term : terms) {
    if (const auto* constant = std::get_if<ConstantTerm>(&term)) {
      at_zero_ += constant->value;
    } else if (const auto* linear = std::get_if<LinearTerm>(&term)) {
      at_zero_ -= linear->slope * linear->zero;
      slope_ += linear->slope;
    } else {
      bent.push_back(std::move(term));
      continue;
    }
    terms_.push_back(std::move(term));
  }
  straight_ = terms_.size();
  for (ErrorTerm& term : bent) terms_.push_back(std::move(term));
}

double ErrorFunction::bent(AxisLetter axis, const AxisState& at) const {
  double sum = 0.0;
  for (std::size_t i = straight_; i < terms_.size(); ++i) {
    sum += std::visit([&](const auto& t) { return value(t, axis, at); }, terms_[i]);
  }
  return sum;
}

}  // namespace frustum::kinematics
