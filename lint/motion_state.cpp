#include "lint/motion_state.hpp"

#include <cmath>

namespace frustum::lint {
namespace {

using parser::AxisLetter;
using parser::AxisTarget;
using parser::kLinearAxes;

// Below any written digit.
constexpr double kStands = 1e-9;  // mm, rad

// Up along Z and nothing else: how a tool leaves a cut by feed.
bool goes_up(const AxisTarget& from, const AxisTarget& to) {
  const auto& z0 = from[AxisLetter::Z];
  const auto& z1 = to[AxisLetter::Z];
  return z0 && z1 && *z1 > *z0 && from[AxisLetter::X] == to[AxisLetter::X] &&
         from[AxisLetter::Y] == to[AxisLetter::Y];
}

}  // namespace

std::optional<AxisLetter> moving_axis(const AxisTarget& from, const AxisTarget& to, bool rotary) {
  for (const AxisLetter axis : parser::kAxisLetters) {
    if (is_rotary(axis) != rotary || !from[axis] || !to[axis]) continue;
    if (std::abs(*from[axis] - *to[axis]) > kStands) return axis;
  }
  return std::nullopt;
}
bool linear_axis_moves(const AxisTarget& from, const AxisTarget& to) {
  return moving_axis(from, to, false).has_value();
}
bool rotary_axis_moves(const AxisTarget& from, const AxisTarget& to) {
  return moving_axis(from, to, true).has_value();
}

void MotionState::follow(const parser::Motion& motion) {
  const parser::LengthCompensation before = modes.compensation.mode;
  modes.follow(motion.command);
  if (std::holds_alternative<parser::CompensationChange>(motion.command)) change_length(before);
  std::visit([this](const auto& command) { after(command); }, motion.command);
  if (!std::holds_alternative<parser::Event>(motion.command)) place = motion.place;
  if (std::holds_alternative<parser::LinearFeed>(motion.command) ||
      std::holds_alternative<parser::ArcFeed>(motion.command)) {
    last_cut = motion.place;
  }
}

void MotionState::forget_linear() {
  for (const AxisLetter axis : kLinearAxes) position[axis].reset();
}

void MotionState::place_at(const AxisTarget& end, parser::Coordinates coordinates) {
  for (const AxisLetter axis : parser::kAxisLetters) {
    if (!end[axis]) continue;  // it stays where it is
    position[axis] = coordinates == parser::Coordinates::program ? end[axis] : std::nullopt;
  }
}

void MotionState::after(const parser::Traverse& move) {
  const bool first = !position[AxisLetter::Z] || !position[AxisLetter::X];
  retracted = retracted || first || move.coordinates == parser::Coordinates::machine ||
              linear_axis_moves(position, move.end);
  place_at(move.end, move.coordinates);
}
void MotionState::after(const parser::HomeReturn& move) {
  retracted = true;
  for (const AxisLetter axis : parser::kAxisLetters) {
    if (move.axes.at(static_cast<std::size_t>(axis))) position[axis].reset();
  }
}
void MotionState::after(const parser::LinearFeed& move) {
  cuts = true;
  retracted = move.coordinates == parser::Coordinates::machine || goes_up(position, move.end);
  place_at(move.end, move.coordinates);
}
void MotionState::after(const parser::ArcFeed& move) {
  cuts = true;
  retracted = false;
  place_at(move.end, parser::Coordinates::program);
}
void MotionState::after(const parser::Probe& /*move*/) {
  // Where the probe has met the part nobody knows.
  position = {};
}
void MotionState::after(const parser::ToolChange& /*change*/) { ++compensation_changes; }
void MotionState::change_length(parser::LengthCompensation before) {
  ++compensation_changes;
  const bool tip = before == parser::LengthCompensation::tool_centre_point || modes.tip_control();
  // A length alone is along Z.
  if (tip || modes.plane) {
    forget_linear();
  } else {
    position[AxisLetter::Z].reset();
  }
}
void MotionState::after(const parser::SpindleChange& /*change*/) { ++spindle_changes; }
void MotionState::after(const parser::TiltedPlaneChange& /*change*/) { forget_linear(); }
void MotionState::after(const parser::WorkOffsetChange& /*change*/) { position = {}; }
void MotionState::after(const parser::AlignToPlane& /*align*/) { position = {}; }
void MotionState::after(const parser::Stop& stop) {
  ended = ended || stop.kind == parser::StopKind::program_end;
}
void MotionState::after(const parser::Event& event) {
  surface_speed = surface_speed || event.name == "surface_speed";
}

}  // namespace frustum::lint
