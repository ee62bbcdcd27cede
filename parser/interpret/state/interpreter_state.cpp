#include "parser/interpret/state/interpreter_state.hpp"

#include <utility>
#include <variant>

namespace frustum::parser {

InterpreterState::InterpreterState(Dialect dialect, const AxisTarget& start,
                                   ControlData control_data)
    : rules(rules_of(dialect)), data(std::move(control_data)), position(start) {
  modes.unit_is_known = !rules.unit_may_be_missing;
  modes.retract_to_initial = rules.cycles.retract_to_initial;
  for (const auto& [number, offset] : data.work_offsets) {
    for (std::size_t i = 0; i < 3; ++i) {
      output.programmed_offsets[number].at(i) = offset.origin[kAxisLetters.at(i)];
    }
  }
}

Diagnostic fail(const InterpreterState& state, std::uint32_t column, DiagnosticId id,
                std::string message, std::string hint) {
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.column = static_cast<int>(column);
  return in_this_block(state, std::move(diagnostic));
}

Diagnostic fail(const InterpreterState& state, std::uint32_t column, const Diagnostic& found) {
  return fail(state, column, found.id, found.message, found.hint);
}

Diagnostic in_this_block(const InterpreterState& state, Diagnostic diagnostic) {
  const SourcePlace place = state.at_work.place_of(static_cast<std::uint32_t>(diagnostic.column));
  diagnostic.line = static_cast<int>(place.line);
  diagnostic.column = static_cast<int>(place.column);
  return diagnostic;
}

void emit(InterpreterState& state, std::uint32_t column, Command command) {
  state.at_work.moved = state.at_work.moved || std::holds_alternative<Traverse>(command) ||
                        std::holds_alternative<LinearFeed>(command) ||
                        std::holds_alternative<ArcFeed>(command) ||
                        std::holds_alternative<HomeReturn>(command);
  state.output.take(Motion{state.at_work.place_of(column), std::move(command)});
}

void assume(InterpreterState& state, std::uint32_t column, std::string_view name,
            std::string_view text) {
  if (!state.output.assumptions.emplace(name).second) return;
  emit(state, column, Event{std::string(name), std::string(text), EventGrade::assumed});
}

void lose_pole(InterpreterState& state) {
  state.modes.pole_lost = state.modes.pole_lost || (state.modes.pole && state.modes.pole->given);
  state.modes.pole.reset();
}

void forget(InterpreterState& state, LetterSet axes, PositionLoss loss, std::string_view word) {
  for (const AxisLetter axis : kAxisLetters) {
    if (axes.has(to_char(axis))) {
      state.position.forget(axis, loss, state.at_work.block->line, word);
    }
  }
  // Moves of the machine leave a pole in the words' frame.
  const bool stays = state.rules.polar.origin_is_pole && loss != PositionLoss::work_offset &&
                     loss != PositionLoss::tilted_plane && loss != PositionLoss::turned_frame;
  if (axes.has('X') && !stays) lose_pole(state);
}

}  // namespace frustum::parser
