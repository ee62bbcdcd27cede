#include "parser/interpret/move_of_block.hpp"

#include <array>

#include "parser/interpret/cycles/canned_cycle_call.hpp"
#include "parser/interpret/cycles/hole_call.hpp"
#include "parser/interpret/cycles/thread_moves.hpp"
#include "parser/interpret/frames/data_input.hpp"
#include "parser/interpret/frames/feature_plane.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/frames/tilted_plane.hpp"
#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/movement_of_block.hpp"
#include "parser/interpret/moves/arc_through_point.hpp"
#include "parser/interpret/moves/cubic_in_space.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/pole.hpp"
#include "parser/interpret/moves/probing.hpp"
#include "parser/interpret/moves/reference_points.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/moves/spline_moves.hpp"
#include "parser/interpret/moves/straight_and_arc.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {
namespace {

using Move = Outcome (*)(InterpreterState& state, const BlockWords& words,
                         const Movement& movement);

// What a non-modal word does, whatever the motion in force.
struct NonModalMove {
  NonModal word;
  Move move;
};
constexpr Move kShiftWords = [](InterpreterState& state, const BlockWords& words,
                                const Movement& movement) {
  return shift_words(state, words, movement.non_modal);
};
constexpr Move kSetPoleInPlane = [](InterpreterState& state, const BlockWords& words,
                                    const Movement& movement) {
  return set_pole_in_plane(state, words, movement.non_modal);
};
constexpr Move kPosition = [](InterpreterState& state, const BlockWords& words,
                              const Movement& movement) {
  assume(state, movement.column, "POS", "axes that go by themselves go by rapid, as G0 does");
  if (auto done = announce_rotary_paths(state, words, movement.column); !done) return done;
  return move_straight(state, words, movement);
};
constexpr std::array kNonModalMoves{
    NonModalMove{NonModal::home,
                 [](auto& state, auto& words, const auto&) { return go_home(state, words, 1); }},
    NonModalMove{NonModal::second_home,
                 [](auto& state, auto& words, const auto&) { return go_home(state, words, 2); }},
    NonModalMove{NonModal::retract_tool,
                 [](auto& state, auto& words, const auto&) { return retract_tool(state, words); }},
    NonModalMove{NonModal::keep_home,
                 [](auto& state, auto&, const auto& movement) {
                   return keep_point(state, 0, movement.column);
                 }},
    NonModalMove{NonModal::keep_second_home,
                 [](auto& state, auto&, const auto& movement) {
                   return keep_point(state, 1, movement.column);
                 }},
    NonModalMove{NonModal::check_home,
                 [](auto& state, auto& words, const auto&) { return check_home(state, words); }},
    NonModalMove{NonModal::from_home, [](auto& state, auto& words,
                                         const auto&) { return come_from_home(state, words); }},
    NonModalMove{NonModal::data,
                 [](auto& state, auto& words, const auto&) { return set_data(state, words); }},
    NonModalMove{NonModal::tool_data,
                 [](auto& state, auto& words, const auto&) { return define_tool(state, words); }},
    NonModalMove{
        NonModal::align,
        [](auto& state, auto&, const auto& movement) { return align(state, movement.column); }},
    NonModalMove{NonModal::pole,
                 [](auto& state, auto& words, const auto&) { return set_pole(state, words); }},
    NonModalMove{NonModal::pole_from_here, kSetPoleInPlane},
    NonModalMove{NonModal::pole_from_origin, kSetPoleInPlane},
    NonModalMove{NonModal::pole_from_pole, kSetPoleInPlane},
    NonModalMove{NonModal::start,
                 [](auto& state, auto& words, const auto&) { return set_start(state, words); }},
    NonModalMove{NonModal::probing_cycle,
                 [](auto& state, auto& words, const auto&) { return pass_probing(state, words); }},
    NonModalMove{NonModal::floating_tap, move_straight},
    NonModalMove{NonModal::positioning, kPosition},
    NonModalMove{
        NonModal::to_reference_point,
        [](auto& state, auto& words, const auto&) { return approach_point(state, words); }},
    NonModalMove{
        NonModal::to_fixed_point,
        [](auto& state, auto& words, const auto&) { return approach_point(state, words); }},
    NonModalMove{NonModal::shift_to_place, kShiftWords},
    NonModalMove{NonModal::shift, kShiftWords},
    NonModalMove{NonModal::shift_off, kShiftWords},
    NonModalMove{NonModal::shift_suspend, kShiftWords},
    NonModalMove{NonModal::shift_resume, kShiftWords},
};

// What a motion word does, from one mode to another.
struct ModalMove {
  MotionMode first;
  MotionMode last;
  Move move;
};
constexpr std::array kModalMoves{
    ModalMove{MotionMode::traverse, MotionMode::linear, move_straight},
    ModalMove{MotionMode::arc_clockwise, MotionMode::arc_tangential, move_along_arc},
    ModalMove{MotionMode::arc_through, MotionMode::arc_through, move_through_point},
    ModalMove{MotionMode::arc_about_axis, MotionMode::arc_about_axis, move_about_axis},
    ModalMove{MotionMode::cubic_in_space, MotionMode::cubic_in_space, move_along_cubic_in_space},
    ModalMove{MotionMode::cubic_spline, MotionMode::nurbs_by_knots, move_along_spline},
    ModalMove{MotionMode::thread, MotionMode::thread, move_along_thread},
    ModalMove{MotionMode::rigid_tap, MotionMode::rigid_tap, tap_rigidly},
    ModalMove{MotionMode::tap_in, MotionMode::tap_out, tap_one_way},
    ModalMove{MotionMode::thread_cycle, MotionMode::thread_cycle, cut_thread},
    ModalMove{MotionMode::probe_towards, MotionMode::probe_away_if_any, probe},
    ModalMove{MotionMode::peck_short, MotionMode::fine_bore, run_cycle},
};

}  // namespace

Outcome make_move(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const bool by_itself = state.rules.starts_with_rapid && state.modes.motion == MotionMode::none &&
                         !words.has(CodeGroup::motion);
  const bool moves = movement.motion != MotionMode::none;
  if (by_itself && moves && movement.non_modal == NonModal::none) {
    assume(state, movement.column, "first motion", "G0 is in force before the first motion word");
  }
  // Axis words or not, the motion word stays in force for the blocks after.
  if (!by_itself || moves) state.modes.motion = motion_of(state, words);
  if (auto done = check_feature(state, movement); !done) return done;
  if (!is_cycle(state.modes.motion)) {
    state.modes.cycle.reset();
    state.modes.before_cycle = state.modes.motion;
  }
  if (auto done = check_open_nurbs(state, movement); !done) return done;
  const bool stays = movement.motion == MotionMode::none && movement.non_modal == NonModal::none;
  if (!stays && movement.motion != MotionMode::cubic_spline) state.spline.leads.reset();
  const bool places = is_cycle(movement.motion) ||
                      (movement.non_modal != NonModal::none &&
                       movement.non_modal != NonModal::dwell && !is_pole(movement.non_modal));
  if (places) state.contour_exit = {};
  if (movement.non_modal != NonModal::none) {
    for (const NonModalMove& row : kNonModalMoves) {
      if (row.word == movement.non_modal) return row.move(state, words, movement);
    }
  }
  if (movement.non_modal == NonModal::machine_coordinates && movement.motion == MotionMode::none) {
    emit(state, movement.column, Event{words[CodeGroup::non_modal].code->name(), {}});
  }
  if (movement.motion == MotionMode::none) return Done{};
  guide_uncalled_tool(state, movement.column);
  if (auto done = announce_rotary_paths(state, words, movement.column); !done) return done;
  if (movement.non_modal == NonModal::machine_coordinates) {
    return move_in_machine_coordinates(state, words, movement);
  }
  const bool makes_hole = state.rules.holes_at_moves && state.modes.hole_cycle.on &&
                          !is_spline(movement.motion) && !is_cycle(movement.motion);
  if (makes_hole) return make_hole(state, words, movement);
  for (const ModalMove& row : kModalMoves) {
    if (movement.motion >= row.first && movement.motion <= row.last) {
      return row.move(state, words, movement);
    }
  }
  return Done{};
}

}  // namespace frustum::parser
