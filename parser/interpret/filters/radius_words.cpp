#include "parser/interpret/filters/radius_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "parser/arc.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxToolNumber = 99'999;

// Where a mill's centre is its control point; other values are the shapes of lathe tools.
constexpr int kCentred = 0;

constexpr int kCentredToo = 9;

// What changes the tool, the coordinates or the plane under a contour.
constexpr std::array kGroupsOff{CodeGroup::length_compensation,
                                CodeGroup::tool_tip,
                                CodeGroup::work_offset,
                                CodeGroup::tilted_plane,
                                CodeGroup::tool_change,
                                CodeGroup::scaling,
                                CodeGroup::mirror,
                                CodeGroup::hole_call,
                                CodeGroup::drilling_cycle};

// M97, M98 and M197 of Klartext.
constexpr std::array kAtCorners{970, 980, 1970};

bool leaves_contour(NonModal word) {
  return word != NonModal::none && word != NonModal::dwell && !is_pole(word);
}

std::string_view off_word(Dialect dialect) { return dialect == Dialect::heidenhain ? "R0" : "G40"; }

// The edge that follows the contour.
struct ToolEdge {
  double radius = 0.0;  // below zero for a tool of negative diameter
  int orientation = kCentred;
};

// Where the control point of a lathe tool is, from the centre of its edge, in radii along Z and X.
Vec2 control_point(int orientation) {
  constexpr std::array<std::array<int, 2>, 10> kPoints{
      {{0, 0}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}, {0, 0}}};
  const auto& point = kPoints.at(static_cast<std::size_t>(orientation));
  return {point[0], point[1]};
}

// Neither setup nor program has given the diameter of any tool; else one that is not there is
// missing.
bool diameters_are_unknown(const InterpreterState& state) {
  return std::ranges::none_of(state.data.tools,
                              [](const auto& tool) { return tool.second.has_diameter; });
}

Result<ToolEdge> edge_for(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::radius_compensation];
  const std::string name = code.code->name();
  const auto word = static_cast<RadiusWord>(code.code->value);
  int orientation = kCentred;
  if (words.has('L')) {
    const auto shape = whole(state, words, 'L', kCentred, kCentredToo);
    if (!shape) return shape.error();
    orientation = *shape;
  }
  if (word == RadiusWord::left_by_diameter || word == RadiusWord::right_by_diameter) {
    if (!words.has('D'))
      return fail(state, code.column, "radius-number-missing"_id, name + " without D",
                  "give the diameter by D");
    return ToolEdge{length_of(state, words['D'].value) / 2.0, orientation};
  }
  const bool has_d = words.has('D') && code.code->arguments.has('D');
  const bool of_linuxcnc = state.rules.dialect == Dialect::linuxcnc;
  int number = state.modes.tool;
  const bool has_h = h_is_of_radius(state, words);
  if (has_h) {
    assume(state, words['H'].column, "radius number",
           fmt::format("H beside {} is the number of the radius, and not of a length", name));
  }
  if (has_d || has_h) {
    const auto given = whole(state, words, has_h ? 'H' : 'D', 0, kMaxToolNumber);
    if (!given) return given.error();
    // D0 of LinuxCNC is the tool in the spindle.
    if (*given != 0 || !of_linuxcnc) number = *given;
    state.modes.radius_number = number;
  } else if (state.rules.radius.source == RadiusSource::last_d) {
    if (!state.modes.radius_number && diameters_are_unknown(state)) return ToolEdge{};
    if (!state.modes.radius_number) {
      return fail(state, code.column, "radius-number-missing"_id, name + " without D",
                  fmt::format("give the number of the offset, for example {} D1", name));
    }
    number = *state.modes.radius_number;
  } else if (number == 0 && !of_linuxcnc) {
    return fail(state, code.column, "radius-number-missing"_id,
                name + " without a tool in the spindle",
                has_d ? "" : "call the tool before, by its number");
  }
  const std::uint32_t column = has_d ? words['D'].column : code.column;
  const auto tool = state.data.tools.find(number);
  const bool open = number == 0 || diameters_are_unknown(state);
  if (open && state.rules.offset_numbers_stand_alone) return ToolEdge{};
  // No tool has no diameter.
  if (tool == state.data.tools.end() && number == 0 && of_linuxcnc) return ToolEdge{};
  if (tool == state.data.tools.end() || !tool->second.has_diameter) {
    const char* by_program = state.rules.dialect == Dialect::fanuc ? ", or by G10 L12" : "";
    return fail(state, column, "radius-compensation"_id,
                fmt::format("nothing gives the diameter of tool {}", number),
                fmt::format("give it by --tool-diameter {}=MM, a job or a tool table (--tools){}",
                            number, by_program));
  }
  const double diameter = tool->second.diameter + tool->second.diameter_wear;
  return ToolEdge{diameter / 2.0 + state.modes.tool_oversize, tool->second.orientation};
}

// Whether a tool without diameter may follow a contour.
bool may_be_point(const InterpreterState& state) {
  return state.rules.dialect == Dialect::linuxcnc || state.rules.dialect == Dialect::heidenhain;
}

void switch_radius_off(InterpreterState& state, MotionFilters& filters, std::uint32_t column) {
  const auto centre = stop_radius_compensation(state, filters, column);
  if (!centre) return;
  const PlaneAxes axes = axes_of(state.modes.plane);
  state.contour_exit.arc_waits = true;
  if (state.rules.radius.any_move_leaves) return;
  state.contour_exit.place[static_cast<AxisLetter>(axes.u)] = centre->x();
  state.contour_exit.place[static_cast<AxisLetter>(axes.v)] = centre->y();
}

// There is no diameter to compensate by, and the setup knows none: the contour itself is the path.
bool goes_along_contour(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::radius_compensation];
  const auto word = static_cast<RadiusWord>(code.code->value);
  const bool by_word =
      word == RadiusWord::left_by_diameter || word == RadiusWord::right_by_diameter;
  if (!state.data.contours_without_diameter || by_word) return false;
  if (!diameters_are_unknown(state)) return false;
  int number = state.modes.tool;
  if (words.has('D') && code.code->arguments.has('D')) {
    number = static_cast<int>(words['D'].value);
  } else if (h_is_of_radius(state, words)) {
    number = static_cast<int>(words['H'].value);
  } else if (state.rules.radius.source == RadiusSource::last_d) {
    number = state.modes.radius_number.value_or(-1);
  }
  if (number > 0) state.modes.radius_number = number;
  const bool left = word == RadiusWord::left || word == RadiusWord::left_in_space;
  state.modes.tool_side = left ? ToolSide::left : ToolSide::right;
  assume(state, code.column, "contour-without-diameter",
         fmt::format("the diameter of tool {} is not known: the tool's centre goes along the "
                     "programmed contour",
                     number));
  return true;
}

}  // namespace

Outcome check_radius_compensation(const InterpreterState& state, const MotionFilters& filters,
                                  const BlockWords& words, const Movement& movement) {
  const GivenCode& given = words[CodeGroup::radius_compensation];
  const auto word = words.value_or(CodeGroup::radius_compensation,
                                   filters.radius.is_on() ? RadiusWord::left : RadiusWord::off);
  if (word == RadiusWord::off) return Done{};
  const auto refuse = [&](const GivenCode& code) {
    return fail(state, code.column, "radius-compensation"_id,
                fmt::format("{} with radius compensation on", code.code->name()),
                fmt::format("switch it off before, by {} and a straight move",
                            off_word(state.rules.dialect)));
  };
  const GivenCode& non_modal = words[CodeGroup::non_modal];
  if (non_modal.code != nullptr && leaves_contour(static_cast<NonModal>(non_modal.code->value))) {
    return refuse(non_modal);
  }
  if (movement.motion > MotionMode::arc_tangential) {
    return fail(
        state, movement.column, "radius-compensation"_id,
        fmt::format("{} with radius compensation on", is_cycle(movement.motion) ? "a canned cycle"
                                                      : is_spline(movement.motion) ? "a spline"
                                                      : movement.motion == MotionMode::arc_through
                                                          ? "an arc through a point"
                                                          : "a thread or a probing move"),
        fmt::format("switch it off before, by {}", off_word(state.rules.dialect)));
  }
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(state, words[rotary].column, "radius-compensation"_id,
                fmt::format("{} with radius compensation on", words.text_of(rotary)),
                "turn the axes before it is switched on");
  }
  if (!filters.radius.is_on()) {
    for (const CodeGroup group : {CodeGroup::scaling, CodeGroup::mirror}) {
      if (words.has(group)) return refuse(words[group]);
    }
    if (!guides_tip(state, words)) return Done{};
    return fail(state, given.column, "radius-compensation"_id,
                "radius compensation with tool-tip control",
                "switch one of them off; with tool vectors the path is that of the tool's tip");
  }
  for (const CodeGroup group : kGroupsOff) {
    if (words.has(group)) return refuse(words[group]);
  }
  for (const GivenCode& event : words.events()) {
    if (state.rules.dialect == Dialect::heidenhain &&
        std::find(kAtCorners.begin(), kAtCorners.end(), event.code->tenths) != kAtCorners.end()) {
      return fail(state, event.column, "not-simulated"_id,
                  fmt::format("{} at a contour is not simulated", event.code->name()),
                  "it changes the corners of the path: write them out");
    }
  }
  const bool other_number = state.rules.offset_numbers_stand_alone && given.code == nullptr &&
                            words['D'].value != state.modes.radius_number.value_or(-1);
  if (words.has('D') && (state.rules.always_claimed.has('D') || other_number)) {
    return fail(state, words['D'].column, "radius-compensation"_id,
                fmt::format("{} with radius compensation on", words.text_of('D')),
                other_number ? "end it by G40, and begin it again with the other number"
                             : "choose the tool's edge before it is switched on");
  }
  if (words.value_or(CodeGroup::plane, state.modes.plane) != state.modes.plane) {
    return refuse(words[CodeGroup::plane]);
  }
  return Done{};
}

Outcome set_radius_compensation(InterpreterState& state, MotionFilters& filters,
                                const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::radius_compensation];
  if (code.code == nullptr) return Done{};
  const auto word = static_cast<RadiusWord>(code.code->value);
  if (word == RadiusWord::off) {
    switch_radius_off(state, filters, code.column);
    return Done{};
  }
  if (goes_along_contour(state, words)) return Done{};
  if (!state.rules.radius.in_yz && state.modes.plane == Plane::yz) {
    return fail(state, code.column, "radius-plane"_id, code.code->name() + " in G19",
                "radius compensation works in G17 and G18");
  }
  const auto edge = edge_for(state, words);
  if (!edge) return edge.error();
  const bool in_space = word == RadiusWord::left_in_space || word == RadiusWord::right_in_space;
  if (in_space && edge->radius != 0.0) {
    return fail(state, code.column, "not-simulated"_id, code.code->name() + " is not simulated",
                "use G41 D or G42 D, in a plane");
  }
  const double radius = edge->radius;
  if (radius == 0.0 && state.rules.offset_numbers_stand_alone) {
    const bool none = state.modes.radius_number == 0;
    if (!none && diameters_are_unknown(state)) {
      assume(state, code.column, "cutter radius",
             code.code->name() +
                 " with a radius that only the setup knows: the moves are those of "
                 "the contour");
    }
    return Done{};
  }
  const Vec2 control = control_point(edge->orientation);
  if (control != Vec2::Zero() && state.modes.plane != Plane::zx) {
    return fail(state, words.has('L') ? words['L'].column : code.column, "radius-plane"_id,
                code.code->name() + " with a lathe tool outside G18",
                "the edge of a lathe tool is in the plane of Z and X: G18");
  }
  if (radius == 0.0 && !may_be_point(state)) {
    return fail(state, words.has('D') ? words['D'].column : code.column, "radius-compensation"_id,
                code.code->name() + " with a tool of no diameter",
                "give the tool's diameter, or leave radius compensation out");
  }
  const bool left =
      (word == RadiusWord::left || word == RadiusWord::left_by_diameter) == (radius >= 0.0);
  const ToolSide side = left ? ToolSide::left : ToolSide::right;
  // TOOL DEF 1 L+0 R+0: the contour is that of the tool's centre.
  if (radius == 0.0 && state.rules.dialect == Dialect::heidenhain) {
    state.modes.tool_side = side;
    return Done{};
  }
  // The path is made in words, which the frame scales.
  const double in_words = std::abs(radius) / state.modes.programmed_frame.scale;
  if (filters.radius.is_on()) {
    const bool same =
        filters.radius.setting().side == side && filters.radius.setting().radius == in_words;
    if (same && state.rules.radius.may_be_repeated) return Done{};
    return fail(state, code.column, "radius-compensation"_id,
                fmt::format("{} while radius compensation is on, since line {}", code.code->name(),
                            filters.radius_since.line),
                fmt::format("switch it off before, by {} and a straight move",
                            off_word(state.rules.dialect)));
  }
  if (!state.modes.programmed_frame.keeps(state.modes.plane) ||
      !state.modes.offset_frame.keeps(state.modes.plane)) {
    return fail(state, code.column, "radius-plane"_id,
                code.code->name() + " in a plane that the frame turns",
                "turn the frame about the normal of the plane");
  }
  filters.radius_since = state.at_work.place_of(code.column);
  state.modes.tool_side = side;
  AxisTarget from = state.position.target();
  // Another contour may begin before the tool has left the last one: it comes from where it is.
  for (const AxisLetter axis : kAxisLetters) {
    if (state.contour_exit.place[axis]) from[axis] = state.contour_exit.place[axis];
  }
  state.contour_exit.place = {};
  state.contour_exit.arc_waits = false;
  emit(state, code.column,
       Event{"radius_compensation", fmt::format("{} of the contour, radius {:.9g} mm",
                                                left ? "left" : "right", std::abs(radius))});
  filters.radius.start({side, in_words, state.modes.plane, state.rules.radius, in_words * control},
                       from);
  return Done{};
}

void tell_contour_settings(InterpreterState& state, MotionFilters& filters,
                           const BlockWords& words) {
  // Blocks at rest that each control reads over to find the corner after them.
  constexpr std::uint32_t kReadOver = 1;
  if (state.rules.dialect != Dialect::fanuc) return;
  const ContourDoubts& doubts = filters.radius.doubts();
  const bool moved = std::exchange(filters.contour_moves, doubts.moves) != doubts.moves;
  const bool says = !words.given().empty() || words.groups() != 0 || !words.events().empty();
  if (!moved && filters.radius.waits() && says) ++filters.blocks_at_rest;
  if (!moved && filters.radius.is_on()) return;
  const std::uint32_t at_rest = std::exchange(filters.blocks_at_rest, 0);
  if (!moved) return;
  if (at_rest > kReadOver) {
    assume(state, 1, "look-ahead",
           fmt::format("the control has read this move before the {} blocks without one in the "
                       "plane before it: parameter 6009 (15i) or 19625 (30i) says how many it "
                       "reads over; 16i one, Mitsubishi three",
                       at_rest));
  }
  if (doubts.outside_corner) {
    assume(state, 1, "outside corners",
           "the tool goes round outside corners by arcs, as bit 2 of parameter 5007 has it; else "
           "by straight lines");
  }
  if (doubts.outside_entry) {
    assume(state, 1, "start-up",
           "the contour begins abeam of its start: start-up of type A, parameter 5003#0 (SUP) = 0");
  }
}

std::optional<Vec2> stop_radius_compensation(InterpreterState& state, MotionFilters& filters,
                                             std::uint32_t column) {
  state.modes.tool_side.reset();
  if (!filters.radius.is_on()) return std::nullopt;
  auto centre = filters.radius.stop(filters.to_sink);
  emit(state, column, Event{"radius_compensation", "off"});
  return centre;
}

Outcome end_radius_compensation(InterpreterState& state, MotionFilters& filters,
                                const SourcePlace& place) {
  if (!filters.radius.is_on()) return Done{};
  if (state.rules.radius.ends_with_program) {
    state.modes.tool_side.reset();
    filters.radius.stop(filters.to_sink);
    return Done{};
  }
  Diagnostic failure = error(
      "radius-compensation"_id,
      fmt::format("radius compensation, on since line {}, is still on at the end of the program",
                  filters.radius_since.line),
      fmt::format("leave the contour by {} and a straight move", off_word(state.rules.dialect)));
  failure.line = static_cast<int>(place.line);
  failure.column = static_cast<int>(place.column);
  return failure;
}

}  // namespace frustum::parser
