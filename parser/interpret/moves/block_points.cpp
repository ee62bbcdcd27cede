// Moves to reference points (G28, G30) and in machine coordinates (G53), and the points that a program stores.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {

// G28 and G30: by the place that the words name, then the axes named to the reference point. One that the program
// knows is a place like any other; else it is the machine's.
BlockExecutor::Outcome BlockExecutor::go_home(const BlockWords& words, std::size_t point) {
  const std::uint32_t column = words[CodeGroup::non_modal].column;
  if (words.has('P')) {
    const auto given = whole(words, 'P', 2, 4);
    if (!given) return given.error();
    point = static_cast<std::size_t>(*given);
  }
  const AxisTarget before = position_.target();
  LetterSet named;
  if ((words.given() & kAxisWords).empty()) named = kAxisWords;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    named.add(letter);
    // "G91 G28 Z0" from a place that is not known goes straight home: zero needs no start.
    const bool stays = state_.distance == DistanceMode::incremental && words[letter].value == 0.0;
    if (stays) continue;
    if (auto done = set_target(words, axis); !done) return done;
  }
  if (!(position_.target() == before)) {
    emit(column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (named.has(to_char(axis))) state_.way_home[axis] = position_[axis];
  }
  return_to_point(point, named, column);
  return Done{};
}

// G27: by rapid to where the words say, which the control holds against the reference point.
BlockExecutor::Outcome BlockExecutor::check_home(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  if (auto done = set_targets(words); !done) return done;
  if (auto done = check_programmed_frame({NonModal::none, MotionMode::traverse, code.column});
      !done) {
    return done;
  }
  emit(code.column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  std::string axes;
  for (const AxisLetter axis : kAxisLetters) {
    if (words.has(to_char(axis))) axes += to_char(axis);
  }
  emit(code.column, Event{code.code->name(), std::move(axes)});
  return Done{};
}

// G29: the axes named go by rapid to the place that G28 or G30 went by, then to the end. Steps count from that place.
BlockExecutor::Outcome BlockExecutor::come_from_home(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    if (!state_.way_home[axis]) {
      return fail(words[letter].column, "home-place-missing"_id,
                  fmt::format("{} goes by the place of G28, which has none for {}",
                              code.code->name(), letter),
                  fmt::format("give {} of the place in G28 or G30 before, in G90", letter));
    }
    position_.set(axis, *state_.way_home[axis]);
  }
  const Movement rapid{NonModal::none, MotionMode::traverse, code.column};
  if (auto done = check_programmed_frame(rapid); !done) return done;
  const AxisTarget way = position_.target();
  emit(code.column, Traverse{way, state_.tool_axis, Coordinates::program});
  if (auto done = set_targets(words); !done) return done;
  if (position_.target() == way) return Done{};
  emit(code.column, Traverse{position_.target(), state_.tool_axis, Coordinates::program});
  return Done{};
}

void BlockExecutor::return_to_point(std::size_t point, LetterSet axes, std::uint32_t column) {
  const bool kept = point <= data_.reference_points.size();
  const AxisTarget& known = kept ? data_.reference_points.at(point - 1) : AxisTarget{};
  HomeReturn home{.point = static_cast<int>(point)};
  LetterSet to_place;
  LetterSet to_machine;
  for (const AxisLetter axis : kAxisLetters) {
    if (!axes.has(to_char(axis))) continue;
    home.axes.at(static_cast<std::size_t>(axis)) = !known[axis];
    (known[axis] ? to_place : to_machine).add(to_char(axis));
  }
  if (!to_place.empty()) go_to_axis_positions(known, to_place, column);
  if (to_machine.empty()) return;
  emit(column, Command{home});
  leave_program_coordinates(to_machine, PositionLoss::home);
}

// By rapid, with the words where the program knows them: in a turned frame named words move, not axes.
void BlockExecutor::go_to_axis_positions(const AxisTarget& point, LetterSet named,
                                         std::uint32_t column) {
  AxisTarget axes = axis_positions();
  AxisTarget end;
  AxisTarget all_there = axes;
  for (const AxisLetter axis : kAxisLetters) {
    if (point[axis]) all_there[axis] = point[axis];
    if (!named.has(to_char(axis))) continue;
    axes[axis] = end[axis] = point[axis];
  }
  ProgramPosition there;
  std::swap(there, position_);
  arrive(all_there);
  const AxisTarget words = position_.target();
  std::swap(there, position_);
  bool all = !state_.tool_centre_point();
  for (const AxisLetter axis : kAxisLetters) {
    if (named.has(to_char(axis)) && !words[axis]) all = false;
  }
  if (!all) {
    emit(column, Traverse{end, std::nullopt, Coordinates::machine});
    leave_program_coordinates(named, PositionLoss::home);
    if (!state_.tool_centre_point()) arrive(axes);
    return;
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (named.has(to_char(axis))) position_.set(axis, *words[axis]);
  }
  emit(column, Traverse{position_.target(), std::nullopt, Coordinates::program});
  if (!(named & kRotaryWords).empty()) state_.tool_axis.reset();
}

// G28.1, G30.1: the reference point is where the axes are. An axis that has never moved keeps the machine's.
BlockExecutor::Outcome BlockExecutor::keep_point(std::size_t point, std::uint32_t column) {
  const AxisTarget axes = axis_positions();
  for (const AxisLetter axis : kAxisLetters) {
    if (axes[axis] || position_.never_known(axis)) continue;
    return fail(
        column, axis_unknown_id(axis),
        fmt::format("the reference point is where the axes are, but {}", why_axis_unknown(axis)),
        "place the work offset with G10 L2 before, or move there with G53");
  }
  data_.reference_points.at(point) = axes;
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::move_in_machine_coordinates(const BlockWords& words,
                                                                  const Movement& movement) {
  const AxisTarget axes_before = axis_positions();
  AxisTarget end;
  LetterSet named;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    named.add(letter);
    end[axis] = scaled(axis, words[letter].value);
  }
  const Compensation& kept = state_.compensation;
  const bool tip_moves = kept.tip || (kept.length && !(named & kLinearWords).empty());
  if (rules_.machine_coordinates_keep_length && tip_moves) {
    return fail(words[CodeGroup::non_modal].column, "tool-length-active"_id,
                fmt::format("{} with a tool length or TRAORI would place the tool's tip",
                            words[CodeGroup::non_modal].code->name()),
                "switch them off before: TRAFOOF, and D0 on this block");
  }
  if (movement.motion == MotionMode::traverse) {
    emit(movement.column, Traverse{end, std::nullopt, Coordinates::machine});
  } else {
    const auto feed =
        feed_for(words, movement, end[AxisLetter::X] || end[AxisLetter::Y] || end[AxisLetter::Z]);
    if (!feed) return feed.error();
    emit(movement.column, LinearFeed{end, std::nullopt, Coordinates::machine, *feed});
  }
  AxisTarget axes = axes_before;
  for (const AxisLetter axis : kAxisLetters) {
    if (end[axis]) axes[axis] = end[axis];
  }
  leave_program_coordinates(named, PositionLoss::machine_coordinates);
  if (!state_.tool_centre_point()) arrive(axes);
  return Done{};
}

void BlockExecutor::leave_program_coordinates(LetterSet axes, PositionLoss loss) {
  // With the tool-centre-point control on, X Y Z are of the tip, which any axis may carry along.
  forget(state_.tool_centre_point() ? axes | kLinearWords : axes, loss);
  if (!(axes & kRotaryWords).empty()) state_.tool_axis.reset();
}

}  // namespace frustum::parser
