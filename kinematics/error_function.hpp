// One component error as a function of the commanded axis position: a sum of simple terms.
//
// Model    : constant a; linear a (q - q0)/D; harmonic a cos(w (q - q0) + psi); table, linear between
//            its points and held at its ends
// Units    : q and value in mm or rad, whichever the axis and the error are
// Errors   : none; shapes are checked where they are read
// Source   : shapes of the ETH thesis, sections 3.8 and 3.9 (cone-test definitions of lin and k-th)
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "kinematics/axes.hpp"

namespace frustum::kinematics {

struct ConstantTerm {
  double value = 0.0;
};
struct LinearTerm {
  double slope = 0.0;
  double zero = 0.0;  // position where the term vanishes
};
struct HarmonicTerm {
  double amplitude = 0.0;
  double angular_frequency = 0.0;  // rad per unit of q
  double origin = 0.0;
  double phase = 0.0;  // rad
};
struct TableTerm {
  std::vector<std::pair<double, double>> points;  // position, value; positions increase
};
using ErrorTerm = std::variant<ConstantTerm, LinearTerm, HarmonicTerm, TableTerm>;

class ErrorFunction {
 public:
  ErrorFunction() = default;
  explicit ErrorFunction(std::vector<ErrorTerm> terms) : terms_(std::move(terms)) {}

  [[nodiscard]] bool is_zero() const { return terms_.empty(); }
  // Of `axis`, where the axes are.
  [[nodiscard]] double operator()(AxisLetter axis, const AxisState& at) const;
  // This function plus `factor` times the other.
  [[nodiscard]] ErrorFunction plus(const ErrorFunction& other, double factor) const;

 private:
  std::vector<ErrorTerm> terms_;
};

}  // namespace frustum::kinematics
