// Displacements in a plane as arrows on a circle, magnified.
//
// Units: rad, um as the wording shows it. Errors: none; arrows that are not finite are left out.
#pragma once

#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

struct CircleArrow {
  double angle = 0.0;  // where on the circle
  double x = 0.0, y = 0.0;
};
struct ArrowSeries {
  std::string name{};
  std::vector<CircleArrow> arrows{};
};

[[nodiscard]] std::string vector_figure(const std::string& title,
                                        const std::vector<ArrowSeries>& series,
                                        const Wording& words = Wording());

}  // namespace frustum::report
