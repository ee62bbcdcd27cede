#include "app/benchmark/benchmark_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/printable_text.hpp"
#include "core/units.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/points/point_file.hpp"

namespace frustum::app {
namespace {

constexpr double kAstray = 1.0;  // mm: errors of machines are a tenth of it, planned points apart

Diagnostic at_point(const metrology::FeaturePoints& points, std::size_t i, DiagnosticId id,
                    std::string what, std::string hint) {
  Diagnostic failure = error(id, std::move(what), std::move(hint));
  failure.file = points.file;
  failure.line = i < points.lines.size() ? points.lines[i] : points.line;
  return failure;
}

}  // namespace

Result<std::vector<std::optional<double>>> planned_deviations(const metrology::InspectionPlan& plan,
                                                              const std::filesystem::path& file) {
  const auto measured = metrology::read_feature_points(file);
  if (!measured) return measured.error();
  for (const auto& points : *measured) {
    if (metrology::find_feature(plan, points.feature) != nullptr) continue;
    return at_point(points, 0, "unknown-feature"_id,
                    fmt::format("the plan has no feature '{}'", printable(points.feature)),
                    "points have the names of the plan's features");
  }
  std::vector<std::optional<double>> all;
  for (const metrology::PlannedFeature& feature : plan.features) {
    const auto planned = metrology::planned_points(feature);
    std::vector<std::optional<double>> own(planned.size());
    const auto found =
        std::ranges::find(*measured, feature.name, &metrology::FeaturePoints::feature);
    const std::size_t count = found == measured->end() ? 0 : found->points.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3& at = found->points[i];
      const auto nearest = std::ranges::min_element(
          planned, {}, [&](const auto& p) { return (p.point - at).squaredNorm(); });
      if (nearest == planned.end() || (nearest->point - at).norm() >= kAstray) {
        return at_point(*found, i, "point-astray"_id,
                        fmt::format("({:.3f}, {:.3f}, {:.3f}) is at no planned point of '{}'",
                                    at.x(), at.y(), at.z(), feature.name),
                        "coordinates are mm in the workpiece frame, under their columns' names");
      }
      auto& deviation = own[static_cast<std::size_t>(nearest - planned.begin())];
      if (deviation) {
        return at_point(*found, i, "given-twice"_id,
                        fmt::format("two points of '{}' are at one planned point", feature.name),
                        "one measured point for each planned one");
      }
      deviation = kUmPerMm * (at - nearest->point).dot(nearest->normal);
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace frustum::app
