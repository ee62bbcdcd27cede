// What Klartext reads of the control: $ID270[1,3] for FN 18: SYSREAD ID270 NR1 IDX3, always in mm
// and degrees, and the preassigned parameters Q108 to Q114.
//
// Where an axis is that nothing has placed is the operator's, who moves it by hand, and what a
// datum or a tool adds is the setup's. Both are taken as zero, which an assumption says: an axis is
// then at zero, or where a move in machine coordinates has left it.
//
// Source: Heidenhain TNC 426/430 Technical Manual, FN 18 SYSREAD; TNC7 (81762x-17), System data;
//         TNC 620 (73498x-02), Preassigned Q parameters
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/units.hpp"
#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/state/system_parameters.hpp"

namespace frustum::parser {
namespace {

constexpr AssumedValue kOperatorsPlace{
    "place",
    "where an axis is that the operator moves: at zero, or where the "
    "program has left it, with nothing added by datum and tool"};

using Value = std::optional<double>;

constexpr double kToolAxisZ = 2.0;

double minus_if(bool on) { return on ? -1.0 : 0.0; }

// X Y Z A B C are 1 to 6.
Value of_axis(const SystemParameters& of, int index, bool of_machine) {
  if (index < 1 || index > static_cast<int>(kAxisLetters.size())) return std::nullopt;
  const AxisLetter axis = kAxisLetters.at(static_cast<std::size_t>(index - 1));
  const double unit = is_rotary(axis) ? kDegPerRad : 1.0;
  const AxisTarget axes = axis_positions(of.state, of.position);
  const AxisTarget& exact = of_machine ? axes : of.position.target();
  if (exact[axis]) return *exact[axis] * unit;
  if (of.state.tilted || !of.state.programmed_frame.is_identity()) return std::nullopt;
  Value place = of_machine ? of.position[axis] : axes[axis];
  if (!place && of.position.never_known(axis)) place = 0.0;
  if (place) of.assumed.push_back(&kOperatorsPlace);
  return place ? Value(*place * unit) : std::nullopt;
}

// 0 M3, 1 M4; which of them M5 came after is not kept.
Value spindle_state(const ModalState& modes) {
  if (modes.spindle == SpindleDirection::off) return std::nullopt;
  return modes.spindle == SpindleDirection::clockwise ? 0.0 : 1.0;
}

Value of_tool(const SystemParameters& of, int number, int tool) {
  const auto found = of.data.tools.find(tool);
  if (found == of.data.tools.end()) return std::nullopt;
  constexpr std::size_t kAlongZ = 2;
  if (number == 1 && found->second.has_length) return found->second.offset.at(kAlongZ);
  if (number == 2 && found->second.has_diameter) return found->second.diameter / 2.0;
  return std::nullopt;
}

Value system_data(const SystemParameters& of, int group, int number, int index) {
  const ModalState& modes = of.state;
  switch (group * 100 + number) {
    case 2001:
      return modes.tool;
    case 2003:
      return kToolAxisZ;
    case 2004:
      return modes.spindle_speed;
    case 2005:
      return spindle_state(modes);
    case 2008:
      return modes.flood ? 1.0 : 0.0;
    case 2009:
      return modes.feed ? Value(modes.feed->scaled) : std::nullopt;
    case 5001:
    case 5002:
      return of_tool(of, number, index > 0 ? index : modes.tool);
    case 21004:
      return modes.programmed_frame.scale;
    case 21006:
      return minus_if(modes.tilted);
    case 24001:
      return of_axis(of, index, true);
    case 27001:
      return of_axis(of, index, false);
    case 28001:
      return minus_if(modes.compensation.tip);
    default:
      return std::nullopt;
  }
}

}  // namespace

Value klartext_variable(const SystemParameters& of, std::string_view name) {
  if (name == "Q108") return of_tool(of, 2, of.state.tool);
  if (name == "Q109") return kToolAxisZ;
  if (name == "Q110") return spindle_state(of.state);
  if (name == "Q111") return of.state.flood ? 1.0 : 0.0;
  if (name == "Q113") return of.state.unit == LengthUnit::millimetre ? 0.0 : 1.0;
  if (name == "Q114") return of_tool(of, 1, of.state.tool);
  constexpr std::string_view kGroup = "$ID";
  if (!name.starts_with(kGroup)) return std::nullopt;
  std::array<int, 3> numbers{};
  const char* place = name.data() + kGroup.size();
  const char* const end = name.data() + name.size();
  for (int& number : numbers) {
    const auto read = std::from_chars(place, end, number);
    if (read.ec != std::errc{}) return std::nullopt;
    place = read.ptr + 1;
    if (read.ptr == end || *read.ptr == ']') break;
    if (*read.ptr == '.') return std::nullopt;
  }
  return system_data(of, numbers[0], numbers[1], numbers[2]);
}

}  // namespace frustum::parser
