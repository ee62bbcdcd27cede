#include "metrology/cmm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/spelling.hpp"
#include "metrology/ball_contact.hpp"
#include "metrology/cmm_errors.hpp"
#include "metrology/evaluation.hpp"
#include "metrology/strategy.hpp"

namespace frustum::metrology {
namespace {

Diagnostic missed(const PlannedFeature& feature, std::size_t index, const PlannedPoint& planned,
                  ContactState state, const ProbeSettings& probe) {
  const std::string place =
      fmt::format("feature '{}', point {} at [{:.3f}, {:.3f}, {:.3f}]", feature.name, index + 1,
                  planned.point.x(), planned.point.y(), planned.point.z());
  if (state == ContactState::starts_inside) {
    return error(fmt::format("{}: the approach starts inside the material, {} mm off the nominal "
                             "surface",
                             place, probe.clearance),
                 "check the nominal geometry and the cut, or enlarge probe.clearance");
  }
  return error(
      fmt::format("{}: the plan misses the part: no surface within {} mm past the nominal one",
                  place, probe.reach),
      "check the nominal geometry and the blank, or enlarge probe.reach");
}

Result<FittedFeature> probed(const InspectionPlan& plan, std::size_t index,
                             const Pose& workpiece_from_datum, const SurfaceProbeRef& part,
                             const CmmErrors& errors) {
  const PlannedFeature& feature = plan.features[index];
  const double ball_radius = 0.5 * plan.probe.ball_diameter;
  std::vector<Vec3> centres;
  std::vector<std::size_t> sections;
  for (const PlannedPoint& planned : planned_points(feature)) {
    const BallApproach approach{workpiece_from_datum.point(planned.point),
                                unit(workpiece_from_datum.direction(planned.normal)), ball_radius,
                                plan.probe.clearance, plan.probe.reach};
    const BallContact contact = touch_with_ball(part, approach);
    if (contact.state != ContactState::contact) {
      return missed(feature, centres.size(), planned, contact.state, plan.probe);
    }
    centres.push_back(errors.measured(
        {contact.centre, approach.outward, point_index(index, centres.size()), planned.scanned}));
    sections.push_back(planned.section);
  }
  return fit_feature(feature, centres, sections, errors.ball_radius(ball_radius));
}

// In the order of the plan; empty for a plan without datum system.
Result<std::vector<FittedFeature>> probed_datum_features(const InspectionPlan& plan,
                                                         const Pose& workpiece_from_datum,
                                                         const SurfaceProbeRef& part,
                                                         const CmmErrors& errors) {
  std::vector<FittedFeature> features;
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    if (!is_datum_feature(plan, plan.features[i])) continue;
    auto feature = probed(plan, i, workpiece_from_datum, part, errors);
    if (!feature) return std::move(feature).error();
    features.push_back(std::move(*feature));
  }
  return features;
}

// True when probing along the planned lines would show: an oblique section of radius r is out of
// round by r t^2 / 2, which is 0.25 nm for 50 mm and 1e-4 rad.
bool lies_askew(const Pose& planned_from_found) {
  return (planned_from_found.rotation - Mat3::Identity()).norm() > 1e-4 ||
         planned_from_found.translation.norm() > 0.01;
}

std::vector<std::string> names_of(const InspectionPlan& plan) {
  std::vector<std::string> names;
  for (const PlannedFeature& feature : plan.features) names.push_back(feature.name);
  return names;
}

}  // namespace

Result<Measurement> measure(const InspectionPlan& plan, SurfaceProbeRef part, const CmmModel& cmm) {
  if (Diagnostics faults = check(plan); has_error(faults)) return faults;
  const CmmErrors errors(cmm);
  Pose workpiece_from_datum;
  auto datum_features = probed_datum_features(plan, workpiece_from_datum, part, errors);
  // A part that lies askew is aligned first and measured then, as on a real machine: three rounds
  // bring an error of 1 deg below rounding.
  for (int round = 0; datum_features && round < 3; ++round) {
    const auto found = alignment_of(plan, *datum_features);
    if (!found) return found.error();
    const bool askew = lies_askew(workpiece_from_datum.inverse() * *found);
    workpiece_from_datum = *found;
    if (!askew) break;
    datum_features = probed_datum_features(plan, workpiece_from_datum, part, errors);
  }
  if (!datum_features) return std::move(datum_features).error();
  std::vector<FittedFeature> features;
  auto next_datum = datum_features->begin();
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    if (is_datum_feature(plan, plan.features[i])) {
      features.push_back(std::move(*next_datum++));
      continue;
    }
    auto feature = probed(plan, i, workpiece_from_datum, part, errors);
    if (!feature) return std::move(feature).error();
    features.push_back(std::move(*feature));
  }
  return evaluated(plan, std::move(features), cmm);
}

Result<Measurement> evaluate(const InspectionPlan& plan, std::span<const FeaturePoints> features,
                             PointMeaning meaning, const CmmModel& cmm) {
  if (Diagnostics faults = check(plan); has_error(faults)) return faults;
  const double ball_radius =
      meaning == PointMeaning::ball_centre ? 0.5 * plan.probe.ball_diameter : 0.0;
  std::vector<FittedFeature> fitted;
  for (const FeaturePoints& points : features) {
    const bool nameless = points.feature.empty() && plan.features.size() == 1;
    const PlannedFeature* feature =
        nameless ? &plan.features.front() : find_feature(plan, points.feature);
    if (feature == nullptr) {
      return points.feature.empty()
                 ? error("the points name no feature, and the plan has several",
                         "begin the file with the header feature,section,x,y,z")
                 : error(fmt::format("the plan has no feature '{}'", points.feature),
                         suggestion(points.feature, names_of(plan)));
    }
    std::vector<std::size_t> sections = points.sections;
    if (sections.size() != points.points.size()) {
      sections.clear();
      for (const Vec3& p : points.points) sections.push_back(nearest_section(*feature, p));
    }
    auto fit = fit_feature(*feature, points.points, sections, ball_radius);
    if (!fit) return std::move(fit).error();
    fitted.push_back(std::move(*fit));
  }
  auto measurement = evaluated(plan, std::move(fitted), cmm);
  if (!measurement) return measurement;
  for (const PlannedFeature& feature : plan.features) {
    const auto& found = measurement->features;
    if (std::none_of(found.begin(), found.end(),
                     [&](const MeasuredFeature& f) { return f.name == feature.name; })) {
      measurement->diagnostics.push_back(
          warning(fmt::format("feature '{}' of the plan has no points", feature.name)));
    }
  }
  return measurement;
}

}  // namespace frustum::metrology
