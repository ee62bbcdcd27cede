// Feed, tool, spindle, coolant and dwell, and the modes that calls keep: what neither moves an axis nor changes a frame.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/units.hpp"
#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxTool = 99'999'999;

}  // namespace

BlockExecutor::Outcome BlockExecutor::set_feed(const BlockWords& words) {
  const auto mode = words.value_or(CodeGroup::feed_mode, state_.feed_mode);
  if (mode != state_.feed_mode) state_.feed.reset();
  state_.feed_mode = mode;
  if (const GivenCode& source = words[CodeGroup::feed_source]; source.code != nullptr) {
    if (!state_.tool_feed) {
      return fail(source.column, "tool-feed-missing"_id,
                  source.code->name() + " without a feed in the tool call",
                  "give F in TOOL CALL, or a number here");
    }
    state_.feed = state_.tool_feed;
  }
  if (!words.has('F')) return Done{};
  const double feed = words['F'].value;
  if (feed < 0.0) {
    return fail(words['F'].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of('F')), "give a feed above zero");
  }
  state_.feed = feed > 0.0 ? std::optional(FeedWord{feed, feed * feed_scale(mode)}) : std::nullopt;
  // F AUTO comes back to that of the tool.
  if (rules_.tool_brings_feed && words.has(CodeGroup::tool_change)) state_.tool_feed = state_.feed;
  return Done{};
}

// Lengths in mm that a feed counts in.
double BlockExecutor::feed_scale(FeedMode mode) const {
  if (state_.unit != LengthUnit::inch || mode == FeedMode::inverse_time) return 1.0;
  return mode == FeedMode::per_minute ? rules_.inch_feed * kMmPerInch : kMmPerInch;
}

Result<std::optional<BlockWords>> BlockExecutor::words_behind_move(BlockWords& words,
                                                                   const Movement& movement) const {
  const bool goes_home =
      movement.non_modal == NonModal::home || movement.non_modal == NonModal::second_home;
  const bool moves =
      movement.motion != MotionMode::none || goes_home || words.has(CodeGroup::hole_call);
  if (!moves || rules_.words_behind_move.empty()) return std::optional<BlockWords>{};
  auto behind = words.set_aside(rules_.words_behind_move);
  if (behind && behind->has(CodeGroup::feed_mode) && words.has('F')) {
    const GivenCode& mode = (*behind)[CodeGroup::feed_mode];
    return fail(words['F'].column, "feed-mode-later"_id,
                fmt::format("{} beside {}, which counts when the move is done", words.text_of('F'),
                            mode.code->name()),
                fmt::format("write {} before, in a block of its own", mode.code->name()));
  }
  return behind;
}

BlockExecutor::Outcome BlockExecutor::set_behind_move(const BlockWords& words) {
  if (auto done = set_feed(words); !done) return done;
  set_spindle_and_coolant(words, false);
  report_events(words);
  if (auto done = set_compensation(words); !done) return done;
  set_paths(words);
  return Done{};
}

// In LinuxCNC the tool table has all the tools there are; T0 is no tool.
BlockExecutor::Outcome BlockExecutor::check_tool_exists(int tool, std::uint32_t column) const {
  const bool listed = rules_.dialect == Dialect::linuxcnc && data_.tools_are_listed;
  if (!listed || tool == 0 || data_.tools.contains(tool)) return Done{};
  return fail(column, "tool-missing"_id, fmt::format("tool {} is not in the tool table", tool),
              fmt::format("add a line T{} to the tool table", tool));
}

BlockExecutor::Outcome BlockExecutor::set_tool(const BlockWords& words) {
  if (words.has('T')) {
    const auto tool = whole(words, 'T', 0, kMaxTool);
    if (!tool) return tool.error();
    if (auto done = check_tool_exists(*tool, words['T'].column); !done) return done;
    state_.selected_tool = *tool;
  }
  const GivenCode& change = words[CodeGroup::tool_change];
  if (words.value_or(CodeGroup::tool_change, ToolWord::change) == ToolWord::is) {
    if (!words.has('Q')) {
      return fail(change.column, "tool-missing"_id, change.code->name() + " without a tool",
                  fmt::format("give the tool that is in the spindle, for example {} Q1",
                              change.code->name()));
    }
    const auto tool = whole(words, 'Q', 0, kMaxTool);
    if (!tool) return tool.error();
    if (auto done = check_tool_exists(*tool, words['Q'].column); !done) return done;
    state_.tool = data_.tool = *tool;
    emit(change.column, ToolChange{state_.tool});
  } else if (change.code != nullptr) {
    if (!state_.selected_tool) {
      return fail(change.column, "tool-missing"_id, change.code->name() + " without a tool",
                  "give T on this block or before");
    }
    if (state_.spindle != SpindleDirection::off) {
      state_.spindle = SpindleDirection::off;
      emit(change.column, SpindleChange{state_.spindle, state_.spindle_speed});
    }
    state_.tool = data_.tool = *state_.selected_tool;
    emit(change.column, ToolChange{state_.tool});
  }
  return Done{};
}

void BlockExecutor::set_spindle_and_coolant(const BlockWords& words, bool speed) {
  const GivenCode& spindle = words[CodeGroup::spindle];
  if (spindle.code != nullptr || (speed && state_.spindle != SpindleDirection::off)) {
    state_.spindle = words.value_or(CodeGroup::spindle, state_.spindle);
    emit(spindle.code != nullptr ? spindle.column : words['S'].column,
         SpindleChange{state_.spindle, state_.spindle_speed});
  }
  const GivenCode& coolant = words[CodeGroup::coolant];
  if (coolant.code != nullptr && !coolant.code->event) {
    state_.flood = static_cast<CoolantWord>(coolant.code->value) == CoolantWord::flood;
    emit(coolant.column, CoolantChange{state_.flood});
  }
}

BlockExecutor::Outcome BlockExecutor::dwell(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  const DwellWord* given = nullptr;
  for (const DwellWord& word : rules_.dwell) {
    if (!words.has(word.letter)) continue;
    if (given != nullptr) {
      return fail(
          words[word.letter].column, "dwell-time"_id,
          fmt::format("{} has both {} and {}", code.code->name(), given->letter, word.letter),
          "give one time");
    }
    given = &word;
  }
  if (given == nullptr) {
    return fail(code.column, "dwell-time"_id, code.code->name() + " without a time",
                std::string(rules_.dwell_hint));
  }
  const GivenWord& time = words[given->letter];
  if (time.value < 0.0) {
    return fail(time.column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of(given->letter)),
                "a dwell takes a time that is not negative");
  }
  if (given->unit == DwellUnit::revolutions && state_.spindle_speed <= 0.0) {
    return fail(time.column, "dwell-without-speed"_id,
                "a dwell in revolutions with no spindle speed", "give a spindle speed before");
  }
  const bool milliseconds =
      given->unit == DwellUnit::milliseconds_without_point && !time.decimal_point;
  emit(code.column, Dwell{milliseconds ? time.value / kMillisecondsPerSecond
                          : given->unit == DwellUnit::revolutions
                              ? time.value * kSecondsPerMinute / state_.spindle_speed
                              : time.value});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::keep_modes(const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::saved_modes];
  if (code.code == nullptr) return Done{};
  SavedModes& saved = saved_modes_.back();
  switch (static_cast<SavedModesWord>(code.code->value)) {
    case SavedModesWord::save:
      saved = {state_, false, false, saved.unit};
      break;
    case SavedModesWord::save_for_call:
      saved = {state_, true, false, saved.unit};
      break;
    case SavedModesWord::drop:
      saved = {.unit = saved.unit};
      break;
    case SavedModesWord::restore:
      if (!saved.state) {
        return fail(code.column, "saved-modes-missing"_id, "there are no saved modes",
                    "save them with M70 or M73 before");
      }
      restore_modes(code.column);
      break;
  }
  return Done{};
}

void BlockExecutor::restore_modes(std::uint32_t column) {
  const ModalState& saved = *saved_modes_.back().state;
  state_.plane = saved.plane;
  state_.unit = saved.unit;
  state_.diameter = saved.diameter;
  state_.distance = saved.distance;
  state_.arc_distance = saved.arc_distance;
  state_.feed_mode = saved.feed_mode;
  const bool all = !saved_modes_.back().of_g_words;
  if (all) {
    state_.feed = saved.feed;
  } else {
    state_.motion = saved.motion;
    state_.orientation_reference = saved.orientation_reference;
    if (state_.orientation_path != saved.orientation_path) {
      state_.orientation_path = saved.orientation_path;
      emit(column, OrientationPathChange{saved.orientation_path});
    }
    if (rules_.planes_end_frames) set_program_frame(saved.program_frame);
  }
  state_.retract_to_initial = saved.retract_to_initial;
  state_.surface_speed = saved.surface_speed;
  if (state_.work_offset != saved.work_offset) {
    // It was in force before, so that there is nothing to complain of.
    static_cast<void>(select_work_offset(saved.work_offset, column));
  }
  if (!all) return;
  if (state_.spindle != saved.spindle || state_.spindle_speed != saved.spindle_speed) {
    state_.spindle = saved.spindle;
    state_.spindle_speed = saved.spindle_speed;
    emit(column, SpindleChange{state_.spindle, state_.spindle_speed});
  }
  if (state_.flood != saved.flood) {
    state_.flood = saved.flood;
    emit(column, CoolantChange{state_.flood});
  }
}

void BlockExecutor::enter_call() {
  saved_modes_.push_back({.unit = state_.unit});
  ++system_.call_level;
}

void BlockExecutor::leave_call() {
  if (saved_modes_.back().state && saved_modes_.back().comes_back) restore_modes(1);
  if (rules_.calls_whole_files) state_.unit = saved_modes_.back().unit;
  saved_modes_.pop_back();
  --system_.call_level;
}

}  // namespace frustum::parser
