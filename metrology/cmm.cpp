#include "metrology/cmm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/name_index.hpp"
#include "core/spelling.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/evaluation.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/probing/ball_contact.hpp"
#include "metrology/probing/cmm_errors.hpp"
#include "metrology/probing/stylus_collision.hpp"

namespace frustum::metrology {
namespace {

std::string place_of(const PlannedFeature& feature, std::size_t index,
                     const PlannedPoint& planned) {
  return fmt::format("feature '{}', point {} at [{:.3f}, {:.3f}, {:.3f}]", feature.name, index + 1,
                     planned.point.x(), planned.point.y(), planned.point.z());
}

Diagnostic missed(const PlannedFeature& feature, std::size_t index, const PlannedPoint& planned,
                  const BallContact& contact, const ProbeSettings& probe) {
  const std::string place = place_of(feature, index, planned);
  if (contact.state == ContactState::starts_inside) {
    return error(
        "approach-in-material"_id,
        fmt::format("{}: the approach starts inside the material, {} mm off the nominal "
                    "surface",
                    place, probe.clearance),
        "check the nominal geometry, the setup, the tool and the cut, or enlarge probe.clearance");
  }
  return error(
      "plan-misses-part"_id,
      fmt::format("{}: the plan misses the part: no surface within {} mm past the nominal one{}",
                  place, probe.reach,
                  contact.surface_past
                      ? fmt::format(", it is {:.3f} mm past it", *contact.surface_past)
                      : ""),
      "check the nominal geometry, the setup and the blank or mesh, or enlarge probe.reach");
}

// One measurement of a part: its features, and what the stylus ran into.
class Probing {
 public:
  Probing(const InspectionPlan& plan, const SurfaceProbeRef& part, const CmmModel& cmm)
      : plan_(plan),
        part_(part),
        stylus_(cmm.stylus),
        errors_(cmm),
        ball_radius_(0.5 * plan.probe.ball_diameter),
        touches_(plan.features.size()),
        collisions_(plan.features.size()) {}

  Result<FittedFeature> feature(std::size_t index, const Pose& workpiece_from_datum) {
    const PlannedFeature& feature = plan_.features[index];
    std::vector<Vec3> centres;
    std::vector<Vec3> outward;
    std::vector<std::size_t> sections;
    std::vector<Touch> touches;
    StylusFaults faults;
    for (const PlannedPoint& planned : planned_points(feature)) {
      const BallApproach approach{workpiece_from_datum.point(planned.point),
                                  unit(workpiece_from_datum.direction(planned.normal)),
                                  ball_radius_, plan_.probe.clearance, plan_.probe.reach};
      const BallContact contact = touch_with_ball(part_, approach);
      if (contact.state != ContactState::contact) {
        return missed(feature, centres.size(), planned, contact, plan_.probe);
      }
      if (!errors_.reaches(contact.centre)) {
        return error("cmm-travel"_id,
                     fmt::format("{} is beyond the machine's travel",
                                 place_of(feature, centres.size(), planned)),
                     "enlarge the cmm's travel, or move its position");
      }
      if (stylus_) {
        faults.note(stylus_fault(part_, *stylus_, approach, contact.centre), centres.size());
      }
      centres.push_back(errors_.measured(
          {contact.centre, approach.outward, point_index(index, centres.size()), planned.scanned}));
      touches.push_back(contact.touch);
      outward.push_back(approach.outward);
      sections.push_back(planned.section);
    }
    touches_[index] = std::move(touches);
    collisions_[index] = faults.warning_for(feature.name, centres.size());
    return fitted(feature, std::move(centres), outward, sections);
  }

  // In the order of the plan; empty for a plan without datum system.
  Result<std::vector<FittedFeature>> datum_features(const Pose& workpiece_from_datum) {
    std::vector<FittedFeature> features;
    for (std::size_t i = 0; i < plan_.features.size(); ++i) {
      if (!is_datum_feature(plan_, plan_.features[i])) continue;
      auto found = feature(i, workpiece_from_datum);
      if (!found) return std::move(found).error();
      features.push_back(std::move(*found));
    }
    return features;
  }

  // Of each feature of the plan as it was probed last.
  [[nodiscard]] std::vector<std::vector<Touch>> touches() && { return std::move(touches_); }
  [[nodiscard]] Diagnostics collisions() const {
    Diagnostics all;
    for (const auto& collision : collisions_) {
      if (collision) all.push_back(*collision);
    }
    return all;
  }

 private:
  Result<FittedFeature> fitted(const PlannedFeature& feature, std::vector<Vec3> centres,
                               const std::vector<Vec3>& outward,
                               const std::vector<std::size_t>& sections) const {
    const double radius = errors_.ball_radius(ball_radius_);
    const bool by_approach = plan_.probe.compensation == Compensation::approach;
    if (by_approach) {
      for (std::size_t i = 0; i < centres.size(); ++i) centres[i] -= radius * outward[i];
    }
    auto fit = fit_feature(feature, centres, sections, by_approach ? 0.0 : radius);
    if (!fit) return fit;
    for (std::size_t i = 0; i < outward.size(); ++i) {
      const double apart = radius * (1.0 - outward[i].dot(fit->points[i].normal));
      fit->compensation_difference = std::max(fit->compensation_difference, apart);
    }
    return fit;
  }

  const InspectionPlan& plan_;
  const SurfaceProbeRef& part_;
  const std::optional<Stylus>& stylus_;
  CmmErrors errors_;
  double ball_radius_;
  std::vector<std::vector<Touch>> touches_;
  std::vector<std::optional<Diagnostic>> collisions_;
};

Diagnostic at(const FeaturePoints& points, Diagnostic d) {
  d.file = points.file;
  d.line = points.line;
  return d;
}

// A section that the plan's strategy does not have.
std::optional<Diagnostic> unknown_section(const PlannedFeature& feature,
                                          const FeaturePoints& points) {
  const std::size_t count = section_count(feature);
  for (std::size_t i = 0; i < points.sections.size(); ++i) {
    if (points.sections[i] < count) continue;
    Diagnostic d =
        error("unknown-section"_id,
              fmt::format("'{}' has {} section{} in the plan, there is no section {}", feature.name,
                          count, count == 1 ? "" : "s", points.sections[i]),
              "the first section is 0; without the column the nearest one is taken");
    d.file = points.file;
    d.line = i < points.lines.size() ? points.lines[i] : points.line;
    return d;
  }
  return std::nullopt;
}

// Points of a feature that the plan does not have.
Diagnostic unknown_feature(const InspectionPlan& plan, const FeaturePoints& points) {
  if (points.feature.empty()) {
    return at(points,
              error("unknown-feature"_id, "the points name no feature, and the plan has several",
                    "begin the file with the header feature,section,x,y,z"));
  }
  std::vector<std::string> names;
  for (const PlannedFeature& feature : plan.features) names.push_back(feature.name);
  const auto meant = nearest_word(points.feature, names);
  return at(points,
            error("unknown-feature"_id, fmt::format("the plan has no feature '{}'", points.feature),
                  fmt::format("{}the plan has {}",
                              meant ? "did you mean " + *meant + "? " : std::string(),
                              fmt::join(names, ", "))));
}

}  // namespace

// An oblique section of radius r is out of round by r t^2 / 2, which is 0.25 nm for 50 mm and 1e-4
// rad.
bool lies_askew(const Pose& planned_from_found) {
  return (planned_from_found.rotation - Mat3::Identity()).norm() > 1e-4 ||
         planned_from_found.translation.norm() > 0.01;
}

Result<Measurement> measure(const InspectionPlan& plan, SurfaceProbeRef part, const CmmModel& cmm,
                            NoErrors mean) {
  if (Diagnostics faults = check(plan); has_error(faults)) return faults;
  if (cmm.stylus && cmm.stylus->diameter >= plan.probe.ball_diameter) {
    return error("stylus-shank"_id,
                 fmt::format("a shank of {} mm behind a ball of {} mm touches before it",
                             cmm.stylus->diameter, plan.probe.ball_diameter),
                 "state a thinner cmm.stylus or a larger probe.ball_diameter");
  }
  Probing probing(plan, part, cmm);
  Pose workpiece_from_datum;
  auto datum_features = probing.datum_features(workpiece_from_datum);
  // A part that lies askew is aligned first and measured then, as on a real machine: three rounds
  // bring an error of 1 deg below rounding.
  for (int round = 0; datum_features && round < 3; ++round) {
    const auto found = alignment_of(plan, *datum_features);
    if (!found) return found.error();
    const bool askew = lies_askew(workpiece_from_datum.inverse() * *found);
    workpiece_from_datum = *found;
    if (!askew) break;
    datum_features = probing.datum_features(workpiece_from_datum);
  }
  if (!datum_features) return std::move(datum_features).error();
  std::vector<FittedFeature> features;
  auto next_datum = datum_features->begin();
  for (std::size_t i = 0; i < plan.features.size(); ++i) {
    if (is_datum_feature(plan, plan.features[i])) {
      features.push_back(std::move(*next_datum++));
      continue;
    }
    auto feature = probing.feature(i, workpiece_from_datum);
    if (!feature) return std::move(feature).error();
    features.push_back(std::move(*feature));
  }
  auto measurement = evaluated(plan, std::move(features), cmm, mean);
  if (measurement) {
    for (Diagnostic& d : probing.collisions()) measurement->diagnostics.push_back(std::move(d));
    auto touches = std::move(probing).touches();
    for (std::size_t i = 0; i < touches.size(); ++i) {
      measurement->features[i].touches = std::move(touches[i]);
    }
  }
  return measurement;
}

Result<Measurement> evaluate(const InspectionPlan& plan, std::span<const FeaturePoints> features,
                             PointMeaning meaning, const CmmModel& cmm) {
  if (Diagnostics faults = check(plan); has_error(faults)) return faults;
  const double ball_radius =
      meaning == PointMeaning::ball_centre ? 0.5 * plan.probe.ball_diameter : 0.0;
  std::vector<FittedFeature> fitted;
  const NameIndex places(plan.features, &PlannedFeature::name);
  for (const FeaturePoints& points : features) {
    const bool nameless = points.feature.empty() && plan.features.size() == 1;
    const auto place = nameless ? std::size_t{0} : places.find(points.feature);
    if (!place) return unknown_feature(plan, points);
    const PlannedFeature* const feature = &plan.features[*place];
    if (auto unknown = unknown_section(*feature, points)) return *std::move(unknown);
    std::vector<std::size_t> sections = points.sections;
    if (sections.size() != points.points.size()) {
      sections.clear();
      for (const Vec3& p : points.points) sections.push_back(nearest_section(*feature, p));
    }
    auto fit = fit_feature(*feature, points.points, sections, ball_radius);
    if (!fit) {
      Diagnostics faults = std::move(fit).error();
      for (Diagnostic& d : faults) d = at(points, std::move(d));
      return faults;
    }
    fitted.push_back(std::move(*fit));
  }
  auto measurement = evaluated(plan, std::move(fitted), cmm, NoErrors::unknown);
  if (!measurement) return measurement;
  const NameIndex found(measurement->features, &MeasuredFeature::name);
  for (const PlannedFeature& feature : plan.features) {
    if (!found.find(feature.name)) {
      measurement->diagnostics.push_back(
          warning("feature-without-points"_id,
                  fmt::format("feature '{}' of the plan has no points", feature.name)));
    }
  }
  return measurement;
}

}  // namespace frustum::metrology
