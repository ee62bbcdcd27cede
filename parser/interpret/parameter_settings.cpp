#include "parser/interpret/parameter_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/decimal.hpp"
#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {
namespace {

constexpr int kFirstSystemVariable = 1000;

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
    SystemVariable{3001, 3002, VariableUse::clock},
    SystemVariable{3003, 3005, VariableUse::event},  // single block, feed hold, settings
    SystemVariable{3006, 3006, VariableUse::message},
    SystemVariable{3007, 3007, VariableUse::clock},
    SystemVariable{3011, 3012, VariableUse::clock},
    SystemVariable{3901, 3902, VariableUse::event},  // parts made and to make
};

// Whether the variable is the control's: what it does is done, and nothing is stored.
Result<bool> set_system_variable(InterpreterState& state, std::uint32_t column, int index,
                                 double value) {
  if (state.rules.dialect != Dialect::fanuc || index < kFirstSystemVariable) return false;
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
  const std::string number = is_vacant(value) ? "0" : shortest_decimal(value);
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
  const bool unknown = is_vacant(value) && state.parameters.rules().values_may_be_unknown;
  if (unknown && read_parameter(state.data, state.rules.dialect, index)) {
    return fail(state, column, "unknown-parameter"_id,
                fmt::format("#{} is set to a value that only the machine knows", index),
                "set it to a value of the program");
  }
  const auto written = is_vacant(value)
                           ? ParameterWrite::not_kept
                           : write_parameter(state.data, state.rules.dialect, index, value);
  if (written == ParameterWrite::read_only) {
    return fail(state, column, "parameter-read-only"_id,
                fmt::format("parameter #{} can only be read", index),
                "it is the tool or the position; use another parameter");
  }
  if (written == ParameterWrite::done) {
    return state.rules.parameters_count_at_once ? replace_datum(state, column) : Outcome{Done{}};
  }
  const auto kept = set_system_variable(state, column, index, value);
  if (!kept) return kept.error();
  if (!*kept) state.parameters.set(index, value);
  return Done{};
}

}  // namespace

Outcome set_parameters(InterpreterState& state, const Block& block) {
  if (block.assignments.empty()) return Done{};
  // All are computed before the first is set: a block reads what the blocks before it left.
  const ExpressionContext context{block.steps, block.names, state.parameters};
  std::vector<std::pair<int, double>> values;
  for (const Assignment& setting : block.assignments) {
    const auto value = evaluate(context, setting.value);
    if (!value) return in_this_block(state, value.error().front());
    int index = 0;
    if (setting.name && state.system.keeps(block.names[*setting.name])) {
      return fail(state, setting.column, "parameter-read-only"_id,
                  fmt::format("parameter #<{}> can only be read", block.names[*setting.name]),
                  "it is the position, a mode or what a call gave back; use a name of your own");
    }
    if (setting.name && !setting.defines && !state.parameters.can_set(block.names[*setting.name])) {
      return fail(state, setting.column, "unknown-parameter"_id,
                  fmt::format("{} is not defined", block.names[*setting.name]),
                  "define it before: DEF REAL and its name; parameters are R0 to R999");
    }
    if (!setting.name) {
      const auto number = evaluate(context, setting.index);
      if (!number) return in_this_block(state, number.error().front());
      const auto checked = Parameters::index_of(*number, state.rules.parameters);
      if (!checked) {
        return fail(state, setting.column, checked.error().front());
      }
      index = *checked;
    }
    values.emplace_back(index, *value);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& name = block.assignments[i].name;
    if (const auto kind = block.assignments[i].defines) {
      state.parameters.define(block.names[*name], *kind, values[i].second);
    } else if (name) {
      state.parameters.set(block.names[*name], values[i].second);
    } else {
      const std::uint32_t column = block.assignments[i].column;
      auto done = set_numbered(state, column, values[i].first, values[i].second);
      if (!done) return done;
    }
  }
  return Done{};
}

}  // namespace frustum::parser
