// How much smaller the errors must be so that enough machines make a good part, at the least cost.
//
// Model    : group g of errors is scaled by s_g and costs c_g / s_g. Values of common draws for
//            given factors come from a function; minimise the cost so that a share p of the values
//            is within T. Values that are homogeneous (all errors scale with the factors: forms of
//            a linear model) let every direction of s be brought to the limit exactly, s T / q_p;
//            the simplex of Nelder and Mead searches the directions
//            One factor on all errors: s = T / q_p, with the interval of the quantile
//            Closed form, for values that are normal with sd sqrt(sum g_j^2 t_j^2):
//            t_j ~ (c_j / g_j^2)^(1/3)
// Units    : values and T in one unit; factors and costs none
// Shape    : one factor a group, one cost a group, above 0
// Errors   : none; T and the quantile above 0
// Accuracy : cost 1e-4 of the least of these draws; the optimum is flat, so compare costs and not
//            factors (tests/studies/allocation_test.cpp)
// Source   : Nelder and Mead 1965; reciprocal cost: Spotts 1973
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "studies/statistics/order_statistics.hpp"

namespace frustum::studies {

struct OneFactor {
  double factor = 1.0;
  Interval ci95{};
};
// For values that scale with all errors.
[[nodiscard]] OneFactor one_factor(std::span<const double> sorted, double probability,
                                   double limit);

struct Allocation {
  std::vector<double> factors{};
  double cost = 0.0;
  double equal_factor = 1.0;  // the one that would do for all groups
  double equal_cost = 0.0;
};

// Values of all draws for these factors, in any order.
using ScaledValues = std::function<std::vector<double>(std::span<const double> factors)>;

[[nodiscard]] Allocation allocate(const ScaledValues& values, std::span<const double> costs,
                                  double probability, double limit);

struct AllowedTolerances {
  std::vector<double> limits{};
  double cost = 0.0;
};
// Of a sum of squares: the t with the least sum of c / t for which sqrt(sum g^2 t^2) / 3 is
// `deviation_allowed`: tolerances are three standard deviations.
[[nodiscard]] AllowedTolerances closed_form_tolerances(std::span<const double> gains,
                                                       std::span<const double> costs,
                                                       double deviation_allowed);

}  // namespace frustum::studies
