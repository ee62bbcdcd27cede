#include "parser/interpret/state/system_parameters.hpp"

#include <algorithm>
#include <array>

#include "core/units.hpp"

namespace frustum::parser {
namespace {

using Value = std::optional<double>;

double in_program_unit(double millimetres, const SystemParameters& of) {
  of.read_by_unit(millimetres);
  return of.state.unit == LengthUnit::millimetre ? millimetres : millimetres / kMmPerInch;
}

Value position_of(const SystemParameters& of, AxisLetter axis) {
  const auto& value = of.position[axis];
  if (!value) return std::nullopt;
  return is_rotary(axis) ? *value * kDegPerRad : in_program_unit(*value, of);
}

double motion_word(MotionMode mode) {
  constexpr std::array kTenths{-1.0,  0.0,   10.0,  20.0,  30.0,  -1.0,  -1.0,  -1.0,  -1.0,
                               50.0,  51.0,  52.0,  53.0,  62.0,  330.0, 331.0, 331.0, 332.0,
                               760.0, 382.0, 383.0, 384.0, 385.0, 730.0, 740.0, 810.0, 820.0,
                               830.0, 840.0, 850.0, 860.0, 870.0, 880.0, 890.0, 760.0};
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
    Named{"_lathe_diameter_mode",
          [](const SystemParameters& of) -> Value { return yes(of.state.diameter); }},
    Named{"_lathe_radius_mode",
          [](const SystemParameters& of) -> Value { return yes(!of.state.diameter); }},
    Named{"_ccomp",
          [](const SystemParameters& of) -> Value {
            if (!of.state.tool_side) return 400.0;
            return *of.state.tool_side == ToolSide::left ? 410.0 : 420.0;
          }},
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
    // Until a subprogram has returned.
    Named{"_value", [](const SystemParameters& /*of*/) -> Value { return 0.0; }},
    Named{"_value_returned", [](const SystemParameters& /*of*/) -> Value { return 0.0; }},
    Named{"_call_level", [](const SystemParameters& of) -> Value { return of.call_level; }},
    Named{"_task", [](const SystemParameters& /*of*/) -> Value { return 0.0; }},
    Named{"_vmajor", [](const SystemParameters& /*of*/) -> Value { return 2.9; }},
    Named{"_vminor", [](const SystemParameters& /*of*/) -> Value { return 0.0; }},
};

// Other names that LinuxCNC keeps to itself, whose values are the machine's or a call's.
constexpr std::array<std::string_view, 26> kKeptNames{"_line",
                                                      "_retract_r_plane",
                                                      "_retract_old_z",
                                                      "_spindle_rpm_mode",
                                                      "_spindle_css_mode",
                                                      "_mist",
                                                      "_speed_override",
                                                      "_feed_override",
                                                      "_adaptive_feed",
                                                      "_feed_hold",
                                                      "_u",
                                                      "_v",
                                                      "_w",
                                                      "_current_pocket",
                                                      "_selected_pocket",
                                                      "_remap_level",
                                                      "_value",
                                                      "_value_returned",
                                                      "_abs_x",
                                                      "_abs_y",
                                                      "_abs_z",
                                                      "_abs_a",
                                                      "_abs_b",
                                                      "_abs_c",
                                                      "_abs_u",
                                                      "_abs_v"};

// G54 to G59; of others G54.1.
Value work_offset_of(const ModalState& state) {
  return state.work_offset <= 6 ? 53.0 + state.work_offset : 54.1;
}

constexpr int kMotionWord = 4001;
constexpr int kUnit = 4006;
constexpr int kTool = 4120;
// The group of G54 on Mitsubishi and Haas; on Fanuc that of G66, which #4014 goes before.
constexpr int kWorkOffsetElsewhere = 4012;

// #4001 to #4130: the word of each group that is in force.
struct ModalVariable {
  int index;
  Value (*value)(const ModalState& state);
};
constexpr std::array kModal{
    ModalVariable{4001,
                  [](const ModalState& state) -> Value {
                    const MotionMode mode = state.cycle ? state.before_cycle : state.motion;
                    if (mode == MotionMode::none) return 0.0;
                    const bool known =
                        mode >= MotionMode::traverse && mode <= MotionMode::arc_counterclockwise;
                    return known ? Value(motion_word(mode) / 10.0) : std::nullopt;
                  }},
    ModalVariable{
        4002,
        [](const ModalState& state) -> Value { return 17.0 + static_cast<double>(state.plane); }},
    ModalVariable{4003,
                  [](const ModalState& state) -> Value {
                    return state.distance == DistanceMode::absolute ? 90.0 : 91.0;
                  }},
    ModalVariable{4005,
                  [](const ModalState& state) -> Value {
                    constexpr std::array kModes{94.0, 93.0, 95.0};
                    return kModes.at(static_cast<std::size_t>(state.feed_mode));
                  }},
    ModalVariable{kUnit,
                  [](const ModalState& state) -> Value {
                    return state.unit == LengthUnit::millimetre ? 21.0 : 20.0;
                  }},
    ModalVariable{4007,
                  [](const ModalState& state) -> Value {
                    if (!state.tool_side) return 40.0;
                    return *state.tool_side == ToolSide::left ? 41.0 : 42.0;
                  }},
    ModalVariable{4008,
                  [](const ModalState& state) -> Value {
                    const Compensation& kept = state.compensation;
                    if (!kept.length || kept.negative) return kept.length ? 44.0 : 49.0;
                    return kept.tool_vectors ? 43.5 : kept.tip ? 43.4 : 43.0;
                  }},
    ModalVariable{4009,
                  [](const ModalState& state) -> Value {
                    return state.cycle ? motion_word(state.motion) / 10.0 : 80.0;
                  }},
    ModalVariable{
        4010,
        [](const ModalState& state) -> Value { return state.retract_to_initial ? 98.0 : 99.0; }},
    ModalVariable{4011,
                  [](const ModalState& state) -> Value {
                    return state.programmed_frame.scale == 1.0 ? 50.0 : 51.0;
                  }},
    ModalVariable{kWorkOffsetElsewhere, work_offset_of},
    ModalVariable{
        4013, [](const ModalState& state) -> Value { return state.surface_speed ? 96.0 : 97.0; }},
    ModalVariable{4014, work_offset_of},
    ModalVariable{4016,
                  [](const ModalState& state) -> Value {
                    return state.tilted || state.programmed_frame.turns() ? 68.0 : 69.0;
                  }},
    ModalVariable{4017, [](const ModalState& state) -> Value { return state.polar ? 16.0 : 15.0; }},
    ModalVariable{4022,
                  [](const ModalState& state) -> Value {
                    return state.programmed_frame.is_mirrored() ? 51.1 : 50.1;
                  }},
    ModalVariable{4107,
                  [](const ModalState& state) -> Value { return state.radius_number.value_or(0); }},
    ModalVariable{
        4109,
        [](const ModalState& state) -> Value { return state.feed ? state.feed->as_written : 0.0; }},
    ModalVariable{
        4111, [](const ModalState& state) -> Value { return state.compensation.offset_number; }},
    ModalVariable{4119, [](const ModalState& state) -> Value { return state.spindle_speed; }},
    ModalVariable{kTool,
                  [](const ModalState& state) -> Value { return state.selected_tool.value_or(0); }},
    ModalVariable{4130,
                  [](const ModalState& state) -> Value {
                    constexpr int kBeforeExtended = 100;
                    return state.work_offset > kBeforeExtended
                               ? Value(state.work_offset - kBeforeExtended)
                               : Value(0.0);
                  }},
};

Value modal_variable(const ModalState& state, int index) {
  const auto found =
      std::find_if(kModal.begin(), kModal.end(),
                   [index](const ModalVariable& entry) { return entry.index == index; });
  return found == kModal.end() ? std::nullopt : found->value(state);
}

// $P_EP[X]: where the last block ended; $AA_IW[X]: where the axis is, which is the same when the
// block runs.
Value sinumerik_variable(const SystemParameters& of, std::string_view name) {
  for (const std::string_view start : {"$P_EP[", "$AA_IW["}) {
    if (!name.starts_with(start)) continue;
    const auto axis = std::string_view("XYZABC").find(name[start.size()]);
    return position_of(of, kAxisLetters.at(axis));
  }
  // Neither a search for a block nor a test or another simulation is under way.
  constexpr std::array<std::string_view, 5> kOfTheRun{"$P_SEARCH", "$P_SEARCHL", "$P_ISTEST",
                                                      "$P_SIM", "$P_DRYRUN"};
  if (std::find(kOfTheRun.begin(), kOfTheRun.end(), name) != kOfTheRun.end()) return 0.0;
  if (name == "$P_TOOLNO") return of.state.tool;
  if (name == "$P_F") return of.state.feed ? of.state.feed->as_written : 0.0;
  if (name == "$P_S") return of.state.spindle_speed;
  if (name == "$P_TOOL") return of.state.compensation.length ? of.state.tool_edge : 0;
  if (name == "$P_TOOLR" || name == "$P_TOOLD") {
    const auto tool = of.data.tools.find(of.state.tool);
    if (tool == of.data.tools.end() || !tool->second.has_diameter) return std::nullopt;
    return in_program_unit(tool->second.diameter / (name == "$P_TOOLR" ? 2.0 : 1.0), of);
  }
  if (name == "$P_SDIR") {
    // 3 clockwise, 4 counterclockwise, 5 off: as the M words.
    constexpr std::array kWords{5.0, 3.0, 4.0};
    return kWords.at(static_cast<std::size_t>(of.state.spindle));
  }
  return std::nullopt;
}

constexpr int kLinuxcncPosition = 5420;
constexpr int kFanucPosition = 5001;
constexpr int kFanucPositionNow = 5041;  // with the length of the tool
constexpr int kAxesOfParameters = 6;
constexpr int kFirstSignal = 1000;  // inputs, one by one and all together
constexpr int kLastSignal = 1035;

constexpr AssumedValue kSignals{"signals", "the inputs that #1000 to #1035 read are off"};
constexpr AssumedValue kFirstMotion{"first motion", "G0 is in force before the first motion word"};
constexpr AssumedValue kNoTool{"#4120", "it is 0 before the first T"};
constexpr AssumedValue kGroupOfWorkOffset{
    "#4012", "the work offset in force, as Mitsubishi and Haas have it (Fanuc: #4014)"};

}  // namespace

const AssumedValue kStartUnit{"units", "lengths are in mm: no G20 or G21 comes before"};

void SystemParameters::read_by_unit(double value) const {
  const bool told = !assumed.empty() && assumed.back() == &kStartUnit;
  if (value != 0.0 && !state.unit_is_known && !told) assumed.push_back(&kStartUnit);
}

Value SystemParameters::number(int index) const {
  const int first = dialect == Dialect::fanuc ? kFanucPosition : kLinuxcncPosition;
  if (index >= first && index < first + kAxesOfParameters) {
    const Value known =
        position_of(*this, kAxisLetters.at(static_cast<std::size_t>(index - first)));
    return known || dialect != Dialect::linuxcnc ? known : kVacant;
  }
  if (dialect == Dialect::fanuc) {
    const int now = index - kFanucPositionNow;
    if (now >= 0 && now < kAxesOfParameters && !state.compensation.length) {
      return position_of(*this, kAxisLetters.at(static_cast<std::size_t>(now)));
    }
    if (const Value mode = modal_variable(state, index)) {
      if (index == kWorkOffsetElsewhere) assumed.push_back(&kGroupOfWorkOffset);
      const bool before = state.motion == MotionMode::none;
      if (index == kMotionWord && before) assumed.push_back(&kFirstMotion);
      if (index == kUnit && !state.unit_is_known) assumed.push_back(&kStartUnit);
      if (index == kTool && !state.selected_tool) assumed.push_back(&kNoTool);
      return mode;
    }
    if (index >= kFirstSignal && index <= kLastSignal) {
      assumed.push_back(&kSignals);
      return 0.0;
    }
  }
  const Value kept = read_parameter(data, dialect, index);
  const bool is_length = use_of(dialect, index) != ParameterUse::other;
  if (kept && !is_vacant(*kept) && is_length) read_by_unit(*kept);
  return kept;
}

Value SystemParameters::named(std::string_view name) const {
  if (dialect == Dialect::sinumerik) return sinumerik_variable(*this, name);
  if (dialect == Dialect::heidenhain) return klartext_variable(*this, name);
  if (dialect != Dialect::linuxcnc) return std::nullopt;
  const auto found = std::find_if(kNamed.begin(), kNamed.end(),
                                  [name](const Named& entry) { return entry.name == name; });
  if (found == kNamed.end()) return keeps(name) ? Value(kVacant) : std::nullopt;
  // Where the program does not know an axis the machine does.
  return found->value(*this).value_or(kVacant);
}

bool SystemParameters::keeps(std::string_view name) const {
  if (dialect != Dialect::linuxcnc || !name.starts_with('_')) return false;
  return std::any_of(kNamed.begin(), kNamed.end(),
                     [name](const Named& entry) { return entry.name == name; }) ||
         std::find(kKeptNames.begin(), kKeptNames.end(), name) != kKeptNames.end();
}

}  // namespace frustum::parser
