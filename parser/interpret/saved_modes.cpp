#include "parser/interpret/saved_modes.hpp"

#include <cstdint>

#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/frames/programmable_frame.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {
namespace {

void restore_modes(InterpreterState& state, std::uint32_t column) {
  const ModalState& saved = *state.saved_modes.back().state;
  state.modes.plane = saved.plane;
  state.modes.unit = saved.unit;
  state.modes.diameter = saved.diameter;
  state.modes.distance = saved.distance;
  state.modes.arc_distance = saved.arc_distance;
  state.modes.feed_mode = saved.feed_mode;
  const bool all = !state.saved_modes.back().of_g_words;
  if (all) {
    state.modes.feed = saved.feed;
  } else {
    state.modes.motion = saved.motion;
    state.modes.orientation_reference = saved.orientation_reference;
    if (state.modes.orientation_path != saved.orientation_path) {
      state.modes.orientation_path = saved.orientation_path;
      emit(state, column, OrientationPathChange{saved.orientation_path});
    }
    if (state.rules.planes_end_frames) set_program_frame(state, saved.program_frame);
  }
  state.modes.retract_to_initial = saved.retract_to_initial;
  state.modes.surface_speed = saved.surface_speed;
  if (state.modes.work_offset != saved.work_offset) {
    // It was in force before, so that there is nothing to complain of.
    static_cast<void>(select_work_offset(state, saved.work_offset, column));
  }
  if (!all) return;
  if (state.modes.spindle != saved.spindle || state.modes.spindle_speed != saved.spindle_speed) {
    state.modes.spindle = saved.spindle;
    state.modes.spindle_speed = saved.spindle_speed;
    emit(state, column, SpindleChange{state.modes.spindle, state.modes.spindle_speed});
  }
  if (state.modes.flood != saved.flood) {
    state.modes.flood = saved.flood;
    emit(state, column, CoolantChange{state.modes.flood});
  }
}

}  // namespace

Outcome keep_modes(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::saved_modes];
  if (code.code == nullptr) return Done{};
  SavedModes& saved = state.saved_modes.back();
  switch (static_cast<SavedModesWord>(code.code->value)) {
    case SavedModesWord::save:
      saved = {state.modes, false, false, saved.unit};
      break;
    case SavedModesWord::save_for_call:
      saved = {state.modes, true, false, saved.unit};
      break;
    case SavedModesWord::drop:
      saved = {.unit = saved.unit};
      break;
    case SavedModesWord::restore:
      if (!saved.state) {
        return fail(state, code.column, "saved-modes-missing"_id, "there are no saved modes",
                    "save them with M70 or M73 before");
      }
      restore_modes(state, code.column);
      break;
  }
  return Done{};
}

void enter_call(InterpreterState& state) {
  state.saved_modes.push_back({.unit = state.modes.unit});
  ++state.system.call_level;
}

void leave_call(InterpreterState& state) {
  if (state.saved_modes.back().state && state.saved_modes.back().comes_back)
    restore_modes(state, 1);
  if (state.rules.calls_whole_files) state.modes.unit = state.saved_modes.back().unit;
  state.saved_modes.pop_back();
  --state.system.call_level;
}

void keep_modes_for_call(InterpreterState& state) {
  state.saved_modes.back() = {state.modes, true, true, state.saved_modes.back().unit};
}

}  // namespace frustum::parser
