#include "parser/interpret/filters/approach_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/units.hpp"
#include "parser/interpret/filters/radius_words.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

// What may be in the blocks between an approach and the contour's first move.
constexpr std::array kBeforeContour{CodeGroup::motion,
                                    CodeGroup::feed_source,
                                    CodeGroup::spindle,
                                    CodeGroup::coolant,
                                    CodeGroup::feed_mode,
                                    CodeGroup::corner,
                                    CodeGroup::radius_compensation};

constexpr double kWholeTurn = 360.0;  // degrees

Result<ContourLink> link_of(const InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::approach];
  ContourLink link;
  link.shape = static_cast<ApproachWord>(code.code->value);
  const bool by_line =
      link.shape == ApproachWord::line_along || link.shape == ApproachWord::line_across ||
      link.shape == ApproachWord::leave_along || link.shape == ApproachWord::leave_across;
  const char size = by_line ? 'l' : 'R';
  // LEN may be left out.
  if (!words.has(size) && !by_line) {
    return fail(state, code.column, "word-missing"_id,
                fmt::format("{} without R", code.code->name()),
                "give the radius of the arc, for example R5");
  }
  link.size = length_of(state, words[size].value);
  const bool takes_sign =
      link.shape == ApproachWord::arc || link.shape == ApproachWord::leave_by_arc || by_line;
  if ((link.size == 0.0 && words.has(size)) || (link.size < 0.0 && !takes_sign)) {
    return fail(state, words[size].column, "value-not-positive"_id,
                fmt::format("{} is not above zero", words.text_of(size)),
                "give a length above zero");
  }
  if (link.shape == ApproachWord::arc || link.shape == ApproachWord::leave_by_arc) {
    if (!words.has('i')) {
      return fail(state, code.column, "word-missing"_id,
                  fmt::format("{} without CCA", code.code->name()),
                  "give the angle of the arc, for example CCA90");
    }
    if (!(words['i'].value > 0.0 && words['i'].value <= kWholeTurn)) {
      return fail(state, words['i'].column, "out-of-range"_id,
                  fmt::format("{} is out of range", words.text_of('i')),
                  "the angle is above 0 and up to 360 degrees");
    }
    link.angle = words['i'].value * kRadPerDeg;
  }
  return link;
}

Outcome approach_contour(InterpreterState& state, MotionFilters& filters, const BlockWords& words,
                         const std::optional<Feed>& feed_before) {
  const GivenCode& code = words[CodeGroup::approach];
  const auto link = link_of(state, words);
  if (!link) return link.error();
  Approach approach{.name = code.code->name(), .link = *link};
  approach.from = state.position.target();
  for (const AxisLetter axis : {X, Y}) {
    if (approach.from[axis]) continue;
    return fail(state, code.column, state.position.unknown_id(axis),
                fmt::format("{} begins where the tool is, but {}", code.code->name(),
                            state.position.why_unknown(axis)),
                "move to its start by L before, with X and Y without I");
  }
  if (auto done = set_targets(state, words); !done) return done;
  const Movement movement{NonModal::none, MotionMode::linear, code.column};
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  approach.contour = state.position.target();
  approach.side = state.modes.tool_side;
  if (filters.radius.is_on()) {
    approach.compensation = filters.radius.setting();
    approach.radius = approach.compensation->radius;
  }
  approach.feed_before = feed_before;
  const bool rapid = words.has('d');
  if (!rapid) {
    const auto feed = feed_for(state, words, movement, true);
    if (!feed) return feed.error();
    approach.feed = *feed;
  }
  // The line to the arc has the feed of the block.
  if (link->shape == ApproachWord::line_and_arc) approach.feed_before = approach.feed;
  if (rapid && link->shape >= ApproachWord::arc) {
    return fail(state, code.column, "word-misplaced"_id,
                fmt::format("{} with FMAX", code.code->name()), "give an arc a feed");
  }
  approach.tool_axis = state.modes.tool_axis;
  approach.place = state.at_work.place_of(code.column);
  if (words.has('Z')) {
    assume(state, words['Z'].column, "APPR Z",
           "the tool goes in the plane first, then down; newer controls do both at once");
  }
  state.contour_exit = {};
  state.modes.heading.reset();
  filters.approach.begin(approach);
  return Done{};
}

Outcome leave_contour(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::approach];
  const auto link = link_of(state, words);
  if (!link) return link.error();
  const auto& heading = state.modes.heading;
  if (!heading || !state.position[X] || !state.position[Y]) {
    return fail(state, code.column, "contour-approach"_id,
                fmt::format("{} leaves no contour", code.code->name()),
                "write it right after the moves of the contour in X and Y");
  }
  const Vec2 along = heading->along.head<2>().normalized();
  const auto side_given = state.modes.tool_side;
  Vec2 contour(*state.position[X], *state.position[Y]);
  filters.corners.release(filters.to_radius);
  if (const auto centre = stop_radius_compensation(state, filters, code.column)) contour = *centre;
  state.contour_exit = {};
  AxisTarget at = state.position.target();
  if (auto done = set_targets(state, words); !done) return done;
  const Vec2 to(*state.position[X], *state.position[Y]);
  const double here = left_of(along).dot(to - contour);
  if (!side_given && link->shape != ApproachWord::leave_along &&
      link->shape != ApproachWord::leave_by_arc_and_line) {
    return fail(state, code.column, "contour-approach"_id,
                fmt::format("{} without radius compensation", code.code->name()),
                "the side that the tool leaves to is that of RL or RR; use DEP LT or DEP LCT");
  }
  const double side =
      side_given ? (*side_given == ToolSide::left ? 1.0 : -1.0) : (here < 0.0 ? -1.0 : 1.0);
  const auto moves = moves_from_contour(*link, contour, along, to, side);
  if (!moves) {
    return fail(state, code.column, "contour-approach"_id,
                fmt::format("{} ends within the circle of its arc", code.code->name()),
                "end further away, or give a smaller radius: no line touches the arc there");
  }
  const Movement movement{NonModal::none, MotionMode::linear, code.column};
  const bool rapid = words.has('d');
  std::optional<Feed> feed;
  if (!rapid) {
    const auto given = feed_for(state, words, movement, true);
    if (!given) return given.error();
    feed = *given;
  }
  const auto straight = [&] {
    if (feed) {
      emit(state, code.column, LinearFeed{at, state.modes.tool_axis, Coordinates::program, *feed});
    } else {
      emit(state, code.column, Traverse{at, state.modes.tool_axis, Coordinates::program});
    }
  };
  for (const LinkMove& move : *moves) {
    at[X] = move.piece.end.x();
    at[Y] = move.piece.end.y();
    if (!move.piece.is_arc()) {
      straight();
    } else if (feed) {
      const Vec3 centre(move.piece.centre.x(), move.piece.centre.y(), at[Z].value_or(0.0));
      emit(state, code.column,
           ArcFeed{at, centre, Plane::xy, move.piece.turns, state.modes.tool_axis, *feed});
    } else {
      return fail(state, code.column, "word-misplaced"_id,
                  fmt::format("{} with FMAX", code.code->name()), "give an arc a feed");
    }
  }
  state.position.set(X, *at[X]);
  state.position.set(Y, *at[Y]);
  state.modes.heading.reset();
  const AxisTarget end = state.position.target();
  if (end == at) return Done{};
  if (words.has('Z')) {
    assume(state, words['Z'].column, "DEP Z",
           "the tool goes in the plane first, then up; newer controls do both at once");
  }
  at = end;
  straight();
  return Done{};
}

}  // namespace

Outcome check_approach(const InterpreterState& state, const MotionFilters& filters,
                       const BlockWords& words) {
  const auto& waits = filters.approach.approach();
  if (!waits) return Done{};
  for (std::uint64_t groups = words.groups(); groups != 0; groups &= groups - 1) {
    const auto group = static_cast<CodeGroup>(std::countr_zero(groups));
    const GivenCode& code = words[group];
    const bool pole = group == CodeGroup::non_modal &&
                      words.value_or(CodeGroup::non_modal, NonModal::none) == NonModal::pole;
    if (code.code == nullptr || code.code->event || pole ||
        std::find(kBeforeContour.begin(), kBeforeContour.end(), group) != kBeforeContour.end()) {
      continue;
    }
    return fail(state, code.column, "contour-approach"_id,
                fmt::format("{} between {} and the contour", code.code->name(), waits->name),
                "write the moves of the contour right after the approach");
  }
  return Done{};
}

Outcome approach_or_leave_contour(InterpreterState& state, MotionFilters& filters,
                                  const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::approach];
  if (code.code == nullptr) return Done{};
  if (is_departure(static_cast<ApproachWord>(code.code->value))) {
    return leave_contour(state, filters, words);
  }
  return approach_contour(state, filters, words, filters.approach.last_feed());
}

Outcome check_approach_at_end(const MotionFilters& filters) {
  const auto& waits = filters.approach.approach();
  if (!waits) return Done{};
  Diagnostic open = error("contour-approach"_id, waits->name + " with no contour after it",
                          "write the moves of the contour after it, or leave it out");
  open.line = static_cast<int>(waits->place.line);
  open.column = static_cast<int>(waits->place.column);
  return open;
}

}  // namespace frustum::parser
