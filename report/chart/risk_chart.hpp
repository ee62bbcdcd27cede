// What a guard band costs: the risks of consumer and producer over its width.
//
// Units: guard band in expanded uncertainties U = 2 u; risks as shares. Errors: none.
#pragma once

#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

struct RiskCurve {
  std::vector<double> guard{};
  std::vector<double> consumer{}, producer{};
};

[[nodiscard]] std::string risk_figure(const std::string& title, const RiskCurve& curve,
                                      const Wording& words = Wording());

}  // namespace frustum::report
