// Flow statements: branches, loops, subprograms by name, jumps and repeats.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "parser/interpret/block_comments.hpp"
#include "parser/interpret/cycles/hole_call.hpp"
#include "parser/interpret/program_run.hpp"
#include "parser/interpret/saved_modes.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kMaxArguments = 30;
constexpr double kMaxLoopTurns = 1e9;
constexpr const char* kEndOfLabel = "LBL 0";

std::string unlabelled(std::string_view kind, const std::string& label) {
  return label.empty() ? std::string(kind) : fmt::format("{} {}", kind, label);
}

std::string spelled(double value) {
  return is_vacant(value) ? "a vacant value" : decimal_text(value);
}

// "120" of the label "N120".
std::optional<std::uint32_t> block_number_of(std::string_view label) {
  std::uint32_t number = 0;
  if (label.size() < 2 || label.front() != 'N') return std::nullopt;
  const auto read = std::from_chars(label.data() + 1, label.data() + label.size(), number);
  if (read.ec != std::errc{} || read.ptr != label.data() + label.size()) return std::nullopt;
  return number;
}

}  // namespace

Result<double> ProgramRun::value_of(const Block& block, ExpressionRange range) {
  auto value = parser::value_of(executor_.state(), block, range);
  if (value) return value;
  return in_this_file(std::move(value).error().front());
}

Result<bool> ProgramRun::holds(const Block& block, const FlowStatement& flow) {
  const auto value = value_of(block, flow.condition);
  if (!value) return value.error();
  return (*value != 0.0 && !is_vacant(*value)) != flow.negated;
}

Result<std::string> ProgramRun::label_of(const Block& block, const FlowStatement& flow) {
  if (flow.label_value.empty()) return flow.label;
  const auto value = value_of(block, flow.label_value);
  if (!value) return value.error();
  const double nearest = std::round(*value);
  if (!(std::abs(*value - nearest) <= 1e-4) || nearest < 0.0 || nearest > 99'999'999.0) {
    return at(block, flow.column, "flow-number"_id,
              fmt::format("{} is no number of a block or subprogram", spelled(*value)),
              "it is a whole number from 0 to 99999999");
  }
  return flow.label + fmt::format("{}", static_cast<std::uint32_t>(nearest));
}

Result<std::uint64_t> ProgramRun::count_of(const Block& block, ExpressionRange range) {
  if (range.empty()) return std::uint64_t{1};
  const auto value = value_of(block, range);
  if (!value) return value.error();
  const double nearest = std::round(*value);
  if (!(std::abs(*value - nearest) <= 1e-4) || nearest > kMaxLoopTurns) {
    return at(block, block.flow->column, "flow-number"_id,
              fmt::format("{} is no number of repeats", spelled(*value)),
              "it is a whole number up to 1000000000");
  }
  return static_cast<std::uint64_t>(std::max(0.0, nearest));
}

ProgramRun::Failure ProgramRun::follow_statement(const Block& block) {
  report_comments(executor_.state(), block);
  const FlowStatement& flow = *block.flow;
  const TextPlace place = frame().cursor.block_place();
  switch (flow.kind) {
    case FlowKind::call:
      return call(block);
    case FlowKind::give_back:
      return give_back(block);
    case FlowKind::jump:
      return jump(block);
    case FlowKind::repeat_part:
      return repeat(block);
    case FlowKind::label:
      // A control for Klartext looks at all labels before it runs.
      if (rules_.calls_whole_files && !frame().program->map().faults().empty()) {
        return frame().program->map().faults().front();
      }
      return block.words.empty() && block.assignments.empty() ? std::nullopt : execute(block);
    case FlowKind::program:
      return receive(block);
    case FlowKind::choice:
      return choose(block);
    case FlowKind::only_if: {
      const auto condition = holds(block, flow);
      if (!condition) return condition.error().front();
      return *condition ? execute(block) : std::nullopt;
    }
    default:
      break;
  }
  const ProgramMap& map = frame().program->map();
  if (!map.faults().empty()) return map.faults().front();
  const Landmark& here = map.at(place);
  switch (here.kind) {
    case FlowKind::branch:
    case FlowKind::else_branch: {
      const bool asked = here.kind == FlowKind::branch || else_to_try_ == place.offset;
      else_to_try_.reset();
      if (!asked) {
        frame().cursor.go_to(map[here.end].behind);
        return std::nullopt;
      }
      const auto condition = holds(block, flow);
      if (!condition) return condition.error().front();
      if (*condition) return std::nullopt;
      const Landmark& next = map[here.next];
      if (next.kind == FlowKind::else_branch) {
        else_to_try_ = next.place.offset;
        frame().cursor.go_to(next.place);
      } else {
        frame().cursor.go_to(next.behind);
      }
      return std::nullopt;
    }
    case FlowKind::otherwise:
      frame().cursor.go_to(map[here.end].behind);
      return std::nullopt;
    case FlowKind::loop:
      return enter_loop(block, here);
    case FlowKind::end_loop:
      return turn_loop(block, here);
    case FlowKind::leave_loop:
    case FlowKind::next_turn:
      if (map[here.begin].turns == Turns::counted) {
        return at(
            block, flow.column, "flow-outside-loop"_id,
            fmt::format("{} of a repeat", here.kind == FlowKind::leave_loop ? "break" : "continue"),
            "it belongs to while and do: count the turns in a while loop");
      }
      if (here.kind == FlowKind::next_turn) {
        frame().cursor.go_to(map[here.end].place);
        return std::nullopt;
      }
      frame().cursor.go_to(map[here.end].behind);
      return std::nullopt;
    case FlowKind::subprogram:
      // Reached by the blocks before it: a definition, which runs when it is called.
      frame().cursor.go_to(map[here.end].behind);
      return std::nullopt;
    case FlowKind::end_sub:
      return give_back(block);
    default:
      return std::nullopt;
  }
}

ProgramRun::Failure ProgramRun::enter_loop(const Block& block, const Landmark& here) {
  const FlowStatement& flow = *block.flow;
  const ProgramMap& map = frame().program->map();
  std::vector<CountedLoop>& loops = frame().loops;
  // Left by a jump and begun anew: what it had counted is of no more use.
  const auto left = std::find_if(loops.begin(), loops.end(), [&](const CountedLoop& loop) {
    return loop.begin == here.place.offset;
  });
  loops.erase(left, loops.end());
  bool goes = true;
  if (flow.turns == Turns::while_true) {
    const auto condition = holds(block, flow);
    if (!condition) return condition.error().front();
    goes = *condition;
  } else if (flow.turns == Turns::counted) {
    const auto count = count_of(block, flow.condition);
    if (!count) return count.error().front();
    goes = *count > 0;
    if (goes) loops.push_back({here.place.offset, static_cast<double>(*count)});
  } else if (flow.turns == Turns::stepped) {
    const auto first = value_of(block, flow.condition);
    if (!first) return first.error().front();
    const auto limit = value_of(block, flow.limit);
    if (!limit) return limit.error().front();
    const std::string& variable = block.names[flow.variable];
    if (!executor_.state().parameters.can_set(variable)) {
      return at(block, flow.column, "parameter-undefined"_id,
                fmt::format("{} is not defined", variable),
                "define it before: DEF INT and its name");
    }
    executor_.state().parameters.set(variable, *first);
    goes = *first <= *limit;
    if (goes) loops.push_back({here.place.offset, 0.0, variable, *limit});
  }
  if (!goes) frame().cursor.go_to(map[here.end].behind);
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::turn_loop(const Block& block, const Landmark& here) {
  const ProgramMap& map = frame().program->map();
  const Landmark& begin = map[here.begin];
  if (begin.turns == Turns::while_true) {
    frame().cursor.go_to(begin.place);
    return std::nullopt;
  }
  if (begin.turns == Turns::until_end) {
    if (!block.flow->condition.empty()) {
      const auto again = holds(block, *block.flow);
      if (!again) return again.error().front();
      if (!*again) return std::nullopt;
    }
    frame().cursor.go_to(begin.behind);
    return std::nullopt;
  }
  std::vector<CountedLoop>& loops = frame().loops;
  const auto loop = std::find_if(loops.begin(), loops.end(), [&](const CountedLoop& candidate) {
    return candidate.begin == begin.place.offset;
  });
  if (loop == loops.end()) {
    return at(block, block.flow->column, "flow-outside-loop"_id,
              "the end of a loop that was not begun",
              fmt::format("the jump into it passed its beginning on line {}", begin.place.line));
  }
  loops.erase(loop + 1, loops.end());
  if (begin.turns == Turns::counted) {
    if (--loop->turns_left > 0.0) {
      frame().cursor.go_to(begin.behind);
    } else {
      loops.pop_back();
    }
    return std::nullopt;
  }
  const auto value = executor_.state().parameters.read(loop->variable);
  const double stepped = (value ? *value : 0.0) + 1.0;
  executor_.state().parameters.set(loop->variable, stepped);
  if (stepped <= loop->limit) {
    frame().cursor.go_to(begin.behind);
  } else {
    loops.pop_back();
  }
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::call(const Block& block) {
  const FlowStatement& flow = *block.flow;
  const auto name = label_of(block, flow);
  if (!name) return name.error().front();
  if (flow.arguments.size() > kMaxArguments) {
    return at(block, flow.column, "call-arguments"_id,
              fmt::format("{} arguments in a call", flow.arguments.size()),
              fmt::format("a subprogram takes up to {}", kMaxArguments));
  }
  std::vector<double> arguments;
  for (const ExpressionRange& argument : flow.arguments) {
    if (argument.empty()) {
      arguments.push_back(kVacant);
      continue;
    }
    const auto value = value_of(block, argument);
    if (!value) return value.error().front();
    arguments.push_back(*value);
  }
  const auto count = count_of(block, flow.condition);
  if (!count) return count.error().front();
  if (*count == 0) return std::nullopt;
  if (rules_.subprograms_are_programs) {
    return call_program(block, *name, std::move(arguments), *count);
  }
  if (flow.of_file) {
    if (!flow.by_cycle) return follow(block, CallFile{*name, flow.column});
    set_called_program(executor_.state(), *name);
    return std::nullopt;
  }
  const auto holder = rules_.calls_whole_files ? frame().program : program_with(*name);
  const Landmark* entry = holder == nullptr ? nullptr : holder->map().target(*name);
  // Labels share the parameters of their file.
  const bool has_locals = !rules_.calls_whole_files;
  if (holder != nullptr && !holder->map().faults().empty()) return holder->map().faults().front();
  if (entry == nullptr) {
    return at(block, flow.column, "missing-subprogram"_id, unlabelled("no subprogram", *name),
              options_.search_path.empty() || rules_.calls_whole_files
                  ? "define it in the program"
                  : "define it in the program or in a file of its name");
  }
  CallFrame next{holder,        BlockCursor(holder->program()),
                 *name,         rules_.calls_whole_files ? kEndOfLabel : "endsub",
                 entry->behind, {entry->place.line, entry->column},
                 *count,        has_locals};
  if (auto failure = push_call(block, flow.column, std::move(next))) return failure;
  if (has_locals) executor_.state().parameters.enter(arguments);
  return std::nullopt;
}

// A program with its head in a file that is open, or in one of its own.
ProgramRun::Failure ProgramRun::call_program(const Block& block, const std::string& name,
                                             std::vector<double> arguments, std::uint64_t count) {
  std::shared_ptr<LoadedProgram> holder = frame().program;
  if (holder->map().head(name) == nullptr) holder = main_;
  if (holder->map().head(name) == nullptr) holder = file_of(name);
  if (holder == nullptr) {
    return at(
        block, block.flow->column, "missing-subprogram"_id, fmt::format("no subprogram {}", name),
        fmt::format("write it behind the program, under %_N_{0}_SPF, or in a file {0}.spf", name));
  }
  const Landmark* head = holder->map().head(name);
  CallFrame next{holder,
                 BlockCursor(holder->program()),
                 name,
                 "RET",
                 head == nullptr ? TextPlace{} : head->place,
                 head == nullptr ? SourcePlace{1, 1} : SourcePlace{head->place.line, head->column},
                 count,
                 true};
  next.arguments = std::move(arguments);
  if (auto failure = push_call(block, block.flow->column, std::move(next))) return failure;
  executor_.state().parameters.enter({});
  return std::nullopt;
}

// PROC NAME(REAL WIDTH, INT COUNT=2): what the call gave gets its names.
ProgramRun::Failure ProgramRun::receive(const Block& block) {
  const FlowStatement& flow = *block.flow;
  if (frames_.size() == 1) return std::nullopt;
  const std::vector<double>& given = frame().arguments;
  // A head without PROC takes none, which the call cannot know.
  if (given.size() > flow.parameters.size() && !block.tape_mark) {
    return at(block, flow.column, "call-arguments"_id,
              fmt::format("{} is called with {} arguments and has {} parameters", frame().name,
                          given.size(), flow.parameters.size()),
              "name the parameters in PROC, or leave arguments out");
  }
  if (flow.keeps_modes && frame().runs_left > 0) keep_modes_for_call(executor_.state());
  for (std::size_t i = 0; i < flow.parameters.size(); ++i) {
    const FormalParameter& parameter = flow.parameters[i];
    double value = i < given.size() ? given[i] : kVacant;
    if (is_vacant(value) && !parameter.otherwise.empty()) {
      const auto otherwise = value_of(block, parameter.otherwise);
      if (!otherwise) return otherwise.error().front();
      value = *otherwise;
    }
    executor_.state().parameters.define(block.names[parameter.name], parameter.kind,
                                        is_vacant(value) ? 0.0 : value);
  }
  return std::nullopt;
}

// CASE: the first value that is the condition's.
ProgramRun::Failure ProgramRun::choose(const Block& block) {
  const auto value = value_of(block, block.flow->condition);
  if (!value) return value.error().front();
  for (const Choice& choice : block.flow->choices) {
    if (!choice.value.empty()) {
      const auto candidate = value_of(block, choice.value);
      if (!candidate) return candidate.error().front();
      // Constants are whole numbers.
      if (std::abs(*candidate - *value) > 1e-4) continue;
    }
    return go_to_label(block, choice.label, choice.search);
  }
  return std::nullopt;
}

ProgramRun::Failure ProgramRun::give_back(const Block& block) {
  const FlowStatement& flow = *block.flow;
  if (frames_.size() == 1 && rules_.subprograms_are_programs)
    return end_program(block, flow.column);
  // Klartext passes the end of a subprogram that was not called.
  if (rules_.calls_whole_files && frame().end != kEndOfLabel) return std::nullopt;
  if (frames_.size() == 1) {
    return at(block, flow.column, "flow-outside-call"_id, "return outside a subprogram",
              "end the main program with M2");
  }
  if (!flow.condition.empty()) {
    const auto value = value_of(block, flow.condition);
    if (!value) return value.error().front();
    executor_.state().parameters.set("_value", *value);
  }
  executor_.state().parameters.set("_value_returned", flow.condition.empty() ? 0.0 : 1.0);
  return_from_call();
  return std::nullopt;
}

std::optional<TextPlace> ProgramRun::find_label(std::string_view label, Search search) {
  const auto number = block_number_of(label);
  const TextPlace here = frame().cursor.block_place();
  const TextPlace start = frame().entry;
  const auto found_in = [&](TextPlace from, std::uint64_t end) {
    return frame().program->numbers().find(*number, from.offset, end, start.offset);
  };
  constexpr auto kEnd = std::numeric_limits<std::uint64_t>::max();
  if (!number) {
    const Landmark* target = frame().program->map().target(label, here);
    if (target == nullptr) return std::nullopt;
    const bool behind = target->place.offset > here.offset;
    if ((search == Search::forward && !behind) || (search == Search::backward && behind))
      return std::nullopt;
    return target->place;
  }
  if (search == Search::forward) return found_in(frame().cursor.place(), kEnd);
  // A block may jump to itself.
  const std::uint64_t up_to_here = here.offset + 1;
  if (search == Search::backward) return found_in(start, up_to_here);
  if (search == Search::from_start) return found_in(start, kEnd);
  const auto ahead = found_in(frame().cursor.place(), kEnd);
  return ahead ? ahead : found_in(start, up_to_here);
}

ProgramRun::Failure ProgramRun::jump(const Block& block) {
  const FlowStatement& flow = *block.flow;
  if (!flow.condition.empty()) {
    const auto condition = holds(block, flow);
    if (!condition) return condition.error().front();
    if (!*condition) return std::nullopt;
  }
  const auto label = label_of(block, flow);
  if (!label) return label.error().front();
  return go_to_label(block, *label, flow.search);
}

ProgramRun::Failure ProgramRun::go_to_label(const Block& block, const std::string& label,
                                            Search search) {
  const FlowStatement& flow = *block.flow;
  if (!block_number_of(label) && !frame().program->map().faults().empty()) {
    return frame().program->map().faults().front();
  }
  const auto target = find_label(label, search);
  if (!target && flow.may_be_missing) return std::nullopt;
  if (!target) {
    return at(block, flow.column, "missing-label"_id, fmt::format("there is no {} to go to", label),
              "the jump names a block or label of this program");
  }
  frame().cursor.go_to(*target);
  frame().parts.clear();
  return std::nullopt;
}

// What is behind the last block of a repeated part.
std::optional<std::uint64_t> ProgramRun::end_of_part(const FlowStatement& flow, TextPlace begin) {
  const TextPlace here = frame().cursor.block_place();
  const ProgramMap& map = frame().program->map();
  if (flow.part_end == PartEnd::last) {
    const auto last =
        find_label(flow.last_label.empty() ? flow.label : flow.last_label, flow.search);
    if (!last) return std::nullopt;
    BlockCursor cursor(frame().program->program());
    cursor.go_to(*last);
    (void)cursor.next();
    return cursor.place().offset;
  }
  if (flow.part_end == PartEnd::end_label) {
    const bool before = begin.offset < here.offset;
    const Landmark* end =
        map.end_label(begin, before ? here.offset : std::numeric_limits<std::uint64_t>::max());
    if (end != nullptr) return end->behind.offset;
    if (!before) return std::nullopt;
  }
  return here.offset;
}

ProgramRun::Failure ProgramRun::repeat(const Block& block) {
  const FlowStatement& flow = *block.flow;
  const auto count = count_of(block, flow.condition);
  if (!count) return count.error().front();
  const auto begin = find_label(flow.label, flow.search);
  if (begin && !frame().program->map().faults().empty() && rules_.subprograms_are_programs) {
    return frame().program->map().faults().front();
  }
  const auto end = begin ? end_of_part(flow, *begin) : std::nullopt;
  if (!end || *end < begin->offset) {
    return at(
        block, flow.column, "missing-label"_id,
        fmt::format("there is no part {} to repeat",
                    flow.last_label.empty() ? flow.label : flow.label + " to " + flow.last_label),
        "name labels of this program, the earlier one first");
  }
  if (*count == 0) return std::nullopt;
  if (frame().parts.size() >= options_.max_call_depth) {
    return at(block, flow.column, "repeat-depth"_id,
              fmt::format("more than {} repeats within each other", options_.max_call_depth),
              "does a repeated part hold its own repeat?");
  }
  const TextPlace behind = frame().cursor.place();
  frame().parts.push_back({*begin, *end, behind, *count - 1});
  frame().cursor.go_to(*begin);
  return std::nullopt;
}

}  // namespace frustum::parser
