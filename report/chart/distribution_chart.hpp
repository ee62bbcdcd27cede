// How values are distributed: boxes whose whiskers reach the smallest and largest value, and the
// empirical distribution function with its band.
//
// Units: those of the values, which the titles name. Errors: none; nothing is drawn of no values.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

struct BoxRow {
  std::string label{};
  double min = 0.0, low = 0.0, middle = 0.0, high = 0.0, max = 0.0;  // low, high: quartiles
  std::vector<double> limits{};  // one for a size, two for deviations of either sign
};

// A <figure> of boxes along one scale.
[[nodiscard]] std::string box_figure(const std::string& title, const std::string& scale_title,
                                     std::span<const BoxRow> rows,
                                     const Wording& words = Wording());

// The share of values that are not larger: at each value its p; as many points as can be seen.
struct DistributionLine {
  std::vector<double> value{};  // ascending
  std::vector<double> p{};
  double half_width = 0.0;  // of the band
  // One for a size, two for deviations of either sign.
  std::vector<double> limits{};
};
[[nodiscard]] std::string distribution_figure(const std::string& title,
                                              const std::string& scale_title,
                                              const DistributionLine& line,
                                              const Wording& words = Wording());

}  // namespace frustum::report
