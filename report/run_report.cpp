#include "report/run_report.hpp"

#include <fmt/format.h>

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
  if (!normals.empty() && normals.size() != vertices.size()) return false;
  const auto is_finite = [](const std::array<float, 3>& v) {
    return std::all_of(v.begin(), v.end(), [](float x) { return std::isfinite(x); });
  };
  return std::all_of(vertices.begin(), vertices.end(), is_finite) &&
         std::all_of(normals.begin(), normals.end(), is_finite) &&
         std::all_of(triangles.begin(), triangles.end(), [&](const auto& triangle) {
           return std::all_of(triangle.begin(), triangle.end(),
                              [&](std::uint32_t corner) { return corner < vertices.size(); });
         });
}

std::string machine_bodies_text(const MachineBodies& bodies, const Wording& words) {
  if (bodies.bodies == 0) {
    return words(
        "Machine collisions were not looked for: neither the machine file nor the job states "
        "bodies.");
  }
  const std::string count =
      bodies.bodies == 1
          ? words("1 body of machine and fixtures, with tools and blank")
          : words("{0} bodies of machine and fixtures, with tools and blank", bodies.bodies);
  if (!bodies.smallest_distance) return words("{0}: none moves against another.", count);
  const std::string line = bodies.line == 0 ? "" : words(", line {0}", bodies.line);
  const std::string place = line + (bodies.file.empty() ? "" : words(" in {0}", bodies.file));
  if (*bodies.smallest_distance == 0.0) {
    return words("{0}: {1} and {2} meet{3}.", count, bodies.first, bodies.second, place);
  }
  const std::string distance =
      words.fixed(words.shown(*bodies.smallest_distance, "mm"), words.is_inch() ? 4 : 2) + " " +
      words.symbol("mm");
  return words("{0}: smallest distance {1}, {2} to {3}{4}.", count, distance, bodies.first,
               bodies.second, place);
}

bool RunReport::passes() const {
  return measurement.passes() && collisions.empty() && !has_error(diagnostics) &&
         !has_error(measurement.diagnostics);
}

metrology::Verdict RunReport::verdict() const {
  if (passes()) return metrology::Verdict::pass;
  const bool is_sound =
      collisions.empty() && !has_error(diagnostics) && !has_error(measurement.diagnostics);
  return is_sound ? measurement.verdict() : metrology::Verdict::fail;
}

}  // namespace frustum::report
