#include "kinematics/model/geometric_errors.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace frustum::kinematics {
namespace {

constexpr std::string_view kDirections = "XYZABC";

std::optional<std::size_t> direction_index(char letter) {
  const auto at = kDirections.find(letter);
  if (at == std::string_view::npos) return std::nullopt;
  return at;
}

}  // namespace

std::optional<ErrorName> ErrorName::parse(std::string_view text) {
  if (text.size() >= 3 && text.front() == 'E') text.remove_prefix(1);
  const bool location = text.size() == 3 && (text[1] == '0' || text[1] == 'O');
  if (!location && text.size() != 2) return std::nullopt;
  const auto axis = direction_index(text.back());
  const auto direction = direction_index(text.front());
  if (!axis || !direction) return std::nullopt;
  return ErrorName{static_cast<ErrorDirection>(*direction), static_cast<AxisLetter>(*axis),
                   location};
}

std::string ErrorName::text() const {
  return fmt::format("E{}{}{}", kDirections[static_cast<std::size_t>(direction)],
                     location ? "0" : "", to_char(axis));
}

std::string ErrorName::meaning() const {
  const char d = kDirections[static_cast<std::size_t>(direction)];
  if (location) {
    return is_rotation(direction) ? fmt::format("orientation of {} about {}", to_char(axis), d)
                                  : fmt::format("position of {} in {}", to_char(axis), d);
  }
  const std::string axis_text(1, to_char(axis));
  if (d == to_char(axis)) return "positioning of " + axis_text;
  if (!is_rotary(axis)) {
    return fmt::format("{} of {} {} {}",
                       is_rotation(direction) ? "angular error motion" : "straightness", axis_text,
                       is_rotation(direction) ? "about" : "in", d);
  }
  if (is_rotation(direction)) return fmt::format("tilt motion of {} about {}", axis_text, d);
  const bool axial = static_cast<std::size_t>(direction) + 3 == static_cast<std::size_t>(axis);
  return fmt::format("{} motion of {} in {}", axial ? "axial" : "radial", axis_text, d);
}

bool AxisErrors::depends_on_direction() const {
  return std::any_of(component.begin(), component.end(),
                     [](const ErrorFunction& f) { return f.depends_on_direction(); });
}

bool GeometricErrors::depends_on_direction() const {
  return std::any_of(axes_.begin(), axes_.end(),
                     [](const AxisErrors& axis) { return axis.depends_on_direction(); });
}

GeometricErrors GeometricErrors::plus(const GeometricErrors& others, double factor) const {
  GeometricErrors sum = *this;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    AxisErrors& axis = sum.axes_[i];
    const AxisErrors& other = others.axes_[i];
    for (std::size_t k = 0; k < axis.component.size(); ++k) {
      axis.component[k] = axis.component[k].plus(other.component[k], factor);
      axis.location[k] += factor * other.location[k];
    }
    axis.carried_tilt += factor * other.carried_tilt;
    axis.lost_motion = std::max(axis.lost_motion, other.lost_motion);
  }
  for (const WeightedGrid& grid : others.grids_) sum.add_grid(grid.grid, factor * grid.factor);
  return sum;
}

GridErrors GeometricErrors::grid_at(const AxisPositions& q) const {
  GridErrors sum;
  for (const WeightedGrid& weighted : grids_) {
    const GridErrors errors = weighted.grid->at(q);
    sum.shift += weighted.factor * errors.shift;
    sum.turn += weighted.factor * errors.turn;
  }
  return sum;
}

}  // namespace frustum::kinematics
