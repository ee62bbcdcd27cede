// Two values of each machine against each other, with their limits.
//
// Units: those that the titles name. Errors: none.
#pragma once

#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

struct ScatterSeries {
  std::string title{};  // with the unit, as are the values
  std::vector<double> values{};
  std::vector<double> limits{};
};

[[nodiscard]] std::string scatter_figure(const std::string& title, const ScatterSeries& along,
                                         const ScatterSeries& up, const Wording& words = Wording());

}  // namespace frustum::report
