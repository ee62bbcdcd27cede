#include "kinematics/errors/error_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units.hpp"

namespace frustum::kinematics {
namespace {

struct SizeLimits {
  double large;  // a warning
  double too_large;
};
// mm, rad
SizeLimits limits_of(ErrorDirection direction) {
  return is_rotation(direction) ? SizeLimits{0.01, 0.1} : SizeLimits{1.0, 10.0};
}

std::string amount_text(double value, bool rotation) {
  return rotation ? fmt::format("{:.4g} mrad", 1e3 * value) : fmt::format("{:.4g} mm", value);
}

// The largest value of one error, and where; nothing counts as larger than what is no number.
struct Largest {
  double value = 0.0;
  std::optional<double> position{};

  void meet(double other, double at) {
    if (std::isnan(value)) return;
    if (std::abs(other) > std::abs(value) || std::isnan(other)) *this = {other, at};
  }
};

std::optional<Diagnostic> told(const ErrorName& name, const Largest& largest) {
  const bool rotation = is_rotation(name.direction);
  const SizeLimits limits = limits_of(name.direction);
  if (std::abs(largest.value) <= limits.large) return std::nullopt;
  const bool refused = !(std::abs(largest.value) <= limits.too_large);
  std::string where;
  if (largest.position) {
    where =
        is_rotary(name.axis)
            ? fmt::format(" at {} = {:.6g} deg", to_char(name.axis), *largest.position * kDegPerRad)
            : fmt::format(" at {} = {:.6g} mm", to_char(name.axis), *largest.position);
  }
  const std::string message =
      fmt::format("error {} is {}{}", name.text(), amount_text(largest.value, rotation), where);
  const std::string hint =
      fmt::format("{}; check amount, unit and span",
                  refused ? "errors are small motions: at most 10 mm or 0.1 rad"
                          : "more than 1 mm or 10 mrad is unusual");
  return refused ? error("error-size"_id, message, hint) : warning("error-size"_id, message, hint);
}

Largest largest_of(const ErrorFunction& function, AxisLetter axis,
                   std::span<const AxisPositions> places) {
  constexpr int kSteps = 1000;
  Largest largest;
  if (function.is_zero() || places.empty()) return largest;
  const auto meet = [&](const AxisPositions& q) {
    AxisPositions heading;
    for (const double direction : {-1.0, 1.0}) {
      heading[axis] = direction;
      largest.meet(function(axis, {q, heading}), q[axis]);
      if (!function.depends_on_direction()) return;
    }
  };
  AxisPositions low = places.front();
  AxisPositions high = places.front();
  for (const AxisPositions& q : places) {
    meet(q);
    if (q[axis] < low[axis]) low = q;
    if (q[axis] > high[axis]) high = q;
  }
  for (int i = 1; i < kSteps; ++i) {
    AxisPositions between = low;
    between[axis] += (high[axis] - low[axis]) * i / kSteps;
    meet(between);
  }
  return largest;
}

}  // namespace

Diagnostics oversize_errors(const Machine& machine, const GeometricErrors& errors,
                            std::span<const AxisPositions> places) {
  Diagnostics found;
  for (const AxisLetter axis : kAxisLetters) {
    if (machine.joint(axis) == nullptr) continue;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto direction = static_cast<ErrorDirection>(k);
      const ErrorFunction& component = errors[axis].component.at(k);
      if (auto large = told({direction, axis, false}, largest_of(component, axis, places))) {
        found.push_back(*std::move(large));
      }
      const double carried = is_rotation(direction)
                                 ? errors[axis].carried_tilt[static_cast<Eigen::Index>(k) - 3]
                                 : 0.0;
      Largest location;
      location.value = errors[axis].location.at(k) + carried;
      if (auto large = told({direction, axis, true}, location)) found.push_back(*std::move(large));
    }
  }
  return found;
}

}  // namespace frustum::kinematics
