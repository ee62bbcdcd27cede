#include "programs/step/step_plan.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::programs {
namespace {

using metrology::CharacteristicKind;
using metrology::FeatureKind;
using metrology::GridStrategy;
using metrology::InspectionPlan;
using metrology::LineStrategy;
using metrology::PlannedFeature;

constexpr double kStep = 5.0;          // mm between points
constexpr double kEdge = 0.2;          // mm: points stay this far inside the line's ends
constexpr double kBallDiameter = 0.8;  // goes between the rows of a ledge and its wall
constexpr double kApproach = 1.0;      // mm: clear of every other step, which are 5 mm away

// Half the number of steps on a line of that length.
int steps_beside_middle(double length) {
  return static_cast<int>(std::floor((0.5 * length - kEdge) / kStep));
}

class StepPlan {
 public:
  StepPlan(const StepTest& test, std::span<const std::string> patterns)
      : test_(test), piece_(test.workpiece) {
    plan_.title = "Step patterns";
    for (const std::string& name : patterns) plan_.title += " " + name;
    plan_.alignment = metrology::Alignment::plan;
    plan_.probe = {kBallDiameter, kApproach, kApproach};
    for (const StepPattern* pattern : reference_patterns(patterns)) {
      add_reference(*pattern, std::string(pattern->reference()));
    }
    for (const std::string& name : patterns) add_pattern(*find_step_pattern(name));
  }

  [[nodiscard]] InspectionPlan plan() && { return std::move(plan_); }

 private:
  [[nodiscard]] Vec3 at(const Vec3& across, double lateral, double height) const {
    return piece_.centre() + lateral * across + height * Vec3::UnitZ();
  }

  void add_line(const std::string& name, const Vec3& point, const Vec3& along, const Vec3& normal,
                double length) {
    const int half = steps_beside_middle(length);
    plan_.features.push_back({.name = name,
                              .kind = FeatureKind::line,
                              .point = point,
                              .axis = along,
                              .normal = normal,
                              .strategy = LineStrategy{-kStep * half, kStep * half, 2 * half + 1}});
  }

  // A line as long as any that uses it, so that the plan of one pattern is part of that of all.
  [[nodiscard]] double reference_length(const StepPattern& pattern) const {
    double length = 0.0;
    for (const StepSize& size : piece_.sizes) {
      const StepPattern* other = find_step_pattern(size.pattern);
      if (other->reference() == pattern.reference()) length = std::max(length, size.length);
    }
    return length;
  }

  void add_reference(const StepPattern& pattern, const std::string& name) {
    const StepSize& size = *piece_.size(pattern.name);
    const Vec3& across = pattern.across_reference;
    const Vec3 along = std::abs(across.y()) > 0.5 ? Vec3::UnitX() : Vec3::UnitY();
    const double length = reference_length(pattern);
    const int half = steps_beside_middle(length);
    const double side_height = size.reference_height + 0.5 * piece_.step_height;
    const double l = piece_.step_width;
    for (const StepName step : {StepName::a, StepName::b}) {
      const double sign = step == StepName::a ? -1.0 : 1.0;
      const Vec3 outward = sign * across;
      add_line(name + ".S_" + to_char(step), at(outward, 0.5 * size.reference_width, side_height),
               along, outward, length);
      // Two rows at +-l / sqrt(6) from the middle of the ledge weigh its slope exactly as three
      // rows at 0, l/2 and l do, and keep a ball off the wall.
      plan_.features.push_back(
          {.name = name + ".B_" + to_char(step),
           .kind = FeatureKind::plane,
           .point = at(outward, 0.5 * (size.reference_width + l), size.reference_height),
           .axis = Vec3::UnitZ(),
           .strategy = GridStrategy{2.0 * kStep * half * along, 2.0 * l / std::sqrt(6.0) * outward,
                                    2 * half + 1, 2}});
    }
    plan_.frames.push_back({name, {name + ".B_a", name + ".B_b"}, name + ".S_a"});
  }

  void add_characteristic(const StepPattern& pattern, const char* what, CharacteristicKind kind,
                          const std::string& of, const char* first, const char* second,
                          const Vec3& direction) {
    const bool angle = kind == CharacteristicKind::line_angle;
    plan_.characteristics.push_back(
        {.name = std::string(pattern.name) + "." + what,
         .kind = kind,
         .features = {of + "." + first, of + "." + second},
         .tolerance = angle ? test_.angle_tolerance.value : test_.tolerance.value,
         .frame = std::string(pattern.reference()),
         .direction = direction});
  }

  void add_pattern(const StepPattern& pattern) {
    const StepSize& size = *piece_.size(pattern.name);
    const std::string name(pattern.name);
    const bool step_kind = pattern.kind == StepKind::step;
    const double side_height = size.height + (step_kind ? 0.5 * piece_.step_height : 0.0);
    for (const StepName step : {StepName::c, StepName::d}) {
      const Vec3 outward = step == StepName::c ? Vec3(-pattern.across) : pattern.across;
      const Vec3 normal = pattern.kind == StepKind::chamfer
                              ? Vec3((outward + Vec3::UnitZ()).normalized())
                              : outward;
      add_line(name + ".S_" + to_char(step), at(outward, 0.5 * size.width, side_height),
               pattern.along, normal, size.length);
    }
    if (step_kind) {
      for (const StepName step : {StepName::c, StepName::d}) {
        const Vec3 outward = step == StepName::c ? Vec3(-pattern.across) : pattern.across;
        add_line(name + ".B_" + to_char(step),
                 at(outward, 0.5 * (size.width + piece_.step_width), size.height), pattern.along,
                 Vec3::UnitZ(), size.length);
      }
    }
    using enum CharacteristicKind;
    const Vec3 up = Vec3::UnitZ();
    add_characteristic(pattern, "dL", line_distance, name, "S_c", "S_d", pattern.across);
    if (step_kind) add_characteristic(pattern, "dH", line_distance, name, "B_c", "B_d", up);
    add_characteristic(pattern, "theta", line_angle, name, "S_c", "S_d", up);
    if (step_kind) {
      // Right-handed about this, a line along Xw rises.
      add_characteristic(pattern, "phi", line_angle, name, "B_c", "B_d", -up.cross(pattern.along));
    }
    add_characteristic(pattern, "dL0", line_distance, std::string(pattern.reference()), "S_a",
                       "S_b", pattern.across_reference);
  }

  const StepTest& test_;
  const StepWorkpiece& piece_;
  InspectionPlan plan_;
};

}  // namespace

InspectionPlan step_plan(const StepTest& test, std::span<const std::string> patterns) {
  return StepPlan(test, patterns).plan();
}

}  // namespace frustum::programs
