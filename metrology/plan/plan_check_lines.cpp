#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/spelling.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/plan/line_axes.hpp"
#include "metrology/plan/plan_check.hpp"

namespace frustum::metrology {
namespace {

// 1e-6 rad and mm: what a program computes is far nearer, what a drawing means to be parallel too;
// more would be a systematic error of a um in a metre.
constexpr double kParallel = 1e-6;

// Sine of the angle between two directions, which have lengths.
double sine(const Vec3& a, const Vec3& b) { return unit(a).vec().cross(unit(b).vec()).norm(); }

double degrees_of_sine(double sine) { return std::asin(std::min(1.0, sine)) * kDegPerRad; }

bool has_directions(const PlannedFeature& line) {
  return UnitVec3::of(line.axis) && UnitVec3::of(line.normal.cross(line.axis));
}

// Component of the surface's normal, taken across the line, along `across`.
double facing(const PlannedFeature& line, const Vec3& across) {
  const Vec3 along = unit(line.axis);
  return std::abs(unit(line.normal - line.normal.dot(along) * along).vec().dot(across));
}

}  // namespace

void check_frame(const NamedPlan& named, std::size_t index, const PlanFault& fault) {
  const PlannedFrame& frame = named.plan.frames[index];
  const auto wrong = [&](std::string_view key, std::string message, std::string hint = {}) {
    fault(PlanPart::frame, index, key, std::move(message), std::move(hint));
  };
  if (frame.name.empty()) wrong("name", "must not be empty");
  if (named.frames.find(frame.name) != index) {
    wrong("name", fmt::format("'{}' names two frames", frame.name));
  }
  if (frame.planes.empty()) wrong("planes", "name one plane or more");
  std::vector<const PlannedFeature*> planes;
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const std::string& name = frame.planes[i];
    if (std::find(frame.planes.begin(), frame.planes.begin() + static_cast<std::ptrdiff_t>(i),
                  name) != frame.planes.begin() + static_cast<std::ptrdiff_t>(i)) {
      wrong("planes", fmt::format("'{}' is named twice", name));
    }
    const PlannedFeature* plane = suitable(named, name, {FeatureKind::plane}, "Z of a frame",
                                           [&](std::string message, std::string hint) {
                                             wrong("planes", std::move(message), std::move(hint));
                                           });
    if (plane != nullptr && UnitVec3::of(plane->axis)) planes.push_back(plane);
  }
  const PlannedFeature* line = suitable(named, frame.line, {FeatureKind::line}, "X of a frame",
                                        [&](std::string message, std::string hint) {
                                          wrong("line", std::move(message), std::move(hint));
                                        });
  if (planes.empty()) return;
  const UnitVec3 z = unit(planes.front()->axis);
  for (const PlannedFeature* plane : planes) {
    const double step = (plane->point - planes.front()->point).dot(z.vec());
    if (unit(plane->axis).vec().dot(z.vec()) < 0.0 || sine(plane->axis, z) > kParallel ||
        std::abs(step) > kParallel) {
      wrong("planes",
            fmt::format("'{}' and '{}' are not one plane: {:.6g} deg and {:.6g} mm apart",
                        planes.front()->name, plane->name,
                        angle_between(unit(plane->axis), z) * kDegPerRad, step),
            "one least-squares plane is laid through the points of all of them");
    }
  }
  if (line == nullptr || !has_directions(*line)) return;
  const double climb = std::abs(unit(line->axis).vec().dot(z.vec()));
  if (climb > kParallel) {
    wrong("line", fmt::format("'{}' must run along the planes, it climbs by {:.6g} deg", line->name,
                              degrees_of_sine(climb)));
  } else if (facing(*line, z.vec().cross(unit(line->axis).vec())) < kSlack) {
    wrong("line",
          fmt::format("the surface of '{}' faces along Z and gives no place across it", line->name),
          "choose a line on a side surface");
  }
}

void check_line_pair(const InspectionPlan& plan, std::size_t index, const PlannedFeature& first,
                     const PlannedFeature& second, const PlanFault& fault) {
  const PlannedCharacteristic& c = plan.characteristics[index];
  const auto wrong = [&](std::string_view key, std::string message, std::string hint = {}) {
    fault(PlanPart::characteristic, index, key, std::move(message), std::move(hint));
  };
  if (&first == &second) wrong("features", fmt::format("'{}' is named twice", first.name));
  if (!UnitVec3::of(c.direction)) {
    wrong("direction", "must be a direction, three finite numbers, not all zero");
    return;
  }
  if (!has_directions(first) || !has_directions(second)) return;
  const bool parallel = is_parallel(first.axis, second.axis);
  if (!parallel && c.kind == CharacteristicKind::line_distance) {
    wrong("features",
          fmt::format("'{}' and '{}' must be planned parallel, they are {:.6g} deg apart",
                      first.name, second.name, degrees_of_sine(sine(first.axis, second.axis))));
    return;
  }
  if (sine(first.axis, c.direction) < kSlack || sine(second.axis, c.direction) < kSlack) {
    wrong("direction", "is along the lines", "choose one across them");
    return;
  }
  const double askew = std::abs(unit(c.direction).vec().dot(unit(first.axis).vec()));
  if (c.kind == CharacteristicKind::line_distance && askew > kParallel) {
    wrong("direction", fmt::format("must be perpendicular to the lines, it is {:.6g} deg off",
                                   degrees_of_sine(askew)));
    return;
  }
  for (const PlannedFeature* line : {&first, &second}) {
    const auto axes = line_axes(c.kind, parallel ? first.axis : line->axis, c.direction);
    if (facing(*line, axes->across) >= kSlack) continue;
    wrong("direction",
          fmt::format("the surface of '{}' is along what is measured, [{:.3g}, {:.3g}, {:.3g}], "
                      "and says nothing of it",
                      line->name, axes->across.x(), axes->across.y(), axes->across.z()),
          "choose a line on a surface that faces that way, or another direction");
  }
}

}  // namespace frustum::metrology
