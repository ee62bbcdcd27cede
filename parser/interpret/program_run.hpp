// One run of a program: which block comes next. What a block does is the executor's
// (block_executor.hpp).
//
// Units : none
// Errors: those of interpreter.hpp
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parser/interpret/call_frame.hpp"
#include "parser/interpreter.hpp"

namespace frustum::parser {

class ProgramRun {
 public:
  ProgramRun(const Program& program, const MotionSink& sink, const InterpreterOptions& options);

  [[nodiscard]] Result<RunSummary> operator()();

 private:
  using Failure = std::optional<Diagnostic>;

  [[nodiscard]] Failure run_next();
  // What the block has read that is assumed.
  void tell_assumed_values(const Block& block);
  // Tells a program that does not end.
  [[nodiscard]] Failure count_block(const Block& block);
  [[nodiscard]] bool goes_on(const Diagnostic& failure) const;
  // The end of the text, a tape mark, or the next program: fine for a main program only.
  [[nodiscard]] Failure run_off(const Block* end);
  void return_from_call();
  // The next block, after the repeated parts that have ended.
  [[nodiscard]] Result<const Block*> next_block();

  // What the words of a block ask for: M98, M99, M30.
  [[nodiscard]] Failure follow(const Block& block, const NextBlock& next);
  [[nodiscard]] Failure follow(const Block& block, const EndProgram& end);
  [[nodiscard]] Failure follow(const Block& block, const LeaveSubprogram& leave);
  [[nodiscard]] Failure follow(const Block& block, CallSubprogram call);
  [[nodiscard]] Failure follow(const Block& block, const CallFile& call);
  [[nodiscard]] Failure follow(const Block& block, const EndModalCall& end);
  [[nodiscard]] Failure call_blocks(const Block& block, const CallSubprogram& call);
  [[nodiscard]] Failure call_numbered(const Block& block, CallSubprogram call, bool by_modal);
  [[nodiscard]] Failure repeat_main_program(const Block& block, const LeaveSubprogram& leave);

  // What its flow statement asks for (program_flow.cpp).
  [[nodiscard]] Failure follow_statement(const Block& block);
  [[nodiscard]] Failure enter_loop(const Block& block, const Landmark& here);
  [[nodiscard]] Failure turn_loop(const Block& block, const Landmark& here);
  [[nodiscard]] Failure call(const Block& block);
  [[nodiscard]] Failure give_back(const Block& block);
  [[nodiscard]] Failure call_program(const Block& block, const std::string& name,
                                     GivenArguments arguments, std::uint64_t count);
  [[nodiscard]] Failure receive(const Block& block);
  [[nodiscard]] Failure receive_array(const Block& block, std::size_t index);
  [[nodiscard]] Failure choose(const Block& block);
  [[nodiscard]] Failure jump(const Block& block);
  [[nodiscard]] Failure go_to_label(const Block& block, const std::string& label, Search search);
  [[nodiscard]] Failure end_program(const Block& block, std::uint32_t column);
  [[nodiscard]] Failure repeat(const Block& block);
  [[nodiscard]] std::optional<std::uint64_t> end_of_part(const FlowStatement& flow,
                                                         TextPlace begin);
  [[nodiscard]] std::optional<TextPlace> find_label(std::string_view label, Search search);
  void report_choice(const Block& block, const std::string& label);

  [[nodiscard]] Failure execute(const Block& block);
  [[nodiscard]] Diagnostic in_main(Diagnostic diagnostic) const;
  [[nodiscard]] Diagnostic in_this_file(Diagnostic diagnostic) const;
  [[nodiscard]] Result<double> value_of(const Block& block, ExpressionRange range);
  // Done with an alarm whose condition only the machine knows.
  [[nodiscard]] std::optional<Failure> pass_alarm(const Block& block);
  [[nodiscard]] Result<bool> holds(const Block& block, const FlowStatement& flow);
  [[nodiscard]] Result<std::string> label_of(const Block& block, const FlowStatement& flow);
  [[nodiscard]] Result<std::uint64_t> count_of(const Block& block, ExpressionRange range);
  // The program that has the subprogram `name`: the one at work, the main one, a file of its own.
  [[nodiscard]] std::shared_ptr<LoadedProgram> program_with(const std::string& name);
  [[nodiscard]] std::shared_ptr<LoadedProgram> file_of(const std::string& name);
  [[nodiscard]] Result<std::shared_ptr<LoadedProgram>> file_of_number(const Block& block,
                                                                      std::uint32_t column,
                                                                      std::uint32_t number);
  [[nodiscard]] Failure push_call(const Block& block, std::uint32_t column, CallFrame frame);
  [[nodiscard]] CallFrame& frame() { return frames_.back(); }
  [[nodiscard]] Diagnostic at(const Block& block, std::uint32_t column, DiagnosticId id,
                              std::string message, std::string hint) const;

  const MotionSink& sink_;
  const InterpreterOptions& options_;
  const DialectRules& rules_;
  BlockExecutor executor_;
  std::shared_ptr<LoadedProgram> main_;
  std::map<std::string, std::shared_ptr<LoadedProgram>> files_{};
  std::vector<CallFrame> frames_{};
  std::uint64_t blocks_ = 0;
  std::uint64_t lines_ = 0;  // of all files, as far as they have run
  // Motions so far, and the blocks before the last of them.
  std::uint64_t moves_ = 0;
  std::uint64_t blocks_at_move_ = 0;
  // Where the O subs are that have been defined, on the way or by a call.
  std::set<std::pair<const LoadedProgram*, std::uint64_t>> defined_{};
  bool statement_ran_ = false;  // since the main program began, or began again by M99
  bool syntax_failed_ = false;
  // The else that a branch whose condition did not hold goes on with, by the offset of its block.
  std::optional<std::uint64_t> else_to_try_{};
};

}  // namespace frustum::parser
