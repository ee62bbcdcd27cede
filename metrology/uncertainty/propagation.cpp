#include "metrology/uncertainty/propagation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrology/characteristic/characteristic.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/uncertainty/influence.hpp"

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
  const auto workpiece_from_datum = alignment_of(plan, *features);
  if (!workpiece_from_datum) return workpiece_from_datum.error();
  std::vector<FittedFeature> in_datum;
  for (const FittedFeature& feature : *features) {
    in_datum.push_back(transformed(workpiece_from_datum->inverse(), feature));
  }
  const PointUncertainty u = point_uncertainty(cmm);
  Influence influence(plan, *features);
  const auto count = static_cast<Eigen::Index>(measurement.characteristics.size());
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(count, influence.of_field().rows());
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(count);  // variances without gradient
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::string& name = measurement.characteristics[static_cast<std::size_t>(i)].name;
    const auto planned = std::find_if(plan.characteristics.begin(), plan.characteristics.end(),
                                      [&](const auto& c) { return c.name == name; });
    if (planned == plan.characteristics.end()) {
      return error("unknown-characteristic"_id,
                   fmt::format("the plan has no characteristic '{}'", name), std::string(kRemedy));
    }
    auto gradient = influence.of(*planned);
    if (!gradient) return std::move(gradient).error();
    if (gradient->has_value()) {
      gradients.row(i) = **gradient;
      continue;
    }
    const auto stated = evaluate(*planned, in_datum, cmm);
    if (!stated) return stated.error();
    const double standard = 0.5 * internal_value(stated->expanded_uncertainty, stated->unit);
    alone[i] = standard * standard;
  }
  const Eigen::MatrixXd by_field = gradients * influence.of_field();
  Eigen::MatrixXd joint = u.probing * u.probing * gradients * gradients.transpose() +
                          u.scale * u.scale * by_field * by_field.transpose();
  joint.diagonal() += alone;
  return joint;
}

}  // namespace frustum::metrology
