// Bars for what each error adds, the largest on top: two bars a row, one over the other.
//
// Units: shares. Errors: none.
#pragma once

#include <span>
#include <string>

#include "report/wording.hpp"

namespace frustum::report {

struct TornadoRow {
  std::string label{};
  double share = 0.0;  // of the mean square
  double total = 0.0;  // index
};

[[nodiscard]] std::string tornado_figure(const std::string& title, std::span<const TornadoRow> rows,
                                         const Wording& words = Wording());

}  // namespace frustum::report
