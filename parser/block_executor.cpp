// Reading a block's intent, and all that does not move an axis. The moves are in block_moves.cpp.
#include "parser/block_executor.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace frustum::parser {
namespace {

constexpr LetterSet kAlwaysClaimed{"FST"};
constexpr LetterSet kMoveWords{"XYZABCIJKR"};
constexpr LetterSet kDwellTimes{"PXU"};
constexpr int kMaxTool = 99'999'999;
constexpr int kMaxOffsetNumber = 9999;
constexpr int kMaxProgramNumber = 99'999'999;
constexpr int kMaxRepeats = 99'999;
constexpr double kMillisecondsPerSecond = 1000.0;

LetterSet centre_letters(Plane plane) {
  constexpr std::array kLetters{LetterSet("IJ"), LetterSet("IK"), LetterSet("JK")};
  return kLetters.at(static_cast<std::size_t>(plane));
}

Compensation compensation_of(LengthWord word) {
  constexpr std::array kModes{LengthCompensation::off, LengthCompensation::length,
                              LengthCompensation::tool_centre_point,
                              LengthCompensation::tool_centre_point};
  return {kModes.at(static_cast<std::size_t>(word)), word == LengthWord::tool_vectors, 0};
}

// The text behind "MSG," when the comment is meant for the operator.
std::optional<std::string> message_in(std::string_view comment) {
  constexpr std::string_view kPrefix = "MSG,";
  std::size_t start = comment.find_first_not_of(" \t");
  for (const char expected : kPrefix) {
    if (start >= comment.size()) return std::nullopt;
    if (std::toupper(static_cast<unsigned char>(comment[start++])) != expected) return std::nullopt;
  }
  return std::string(
      comment.substr(std::min(comment.find_first_not_of(" \t", start), comment.size())));
}

}  // namespace

Result<Flow> BlockExecutor::execute(const Block& block) {
  line_ = block.line;
  auto words = read_words(block, parameters_);
  if (!words) return std::move(words).error();
  const auto movement = movement_of(*words);
  if (!movement) return movement.error();
  if (auto done = check_claims(*words, *movement); !done) return std::move(done).error();

  report_comments(block);
  if (auto done = set_parameters(block); !done) return std::move(done).error();
  state_.unit = words->value_or(CodeGroup::unit, state_.unit);
  if (auto done = set_feed(*words); !done) return std::move(done).error();
  if (auto done = set_tool_and_spindle(*words); !done) return std::move(done).error();
  report_events(*words);
  if (movement->non_modal == NonModal::dwell) {
    if (auto done = dwell(*words); !done) return std::move(done).error();
  }
  if (auto done = set_frames(*words); !done) return std::move(done).error();
  if (auto done = move(*words, *movement); !done) return std::move(done).error();
  return finish(*words);
}

MotionMode BlockExecutor::motion_of(const BlockWords& words) const {
  const bool cancelled = words.has(CodeGroup::cycle);
  return words.value_or(CodeGroup::motion, cancelled ? MotionMode::none : state_.motion);
}

Result<BlockExecutor::Movement> BlockExecutor::movement_of(const BlockWords& words) const {
  const auto non_modal = words.value_or(CodeGroup::non_modal, NonModal::none);
  const MotionMode mode = motion_of(words);
  const GivenCode& motion_code = words[CodeGroup::motion];
  const GivenCode& non_modal_code = words[CodeGroup::non_modal];
  const LetterSet move_words = words.given() & kMoveWords;

  if (non_modal == NonModal::home) {
    if (motion_code.code != nullptr && mode != MotionMode::traverse) {
      return fail(motion_code.column,
                  fmt::format("G28 and {} both use the axis words", motion_code.code->name()),
                  "write two blocks");
    }
    if ((words.given() & kAxisWords).empty()) {
      return fail(non_modal_code.column, "G28 names no axis",
                  "give the axes to send home, for example G91 G28 Z0");
    }
    return Movement{non_modal, MotionMode::none, non_modal_code.column};
  }
  if (non_modal == NonModal::dwell && motion_code.code == nullptr) {
    return Movement{non_modal, MotionMode::none, non_modal_code.column};
  }
  if (non_modal == NonModal::machine_coordinates) {
    if (mode != MotionMode::traverse && mode != MotionMode::linear) {
      return fail(non_modal_code.column, "G53 without G0 or G1", "write G53 G0 or G53 G1");
    }
    if ((words.given() & kAxisWords).empty()) {
      return fail(non_modal_code.column, "G53 names no axis",
                  "give the axes to move, for example G53 G0 Z0");
    }
    if (words.value_or(CodeGroup::distance, state_.distance) == DistanceMode::incremental) {
      return fail(non_modal_code.column, "G53 in G91", "machine coordinates need G90");
    }
    return Movement{non_modal, mode, non_modal_code.column};
  }
  if (move_words.empty()) return Movement{non_modal, MotionMode::none, 0};
  const std::uint32_t column =
      motion_code.code != nullptr ? motion_code.column : words[words.first_of(move_words)].column;
  return Movement{non_modal, mode, column};
}

LetterSet BlockExecutor::motion_words(const BlockWords& words, const Movement& movement) const {
  switch (movement.motion) {
    case MotionMode::none:
      return {};
    case MotionMode::traverse:
    case MotionMode::linear: {
      const GivenCode& length = words[CodeGroup::length_compensation];
      const auto mode = length.code == nullptr
                            ? state_.compensation.mode
                            : compensation_of(static_cast<LengthWord>(length.code->value)).mode;
      const bool vectors = mode == LengthCompensation::tool_centre_point &&
                           movement.non_modal != NonModal::machine_coordinates;
      return vectors ? kAxisWords | kVectorWords : kAxisWords;
    }
    case MotionMode::arc_clockwise:
    case MotionMode::arc_counterclockwise:
      return kAxisWords | LetterSet("RP") |
             centre_letters(words.value_or(CodeGroup::plane, state_.plane));
  }
  return {};
}

BlockExecutor::Outcome BlockExecutor::check_claims(const BlockWords& words,
                                                   const Movement& movement) const {
  LetterSet claimed = kAlwaysClaimed;
  LetterSet twice;
  const auto claim = [&](LetterSet letters) {
    twice = twice | (claimed & letters);
    claimed = claimed | letters;
  };
  for (std::size_t group = 0; group < kCodeGroups; ++group) {
    const Code* code = words[static_cast<CodeGroup>(group)].code;
    if (code != nullptr && !code->event) claim(code->arguments);
  }
  for (const GivenCode& event : words.events()) claim(event.code->arguments);
  claim(motion_words(words, movement));

  if (const char letter = words.first_of(words.given() & twice); letter != 0) {
    return fail(words[letter].column,
                fmt::format("{} could belong to two words of the block", words.text_of(letter)),
                "write two blocks");
  }
  const char letter = words.first_of(words.given().without(claimed));
  if (letter == 0) return Done{};
  const std::string_view use = letter_use(letter);
  if (use.empty()) {
    return fail(words[letter].column, "unknown word " + words.text_of(letter),
                "known are the letters A B C F G H I J K L M N O P Q R S T U X Y Z");
  }
  return fail(words[letter].column,
              fmt::format("{} has no meaning in this block", words.text_of(letter)),
              std::string(use));
}

Result<int> BlockExecutor::whole(const BlockWords& words, char letter, int least, int most) const {
  const GivenWord& word = words[letter];
  const double nearest = std::round(word.value);
  // RS-274 forgives 1e-4 in numbers that have to be whole.
  if (std::abs(word.value - nearest) > 1e-4) {
    return fail(word.column, fmt::format("{} is not a whole number", words.text_of(letter)),
                fmt::format("give {} without decimals", letter));
  }
  if (nearest < least || nearest > most) {
    return fail(word.column, fmt::format("{} is out of range", words.text_of(letter)),
                fmt::format("{} goes from {} to {}", letter, least, most));
  }
  return static_cast<int>(nearest);
}

BlockExecutor::Outcome BlockExecutor::set_parameters(const Block& block) {
  if (block.assignments.empty()) return Done{};
  // All are computed before the first is set: a block reads what the blocks before it left.
  const ExpressionContext context{block.steps, block.names, parameters_};
  std::vector<std::pair<int, double>> values;
  for (const Assignment& setting : block.assignments) {
    const auto value = evaluate(context, setting.value);
    if (!value) return on_this_line(value.error().front());
    int index = 0;
    if (!setting.name) {
      const auto number = evaluate(context, setting.index);
      if (!number) return on_this_line(number.error().front());
      const auto checked = Parameters::index_of(*number);
      if (!checked) {
        return fail(setting.column, checked.error().front().message, checked.error().front().hint);
      }
      index = *checked;
    }
    values.emplace_back(index, *value);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& name = block.assignments[i].name;
    if (name) {
      parameters_.set(block.names[*name], values[i].second);
    } else {
      parameters_.set(values[i].first, values[i].second);
    }
  }
  return Done{};
}

void BlockExecutor::report_comments(const Block& block) {
  for (const Comment& comment : block.comments) {
    auto message = message_in(comment.text);
    const char* name = message ? "message" : "comment";
    emit(comment.column, Event{name, message ? *std::move(message) : comment.text});
  }
}

void BlockExecutor::report_events(const BlockWords& words) {
  for (const GivenCode& event : words.events()) {
    std::string arguments;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      if (!words.has(letter) || !event.code->arguments.has(letter)) continue;
      if (!arguments.empty()) arguments += ' ';
      arguments += words.text_of(letter);
    }
    emit(event.column, Event{event.code->name(), std::move(arguments)});
  }
}

BlockExecutor::Outcome BlockExecutor::set_feed(const BlockWords& words) {
  const auto mode = words.value_or(CodeGroup::feed_mode, state_.feed_mode);
  if (mode != state_.feed_mode) state_.feed.reset();
  state_.feed_mode = mode;
  if (!words.has('F')) return Done{};
  const double feed = words['F'].value;
  if (feed < 0.0) {
    return fail(words['F'].column, fmt::format("{} is negative", words.text_of('F')),
                "give a feed above zero");
  }
  const double scale = mode == FeedMode::inverse_time ? 1.0 : unit_scale();
  state_.feed.reset();
  if (feed > 0.0) state_.feed = FeedWord{feed, feed * scale};
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_tool_and_spindle(const BlockWords& words) {
  if (words.has('S')) {
    if (words['S'].value < 0.0) {
      return fail(words['S'].column, fmt::format("{} is negative", words.text_of('S')),
                  "give the direction by M3 or M4 and a speed that is not negative");
    }
    state_.spindle_speed = words['S'].value;
  }
  if (words.has('T')) {
    const auto tool = whole(words, 'T', 0, kMaxTool);
    if (!tool) return tool.error();
    state_.selected_tool = *tool;
  }
  const GivenCode& change = words[CodeGroup::tool_change];
  if (change.code != nullptr) {
    if (!state_.selected_tool) {
      return fail(change.column, "M6 without a tool", "give T on this block or before");
    }
    if (state_.spindle != SpindleDirection::off) {
      state_.spindle = SpindleDirection::off;
      emit(change.column, SpindleChange{state_.spindle, state_.spindle_speed});
    }
    emit(change.column, ToolChange{*state_.selected_tool});
  }
  const GivenCode& spindle = words[CodeGroup::spindle];
  if (spindle.code != nullptr || (words.has('S') && state_.spindle != SpindleDirection::off)) {
    state_.spindle = words.value_or(CodeGroup::spindle, state_.spindle);
    emit(spindle.code != nullptr ? spindle.column : words['S'].column,
         SpindleChange{state_.spindle, state_.spindle_speed});
  }
  const GivenCode& coolant = words[CodeGroup::coolant];
  if (coolant.code != nullptr && !coolant.code->event) {
    state_.flood = static_cast<CoolantWord>(coolant.code->value) == CoolantWord::flood;
    emit(coolant.column, CoolantChange{state_.flood});
  }
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::dwell(const BlockWords& words) {
  const std::uint32_t column = words[CodeGroup::non_modal].column;
  const LetterSet times = words.given() & kDwellTimes;
  const char letter = words.first_of(times);
  if (letter == 0) {
    return fail(column, "G4 without a time", "give P in milliseconds, or X in seconds");
  }
  LetterSet first;
  first.add(letter);
  if (const char second = words.first_of(times.without(first)); second != 0) {
    return fail(words[second].column, fmt::format("G4 has both {} and {}", letter, second),
                "give one time");
  }
  const GivenWord& time = words[letter];
  if (time.value < 0.0) {
    return fail(time.column, fmt::format("{} is negative", words.text_of(letter)),
                "a dwell takes a time that is not negative");
  }
  const bool milliseconds = letter == 'P' && !time.decimal_point;
  emit(column, Dwell{milliseconds ? time.value / kMillisecondsPerSecond : time.value});
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::set_frames(const BlockWords& words) {
  state_.plane = words.value_or(CodeGroup::plane, state_.plane);
  state_.distance = words.value_or(CodeGroup::distance, state_.distance);
  state_.arc_distance = words.value_or(CodeGroup::arc_distance, state_.arc_distance);

  const GivenCode& length = words[CodeGroup::length_compensation];
  if (length.code != nullptr) {
    Compensation next = compensation_of(static_cast<LengthWord>(length.code->value));
    if (words.has('H')) {
      const auto number = whole(words, 'H', 1, kMaxOffsetNumber);
      if (!number) return number.error();
      next.offset_number = *number;
    }
    const bool tip_before = state_.tool_centre_point();
    const bool tip_after = next.mode == LengthCompensation::tool_centre_point;
    const bool same_tool = next.offset_number == state_.compensation.offset_number;
    if (tip_before != tip_after || (tip_after && !same_tool)) {
      forget(kLinearWords, PositionLoss::length_compensation);
    } else if (next.mode != state_.compensation.mode || !same_tool) {
      forget(LetterSet("Z"), PositionLoss::length_compensation);
    }
    if (!tip_after) state_.tool_axis.reset();
    state_.compensation = next;
    emit(length.column, CompensationChange{next.mode, next.tool_vectors, next.offset_number});
  }

  const GivenCode& offset = words[CodeGroup::work_offset];
  if (offset.code != nullptr) {
    const int number = offset.code->value;
    if (number != state_.work_offset) forget(kAxisWords, PositionLoss::work_offset);
    state_.work_offset = number;
    emit(offset.column, WorkOffsetChange{number});
  }
  return Done{};
}

Result<Flow> BlockExecutor::finish(const BlockWords& words) {
  const GivenCode& stop = words[CodeGroup::stop];
  if (stop.code != nullptr) {
    const auto kind = static_cast<StopKind>(stop.code->value);
    emit(stop.column, Stop{kind});
    if (kind == StopKind::program_end) return Flow{EndProgram{}};
  }
  const GivenCode& subprogram = words[CodeGroup::subprogram];
  const auto word = words.value_or(CodeGroup::subprogram, SubprogramWord::none);
  if (word == SubprogramWord::leave) return Flow{LeaveSubprogram{subprogram.column}};
  if (word == SubprogramWord::none) return Flow{NextBlock{}};

  CallSubprogram call{0, false, 1, subprogram.column};
  if (!words.has('P')) {
    return fail(subprogram.column, "M98 without P", "name the subprogram, for example M98 P2000");
  }
  const auto program = whole(words, 'P', 1, kMaxProgramNumber);
  if (!program) return program.error();
  call.program = static_cast<std::uint32_t>(*program);
  call.column = words['P'].column;
  if (words.has('L')) {
    const auto count = whole(words, 'L', 0, kMaxRepeats);
    if (!count) return count.error();
    call.counted = true;
    call.count = static_cast<std::uint32_t>(*count);
  }
  return Flow{call};
}

Diagnostic BlockExecutor::fail(std::uint32_t column, std::string message, std::string hint) const {
  Diagnostic diagnostic = error(std::move(message), std::move(hint));
  diagnostic.column = static_cast<int>(column);
  return on_this_line(std::move(diagnostic));
}

Diagnostic BlockExecutor::on_this_line(Diagnostic diagnostic) const {
  diagnostic.line = static_cast<int>(line_);
  return diagnostic;
}

void BlockExecutor::emit(std::uint32_t column, Command command) {
  sink_(Motion{{line_, column}, std::move(command)});
}

}  // namespace frustum::parser
