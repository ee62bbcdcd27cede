#include "parser/interpret/state/control_data.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/units.hpp"
#include "parser/language/parameters.hpp"

namespace frustum::parser {
namespace {

enum class Kept : std::uint8_t {
  reference_point,
  shift_counts,
  shift,
  selected_offset,
  origin,
  rotation,
  tool_number,
  tool_offset,
  tool_diameter,
  tool_front_angle,
  tool_back_angle,
  tool_orientation,
  position,
  length,
  length_wear,
  radius,
  radius_wear
};
constexpr bool kReadOnly = true;

// Parameters first, first + step, ... for the things first_number, first_number + 1, ...; of each
// `width` parameters.
struct Row {
  int first;
  int count;  // of things
  int step;
  int width;
  Kept kept;
  int first_number;
  bool read_only = false;
};
constexpr int kAxisCount = static_cast<int>(kAxisLetters.size());
constexpr Row kLinuxcnc[] = {
    {5161, 2, 20, kAxisCount, Kept::reference_point, 0},
    {5210, 1, 1, 1, Kept::shift_counts, 0},
    {5211, 1, 1, kAxisCount, Kept::shift, 0},
    {5220, 1, 1, 1, Kept::selected_offset, 0},
    {5221, 9, 20, kAxisCount, Kept::origin, 1},
    {5230, 9, 20, 1, Kept::rotation, 1},
    {5400, 1, 1, 1, Kept::tool_number, 0, kReadOnly},
    {5401, 1, 1, kAxisCount, Kept::tool_offset, 0, kReadOnly},
    {5410, 1, 1, 1, Kept::tool_diameter, 0, kReadOnly},
    {5411, 1, 1, 1, Kept::tool_front_angle, 0, kReadOnly},
    {5412, 1, 1, 1, Kept::tool_back_angle, 0, kReadOnly},
    {5413, 1, 1, 1, Kept::tool_orientation, 0, kReadOnly},
    {5420, 1, 1, kAxisCount, Kept::position, 0, kReadOnly},
};
constexpr Row kFanuc[] = {
    {5001, 1, 1, kAxisCount, Kept::position, 0, kReadOnly},
    {5201, 1, 1, kAxisCount, Kept::origin, 0},
    {5221, 6, 20, kAxisCount, Kept::origin, 1},
    {7001, 48, 20, kAxisCount, Kept::origin, kExtendedWorkOffset + 1},
    {2001, 200, 1, 1, Kept::length, 1},
    {10001, 999, 1, 1, Kept::length, 1},
    {11001, 999, 1, 1, Kept::length_wear, 1},
    {12001, 999, 1, 1, Kept::radius, 1},
    {13001, 999, 1, 1, Kept::radius_wear, 1},
};

struct Slot {
  Kept kept;
  int number;        // of the thing
  std::size_t axis;  // or of what the thing has
  bool read_only;
};

std::optional<Slot> slot_of(Dialect dialect, int index) {
  std::span<const Row> rows;
  if (dialect == Dialect::linuxcnc) rows = kLinuxcnc;
  if (dialect == Dialect::fanuc) rows = kFanuc;
  for (const Row& row : rows) {
    const int offset = index - row.first;
    if (offset < 0) continue;
    // One thing may have more values than the step says.
    const bool alone = row.count == 1;
    const int thing = alone ? 0 : offset / row.step;
    const int part = alone ? offset : offset % row.step;
    if (thing >= row.count || part >= row.width) continue;
    return Slot{row.kept, row.first_number + thing, static_cast<std::size_t>(part), row.read_only};
  }
  return std::nullopt;
}

double length_scale(LengthUnit unit) { return unit == LengthUnit::millimetre ? 1.0 : kMmPerInch; }

double scale_of(const ControlData& data, const Slot& slot) {
  const bool angle = slot.axis < kAxisLetters.size() && is_rotary(kAxisLetters.at(slot.axis));
  return angle ? kRadPerDeg : length_scale(data.unit);
}

}  // namespace

WorkOffset ControlData::work_offset(int number) const {
  const auto found = work_offsets.find(number);
  return found == work_offsets.end() ? WorkOffset{} : found->second;
}

ParameterUse use_of(Dialect dialect, int index) {
  const auto slot = slot_of(dialect, index);
  if (!slot) return ParameterUse::other;
  switch (slot->kept) {
    case Kept::radius:
    case Kept::radius_wear:
      return ParameterUse::radius;
    case Kept::length:
    case Kept::length_wear:
    case Kept::tool_diameter:
      return ParameterUse::length;
    case Kept::reference_point:
    case Kept::shift:
    case Kept::origin:
    case Kept::tool_offset:
    case Kept::position:
      return is_rotary(kAxisLetters.at(slot->axis)) ? ParameterUse::other : ParameterUse::length;
    default:
      return ParameterUse::other;
  }
}

std::optional<double> read_parameter(const ControlData& data, Dialect dialect, int index) {
  const auto slot = slot_of(dialect, index);
  if (!slot) return std::nullopt;
  const auto letter = static_cast<AxisLetter>(slot->axis);
  const double scale = scale_of(data, *slot);
  const auto told = [scale](const std::optional<double>& value) {
    return value ? *value / scale : kVacant;
  };
  const auto find_tool = [&](int number) -> const Tool* {
    const auto found = data.tools.find(number);
    return found == data.tools.end() ? nullptr : &found->second;
  };
  // No tool at all has no offsets; one that is not listed has those of the setup.
  const Tool* in_spindle = find_tool(data.tool);
  const auto of_tool = [&](auto value) -> double {
    if (in_spindle != nullptr) return value(*in_spindle);
    return data.tool == 0 ? 0.0 : kVacant;
  };
  const Tool* numbered = find_tool(slot->number);
  switch (slot->kept) {
    case Kept::reference_point:
      return told(data.reference_points.at(static_cast<std::size_t>(slot->number))[letter]);
    case Kept::shift_counts:
      return data.shift_counts ? 1.0 : 0.0;
    case Kept::shift:
      return data.shift.at(slot->axis) / scale;
    case Kept::selected_offset:
      return data.selected_offset;
    case Kept::origin: {
      auto value = data.work_offset(slot->number).origin[letter];
      const bool external = slot->number == 0;
      if (!value && (external || is_rotary(letter))) value = 0.0;
      return told(value);
    }
    case Kept::rotation:
      return data.work_offset(slot->number).rotation * kDegPerRad;
    case Kept::tool_number:
      return data.tool;
    case Kept::tool_offset:
      return of_tool([&](const Tool& tool) { return tool.offset.at(slot->axis) / scale; });
    case Kept::tool_diameter:
      return of_tool(
          [&](const Tool& tool) { return tool.has_diameter ? tool.diameter / scale : kVacant; });
    case Kept::tool_front_angle:
      return of_tool([](const Tool& tool) { return tool.front_angle; });
    case Kept::tool_back_angle:
      return of_tool([](const Tool& tool) { return tool.back_angle; });
    case Kept::tool_orientation:
      return of_tool([](const Tool& tool) { return tool.orientation; });
    case Kept::position:
      return std::nullopt;  // not of this data
    case Kept::length:
      if (numbered == nullptr || !numbered->has_length) return kVacant;
      return numbered->offset.at(2) / scale;
    case Kept::length_wear:
      return numbered == nullptr ? 0.0 : numbered->length_wear / scale;
    case Kept::radius:
      if (numbered == nullptr || !numbered->has_diameter) return kVacant;
      return numbered->diameter / 2.0 / scale;
    case Kept::radius_wear:
      return numbered == nullptr ? 0.0 : numbered->diameter_wear / 2.0 / scale;
  }
  return std::nullopt;
}

ParameterWrite write_parameter(ControlData& data, Dialect dialect, int index, double value) {
  const auto slot = slot_of(dialect, index);
  if (!slot) return ParameterWrite::not_kept;
  if (slot->read_only) return ParameterWrite::read_only;
  const auto letter = static_cast<AxisLetter>(slot->axis);
  const double scaled = value * scale_of(data, *slot);
  const auto tool = [&]() -> Tool& { return entry_of(data.tools, slot->number); };
  switch (slot->kept) {
    case Kept::reference_point:
      data.reference_points.at(static_cast<std::size_t>(slot->number))[letter] = scaled;
      break;
    case Kept::shift_counts:
      data.shift_counts = value != 0.0;
      break;
    case Kept::shift:
      data.shift.at(slot->axis) = scaled;
      break;
    case Kept::selected_offset:
      data.selected_offset = static_cast<int>(std::lround(std::clamp(value, 1.0, 9.0)));
      break;
    case Kept::origin:
      data.work_offsets[slot->number].origin[letter] = scaled;
      break;
    case Kept::rotation:
      data.work_offsets[slot->number].rotation = value * kRadPerDeg;
      break;
    case Kept::length:
      tool().offset.at(2) = scaled;
      tool().has_length = true;
      break;
    case Kept::length_wear:
      tool().length_wear = scaled;
      break;
    case Kept::radius:
      tool().diameter = 2.0 * scaled;
      tool().has_diameter = true;
      break;
    case Kept::radius_wear:
      tool().diameter_wear = 2.0 * scaled;
      break;
    default:
      return ParameterWrite::read_only;
  }
  return ParameterWrite::done;
}

}  // namespace frustum::parser
