#include "parser/interpret/feed_and_tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/language/letter_set.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxTool = 99'999'999;

// The offset behind the point of T1.1. T10.10 has the value of T10.1: a number that is written
// twice is meant.
std::optional<int> offset_behind_point(double number) {
  constexpr double kMostTools = 1000.0;
  constexpr double kNear = 1e-9;
  if (number <= 0.0 || number >= kMostTools || number == std::floor(number)) return std::nullopt;
  const double tool = std::floor(number);
  const double offset_places = tool < 10.0 ? 10.0 : tool < 100.0 ? 100.0 : 1000.0;
  if (std::abs(number - tool - tool / offset_places) < kNear) return static_cast<int>(tool);
  const double tenths = (number - tool) * 10.0;
  if (std::abs(tenths - std::round(tenths)) > kNear) return std::nullopt;
  return static_cast<int>(std::round(tenths));
}

// T1.1 of Fagor and others: the tool and its offset, which is in force as by H and D.
Result<int> tool_number(InterpreterState& state, const BlockWords& words) {
  const double number = words['T'].value;
  const auto offset =
      state.rules.dialect == Dialect::fanuc ? offset_behind_point(number) : std::nullopt;
  if (!offset) return whole(state, words, 'T', 0, kMaxTool);
  assume(state, words['T'].column, "tool with offset",
         fmt::format("{}: tool {:g}, and behind the point its offset", words.text_of('T'),
                     std::floor(number)));
  state.modes.length_number = state.modes.radius_number = *offset;
  if (state.modes.tool_order == ToolOrder::not_known) {
    state.modes.tool_order = ToolOrder::behind_change;
  }
  return static_cast<int>(number);
}

// A feed that only the machine knows, as that of a material of plasma cutting.
void take_unknown_feed(InterpreterState& state, const BlockWords& words) {
  constexpr double kFeed = 1000.0;  // mm/min
  for (const GivenCode& word : words.vacant()) {
    const auto& written = state.at_work.block->words;
    const bool is_feed = std::any_of(written.begin(), written.end(), [&](const Word& w) {
      return w.column == word.column && w.letter == 'F';
    });
    if (!is_feed) continue;
    assume(state, word.column, "feed",
           fmt::format("a value that only the machine knows: {:g} mm/min taken", kFeed));
    state.modes.feed = FeedWord{kFeed / feed_scale(state, state.modes.feed_mode), kFeed};
  }
}

// The number that a tool with a name goes by: the name, where that is one and tools have no numbers
// beside their names; that of the tool whose name it is; else the first that is free. Names are the
// same in capitals and small letters.
Result<int> tool_named(InterpreterState& state, const GivenWord& word) {
  constexpr int kFirstNamedTool = 1001;
  constexpr std::size_t kMostDigits = 8;
  const std::string& given = state.parameters.text_of(word.value);
  const bool counts = !state.rules.tools_are_named_beside_numbers;
  const bool digits = counts && !given.empty() && given.size() <= kMostDigits &&
                      given.find_first_not_of("0123456789") == std::string::npos;
  if (digits) return std::stoi(given);
  if (given.empty()) return 0;
  const std::string name = upper_case(given);
  const auto known = state.data.tool_names.find(name);
  if (known != state.data.tool_names.end()) return known->second;
  std::vector<int> found;
  for (const auto& [number, tool] : state.data.tools) {
    if (upper_case(tool.remark) == name) found.push_back(number);
  }
  if (found.size() > 1) {
    return fail(state, word.column, "tool-name"_id,
                fmt::format("\"{}\" is the name of tools {} and {}", given, found[0], found[1]),
                "give each tool its own name, or call it by its number");
  }
  int number = found.empty() ? kFirstNamedTool : found.front();
  const auto taken = [&] {
    return state.data.tools.contains(number) ||
           std::ranges::any_of(state.data.tool_names,
                               [&](const auto& tool) { return tool.second == number; });
  };
  while (found.empty() && taken()) ++number;
  state.data.tool_names.emplace(name, number);
  if (!found.empty()) return number;
  emit(state, word.column,
       Event{"tool_name", fmt::format("{} is tool {}", given, number), EventGrade::assumed});
  return number;
}

// DL: the control takes the tool for longer than it is. Until Z is programmed again the axis is
// where it was.
Outcome lengthen_tool(InterpreterState& state, const BlockWords& words) {
  const bool given = words.has('U') && state.rules.always_claimed.has('U');
  if (!given && !words.has(CodeGroup::tool_change)) return Done{};
  const double length = given ? length_of(state, words['U'].value) : 0.0;
  if (length != 0.0 && state.modes.tilted) {
    return fail(state, words['U'].column, "not-supported"_id,
                words.text_of('U') + " in a tilted plane is not simulated",
                "give the tool's true length in the job");
  }
  if (std::exchange(state.modes.tool_lengthening, length) != length) {
    forget(state, LetterSet("Z"), PositionLoss::length_compensation);
  }
  return Done{};
}

// T behind M6, in a block of its own: the tool of that change.
bool comes_behind_change(const InterpreterState& state, const BlockWords& words) {
  return words.has('T') && state.modes.tool_order == ToolOrder::behind_change;
}

// M6 with no tool prepared by the program, or with the T behind it.
Outcome change_before_tool(InterpreterState& state, const GivenCode& change) {
  if (state.modes.tool_order == ToolOrder::behind_change) return Done{};
  if (!state.rules.first_tool_may_be_prepared) {
    return fail(state, change.column, "tool-missing"_id, change.code->name() + " without a tool",
                "give T on this block or before");
  }
  assume(
      state, change.column, "tool before T",
      fmt::format("{} before any T: the tool that the operator has prepared, unless the T behind "
                  "it gives one with its offset (T1.1)",
                  change.code->name()));
  state.modes.tool_order = ToolOrder::not_known;
  return Done{};
}

// Most machines change tools at a place of their own, and stay there. Where Z has been sent home or
// to a place of the machine, that is the place.
void lose_height(InterpreterState& state) {
  const ProgramPosition& position = state.position;
  const std::optional<double> height = position.programmed(AxisLetter::Z)
                                           ? position.programmed(AxisLetter::Z)
                                           : position[AxisLetter::Z];
  if (!height && position.standing(AxisLetter::Z)) return;
  const bool by_axes = !state.modes.tool_centre_point() && !state.modes.tilted;
  forget(state, by_axes ? LetterSet("Z") : kLinearWords, PositionLoss::tool_change);
  state.position.keep_tool_change({state.at_work.block->line, height});
}

Outcome change_tool(InterpreterState& state, const BlockWords& words) {
  const GivenCode& change = words[CodeGroup::tool_change];
  const std::uint32_t column = change.code != nullptr ? change.column : words['T'].column;
  const bool waits = state.modes.tool_order == ToolOrder::behind_change && !words.has('T');
  const bool known = state.modes.selected_tool && !waits;
  if (!known) {
    if (auto done = change_before_tool(state, change); !done) return done;
  }
  if (state.modes.spindle != SpindleDirection::off && change.code != nullptr) {
    state.modes.spindle = SpindleDirection::off;
    emit(state, column, SpindleChange{state.modes.spindle, state.modes.spindle_speed});
  }
  // TOOL CALL of the tool that is in the spindle gives it another speed.
  const bool called_again =
      known && state.rules.tool_brings_length && state.modes.tool == *state.modes.selected_tool;
  if (!state.rules.tool_change_keeps_place && !called_again) lose_height(state);
  if (!known) return Done{};
  state.modes.tool = state.data.tool = *state.modes.selected_tool;
  emit(state, column, ToolChange{state.modes.tool, state.rules.tool_change_keeps_place});
  return Done{};
}

}  // namespace

Outcome set_feed(InterpreterState& state, const BlockWords& words) {
  const auto mode = words.value_or(CodeGroup::feed_mode, state.modes.feed_mode);
  // LinuxCNC: G94 and G95 end the feed, also of the same mode.
  const bool again = state.rules.dialect == Dialect::linuxcnc && words.has(CodeGroup::feed_mode);
  if (again || mode != state.modes.feed_mode) state.modes.feed.reset();
  state.modes.feed_mode = mode;
  if (const GivenCode& source = words[CodeGroup::feed_source]; source.code != nullptr) {
    if (!state.modes.tool_feed) {
      return fail(state, source.column, "tool-feed-missing"_id,
                  source.code->name() + " without a feed in the tool call",
                  "give F in TOOL CALL, or a number here");
    }
    state.modes.feed = state.modes.tool_feed;
  }
  if (state.parameters.rules().values_may_be_unknown) take_unknown_feed(state, words);
  if (!words.has('F')) return Done{};
  const double feed = words['F'].value;
  state.modes.feed_was_given = true;
  if (feed < 0.0) {
    return fail(state, words['F'].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of('F')), "give a feed above zero");
  }
  state.modes.feed =
      feed > 0.0 ? std::optional(FeedWord{feed, feed * feed_scale(state, mode)}) : std::nullopt;
  // F AUTO comes back to that of the tool.
  if (state.rules.tool_brings_feed && words.has(CodeGroup::tool_change))
    state.modes.tool_feed = state.modes.feed;
  return Done{};
}

Outcome set_tool(InterpreterState& state, const BlockWords& words) {
  if (words.has('T') && is_text(words['T'].value)) {
    const auto tool = tool_named(state, words['T']);
    if (!tool) return tool.error();
    state.modes.selected_tool = *tool;
  } else if (words.has('T')) {
    const auto tool = tool_number(state, words);
    if (!tool) return tool.error();
    if (auto done = check_tool_exists(state, *tool, words['T'].column); !done) return done;
    state.modes.selected_tool = *tool;
  }
  if (words.has('T') && state.modes.tool_order == ToolOrder::not_known) {
    state.modes.tool_order = ToolOrder::before_change;
  }
  const GivenCode& change = words[CodeGroup::tool_change];
  if (change.code != nullptr) state.modes.tool_oversize = 0.0;
  if (words.has('j') && state.rules.always_claimed.has('j')) {
    state.modes.tool_oversize = length_of(state, words['j'].value);
  }
  if (auto done = lengthen_tool(state, words); !done) return done;
  if (words.value_or(CodeGroup::tool_change, ToolWord::change) == ToolWord::is) {
    if (!words.has('Q')) {
      return fail(state, change.column, "tool-missing"_id, change.code->name() + " without a tool",
                  fmt::format("give the tool that is in the spindle, for example {} Q1",
                              change.code->name()));
    }
    const auto tool = whole(state, words, 'Q', 0, kMaxTool);
    if (!tool) return tool.error();
    if (auto done = check_tool_exists(state, *tool, words['Q'].column); !done) return done;
    state.modes.tool = state.data.tool = *tool;
    emit(state, change.column, ToolChange{state.modes.tool, true});
  } else if (change.code != nullptr || comes_behind_change(state, words)) {
    return change_tool(state, words);
  }
  return Done{};
}

void set_spindle_and_coolant(InterpreterState& state, const BlockWords& words, bool speed) {
  const GivenCode& spindle = words[CodeGroup::spindle];
  if (spindle.code != nullptr || (speed && state.modes.spindle != SpindleDirection::off)) {
    state.modes.spindle = words.value_or(CodeGroup::spindle, state.modes.spindle);
    emit(state, spindle.code != nullptr ? spindle.column : words['S'].column,
         SpindleChange{state.modes.spindle, state.modes.spindle_speed});
  }
  const GivenCode& coolant = words[CodeGroup::coolant];
  if (coolant.code != nullptr && !coolant.code->event) {
    state.modes.flood = static_cast<CoolantWord>(coolant.code->value) == CoolantWord::flood;
    emit(state, coolant.column, CoolantChange{state.modes.flood});
  }
}

Outcome dwell(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  const DwellWord* given = nullptr;
  for (const DwellWord& word : state.rules.dwell) {
    if (!words.has(word.letter)) continue;
    if (given != nullptr) {
      return fail(
          state, words[word.letter].column, "dwell-time"_id,
          fmt::format("{} has both {} and {}", code.code->name(), given->letter, word.letter),
          "give one time");
    }
    given = &word;
  }
  if (given == nullptr) {
    return fail(state, code.column, "dwell-time"_id, code.code->name() + " without a time",
                std::string(state.rules.dwell_hint));
  }
  const GivenWord& time = words[given->letter];
  if (time.value < 0.0) {
    return fail(state, time.column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(given->letter)),
                "a dwell takes a time that is not negative");
  }
  if (given->unit == DwellUnit::revolutions && state.modes.spindle_speed <= 0.0) {
    return fail(state, time.column, "dwell-without-speed"_id,
                "a dwell in revolutions with no spindle speed", "give a spindle speed before");
  }
  const bool milliseconds =
      given->unit == DwellUnit::milliseconds_without_point && !time.decimal_point;
  emit(state, code.column,
       Dwell{milliseconds ? time.value / kMillisecondsPerSecond
             : given->unit == DwellUnit::revolutions
                 ? time.value * kSecondsPerMinute / state.modes.spindle_speed
                 : time.value});
  return Done{};
}

Result<bool> set_speed(InterpreterState& state, const BlockWords& words, bool counts) {
  const bool any_speed = words.has('S') && counts;
  if (any_speed && words['S'].value < 0.0) {
    return fail(state, words['S'].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of('S')),
                "give the direction by M3 or M4 and a speed that is not negative");
  }
  state.modes.surface_speed =
      words.value_or(CodeGroup::speed_mode,
                     state.modes.surface_speed ? SpeedWord::surface : SpeedWord::revolutions) ==
      SpeedWord::surface;
  const bool speed = any_speed && !state.modes.surface_speed;
  if (any_speed && state.modes.surface_speed) {
    emit(state, words['S'].column, Event{"surface_speed", words.text_of('S')});
  } else if (speed) {
    state.modes.spindle_speed = words['S'].value;
  }
  return speed;
}

}  // namespace frustum::parser
