#include "parser/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace frustum::parser {
namespace {

// Where a program or subprogram is at work.
struct Frame {
  std::uint32_t program = 0;  // O number; of no meaning for a main program without one
  std::size_t entry = 0;      // index of its first block that does something
  std::size_t next = 0;       // index of the block to run
  std::uint32_t runs_left = 1;
};

class Run {
 public:
  Run(const Program& program, const MotionSink& sink, const InterpreterOptions& options)
      : program_(program), sink_(sink), options_(options), executor_(program.dialect, sink) {}

  Result<RunSummary> operator()() {
    frames_.push_back({0, main_entry(), 0, 1});
    while (!frames_.empty()) {
      if (auto failure = run_next()) return located(*std::move(failure));
    }
    return RunSummary{executor_.state(), blocks_};
  }

 private:
  using Failure = std::optional<Diagnostic>;

  // Behind the comments and the tape mark that open the file.
  [[nodiscard]] std::size_t main_entry() const {
    const auto opening = [](const Block& block) {
      return block.words.empty() && block.assignments.empty() && !block.program;
    };
    const auto entry = std::find_if_not(program_.blocks.begin(), program_.blocks.end(), opening);
    return static_cast<std::size_t>(entry - program_.blocks.begin());
  }

  Failure run_next() {
    Frame& frame = frames_.back();
    if (frame.next >= program_.blocks.size()) return run_off(nullptr);
    const Block& block = program_.blocks[frame.next];
    if ((block.tape_mark || block.program) && frame.next > frame.entry) return run_off(&block);
    ++frame.next;
    if (++blocks_ > options_.max_blocks) {
      return at(block, 1, fmt::format("more than {} blocks have run", options_.max_blocks),
                "look for repeats within repeats (M98 L)");
    }
    if (block.deletable && options_.block_delete) {
      sink_(Motion{{block.line, 1}, Event{"block_delete", {}}});
      return std::nullopt;
    }
    auto flow = executor_.execute(block);
    if (!flow) return std::move(flow).error().front();
    return std::visit([&](const auto& next) { return follow(block, next); }, *flow);
  }

  // The end of the text, a tape mark, or the next program: fine for a main program only.
  Failure run_off(const Block* end) {
    const Frame& frame = frames_.back();
    if (frames_.size() > 1) {
      return at(program_.blocks[frame.entry], program_.blocks[frame.entry].program_column,
                fmt::format("subprogram O{} has no M99", frame.program),
                "end the subprogram with M99");
    }
    if (end != nullptr && end->program) {
      return at(*end, end->program_column, fmt::format("the program runs into O{}", *end->program),
                "end the main program with M30");
    }
    frames_.clear();
    return std::nullopt;
  }

  static Failure follow(const Block& /*block*/, NextBlock /*next*/) { return std::nullopt; }

  Failure follow(const Block& /*block*/, EndProgram /*end*/) {
    frames_.clear();
    return std::nullopt;
  }

  Failure follow(const Block& block, const LeaveSubprogram& leave) {
    if (frames_.size() == 1) {
      return at(block, leave.column, "M99 in the main program would repeat it for ever",
                "end the main program with M30");
    }
    Frame& frame = frames_.back();
    if (--frame.runs_left > 0) {
      frame.next = frame.entry;
    } else {
      frames_.pop_back();
    }
    return std::nullopt;
  }

  Failure follow(const Block& block, CallSubprogram call) {
    auto entry = program_.entries.find(call.program);
    if (entry == program_.entries.end() && !call.counted && call.program >= kRepeatsFactor) {
      call.count = call.program / kRepeatsFactor;
      call.program %= kRepeatsFactor;
      entry = program_.entries.find(call.program);
    }
    if (entry == program_.entries.end()) {
      return at(block, call.column, fmt::format("subprogram O{} does not exist", call.program),
                known_programs());
    }
    if (call.count == 0) return std::nullopt;
    if (frames_.size() > options_.max_call_depth) {
      return at(block, call.column,
                fmt::format("more than {} subprograms within each other", options_.max_call_depth),
                fmt::format("does O{} call itself?", call.program));
    }
    frames_.push_back({call.program, entry->second, entry->second, call.count});
    return std::nullopt;
  }

  [[nodiscard]] std::string known_programs() const {
    if (program_.entries.empty())
      return "the file holds no subprogram; begin one with O and its number";
    std::string names = "the file holds";
    for (const auto& entry : program_.entries) names += fmt::format(" O{}", entry.first);
    return names;
  }

  static Diagnostic at(const Block& block, std::uint32_t column, std::string message,
                       std::string hint) {
    Diagnostic diagnostic = error(std::move(message), std::move(hint));
    diagnostic.line = static_cast<int>(block.line);
    diagnostic.column = static_cast<int>(column);
    return diagnostic;
  }

  [[nodiscard]] Diagnostic located(Diagnostic diagnostic) const {
    diagnostic.file = program_.file;
    return diagnostic;
  }

  // P00032000: three times O2000.
  static constexpr std::uint32_t kRepeatsFactor = 10'000;

  const Program& program_;
  const MotionSink& sink_;
  const InterpreterOptions& options_;
  BlockExecutor executor_;
  std::vector<Frame> frames_;
  std::uint64_t blocks_ = 0;
};

}  // namespace

Result<RunSummary> interpret(const Program& program, const MotionSink& sink,
                             const InterpreterOptions& options) {
  return Run(program, sink, options)();
}

Result<std::vector<Motion>> motions_of(const Program& program, const InterpreterOptions& options) {
  std::vector<Motion> motions;
  const auto summary = interpret(
      program, [&motions](Motion&& motion) { motions.push_back(std::move(motion)); }, options);
  if (!summary) return summary.error();
  return motions;
}

}  // namespace frustum::parser
