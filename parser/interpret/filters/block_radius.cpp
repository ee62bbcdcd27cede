// Cutter radius compensation in a program: its words, what may not happen while it is on, and how
// it ends.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "parser/arc.hpp"
#include "parser/interpret/block_executor.hpp"

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

bool leaves_contour(NonModal word) {
  return word != NonModal::none && word != NonModal::dwell && !is_pole(word);
}

std::string_view off_word(Dialect dialect) { return dialect == Dialect::heidenhain ? "R0" : "G40"; }

}  // namespace

BlockExecutor::Outcome BlockExecutor::check_radius_compensation(const BlockWords& words,
                                                                const Movement& movement) const {
  const GivenCode& given = words[CodeGroup::radius_compensation];
  const auto word = words.value_or(CodeGroup::radius_compensation,
                                   radius_.is_on() ? RadiusWord::left : RadiusWord::off);
  if (word == RadiusWord::off) return Done{};
  const auto refuse = [&](const GivenCode& code) {
    return fail(
        code.column, "radius-compensation"_id,
        fmt::format("{} with radius compensation on", code.code->name()),
        fmt::format("switch it off before, by {} and a straight move", off_word(rules_.dialect)));
  };
  const GivenCode& non_modal = words[CodeGroup::non_modal];
  if (non_modal.code != nullptr && leaves_contour(static_cast<NonModal>(non_modal.code->value))) {
    return refuse(non_modal);
  }
  if (movement.motion > MotionMode::arc_tangential) {
    return fail(
        movement.column, "radius-compensation"_id,
        fmt::format("{} with radius compensation on", is_cycle(movement.motion) ? "a canned cycle"
                                                      : is_spline(movement.motion) ? "a spline"
                                                      : movement.motion == MotionMode::arc_through
                                                          ? "an arc through a point"
                                                          : "a thread or a probing move"),
        fmt::format("switch it off before, by {}", off_word(rules_.dialect)));
  }
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(words[rotary].column, "radius-compensation"_id,
                fmt::format("{} with radius compensation on", words.text_of(rotary)),
                "turn the axes before it is switched on");
  }
  if (!radius_.is_on()) {
    for (const CodeGroup group : {CodeGroup::scaling, CodeGroup::mirror}) {
      if (words.has(group)) return refuse(words[group]);
    }
    if (!guides_tip(words)) return Done{};
    return fail(given.column, "radius-compensation"_id, "radius compensation with tool-tip control",
                "switch one of them off; with tool vectors the path is that of the tool's tip");
  }
  for (const CodeGroup group : kGroupsOff) {
    if (words.has(group)) return refuse(words[group]);
  }
  if (words.has('D') && rules_.always_claimed.has('D')) {
    return fail(words['D'].column, "radius-compensation"_id,
                fmt::format("{} with radius compensation on", words.text_of('D')),
                "choose the tool's edge before it is switched on");
  }
  if (words.value_or(CodeGroup::plane, state_.plane) != state_.plane) {
    return refuse(words[CodeGroup::plane]);
  }
  return Done{};
}

// The radius, below zero for a tool of negative diameter.
Result<double> BlockExecutor::radius_for(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::radius_compensation];
  const std::string name = code.code->name();
  const auto word = static_cast<RadiusWord>(code.code->value);
  if (words.has('L')) {
    const auto shape = whole(words, 'L', kCentred, kCentredToo);
    if (!shape) return shape.error();
    if (*shape != kCentred && *shape != kCentredToo) {
      return fail(words['L'].column, "not-simulated"_id,
                  fmt::format("{} is not simulated", words.text_of('L')),
                  "shapes of lathe tools are not simulated; leave L out");
    }
  }
  if (word == RadiusWord::left_by_diameter || word == RadiusWord::right_by_diameter) {
    if (!words.has('D'))
      return fail(code.column, "radius-number-missing"_id, name + " without D",
                  "give the diameter by D");
    return words['D'].value / 2.0 * unit_scale();
  }
  const bool has_d = words.has('D') && code.code->arguments.has('D');
  int number = state_.tool;
  if (has_d) {
    const auto given = whole(words, 'D', 0, kMaxToolNumber);
    if (!given) return given.error();
    number = *given;
    state_.radius_number = number;
  } else if (rules_.radius.source == RadiusSource::last_d) {
    if (!state_.radius_number) {
      return fail(code.column, "radius-number-missing"_id, name + " without D",
                  fmt::format("give the number of the offset, for example {} D1", name));
    }
    number = *state_.radius_number;
  } else if (number == 0) {
    return fail(code.column, "radius-number-missing"_id, name + " without a tool in the spindle",
                has_d ? "" : "call the tool before, by its number");
  }
  const std::uint32_t column = has_d ? words['D'].column : code.column;
  const auto tool = data_.tools.find(number);
  if (tool == data_.tools.end()) {
    return fail(column, "radius-compensation"_id,
                fmt::format("the tool table has no tool {}", number),
                "give the tool's diameter in the tool table");
  }
  return tool->second.diameter / 2.0;
}

BlockExecutor::Outcome BlockExecutor::set_radius_compensation(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::radius_compensation];
  if (code.code == nullptr) return Done{};
  const auto word = static_cast<RadiusWord>(code.code->value);
  if (word == RadiusWord::off) {
    switch_radius_off(code.column);
    return Done{};
  }
  if (!rules_.radius.in_yz && state_.plane == Plane::yz) {
    return fail(code.column, "radius-plane"_id, code.code->name() + " in G19",
                "radius compensation works in G17 and G18");
  }
  const auto radius = radius_for(words);
  if (!radius) return radius.error();
  if (*radius == 0.0) {
    return fail(words.has('D') ? words['D'].column : code.column, "radius-compensation"_id,
                code.code->name() + " with a tool of no diameter",
                "give the tool's diameter, or leave radius compensation out");
  }
  const bool left =
      (word == RadiusWord::left || word == RadiusWord::left_by_diameter) == (*radius > 0.0);
  const ToolSide side = left ? ToolSide::left : ToolSide::right;
  // The path is made in words, which the frame scales.
  const double in_words = std::abs(*radius) / state_.programmed_frame.scale;
  if (radius_.is_on()) {
    const bool same = radius_.setting().side == side && radius_.setting().radius == in_words;
    if (same && rules_.radius.may_be_repeated) return Done{};
    return fail(
        code.column, "radius-compensation"_id,
        fmt::format("{} while radius compensation is on, since line {}", code.code->name(),
                    radius_place_.line),
        fmt::format("switch it off before, by {} and a straight move", off_word(rules_.dialect)));
  }
  if (!state_.programmed_frame.keeps(state_.plane) || !state_.offset_frame.keeps(state_.plane)) {
    return fail(code.column, "radius-plane"_id,
                code.code->name() + " in a plane that the frame turns",
                "turn the frame about the normal of the plane");
  }
  radius_place_ = block_->place_of(code.column);
  state_.tool_side = side;
  AxisTarget from = position_.target();
  // Another contour may begin before the tool has left the last one: it comes from where it is.
  for (const AxisLetter axis : kAxisLetters) {
    if (radius_exit_[axis]) from[axis] = radius_exit_[axis];
  }
  radius_exit_ = {};
  arc_waits_for_exit_ = false;
  emit(code.column,
       Event{"radius_compensation", fmt::format("{} of the contour, radius {:.9g} mm",
                                                left ? "left" : "right", std::abs(*radius))});
  radius_.start({side, in_words, state_.plane, rules_.radius}, from);
  return Done{};
}

void BlockExecutor::switch_radius_off(std::uint32_t column) {
  if (!radius_.is_on()) return;
  state_.tool_side.reset();
  const Plane plane = radius_.setting().plane;
  const auto centre = radius_.stop(to_sink_);
  emit(column, Event{"radius_compensation", "off"});
  if (!centre) return;
  arc_waits_for_exit_ = true;
  if (rules_.radius.any_move_leaves) return;
  const PlaneAxes axes = axes_of(plane);
  radius_exit_[static_cast<AxisLetter>(axes.u)] = centre->x();
  radius_exit_[static_cast<AxisLetter>(axes.v)] = centre->y();
}

BlockExecutor::Outcome BlockExecutor::end_radius_compensation(const SourcePlace& place) {
  if (!radius_.is_on()) return Done{};
  if (rules_.radius.ends_with_program) {
    state_.tool_side.reset();
    radius_.stop(to_sink_);
    return Done{};
  }
  Diagnostic failure = error(
      "radius-compensation"_id,
      fmt::format("radius compensation, on since line {}, is still on at the end of the program",
                  radius_place_.line),
      fmt::format("leave the contour by {} and a straight move", off_word(rules_.dialect)));
  failure.line = static_cast<int>(place.line);
  failure.column = static_cast<int>(place.column);
  return failure;
}

BlockExecutor::Outcome BlockExecutor::end_of_text() {
  if (const auto& corner = corners_.corner()) {
    Diagnostic open = error("corner-without-move"_id, corner->name + " with no move behind it",
                            "write an L or C block behind it, or leave it out");
    open.line = static_cast<int>(corner->place.line);
    open.column = static_cast<int>(corner->place.column);
    return open;
  }
  corners_.release(to_radius_);
  if (auto failure = spline_without_end()) return *failure;
  return end_radius_compensation(radius_place_);
}

// Behind G40 the tool stays beside the contour until a move in the plane.
AxisTarget BlockExecutor::leaving_contour(const BlockWords& words, AxisTarget end) {
  const bool polar = !(words.given() & rules_.polar_words).empty();
  bool leaves = polar || rules_.radius.any_move_leaves;
  for (const AxisLetter axis : kAxisLetters) {
    if (radius_exit_[axis] && words.has(to_char(axis))) leaves = true;
  }
  if (leaves) {
    radius_exit_ = {};
    arc_waits_for_exit_ = false;
    return end;
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (radius_exit_[axis]) end[axis] = radius_exit_[axis];
  }
  return end;
}

}  // namespace frustum::parser
