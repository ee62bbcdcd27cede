#include "parser/running/system_parameters.hpp"

#include <algorithm>
#include <array>

#include "core/units.hpp"

namespace frustum::parser {
namespace {

using Value = std::optional<double>;

double in_program_unit(double millimetres, const ModalState& state) {
  return state.unit == LengthUnit::millimetre ? millimetres : millimetres / kMmPerInch;
}

Value position_of(const SystemParameters& of, AxisLetter axis) {
  const auto& value = of.position[axis];
  if (!value) return std::nullopt;
  return is_rotary(axis) ? *value * kDegPerRad : in_program_unit(*value, of.state);
}

double motion_word(MotionMode mode) {
  constexpr std::array kTenths{-1.0,  0.0,   10.0,  20.0,  30.0,  730.0, 740.0, 810.0,
                               820.0, 830.0, 840.0, 850.0, 860.0, 870.0, 880.0, 890.0};
  return kTenths.at(static_cast<std::size_t>(mode));
}

double yes(bool condition) { return condition ? 1.0 : 0.0; }

// G54 to G59, then G59.1 to G59.3.
double work_offset_word(int number) {
  return number <= 6 ? 10.0 * (53 + number) : 590.0 + (number - 6);
}

struct Named {
  std::string_view name;
  Value (*value)(const SystemParameters& of);
};
constexpr std::array kNamed{
    Named{"_x", [](const SystemParameters& of) { return position_of(of, AxisLetter::X); }},
    Named{"_y", [](const SystemParameters& of) { return position_of(of, AxisLetter::Y); }},
    Named{"_z", [](const SystemParameters& of) { return position_of(of, AxisLetter::Z); }},
    Named{"_a", [](const SystemParameters& of) { return position_of(of, AxisLetter::A); }},
    Named{"_b", [](const SystemParameters& of) { return position_of(of, AxisLetter::B); }},
    Named{"_c", [](const SystemParameters& of) { return position_of(of, AxisLetter::C); }},
    Named{"_motion_mode",
          [](const SystemParameters& of) -> Value { return motion_word(of.state.motion); }},
    Named{"_plane",
          [](const SystemParameters& of) -> Value {
            constexpr std::array kPlanes{170.0, 180.0, 190.0};
            return kPlanes.at(static_cast<std::size_t>(of.state.plane));
          }},
    Named{"_metric",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.unit == LengthUnit::millimetre);
          }},
    Named{"_imperial",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.unit != LengthUnit::millimetre);
          }},
    Named{"_absolute",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.distance == DistanceMode::absolute);
          }},
    Named{"_incremental",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.distance == DistanceMode::incremental);
          }},
    Named{"_ijk_absolute_mode",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.arc_distance == DistanceMode::absolute);
          }},
    Named{"_inverse_time",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.feed_mode == FeedMode::inverse_time);
          }},
    Named{"_units_per_minute",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.feed_mode == FeedMode::per_minute);
          }},
    Named{"_units_per_rev",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.feed_mode == FeedMode::per_revolution);
          }},
    Named{
        "_coord_system",
        [](const SystemParameters& of) -> Value { return work_offset_word(of.state.work_offset); }},
    Named{"_tool_offset",
          [](const SystemParameters& of) -> Value { return yes(of.state.compensation.length); }},
    Named{"_ccomp", [](const SystemParameters& /*of*/) -> Value { return 400.0; }},
    Named{"_spindle_on",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.spindle != SpindleDirection::off);
          }},
    Named{"_spindle_cw",
          [](const SystemParameters& of) -> Value {
            return yes(of.state.spindle == SpindleDirection::clockwise);
          }},
    Named{"_flood", [](const SystemParameters& of) -> Value { return yes(of.state.flood); }},
    Named{"_rpm", [](const SystemParameters& of) -> Value { return of.state.spindle_speed; }},
    Named{"_feed",
          [](const SystemParameters& of) -> Value {
            return of.state.feed ? of.state.feed->as_written : 0.0;
          }},
    Named{"_current_tool", [](const SystemParameters& of) -> Value { return of.state.tool; }},
    Named{"_selected_tool",
          [](const SystemParameters& of) -> Value { return of.state.selected_tool.value_or(0); }},
    Named{"_call_level", [](const SystemParameters& of) -> Value { return of.call_level; }},
    Named{"_task", [](const SystemParameters& /*of*/) -> Value { return 0.0; }},
    Named{"_vmajor", [](const SystemParameters& /*of*/) -> Value { return 2.9; }},
    Named{"_vminor", [](const SystemParameters& /*of*/) -> Value { return 0.0; }},
};

constexpr int kLinuxcncPosition = 5420;
constexpr int kFanucPosition = 5001;
constexpr int kWorkOffset = 5220;
constexpr int kTool = 5400;
constexpr int kAxes = 6;

}  // namespace

Value SystemParameters::number(int index) const {
  const int first = dialect == Dialect::fanuc ? kFanucPosition : kLinuxcncPosition;
  if (index >= first && index < first + kAxes) {
    return position_of(*this, kAxisLetters.at(static_cast<std::size_t>(index - first)));
  }
  if (dialect != Dialect::linuxcnc) return std::nullopt;
  if (index == kWorkOffset) return state.work_offset;
  if (index == kTool) return state.tool;
  return std::nullopt;
}

Value SystemParameters::named(std::string_view name) const {
  if (dialect != Dialect::linuxcnc) return std::nullopt;
  const auto found = std::find_if(kNamed.begin(), kNamed.end(),
                                  [name](const Named& entry) { return entry.name == name; });
  return found == kNamed.end() ? std::nullopt : found->value(*this);
}

}  // namespace frustum::parser
