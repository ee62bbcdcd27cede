#include "parser/interpret/block_end.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "parser/interpret/block_flow.hpp"
#include "parser/interpret/filters/approach_words.hpp"
#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/filters/radius_words.hpp"
#include "parser/interpret/moves/spline_moves.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

Result<CallSubprogram> called_program(const InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::subprogram];
  CallSubprogram call{0, false, 1, code.column, {}};
  if (!words.has('P')) {
    return fail(state, code.column, "word-missing"_id, code.code->name() + " without P",
                fmt::format("name the subprogram, for example {} P2000", code.code->name()));
  }
  if (words.has('H') && state.rules.offset_numbers_stand_alone) {
    return fail(state, words['H'].column, "word-ambiguous"_id,
                fmt::format("{} beside {}", words.text_of('H'), code.code->name()),
                "it is a length, or the block where the subprogram begins: give a length before");
  }
  const auto program = whole(state, words, 'P', 1, kMaxProgramNumber);
  if (!program) return program.error();
  call.program = static_cast<std::uint32_t>(*program);
  call.column = words['P'].column;
  if (words.has('L')) {
    const auto count = whole(state, words, 'L', 0, kMaxRepeats);
    if (!count) return count.error();
    call.counted = true;
    call.count = static_cast<std::uint32_t>(*count);
  }
  return call;
}

}  // namespace

Result<Flow> finish(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  const GivenCode& stop = words[CodeGroup::stop];
  if (stop.code != nullptr) {
    const auto kind = static_cast<StopKind>(stop.code->value);
    const bool called = state.rules.calls_whole_files && state.at_work.file != nullptr;
    if (kind == StopKind::program_end && called) {
      if (stop.code->letter == kNamedWord) return Flow{LeaveSubprogram{stop.column, {}, true}};
      return fail(state, stop.column, "call-end"_id,
                  stop.code->name() + " in a program that is called",
                  "end it with END PGM, which goes back to the caller");
    }
    if (kind == StopKind::program_end) {
      if (auto open = check_approach_at_end(filters); !open) return std::move(open).error();
      auto done = end_radius_compensation(state, filters, state.at_work.place_of(stop.column));
      if (!done) return std::move(done).error();
      if (auto failure = spline_without_end(state)) return *failure;
    }
    emit(state, stop.column, Stop{kind});
    if (kind == StopKind::program_end) return Flow{EndProgram{}};
  }
  if (words.has(CodeGroup::hole_call) && !state.modes.hole_cycle.program.empty()) {
    return Flow{CallFile{state.modes.hole_cycle.program, words[CodeGroup::hole_call].column}};
  }
  const GivenCode& subprogram = words[CodeGroup::subprogram];
  const auto word = words.value_or(CodeGroup::subprogram, SubprogramWord::none);
  if (word == SubprogramWord::leave) {
    LeaveSubprogram leave{subprogram.column};
    if (words.has('P') && subprogram.code->arguments.has('P')) {
      const auto number = whole(state, words, 'P', 1, kMaxProgramNumber);
      if (!number) return number.error();
      leave.column = words['P'].column;
      leave.block_number = static_cast<std::uint32_t>(*number);
    }
    return Flow{leave};
  }
  if (word == SubprogramWord::end_modal) return Flow{EndModalCall{}};
  if (word == SubprogramWord::none) return Flow{NextBlock{state.at_work.moved}};

  const bool blocks = word == SubprogramWord::call_blocks;
  if ((blocks || word == SubprogramWord::jump_by_signal) && !words.has('P')) {
    emit(state, subprogram.column, Event{subprogram.code->name(), {}, EventGrade::builder});
    return Flow{NextBlock{state.at_work.moved}};
  }
  if (word == SubprogramWord::jump_by_signal) {
    return fail(state, subprogram.column, "not-simulated"_id,
                subprogram.code->name() + " P is not simulated",
                "whether it jumps is for a signal of the machine: leave it out");
  }
  auto call = called_program(state, words);
  if (!call) return call.error();
  call->blocks = blocks;
  return Flow{*std::move(call)};
}

Outcome finish_text(InterpreterState& state, MotionFilters& filters) {
  if (auto done = check_approach_at_end(filters); !done) return done;
  if (const auto& corner = filters.corners.corner(); corner && !corner->if_any) {
    Diagnostic open = error("corner-without-move"_id, corner->name + " with no move after it",
                            "write an L or C block after it, or leave it out");
    open.line = static_cast<int>(corner->place.line);
    open.column = static_cast<int>(corner->place.column);
    return open;
  }
  filters.corners.release(filters.to_radius);
  if (auto failure = spline_without_end(state)) return *failure;
  return end_radius_compensation(state, filters, filters.radius_since);
}

}  // namespace frustum::parser
