#include "parser/interpret/cycles/thread_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "core/units.hpp"
#include "parser/interpret/cycles/threading_cycle.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr double kMaxPasses = 10'000.0;

constexpr double kMostSlide = 80.0;  // degrees

Feed synchronised(double lead) { return {lead, FeedMode::per_revolution, true}; }

// The way of one revolution; the spindle has to turn.
Result<double> lead_of(const InterpreterState& state, const BlockWords& words,
                       const Movement& movement, char letter) {
  const std::string name = words[CodeGroup::motion].code == nullptr
                               ? std::string("a thread")
                               : words[CodeGroup::motion].code->name();
  const bool goes_on = letter == 'F' && !words.has(CodeGroup::motion) && state.modes.feed;
  if (!words.has(letter) && !goes_on) {
    return fail(state, movement.column, "thread-lead"_id,
                fmt::format("{} without {}", name, letter),
                fmt::format("give {}, the way of one revolution, on each such block", letter));
  }
  const double lead = goes_on ? state.modes.feed->scaled : length_of(state, words[letter].value);
  if (!(lead > 0.0)) {
    return fail(state, words[letter].column, "thread-lead"_id,
                fmt::format("{} is not above zero", words.text_of(letter)),
                "the lead is above zero; the spindle's direction makes a thread left-handed");
  }
  if (state.modes.spindle == SpindleDirection::off) {
    return fail(state, movement.column, "thread-spindle-off"_id,
                name + " while the spindle is at rest",
                "start the spindle with S and M3 or M4 before");
  }
  return lead;
}

// Where I J K are the leads along X Y Z: the one of the axis that the thread runs along.
char lead_letter(const InterpreterState& state, const BlockWords& words) {
  if (!state.rules.leads_by_axis) return state.rules.thread_lead;
  const char given = words.first_of(LetterSet("IJK"));
  return given != 0 ? given : 'K';
}

// The way of one revolution from that of its longest axis.
Result<double> lead_along_way(const InterpreterState& state, const BlockWords& words, double lead,
                              const AxisTarget& before) {
  const char letter = lead_letter(state, words);
  const auto along = static_cast<AxisLetter>(letter - 'I');
  for (const char other : {'I', 'J', 'K'}) {
    if (other == letter || !words.has(other)) continue;
    return fail(state, words[other].column, "thread-lead"_id,
                fmt::format("{} beside {}", words.text_of(other), letter),
                "give one lead, that along the longer way");
  }
  Vec3 way = Vec3::Zero();
  bool known = true;
  for (const AxisLetter axis : kLinearAxes) {
    if (!words.has(to_char(axis))) continue;
    known = known && before[axis].has_value();
    way[static_cast<Eigen::Index>(axis)] = *state.position[axis] - before[axis].value_or(0.0);
  }
  const bool alone = words.has(to_char(along)) &&
                     (words.given() & kLinearWords)
                         .without(LetterSet({&"XYZ"[static_cast<std::size_t>(along)], 1}))
                         .empty();
  if (alone) return lead;
  const double longest = std::abs(way[static_cast<Eigen::Index>(along)]);
  // At 45 degrees either may be longer by what its place was rounded to; the leads are the same.
  constexpr double kRounded = 1.0 - 1e-4;
  if (known && longest > 0.0 && longest >= kRounded * way.cwiseAbs().maxCoeff()) {
    return lead * (way.norm() / longest);
  }
  return fail(state, words[letter].column, "thread-lead"_id,
              fmt::format("{} is the lead along {}, which is not the way of the thread",
                          words.text_of(letter), to_char(along)),
              "give I along X, J along Y, K along Z, of the axis with the longest way");
}

Result<ThreadingCycle> threading_cycle(const InterpreterState& state, const BlockWords& words,
                                       const Movement& movement) {
  for (const char letter : std::string_view("PZIJK")) {
    if (words.has(letter)) continue;
    return fail(state, movement.column, "cycle-word-missing"_id,
                fmt::format("the threading cycle has no {}", letter),
                "give P (lead), Z (end), I (crest), J (first depth) and K (full depth)");
  }
  for (const AxisLetter axis : kLinearAxes) {
    if (state.position[axis] || axis == AxisLetter::Y) continue;
    return fail(state, movement.column, state.position.unknown_id(axis),
                fmt::format("the threading cycle starts at an unknown {}: {}", to_char(axis),
                            state.position.why_unknown(axis)),
                "move to its start in G90 before");
  }
  const auto lead = lead_of(state, words, movement, 'P');
  if (!lead) return lead.error();
  ThreadingCycle cycle;
  cycle.start_x = *state.position[AxisLetter::X];
  cycle.start_z = *state.position[AxisLetter::Z];
  cycle.lead = *lead;
  cycle.crest = length_of(state, words['I'].value);
  cycle.first_depth = length_of(state, words['J'].value);
  cycle.full_depth = length_of(state, words['K'].value);
  cycle.slide_angle = words['Q'].value * kRadPerDeg;
  cycle.taper = length_of(state, words['E'].value);
  // Below 1 it would cut deeper from pass to pass; the control takes 1 then.
  if (words.has('R')) cycle.degression = std::max(1.0, words['R'].value);
  if (cycle.crest == 0.0) {
    return fail(state, words['I'].column, "thread-depth"_id, "the crest is on the drive line",
                "give I below zero for a thread outside, above zero for one inside");
  }
  for (const char letter : {'J', 'K'}) {
    if (words[letter].value > 0.0) continue;
    return fail(state, words[letter].column, "value-not-positive"_id,
                fmt::format("{} is not above zero", words.text_of(letter)),
                "depths count from the crest into the part");
  }
  if (cycle.first_depth > cycle.full_depth) {
    return fail(state, words['J'].column, "thread-depth"_id,
                "the first depth is more than the full one", "give J at most as large as K");
  }
  if (words['Q'].value < 0.0 || words['Q'].value > kMostSlide) {
    return fail(state, words['Q'].column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of('Q')),
                "the angle of the slide goes from 0 to 80 degrees; 29.5 is common");
  }
  if (words.has('H')) {
    const auto springs = whole(state, words, 'H', 0, static_cast<int>(kMaxPasses));
    if (!springs) return springs.error();
    cycle.spring_passes = *springs;
  }
  if (words.has('L')) {
    const auto ends = whole(state, words, 'L', 0, 3);
    if (!ends) return ends.error();
    cycle.tapers_in = (*ends & 1) != 0;
    cycle.tapers_out = (*ends & 2) != 0;
  }
  if (cycle.taper < 0.0) {
    return fail(state, words['E'].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of('E')), "give the length of the taper");
  }
  if (!(cycle.passes() <= kMaxPasses)) {
    return fail(state, words['J'].column, "thread-passes"_id,
                "the thread would take more than 10000 passes",
                "give J, the first depth, a larger share of K");
  }
  return cycle;
}

}  // namespace

Outcome move_along_thread(InterpreterState& state, const BlockWords& words,
                          const Movement& movement) {
  auto lead = lead_of(state, words, movement, lead_letter(state, words));
  if (!lead) return lead.error();
  if (state.rules.thread_lead == 'F' && state.modes.feed_mode == FeedMode::inverse_time) {
    return fail(state, movement.column, "thread-inverse-time"_id,
                "a thread in G93, where F is a time", "cut it in G94 or G95");
  }
  const AxisTarget before = state.position.target();
  if ((words.given() & kAxisWords).empty()) {
    return fail(state, movement.column, "thread-end-missing"_id, "a thread without an end",
                "give X Y Z of its end");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  if (state.rules.leads_by_axis) lead = lead_along_way(state, words, *lead, before);
  if (!lead) return lead.error();
  emit(state, movement.column,
       LinearFeed{end_of(state, words), state.modes.tool_axis, Coordinates::program,
                  synchronised(*lead)});
  return Done{};
}

Outcome tap_rigidly(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const auto lead = lead_of(state, words, movement, 'K');
  if (!lead) return lead.error();
  if ((words.given() & kLinearWords).empty()) {
    return fail(state, movement.column, "thread-end-missing"_id, "a thread without an end",
                "give X Y Z of the bottom");
  }
  for (const AxisLetter axis : kLinearAxes) {
    if (!words.has(to_char(axis)) || state.position[axis]) continue;
    return fail(state, movement.column, state.position.unknown_id(axis),
                fmt::format("the tap goes back to a start that is not known: {}",
                            state.position.why_unknown(axis)),
                "move to the start with G0 in G90 first");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  const AxisTarget start = end_of(state, words);
  const auto before = state.position;
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  const Feed feed = synchronised(*lead);
  const SpindleDirection turned = state.modes.spindle;
  const SpindleDirection back = turned == SpindleDirection::clockwise
                                    ? SpindleDirection::counterclockwise
                                    : SpindleDirection::clockwise;
  emit(state, movement.column,
       LinearFeed{end_of(state, words), state.modes.tool_axis, Coordinates::program, feed});
  emit(state, movement.column, SpindleChange{back, state.modes.spindle_speed});
  emit(state, movement.column,
       LinearFeed{start, state.modes.tool_axis, Coordinates::program, feed});
  emit(state, movement.column, SpindleChange{turned, state.modes.spindle_speed});
  state.position = before;
  return Done{};
}

Outcome tap_one_way(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const char letter = lead_letter(state, words);
  const double signed_lead = length_of(state, words[letter].value);
  if (signed_lead == 0.0) {
    return fail(state, movement.column, "thread-lead"_id, fmt::format("a tap without {}", letter),
                "give K along Z, the way of one revolution; below zero for a left-handed thread");
  }
  if (!(state.modes.spindle_speed > 0.0)) {
    return fail(state, movement.column, "cycle-speed-missing"_id, "a tap without a spindle speed",
                "give S before, above zero");
  }
  if (auto done = check_tool_length(state, movement); !done) return done;
  const AxisTarget before = state.position.target();
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  const auto along_way = lead_along_way(state, words, std::abs(signed_lead), before);
  if (!along_way) return along_way.error();
  const bool right = (signed_lead > 0.0) == (movement.motion == MotionMode::tap_in);
  const double speed = state.modes.spindle_speed;
  emit(state, movement.column,
       SpindleChange{right ? SpindleDirection::clockwise : SpindleDirection::counterclockwise,
                     speed});
  emit(state, movement.column,
       LinearFeed{end_of(state, words), state.modes.tool_axis, Coordinates::program,
                  synchronised(*along_way)});
  state.modes.spindle = SpindleDirection::off;
  emit(state, movement.column, SpindleChange{SpindleDirection::off, speed});
  return Done{};
}

Outcome cut_thread(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  if (auto done = check_tool_length(state, movement); !done) return done;
  auto cycle = threading_cycle(state, words, movement);
  if (!cycle) return cycle.error();
  const AxisTarget start = state.position.target();
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  const AxisTarget end = state.position.target();
  cycle->end_z = *end[AxisLetter::Z];
  const int tapers = static_cast<int>(cycle->tapers_in) + static_cast<int>(cycle->tapers_out);
  if (cycle->taper * tapers > std::abs(cycle->end_z - cycle->start_z)) {
    return fail(state, words['E'].column, "thread-taper"_id,
                "the tapers are longer than the thread", "give E at most half of its length");
  }
  for (const ThreadMove& move : moves_of(*cycle)) {
    AxisTarget target = start;
    target[AxisLetter::X] = move.x;
    target[AxisLetter::Z] = move.z;
    if (move.lead > 0.0) {
      emit(
          state, movement.column,
          LinearFeed{target, state.modes.tool_axis, Coordinates::program, synchronised(move.lead)});
    } else {
      emit(state, movement.column, Traverse{target, state.modes.tool_axis, Coordinates::program});
    }
  }
  if (words.has('X') || words.has('Y')) {
    emit(state, movement.column, Traverse{end, state.modes.tool_axis, Coordinates::program});
  }
  return Done{};
}

}  // namespace frustum::parser
