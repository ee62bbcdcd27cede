#include "parser/interpret/parameter_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/decimal.hpp"
#include "parser/interpret/frames/data_input.hpp"
#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/frames/machine_variables.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {
namespace {

// What a setting of a system variable does.
enum class VariableUse : std::uint8_t { alarm, message, event, clock };

struct SystemVariable {
  int first;
  int last;
  VariableUse use;
};

constexpr std::array kVariables{
    SystemVariable{1000, 1135, VariableUse::event},  // signals to the machine
    SystemVariable{3000, 3000, VariableUse::alarm},
    SystemVariable{3001, 3002, VariableUse::event},  // timers
    SystemVariable{3003, 3005, VariableUse::event},  // single block, feed hold, settings
    SystemVariable{3006, 3006, VariableUse::message},
    SystemVariable{3007, 3007, VariableUse::clock},
    SystemVariable{3011, 3012, VariableUse::clock},
    SystemVariable{3901, 3902, VariableUse::event},  // parts made and to make
};

// Whether the variable is the control's: what it does is done, and nothing is stored.
Result<bool> set_system_variable(InterpreterState& state, std::uint32_t column, int index,
                                 double value) {
  if (!state.rules.parameters.is_system(index)) return false;
  const auto known =
      std::find_if(kVariables.begin(), kVariables.end(), [index](const SystemVariable& variable) {
        return index >= variable.first && index <= variable.last;
      });
  if (known == kVariables.end()) {
    return fail(state, column, "not-simulated"_id,
                fmt::format("system variable #{} is not simulated", index),
                "leave the setting out of the simulated program");
  }
  const std::string text = state.at_work.block->comments.empty()
                               ? std::string{}
                               : state.at_work.block->comments.front().text;
  const std::string number = is_vacant(value)   ? "0"
                             : is_symbol(value) ? state.parameters.text_of(value)
                                                : shortest_decimal(value);
  switch (known->use) {
    case VariableUse::alarm:
      return fail(
          state, column, "program-alarm"_id,
          fmt::format("the program raises alarm {}{}{}", number, text.empty() ? "" : ": ", text),
          "it stops itself here; see what it checks before");
    case VariableUse::clock:
      return fail(
          state, column, "not-simulated"_id,
          fmt::format("system variable #{} is not simulated", index),
          "the clocks and the panel are the machine's: leave them out of the simulated program");
    case VariableUse::message:
      emit(state, column, Event{"message", text});
      emit(state, column, Stop{StopKind::program_stop});
      return true;
    case VariableUse::event:
      emit(state, column, Event{fmt::format("#{}", index), number});
      return true;
  }
  return true;
}

Outcome set_numbered(InterpreterState& state, std::uint32_t column, int index, double value) {
  const bool unknown =
      is_unknown(value) || (is_vacant(value) && state.parameters.rules().values_may_be_unknown);
  if (unknown && read_parameter(state.data, state.rules.dialect, index)) {
    return fail(state, column, "unknown-parameter"_id,
                fmt::format("#{} is set to a value that only the machine knows", index),
                "set it to a value of the program");
  }
  const LengthInForce in_force = length_in_force(state);
  const auto written = is_vacant(value) || is_unknown(value)
                           ? ParameterWrite::not_kept
                           : write_parameter(state.data, state.rules.dialect, index, value);
  if (written == ParameterWrite::read_only) {
    return fail(state, column, "parameter-read-only"_id,
                fmt::format("parameter #{} can only be read", index),
                "it is the tool or the position; use another parameter");
  }
  if (written == ParameterWrite::done) {
    const ParameterUse use = use_of(state.rules.dialect, index);
    if (use != ParameterUse::other) state.system.read_by_unit(value);
    if (use == ParameterUse::radius && value != 0.0) assume_radius(state, column);
    assume_length_waits(state, column, in_force);
    return state.rules.parameters_count_at_once ? replace_datum(state, column) : Outcome{Done{}};
  }
  const auto kept = set_system_variable(state, column, index, value);
  if (!kept) return kept.error();
  if (!*kept) state.parameters.set(index, value);
  return Done{};
}

// Where a setting puts its value.
struct SettingTarget {
  int index = 0;            // of a numbered parameter
  std::string name{};       // of a named one, or an array
  bool element = false;     // from `place` on
  bool of_machine = false;  // a variable that the program does not define
  std::size_t place = 0;
  std::vector<double> values{};
  std::vector<MachineFrame> frame{};
};

Result<std::vector<double>> computed(const InterpreterState& state,
                                     const ExpressionContext& context,
                                     std::span<const ExpressionRange> ranges) {
  std::vector<double> values;
  for (const ExpressionRange& range : ranges) {
    const auto value = evaluate(context, range);
    if (!value) return in_this_block(state, value.error().front());
    values.push_back(*value);
  }
  return values;
}

// DEF REAL A[3,4]
Outcome define_array(InterpreterState& state, const Assignment& setting,
                     const SettingTarget& target, std::span<const double> sizes) {
  constexpr double kMostElements = 100'000.0;
  std::vector<std::size_t> dimensions;
  double count = 1.0;
  for (const double size : sizes) {
    if (is_unknown(size)) {
      return fail(state, setting.column, "unknown-value"_id,
                  fmt::format("the size of {} depends on {}, which only the machine knows",
                              target.name, state.parameters.text_of(size)),
                  "give a number");
    }
    count *= std::round(size);
    if (!(count >= 1.0 && count <= kMostElements)) {
      return fail(state, setting.column, "array-size"_id,
                  fmt::format("{} has {} elements", target.name, shortest_decimal(count)),
                  "an array has 1 to 100000 of them");
    }
    dimensions.push_back(static_cast<std::size_t>(std::round(size)));
  }
  const bool text = *setting.defines == VariableKind::text;
  state.parameters.define_array(target.name, *setting.defines, std::move(dimensions),
                                text ? state.parameters.text_value("") : 0.0);
  return Done{};
}

Outcome set_elements(InterpreterState& state, const Assignment& setting,
                     const SettingTarget& target) {
  const std::size_t size = state.parameters.size_of(target.name);
  std::size_t place = target.place;
  for (std::size_t i = 0; i < target.values.size() || (setting.fills && place < size); ++i) {
    const double value = target.values[std::min(i, target.values.size() - 1)];
    if (state.parameters.set_element(target.name, place++, value)) continue;
    return fail(state, setting.column, "array-index"_id,
                fmt::format("{} has {} elements", target.name, size),
                "give no more values than there are elements");
  }
  return Done{};
}

Result<SettingTarget> target_of(const InterpreterState& state, const ExpressionContext& context,
                                const Assignment& setting) {
  const Block& block = *state.at_work.block;
  SettingTarget target;
  if (!setting.name) {
    const auto number = evaluate(context, setting.index);
    if (!number) return in_this_block(state, number.error().front());
    const auto checked = Parameters::index_of(*number, state.rules.parameters);
    if (!checked) return fail(state, setting.column, checked.error().front());
    target.index = *checked;
    return target;
  }
  target.name = block.names[*setting.name];
  if (state.system.keeps(target.name)) {
    return fail(state, setting.column, "parameter-read-only"_id,
                fmt::format("parameter #<{}> can only be read", target.name),
                "it is the position, a mode or what a call gave back; use a name of your own");
  }
  if (setting.defines) return target;
  if (!setting.indices.empty()) {
    const auto indices = computed(state, context, setting.indices);
    if (!indices) return indices.error();
    if (target.name.starts_with('$')) {
      target.name = Parameters::name_of_element(target.name, *indices);
      return target;
    }
    if (state.parameters.size_of(target.name) == 0) {
      target.name = Parameters::name_of_element(target.name, *indices);
      target.of_machine = true;
      return target;
    }
    const auto place = state.parameters.place_in(target.name, *indices);
    if (!place) return fail(state, setting.column, place.error().front());
    target.element = true;
    target.place = *place;
    return target;
  }
  target.of_machine = !state.parameters.can_set(target.name);
  const auto read = target.of_machine ? state.parameters.read(target.name) : Result<double>{0.0};
  // R1000
  if (!read) return fail(state, setting.column, read.error().front());
  return target;
}

Outcome set_one(InterpreterState& state, const Assignment& setting, const SettingTarget& target,
                std::span<const double> sizes) {
  if (setting.defines && !sizes.empty()) {
    if (auto done = define_array(state, setting, target, sizes); !done) return done;
    return setting.value.empty() ? Outcome{Done{}} : set_elements(state, setting, target);
  }
  if (target.element) return set_elements(state, setting, target);
  if (!setting.frame.empty()) {
    return set_machine_frame(state, setting.column, target.name, target.frame);
  }
  const double value = target.values.front();
  if (setting.defines) {
    state.parameters.define(target.name, *setting.defines, value);
  } else if (target.name.starts_with('$')) {
    return set_machine_variable(state, setting.column, target.name, value);
  } else if (target.of_machine) {
    const bool text = is_symbol(value);
    emit(state, setting.column,
         Event{target.name, text ? state.parameters.text_of(value) : shortest_decimal(value),
               EventGrade::builder});
    state.parameters.set(target.name, value);
  } else if (setting.name) {
    state.parameters.set(target.name, value);
  } else {
    return set_numbered(state, setting.column, target.index, value);
  }
  return Done{};
}

}  // namespace

Outcome set_parameters(InterpreterState& state, const Block& block) {
  if (block.assignments.empty()) return Done{};
  // All are computed before the first is set: a block reads what the blocks before it left.
  const ExpressionContext context{block.steps, block.names, state.parameters};
  std::vector<SettingTarget> targets;
  std::vector<std::vector<double>> sizes;
  for (const Assignment& setting : block.assignments) {
    std::vector<double> values;
    if (!setting.value.empty()) {
      auto first = computed(state, context, std::span(&setting.value, 1));
      if (!first) return std::move(first).error();
      values = *std::move(first);
    }
    auto more = computed(state, context, setting.more);
    if (!more) return std::move(more).error();
    values.insert(values.end(), more->begin(), more->end());
    auto target = target_of(state, context, setting);
    if (!target) return std::move(target).error();
    target->values = std::move(values);
    for (const FramePart& part : setting.frame) {
      auto parts = computed(state, context, part.values);
      if (!parts) return std::move(parts).error();
      target->frame.push_back({part.name, part.axes, *std::move(parts)});
    }
    targets.push_back(*std::move(target));
    auto dimensions = setting.defines ? computed(state, context, setting.indices)
                                      : Result<std::vector<double>>{std::vector<double>{}};
    if (!dimensions) return std::move(dimensions).error();
    sizes.push_back(*std::move(dimensions));
  }
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (auto done = set_one(state, block.assignments[i], targets[i], sizes[i]); !done) return done;
  }
  return Done{};
}

}  // namespace frustum::parser
