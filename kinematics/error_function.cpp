#include "kinematics/error_function.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::kinematics {
namespace {

double value(const ConstantTerm& term, double /*q*/) { return term.value; }
double value(const LinearTerm& term, double q) { return term.slope * (q - term.zero); }
double value(const HarmonicTerm& term, double q) {
  return term.amplitude * std::cos(term.angular_frequency * (q - term.origin) + term.phase);
}
double value(const TableTerm& term, double q) {
  const auto& points = term.points;
  const auto after = std::upper_bound(points.begin(), points.end(), q,
                                      [](double x, const auto& p) { return x < p.first; });
  if (after == points.begin()) return points.front().second;
  if (after == points.end()) return points.back().second;
  const auto& before = *std::prev(after);
  const double t = (q - before.first) / (after->first - before.first);
  return before.second + t * (after->second - before.second);
}

ErrorTerm scaled(ConstantTerm term, double factor) {
  term.value *= factor;
  return term;
}
ErrorTerm scaled(LinearTerm term, double factor) {
  term.slope *= factor;
  return term;
}
ErrorTerm scaled(HarmonicTerm term, double factor) {
  term.amplitude *= factor;
  return term;
}
ErrorTerm scaled(TableTerm term, double factor) {
  for (auto& point : term.points) point.second *= factor;
  return term;
}

}  // namespace

ErrorFunction ErrorFunction::plus(const ErrorFunction& other, double factor) const {
  std::vector<ErrorTerm> terms = terms_;
  for (const ErrorTerm& term : other.terms_) {
    terms.push_back(std::visit([factor](const auto& t) { return scaled(t, factor); }, term));
  }
  return ErrorFunction(std::move(terms));
}

double ErrorFunction::operator()(AxisLetter axis, const AxisState& at) const {
  const double q = at.q[axis];
  double sum = 0.0;
  for (const ErrorTerm& term : terms_) {
    sum += std::visit([q](const auto& t) { return value(t, q); }, term);
  }
  return sum;
}

}  // namespace frustum::kinematics
