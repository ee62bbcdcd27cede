// Moves synchronised with the spindle: G33, rigid tapping G33.1, the threading cycle G76.
#include <fmt/format.h>

#include "core/units.hpp"
#include "parser/interpret/block_executor.hpp"
#include "parser/interpret/cycles/threading_cycle.hpp"

namespace frustum::parser {
namespace {

constexpr double kMaxPasses = 10'000.0;
constexpr double kMostSlide = 80.0;  // degrees

Feed synchronised(double lead) { return {lead, FeedMode::per_revolution, true}; }

}  // namespace

// The way of one revolution; the spindle has to turn.
Result<double> BlockExecutor::lead_of(const BlockWords& words, const Movement& movement,
                                      char letter) const {
  const std::string name = words[CodeGroup::motion].code == nullptr
                               ? std::string("a thread")
                               : words[CodeGroup::motion].code->name();
  const bool goes_on = letter == 'F' && !words.has(CodeGroup::motion) && state_.feed;
  if (!words.has(letter) && !goes_on) {
    return fail(movement.column, "thread-lead"_id, fmt::format("{} without {}", name, letter),
                fmt::format("give {}, the way of one revolution, on each such block", letter));
  }
  const double lead = goes_on ? state_.feed->scaled : words[letter].value * unit_scale();
  if (!(lead > 0.0)) {
    return fail(words[letter].column, "thread-lead"_id,
                fmt::format("{} is not above zero", words.text_of(letter)),
                "the lead is above zero; the spindle's direction makes a thread left-handed");
  }
  if (state_.spindle == SpindleDirection::off) {
    return fail(movement.column, "thread-spindle-off"_id, name + " while the spindle stands",
                "start the spindle with S and M3 or M4 before");
  }
  return lead;
}

// Where I J K are the leads along X Y Z: the one of the axis that the thread runs along.
char BlockExecutor::lead_letter(const BlockWords& words) const {
  if (!rules_.leads_by_axis) return rules_.thread_lead;
  const char given = words.first_of(LetterSet("IJK"));
  return given != 0 ? given : 'K';
}

// The way of one revolution from that of its longest axis.
Result<double> BlockExecutor::lead_along_way(const BlockWords& words, double lead,
                                             const AxisTarget& before) const {
  const char letter = lead_letter(words);
  const auto along = static_cast<AxisLetter>(letter - 'I');
  for (const char other : {'I', 'J', 'K'}) {
    if (other == letter || !words.has(other)) continue;
    return fail(words[other].column, "thread-lead"_id,
                fmt::format("{} beside {}", words.text_of(other), letter),
                "give one lead, that along the longer way");
  }
  Vec3 way = Vec3::Zero();
  bool known = true;
  for (const AxisLetter axis : kLinearAxes) {
    if (!words.has(to_char(axis))) continue;
    known = known && before[axis].has_value();
    way[static_cast<Eigen::Index>(axis)] = *position_[axis] - before[axis].value_or(0.0);
  }
  const bool alone = words.has(to_char(along)) &&
                     (words.given() & kLinearWords)
                         .without(LetterSet({&"XYZ"[static_cast<std::size_t>(along)], 1}))
                         .empty();
  if (alone) return lead;
  const double longest = std::abs(way[static_cast<Eigen::Index>(along)]);
  if (known && longest > 0.0 && longest >= way.cwiseAbs().maxCoeff()) {
    return lead * (way.norm() / longest);
  }
  return fail(words[letter].column, "thread-lead"_id,
              fmt::format("{} is the lead along {}, which is not the way of the thread",
                          words.text_of(letter), to_char(along)),
              "give I along X, J along Y, K along Z, of the axis with the longest way");
}

BlockExecutor::Outcome BlockExecutor::move_along_thread(const BlockWords& words,
                                                        const Movement& movement) {
  auto lead = lead_of(words, movement, lead_letter(words));
  if (!lead) return lead.error();
  if (rules_.thread_lead == 'F' && state_.feed_mode == FeedMode::inverse_time) {
    return fail(movement.column, "thread-inverse-time"_id, "a thread in G93, where F is a time",
                "cut it in G94 or G95");
  }
  const AxisTarget before = position_.target();
  if ((words.given() & kAxisWords).empty()) {
    return fail(movement.column, "thread-end-missing"_id, "a thread without an end",
                "give X Y Z of its end");
  }
  if (auto done = check_tool_length(movement); !done) return done;
  if (auto done = set_targets(words); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  if (rules_.leads_by_axis) lead = lead_along_way(words, *lead, before);
  if (!lead) return lead.error();
  emit(movement.column,
       LinearFeed{end_of(words), state_.tool_axis, Coordinates::program, synchronised(*lead)});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::tap_rigidly(const BlockWords& words,
                                                  const Movement& movement) {
  const auto lead = lead_of(words, movement, 'K');
  if (!lead) return lead.error();
  if ((words.given() & kLinearWords).empty()) {
    return fail(movement.column, "thread-end-missing"_id, "a thread without an end",
                "give X Y Z of the bottom");
  }
  for (const AxisLetter axis : kLinearAxes) {
    if (!words.has(to_char(axis)) || position_[axis]) continue;
    return fail(movement.column, position_.unknown_id(axis),
                fmt::format("the tap goes back to a start that is not known: {}",
                            position_.why_unknown(axis)),
                "move to the start with G0 in G90 first");
  }
  if (auto done = check_tool_length(movement); !done) return done;
  const AxisTarget start = end_of(words);
  const auto before = position_;
  if (auto done = set_targets(words); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  const Feed feed = synchronised(*lead);
  const SpindleDirection turned = state_.spindle;
  const SpindleDirection back = turned == SpindleDirection::clockwise
                                    ? SpindleDirection::counterclockwise
                                    : SpindleDirection::clockwise;
  emit(movement.column, LinearFeed{end_of(words), state_.tool_axis, Coordinates::program, feed});
  emit(movement.column, SpindleChange{back, state_.spindle_speed});
  emit(movement.column, LinearFeed{start, state_.tool_axis, Coordinates::program, feed});
  emit(movement.column, SpindleChange{turned, state_.spindle_speed});
  position_ = before;
  return Done{};
}

Result<ThreadingCycle> BlockExecutor::threading_cycle(const BlockWords& words,
                                                      const Movement& movement) const {
  for (const char letter : std::string_view("PZIJK")) {
    if (words.has(letter)) continue;
    return fail(movement.column, "cycle-word-missing"_id,
                fmt::format("the threading cycle has no {}", letter),
                "give P (lead), Z (end), I (crest), J (first depth) and K (full depth)");
  }
  for (const AxisLetter axis : kLinearAxes) {
    if (position_[axis] || axis == AxisLetter::Y) continue;
    return fail(movement.column, position_.unknown_id(axis),
                fmt::format("the threading cycle starts at an unknown {}: {}", to_char(axis),
                            position_.why_unknown(axis)),
                "move to its start in G90 before");
  }
  const auto lead = lead_of(words, movement, 'P');
  if (!lead) return lead.error();
  ThreadingCycle cycle;
  cycle.start_x = *position_[AxisLetter::X];
  cycle.start_z = *position_[AxisLetter::Z];
  cycle.lead = *lead;
  cycle.crest = words['I'].value * unit_scale();
  cycle.first_depth = words['J'].value * unit_scale();
  cycle.full_depth = words['K'].value * unit_scale();
  cycle.slide_angle = words['Q'].value * kRadPerDeg;
  cycle.taper = words['E'].value * unit_scale();
  // Below 1 it would cut deeper from pass to pass; the control takes 1 then.
  if (words.has('R')) cycle.degression = std::max(1.0, words['R'].value);
  if (cycle.crest == 0.0) {
    return fail(words['I'].column, "thread-depth"_id, "the crest is on the drive line",
                "give I below zero for a thread outside, above zero for one inside");
  }
  for (const char letter : {'J', 'K'}) {
    if (words[letter].value > 0.0) continue;
    return fail(words[letter].column, "value-not-positive"_id,
                fmt::format("{} is not above zero", words.text_of(letter)),
                "depths count from the crest into the part");
  }
  if (cycle.first_depth > cycle.full_depth) {
    return fail(words['J'].column, "thread-depth"_id, "the first depth is more than the full one",
                "give J at most as large as K");
  }
  if (words['Q'].value < 0.0 || words['Q'].value > kMostSlide) {
    return fail(words['Q'].column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of('Q')),
                "the angle of the slide goes from 0 to 80 degrees; 29.5 is common");
  }
  if (words.has('H')) {
    const auto springs = whole(words, 'H', 0, static_cast<int>(kMaxPasses));
    if (!springs) return springs.error();
    cycle.spring_passes = *springs;
  }
  if (words.has('L')) {
    const auto ends = whole(words, 'L', 0, 3);
    if (!ends) return ends.error();
    cycle.tapers_in = (*ends & 1) != 0;
    cycle.tapers_out = (*ends & 2) != 0;
  }
  if (cycle.taper < 0.0) {
    return fail(words['E'].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of('E')), "give the length of the taper");
  }
  if (!(cycle.passes() <= kMaxPasses)) {
    return fail(words['J'].column, "thread-passes"_id,
                "the thread would take more than 10000 passes",
                "give J, the first depth, a larger share of K");
  }
  return cycle;
}

BlockExecutor::Outcome BlockExecutor::cut_thread(const BlockWords& words,
                                                 const Movement& movement) {
  if (auto done = check_tool_length(movement); !done) return done;
  auto cycle = threading_cycle(words, movement);
  if (!cycle) return cycle.error();
  const AxisTarget start = position_.target();
  if (auto done = set_targets(words); !done) return done;
  if (auto done = check_programmed_frame(movement); !done) return done;
  const AxisTarget end = position_.target();
  cycle->end_z = *end[AxisLetter::Z];
  const int tapers = static_cast<int>(cycle->tapers_in) + static_cast<int>(cycle->tapers_out);
  if (cycle->taper * tapers > std::abs(cycle->end_z - cycle->start_z)) {
    return fail(words['E'].column, "thread-taper"_id, "the tapers are longer than the thread",
                "give E at most half of its length");
  }
  for (const ThreadMove& move : moves_of(*cycle)) {
    AxisTarget target = start;
    target[AxisLetter::X] = move.x;
    target[AxisLetter::Z] = move.z;
    if (move.lead > 0.0) {
      emit(movement.column,
           LinearFeed{target, state_.tool_axis, Coordinates::program, synchronised(move.lead)});
    } else {
      emit(movement.column, Traverse{target, state_.tool_axis, Coordinates::program});
    }
  }
  if (words.has('X') || words.has('Y')) {
    emit(movement.column, Traverse{end, state_.tool_axis, Coordinates::program});
  }
  return Done{};
}

}  // namespace frustum::parser
