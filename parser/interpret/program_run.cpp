// The blocks in their order, and the calls that words make. Flow statements are in
// program_flow.cpp.
#include "parser/interpret/program_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "parser/interpret/macro_call.hpp"
#include "parser/interpret/saved_modes.hpp"

namespace frustum::parser {
namespace {

// P00032000: three times O2000.
constexpr std::uint32_t kRepeatsFactor = 10'000;

constexpr const char* kEndOfFile = "END PGM";

std::string known_programs(const ProgramMap& map) {
  if (map.programs().empty())
    return "the file holds no subprogram; begin one with O and its number";
  std::string names = "the file holds";
  for (const auto& entry : map.programs()) names += fmt::format(" O{}", entry.first);
  return names;
}

bool does_something(const Block& block) {
  return !block.words.empty() || !block.assignments.empty() || block.program || block.flow;
}

// The first word that may be a length or a feed, else the first setting.
std::uint32_t column_of_length(const Block& block) {
  constexpr LetterSet kLengths{"XYZIJKRQF"};
  for (const Word& word : block.words) {
    if (kLengths.has(word.letter) && word.number != 0.0) return word.column;
  }
  return block.assignments.empty() ? 1 : block.assignments.front().column;
}

ControlData data_before(const InterpreterOptions& options, Dialect dialect) {
  ControlData data;
  data.tools = options.tools;
  data.tools_are_listed =
      options.tools_are_all && std::any_of(data.tools.begin(), data.tools.end(),
                                           [](const auto& tool) { return tool.second.has_length; });
  // What LinuxCNC's own table leaves out is zero.
  if (dialect == Dialect::linuxcnc && data.tools_are_listed) {
    for (auto& [number, tool] : data.tools) tool.has_diameter = true;
  }
  data.work_offsets = options.work_offsets;
  data.reference_points = options.reference_points;
  data.unit = options.machine_unit;
  data.contours_without_diameter = options.contours_without_diameter;
  return data;
}

}  // namespace

ProgramRun::ProgramRun(const Program& program, const MotionSink& sink,
                       const InterpreterOptions& options)
    : sink_(sink),
      options_(options),
      rules_(rules_of(program.dialect)),
      executor_(program.dialect, options.start, data_before(options, program.dialect), sink),
      main_(std::make_shared<LoadedProgram>(program, LoadedProgram::Role::main)) {
  executor_.state().control = options.control;
  if (options.control.unit && rules_.unit_may_be_missing) {
    executor_.state().modes.unit = executor_.state().data.unit = *options.control.unit;
    executor_.state().modes.unit_is_known = true;
  }
  if (options.go_on) executor_.state().control.feed_before_first_word = false;
}

Result<RunSummary> ProgramRun::operator()() {
  frames_.push_back({main_, BlockCursor(main_->program())});
  while (!frames_.empty()) {
    auto failure = run_next();
    if (!failure) continue;
    executor_.settle();
    Diagnostics failures{*std::move(failure)};
    if (syntax_failed_ && failures.front().id != "not-milling"_id) {
      // The rest of the text is read for its own mistakes, so that they are mended together.
      const auto more = syntax_errors(frame().program->program(), frame().cursor.place());
      failures.insert(failures.end(), more.begin(), more.end());
    }
    return failures;
  }
  executor_.settle();
  return RunSummary{executor_.state().modes, blocks_};
}

ProgramRun::Failure ProgramRun::run_next() {
  auto next = next_block();
  if (!next) {
    if (goes_on(next.error().front())) return std::nullopt;
    syntax_failed_ = !options_.go_on;
    return std::move(next).error().front();
  }
  if (*next == nullptr) return run_off(nullptr);
  const Block& block = **next;
  const bool next_program = block.program && !rules_.runs_into_programs;
  // Sinumerik's programs begin with their names; % alone ends none.
  const bool bare_mark = block.tape_mark && !block.flow && rules_.subprograms_are_programs;
  const bool ends = (block.tape_mark && !bare_mark) || next_program;
  if (frame().opened && ends) return run_off(&block);
  if (frame().opened && bare_mark) {
    executor_.settle();
    sink_(Motion{executor_.state().at_work.place_of(block, 1),
                 Event{"%", "within a program it is passed over", EventGrade::assumed}});
  }
  if (!frame().opened && does_something(block)) {
    frame().opened = true;
    if (frames_.size() == 1) frame().entry = frame().cursor.block_place();
  }
  if (auto endless = count_block(block)) return endless;
  if (options_.watch &&
      !options_.watch({block, frame().program->place_file(), frames_.size() - 1})) {
    frames_.clear();
    return std::nullopt;
  }
  if (block.deletable && options_.block_delete) {
    sink_(Motion{executor_.state().at_work.place_of(block, 1), Event{"block_delete", {}}});
    return std::nullopt;
  }
  statement_ran_ = statement_ran_ || block.flow.has_value();
  const std::size_t calls = frames_.size();
  auto failure = block.flow ? follow_statement(block) : execute(block);
  // A call moves the blocks of its callers, and a subprogram that has been left took its own with
  // it: what such a statement has read is told at the next block.
  const bool stays = frames_.size() == calls;
  if (stays) tell_assumed_values(block);
  if (!failure || !goes_on(*failure)) return failure;
  if (stays) pass_over(executor_.state(), block);
  return std::nullopt;
}

void ProgramRun::tell_assumed_values(const Block& block) {
  InterpreterState& state = executor_.state();
  const auto stored = state.parameters.take_stored_read();
  const auto angle = state.parameters.take_angle_from_zero();
  if (state.system.assumed.empty() && !stored && !angle) return;
  state.at_work.block = &block;
  if (angle) {
    assume(state, 1, "angle from zero",
           fmt::format("ATAN and ASIN give {:.6g} degrees, not {:.6g}: angles from 0 to 360, as "
                       "parameter 6004#0 (NAT) = 0 has it",
                       *angle, *angle - 360.0));
  }
  for (const AssumedValue* value : state.system.assumed) {
    const bool of_unit = value == &kStartUnit;
    state.modes.unit_is_known = state.modes.unit_is_known || of_unit;
    assume(state, of_unit ? column_of_length(block) : 1, value->name, value->text);
  }
  state.system.assumed.clear();
  if (!stored) return;
  assume(state, 1, "stored variables",
         fmt::format("#{}, which the program does not set, is vacant on the machine too", *stored));
}

ProgramRun::Failure ProgramRun::count_block(const Block& block) {
  constexpr const char* kRemedy =
      "look for repeats within repeats, for loops whose condition never changes, and for M99 in "
      "the main program; max_blocks of the control allows more";
  lines_ += frame().program->advance_to(block.line);
  const std::uint64_t most = options_.control.max_blocks.value_or(options_.max_blocks);
  if (++blocks_ > lines_ && blocks_ - lines_ > most) {
    return at(block, 1, "endless-loop"_id, fmt::format("more than {} blocks have run again", most),
              kRemedy);
  }
  if (executor_.state().output.moves != moves_) {
    moves_ = executor_.state().output.moves;
    blocks_at_move_ = blocks_;
  }
  if (blocks_ - blocks_at_move_ <= options_.max_idle_blocks) return std::nullopt;
  return at(block, 1, "endless-loop"_id,
            fmt::format("more than {} blocks have run without a motion", options_.max_idle_blocks),
            kRemedy);
}

bool ProgramRun::goes_on(const Diagnostic& failure) const {
  return options_.go_on && options_.go_on(Diagnostic(failure));
}

ProgramRun::Failure ProgramRun::execute(const Block& block) {
  auto flow = executor_.execute(block);
  if (!flow) return in_this_file(std::move(flow).error().front());
  tell_assumed_values(block);  // before the block may go with its frame
  const bool calls_or_leaves = std::holds_alternative<CallSubprogram>(*flow) ||
                               std::holds_alternative<CallFile>(*flow) ||
                               std::holds_alternative<LeaveSubprogram>(*flow);
  if (calls_or_leaves && executor_.state().at_work.moved && !frame().modal_macros.empty()) {
    return at(block, 1, "macro-beside"_id,
              "a call or M99 beside a move, which calls the macro of G66",
              "write two blocks, or end G66 with G67 before");
  }
  return std::visit([&](const auto& wish) { return follow(block, wish); }, *flow);
}

Diagnostic ProgramRun::in_main(Diagnostic diagnostic) const {
  diagnostic.file = main_->program().file;
  return diagnostic;
}

Diagnostic ProgramRun::in_this_file(Diagnostic diagnostic) const {
  diagnostic.file = frames_.back().program->program().file;
  return diagnostic;
}

ProgramRun::Failure ProgramRun::run_off(const Block* end) {
  if (frames_.size() > 1) {
    Diagnostic failure =
        in_this_file(error("subprogram-end-missing"_id,
                           fmt::format("subprogram {} has no {}", frame().name, frame().end),
                           fmt::format("end the subprogram with {}", frame().end)));
    failure.line = static_cast<int>(frame().named.line);
    failure.column = static_cast<int>(frame().named.column);
    return failure;
  }
  if (end != nullptr && end->program) {
    return at(*end, end->program_column, "program-end-missing"_id,
              fmt::format("the program runs into O{}", *end->program),
              "end the main program with M30");
  }
  frames_.clear();
  if (auto done = executor_.end_of_text(); !done) return in_main(std::move(done).error().front());
  return std::nullopt;
}

void ProgramRun::return_from_call() {
  CallFrame& done = frame();
  if (--done.runs_left > 0) {
    done.cursor.go_to(done.entry);
    done.opened = false;
    done.loops.clear();
    done.parts.clear();
    return;
  }
  CallFrame& caller = frames_[frames_.size() - 2];
  if (done.is_modal) {
    caller.modal_macros.back().call.arguments = local_values(executor_.state());
  } else {
    caller.modal_macros = std::move(done.modal_macros);
  }
  std::vector<double> results;
  for (const auto& [name, variable] : done.given_back) {
    const auto value = executor_.state().parameters.read(name);
    results.push_back(value ? *value : 0.0);
  }
  for (const auto& [name, variable] : done.given_back_arrays) {
    executor_.state().parameters.give_array_back(name, variable);
  }
  if (done.has_locals) executor_.state().parameters.leave();
  for (std::size_t i = 0; i < results.size(); ++i) {
    executor_.state().parameters.set(done.given_back[i].second, results[i]);
  }
  leave_call(executor_.state());
  frames_.pop_back();
  executor_.state().at_work.file = frame().program->place_file();
  if (frames_.size() == 1) executor_.state().at_work.call_line = 0;
}

Result<const Block*> ProgramRun::next_block() {
  CallFrame& here = frame();
  auto next = here.cursor.next();
  while (next && !here.parts.empty() &&
         (*next == nullptr || here.cursor.block_place().offset >= here.parts.back().end)) {
    RepeatedPart& part = here.parts.back();
    const bool again = part.turns_left > 0;
    here.cursor.go_to(again ? part.begin : part.behind);
    if (again) {
      --part.turns_left;
    } else {
      here.parts.pop_back();
    }
    next = here.cursor.next();
    if (again) break;
  }
  return next;
}

ProgramRun::Failure ProgramRun::end_program(const Block& block, std::uint32_t column) {
  if (auto done = executor_.end_of_text(); !done) return in_main(std::move(done).error().front());
  sink_(Motion{executor_.state().at_work.place_of(block, column), Stop{StopKind::program_end}});
  frames_.clear();
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::follow(const Block& block, const NextBlock& next) {
  if (!next.moved || frame().modal_macros.empty()) return std::nullopt;
  CallSubprogram call = frame().modal_macros.back().call;
  call.column = 1;  // that of G66 is of another block
  return call_numbered(block, std::move(call), true);
}

ProgramRun::Failure ProgramRun::follow(const Block& /*block*/, const EndModalCall& /*end*/) {
  if (!frame().modal_macros.empty()) frame().modal_macros.pop_back();
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::follow(const Block& /*block*/, const EndProgram& /*end*/) {
  frames_.clear();
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::follow(const Block& block, const LeaveSubprogram& leave) {
  if (frames_.size() == 1 && rules_.subprograms_are_programs) {
    return end_program(block, leave.column);
  }
  if (frames_.size() == 1) return repeat_main_program(block, leave);
  // Of a subprogram within the file, which has not ended.
  if (leave.of_file && frame().end != kEndOfFile) return run_off(nullptr);
  if (!leave.block_number) {
    return_from_call();
    return std::nullopt;
  }
  // What is left of the repeats does not run.
  const std::string label = fmt::format("N{}", *leave.block_number);
  Diagnostic failure = at(block, leave.column, "missing-return"_id,
                          fmt::format("there is no {} to go back to", label),
                          "P of M99 names a block of the program that called this one");
  frame().runs_left = 1;
  return_from_call();
  const auto target = find_label(label, Search::forward_then_backward);
  if (!target) return failure;
  frame().cursor.go_to(*target);
  frame().parts.clear();
  return std::nullopt;
}

// M99 of the main program runs it again from its start, or goes on at the block that P names.
ProgramRun::Failure ProgramRun::repeat_main_program(const Block& block,
                                                    const LeaveSubprogram& leave) {
  if (leave.block_number && rules_.dialect == Dialect::fanuc) {
    const std::string label = fmt::format("N{}", *leave.block_number);
    const auto target = find_label(label, Search::forward_then_backward);
    if (!target) {
      return at(block, leave.column, "missing-label"_id,
                fmt::format("there is no {} to go to", label),
                "P of M99 names a block of this program");
    }
    frame().cursor.go_to(*target);
    frame().parts.clear();
    return std::nullopt;
  }
  if (rules_.dialect == Dialect::linuxcnc) {
    assume(executor_.state(), leave.column, "M99",
           "the program would begin again without an end: run once");
    return end_program(block, leave.column);
  }
  // Nothing that has run could make the next time another.
  if (!statement_ran_ && rules_.dialect == Dialect::fanuc) {
    const auto tell = [&](Command command) {
      sink_(Motion{executor_.state().at_work.place_of(block, leave.column), std::move(command)});
    };
    executor_.settle();
    tell(Event{"M99", "the main program would begin again"});
    return end_program(block, leave.column);
  }
  if (!statement_ran_ || rules_.dialect != Dialect::fanuc) {
    return at(block, leave.column, "endless-loop"_id,
              "M99 in the main program would repeat it for ever", "end the main program with M30");
  }
  statement_ran_ = false;
  frame().cursor.go_to(frame().entry);
  frame().opened = false;
  frame().loops.clear();
  frame().parts.clear();
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::follow(const Block& block, CallSubprogram call) {
  if (call.blocks) return call_blocks(block, call);
  if (!call.modal) return call_numbered(block, std::move(call), false);
  frame().modal_macros.push_back({std::move(call)});
  return std::nullopt;
}

// CALL PGM: the file from its start to its END PGM.
ProgramRun::Failure ProgramRun::follow(const Block& block, const CallFile& call) {
  const auto holder = file_of(call.name);
  if (holder == nullptr) {
    return at(
        block, call.column, "missing-program"_id, fmt::format("there is no program {}", call.name),
        fmt::format("it is looked for beside this one and in the search path, as {}.h", call.name));
  }
  CallFrame next{holder, BlockCursor(holder->program()), call.name, kEndOfFile, {}, {1, 1}, 1,
                 true};
  if (auto failure = push_call(block, call.column, std::move(next))) return failure;
  executor_.state().parameters.enter({});
  return std::nullopt;
}

// M97: from a block of the program at work to its M99.
ProgramRun::Failure ProgramRun::call_blocks(const Block& block, const CallSubprogram& call) {
  const std::string label = fmt::format("N{}", call.program);
  const auto target = find_label(label, Search::forward_then_backward);
  if (!target) {
    return at(block, call.column, "missing-label"_id, fmt::format("there is no {} to call", label),
              "P of M97 names a block of this program");
  }
  if (call.count == 0) return std::nullopt;
  CallFrame next{frame().program, BlockCursor(frame().program->program()),
                 label,           "M99",
                 *target,         {target->line, 1},
                 call.count};
  return push_call(block, call.column, std::move(next));
}

ProgramRun::Failure ProgramRun::call_numbered(const Block& block, CallSubprogram call,
                                              bool by_modal) {
  std::shared_ptr<LoadedProgram> holder = frame().program;
  const auto has = [&](std::uint32_t number) { return holder->map().programs().contains(number); };
  if (!has(call.program) && !call.counted && call.program >= kRepeatsFactor &&
      has(call.program % kRepeatsFactor)) {
    call.count = call.program / kRepeatsFactor;
    call.program %= kRepeatsFactor;
  }
  const std::string name = fmt::format("O{}", call.program);
  if (!has(call.program)) {
    holder = file_of(name);
    if (holder == nullptr) {
      auto numbered = file_of_number(block, call.column, call.program);
      if (!numbered) return std::move(numbered).error().front();
      holder = *std::move(numbered);
    }
    if (holder == nullptr || !has(call.program)) {
      return at(block, call.column, "missing-subprogram"_id,
                fmt::format("subprogram {} does not exist", name),
                known_programs(frame().program->map()));
    }
  }
  if (call.count == 0) return std::nullopt;
  const auto& entry = holder->map().programs().at(call.program);
  CallFrame next{holder,      BlockCursor(holder->program()),   name,      "M99",
                 entry.place, {entry.place.line, entry.column}, call.count};
  next.has_locals = call.arguments.has_value();
  next.is_modal = by_modal;
  if (auto failure = push_call(block, call.column, std::move(next))) return failure;
  if (call.arguments) executor_.state().parameters.enter(*call.arguments);
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::push_call(const Block& block, std::uint32_t column,
                                          CallFrame next) {
  if (frames_.size() > options_.max_call_depth) {
    return at(block, column, "recursion"_id,
              fmt::format("more than {} subprograms within each other", options_.max_call_depth),
              fmt::format("does {} call itself?", next.name));
  }
  next.modal_macros = frame().modal_macros;
  if (next.is_modal) next.modal_macros.pop_back();
  next.cursor.go_to(next.entry);
  if (frames_.size() == 1) executor_.state().at_work.call_line = block.place_of(column).line;
  frames_.push_back(std::move(next));
  enter_call(executor_.state());
  executor_.state().at_work.file = frame().program->place_file();
  return std::nullopt;
}

Diagnostic ProgramRun::at(const Block& block, std::uint32_t column, DiagnosticId id,
                          std::string message, std::string hint) const {
  const SourcePlace place = block.place_of(column);
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.line = static_cast<int>(place.line);
  diagnostic.column = static_cast<int>(place.column);
  return in_this_file(std::move(diagnostic));
}

}  // namespace frustum::parser
