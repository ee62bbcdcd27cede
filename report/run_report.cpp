#include "report/run_report.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::report {

std::optional<AxisRange> range_of(const AxisSeries& series) {
  if (series.range) return series.range;
  std::optional<AxisRange> range;
  for (const double value : series.values) {
    if (!std::isfinite(value)) continue;
    if (!range) range = AxisRange{value, value};
    range->low = std::min(range->low, value);
    range->high = std::max(range->high, value);
  }
  return range;
}

bool SurfacePicture::is_valid() const {
  if (!deviation.empty() && deviation.size() != vertices.size()) return false;
  for (const std::array<float, 3>& vertex : vertices) {
    if (!std::all_of(vertex.begin(), vertex.end(), [](float x) { return std::isfinite(x); })) {
      return false;
    }
  }
  return std::all_of(triangles.begin(), triangles.end(), [&](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t corner) { return corner < vertices.size(); });
  });
}

bool RunReport::passes() const {
  return measurement.passes() && collisions.empty() && !has_error(diagnostics) &&
         !has_error(measurement.diagnostics);
}

}  // namespace frustum::report
