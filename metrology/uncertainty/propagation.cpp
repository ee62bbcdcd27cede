#include "metrology/uncertainty/propagation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrology/uncertainty/linear_uncertainty.hpp"

namespace frustum::metrology {
namespace {

constexpr std::string_view kRemedy = "give the plan that the part was measured with";

// The measured features with their fits, in the workpiece frame.
Result<std::vector<FittedFeature>> refitted(const InspectionPlan& plan,
                                            const Measurement& measurement) {
  std::vector<FittedFeature> features;
  for (const MeasuredFeature& measured : measurement.features) {
    const PlannedFeature* planned = find_feature(plan, measured.name);
    if (planned == nullptr) {
      return error("unknown-feature"_id, fmt::format("the plan has no feature '{}'", measured.name),
                   std::string(kRemedy));
    }
    std::vector<Vec3> points;
    std::vector<std::size_t> sections;
    for (const MeasuredPoint& p : measured.points) {
      points.push_back(measurement.workpiece_from_datum.point(p.point));
      sections.push_back(p.section);
    }
    auto fit = fit_feature(*planned, points, sections, 0.0);
    if (!fit) return std::move(fit).error();
    features.push_back(std::move(*fit));
  }
  return features;
}

}  // namespace

Result<Eigen::MatrixXd> covariance(const InspectionPlan& plan, const Measurement& measurement,
                                   const CmmModel& cmm) {
  if (Diagnostics faults = check(plan); has_error(faults)) return faults;
  const auto features = refitted(plan, measurement);
  if (!features) return features.error();
  const auto found = linear_uncertainty(plan, *features, point_uncertainty(cmm));
  if (!found) return found.error();
  // As the results are in order, which need not be the plan's.
  std::vector<Eigen::Index> rows;
  for (const CharacteristicResult& c : measurement.characteristics) {
    const auto planned = std::find_if(plan.characteristics.begin(), plan.characteristics.end(),
                                      [&](const auto& p) { return p.name == c.name; });
    if (planned == plan.characteristics.end()) {
      return error("unknown-characteristic"_id,
                   fmt::format("the plan has no characteristic '{}'", c.name),
                   std::string(kRemedy));
    }
    rows.push_back(planned - plan.characteristics.begin());
  }
  const Eigen::MatrixXd of_plan = found->answers * found->answers.transpose();
  Eigen::MatrixXd joint = of_plan(rows, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double standard = found->standard[static_cast<std::size_t>(rows[i])];
    const auto k = static_cast<Eigen::Index>(i);
    if (joint(k, k) == 0.0) joint(k, k) = standard * standard;
  }
  return joint;
}

}  // namespace frustum::metrology
