#include "parser/interpret/frames/machine_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/decimal.hpp"
#include "core/units.hpp"
#include "parser/interpret/frames/data_input.hpp"
#include "parser/interpret/frames/programmable_frame.hpp"
#include "parser/interpret/state/word_values.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

// What would move the tool. Longer names before those that they begin with.
struct MovingVariable {
  std::string_view start;
  std::string_view remedy;
};
constexpr std::array kMovingVariables{
    MovingVariable{"$TC_DP3[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP4[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP5[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP12[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP13[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP14[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP6[", "set the radius of the first edge, as in $TC_DP6[1,1]=5"},
    MovingVariable{"$TC_DP15[", "give the tool's diameter in the job, wear and all"},
    MovingVariable{"$TC_DP21[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP22[", "give the tool's length in the job"},
    MovingVariable{"$TC_DP23[", "give the tool's length in the job"},
    MovingVariable{"$TC_CARR", "swivel with CYCLE800"},
    MovingVariable{"$AA_OFF[", "write the overlaid motion into the moves"},
    MovingVariable{"$P_UIFR[", "write it as $P_UIFR[1,X,TR]=10"},
    MovingVariable{"$P_PFRAME", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_IFRAME", "use G54 to G57"},
    MovingVariable{"$P_BFRAME", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_UBFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_CHBFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_NCBFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_CYCFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_SETFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_EXTFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_WPFR", "use TRANS, ROT, SCALE and MIRROR"},
    MovingVariable{"$P_TOOLFR", "use CYCLE800"},
    MovingVariable{"$P_PARTFR", "use CYCLE800"},
    MovingVariable{"$P_TRAFR", "use TRANS, ROT, SCALE and MIRROR"},
};

// The indices of $NAME[1,X,TR].
std::vector<std::string_view> indices_in(std::string_view name) {
  std::vector<std::string_view> indices;
  const std::size_t open = name.find('[');
  if (open == std::string_view::npos) return indices;
  std::string_view rest = name.substr(open + 1, name.size() - open - 2);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    indices.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return indices;
}

std::optional<int> number_of(std::string_view digits) {
  int number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size()) return std::nullopt;
  return number;
}

// $TC_DP6[tool,edge]: the radius of its first edge.
bool set_radius_variable(InterpreterState& state, std::uint32_t column, std::string_view name,
                         double value) {
  const auto indices = indices_in(name);
  if (!name.starts_with("$TC_DP6[") || indices.size() != 2 || indices[1] != "1") return false;
  const auto number = number_of(indices[0]);
  if (!number) return false;
  set_tool_radius(state, column, "$TC_DP6", *number, length_of(state, value));
  return true;
}

// $P_UIFR[1,X,TR]: the shift of a work offset.
std::optional<Outcome> set_offset_shift(InterpreterState& state, std::string_view name,
                                        double value) {
  const auto indices = indices_in(name);
  if (!name.starts_with("$P_UIFR[") || indices.size() != 3 || indices[2] != "TR") {
    return std::nullopt;
  }
  const auto number = number_of(indices[0]);
  const std::size_t axis =
      indices[1].size() == 1 ? std::string_view("XYZABC").find(indices[1]) : std::string_view::npos;
  if (!number || *number < 0 || *number > 99 || axis == std::string_view::npos) return std::nullopt;
  WorkOffset offset = state.data.work_offset(*number);
  const AxisLetter letter = kAxisLetters.at(axis);
  offset.origin[letter] = scaled(state, letter, value);
  state.data.work_offsets[*number] = offset;
  return Done{};
}

// The product of the parts; an axis that is named twice counts as it is written last.
Result<ProgramFrame> frame_of_parts(const InterpreterState& state, std::uint32_t column,
                                    const std::vector<MachineFrame>& parts) {
  ProgramFrame frame;
  for (const MachineFrame& part : parts) {
    Vec3 numbers = Vec3::Zero();
    std::array<double, 3> rotary{};
    std::array<bool, 3> named{};
    for (std::size_t i = 0; i < part.axes.size(); ++i) {
      const std::size_t axis = std::string_view("XYZABC").find(part.axes[i]);
      const double value = i < part.values.size() ? part.values[i] : 0.0;
      if (axis > 5 || is_symbol(value)) {
        return fail(state, column, "not-simulated"_id,
                    fmt::format("{} of {} is not simulated", part.name, part.axes[i]),
                    "give numbers for X Y Z A B C");
      }
      if (axis < 3) {
        numbers[static_cast<Eigen::Index>(axis)] = value;
        named.at(axis) = true;
      } else {
        rotary.at(axis - 3) = value * kRadPerDeg;
      }
    }
    if (part.name == "CTRANS" || part.name == "CFINE") {
      frame = frame.with(ProgramFrame::shift(numbers * unit_scale(state), rotary));
    } else if (part.name == "CROT") {
      frame = frame.with(ProgramFrame::turn(numbers * kRadPerDeg));
    } else if (part.name == "CMIRROR") {
      frame = frame.with(ProgramFrame::mirror(named));
    } else {
      return fail(state, column, "not-simulated"_id, part.name + " is not simulated",
                  "use CTRANS, CROT and CMIRROR");
    }
  }
  return frame;
}

}  // namespace

Outcome set_machine_frame(InterpreterState& state, std::uint32_t column, const std::string& name,
                          const std::vector<MachineFrame>& parts) {
  const auto frame = frame_of_parts(state, column, parts);
  if (!frame) return frame.error();
  if (name == "$P_PFRAME") {
    set_program_frame(state, *frame);
    return Done{};
  }
  const auto indices = indices_in(name);
  const auto number = indices.size() == 1 ? number_of(indices[0]) : std::nullopt;
  const double angle = std::atan2(frame->linear(1, 0), frame->linear(0, 0));
  const bool about_z = (frame->linear - rotation_z(angle)).norm() < 1e-12;
  const bool offset = name.starts_with("$P_UIFR[") && number && *number >= 1 && *number <= 99;
  if (!offset || !about_z) {
    return fail(state, column, "not-simulated"_id,
                fmt::format("{} is not simulated{}", name, offset ? " when it tilts" : ""),
                "use TRANS, ROT and MIRROR, or shift and turn G54 about Z");
  }
  WorkOffset& kept = state.data.work_offsets[*number];
  for (std::size_t i = 0; i < 3; ++i) {
    kept.origin[kAxisLetters.at(i)] = frame->origin[static_cast<Eigen::Index>(i)];
    kept.origin[kAxisLetters.at(3 + i)] = frame->rotary_shift.at(i);
  }
  kept.rotation = angle;
  emit(state, column, Event{name, fmt::format("turned by {:g}", angle * kDegPerRad)});
  return Done{};
}

Outcome set_machine_variable(InterpreterState& state, std::uint32_t column, const std::string& name,
                             double value) {
  if (is_unknown(value)) {
    for (const MovingVariable& moving : kMovingVariables) {
      if (!name.starts_with(moving.start)) continue;
      return fail(state, column, "unknown-value"_id,
                  fmt::format("{} depends on {}, which only the machine knows", name,
                              state.parameters.text_of(value)),
                  "give a number");
    }
    emit(state, column, Event{name, state.parameters.text_of(value)});
    return Done{};
  }
  state.parameters.set(name, value);
  emit(state, column,
       Event{name, is_text(value) ? state.parameters.text_of(value) : shortest_decimal(value)});
  if (is_text(value)) {
    const auto indices = indices_in(name);
    const auto number = indices.size() == 1 ? number_of(indices[0]) : std::nullopt;
    if (name.starts_with("$TC_TP2[") && number) {
      state.data.tool_names.insert_or_assign(upper_case(state.parameters.text_of(value)), *number);
    }
    return Done{};
  }
  if (set_radius_variable(state, column, name, value)) return Done{};
  if (auto done = set_offset_shift(state, name, value)) return *std::move(done);
  for (const MovingVariable& moving : kMovingVariables) {
    if (!name.starts_with(moving.start) || value == 0.0) continue;
    return fail(state, column, "not-simulated"_id, fmt::format("{} is not simulated", name),
                std::string(moving.remedy));
  }
  return Done{};
}

}  // namespace frustum::parser
