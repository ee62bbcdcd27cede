// Flow statements: their order, branches and jumps. Loops are in program_loops.cpp, calls in
// program_calls.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/decimal.hpp"
#include "parser/interpret/block_comments.hpp"
#include "parser/interpret/program_run.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr double kMaxLoopTurns = 1e9;
std::string spelled(double value) {
  return is_vacant(value) ? "a vacant value" : shortest_decimal(value);
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
  if (!value) return in_this_file(std::move(value).error().front());
  if (!is_unknown(*value)) return value;
  return at(block, block.flow->column, "unknown-value"_id,
            fmt::format("what comes next depends on {}, which only the machine knows",
                        executor_.state().parameters.text_of(*value)),
            "give a number");
}

Result<bool> ProgramRun::holds(const Block& block, const FlowStatement& flow) {
  const ParameterRules& rules = rules_.parameters;
  auto value = parser::value_of(executor_.state(), block, flow.condition);
  if (value && is_unknown(*value) && rules.conditions_may_be_unknown) {
    value = kVacant;
  } else {
    value = value_of(block, flow.condition);
  }
  if (!value) return value.error();
  if (is_vacant(*value) && (rules.values_may_be_unknown || rules.conditions_may_be_unknown)) {
    assume(executor_.state(), flow.column, "condition",
           fmt::format("on line {}, of a value that only the machine knows: taken as not met",
                       block.line));
  }
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

// IF [#5401 GT 60] THEN #3000=1: what only the machine knows raises no alarm.
std::optional<ProgramRun::Failure> ProgramRun::pass_alarm(const Block& block) {
  constexpr double kAlarm = 3000.0;
  InterpreterState& state = executor_.state();
  if (rules_.dialect != Dialect::fanuc || !block.words.empty() || block.assignments.size() != 1 ||
      block.assignments.front().name) {
    return std::nullopt;
  }
  const auto target = parser::value_of(state, block, block.assignments.front().index);
  if (!target || *target != kAlarm) return std::nullopt;
  const auto value = parser::value_of(state, block, block.flow->condition);
  if (!value || !is_unknown(*value)) return std::nullopt;
  state.at_work.block = &block;
  assume(
      state, block.flow->column, "alarm",
      fmt::format("{} is such that the program raises no alarm", state.parameters.text_of(*value)));
  return ProgramRun::Failure{};
}

ProgramRun::Failure ProgramRun::follow_statement(const Block& block) {
  if (auto done = report_comments(executor_.state(), block); !done) {
    return in_this_file(std::move(done).error().front());
  }
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
      if (const auto passed = pass_alarm(block)) return *passed;
      const auto condition = holds(block, flow);
      if (!condition) return condition.error().front();
      return *condition ? execute(block) : std::nullopt;
    }
    default:
      break;
  }
  const ProgramMap& map = frame().program->map();
  const Landmark& here = map.at(place);
  if (const Diagnostic* fault = map.fault_of(here, !rules_.faults_count_when_run)) return *fault;
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
    case FlowKind::end_branch:
      if (&map[here.begin] != &here) return std::nullopt;
      executor_.state().at_work.block = &block;
      assume(executor_.state(), flow.column, "ENDIF", "of a jump, IF .. GOTOF, it closes nothing");
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
      if (!defined_.insert({frame().program.get(), here.place.offset}).second) {
        return at(
            block, flow.column, "subprogram-in-path"_id,
            fmt::format("the program runs into subprogram {}, which it has met before", flow.label),
            "end the main program with M2 before it, or define it before it is called");
      }
      // One within it is wrong even if nothing calls it.
      for (std::size_t i = here.begin + 1; i < here.end; ++i) {
        if (map[i].kind == FlowKind::subprogram && map[i].fault)
          return *map.fault_of(map[i], false);
      }
      frame().cursor.go_to(map[here.end].behind);
      return std::nullopt;
    case FlowKind::end_sub:
      return give_back(block);
    default:
      return std::nullopt;
  }
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

std::optional<TextPlace> ProgramRun::find_label(std::string_view label, Search search) {
  const auto number = block_number_of(label);
  const TextPlace here = frame().cursor.block_place();
  const TextPlace start = frame().entry;
  const auto found_in = [&](TextPlace from, std::uint64_t end) {
    return frame().program->numbers().find(*number, from.offset, end, start.offset);
  };
  constexpr auto kEnd = std::numeric_limits<std::uint64_t>::max();
  if (!number) {
    const Landmark* target = frame().program->map().target(label, here, search);
    return target == nullptr ? std::nullopt : std::optional(target->place);
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

// Of labels that are there twice.
void ProgramRun::report_choice(const Block& block, const std::string& label) {
  if (!frame().program->map().is_there_twice(label, frame().cursor.block_place())) return;
  executor_.state().at_work.block = &block;
  assume(executor_.state(), block.flow->column, "label",
         fmt::format("{} is there twice: the nearest one where the search goes counts", label));
}

ProgramRun::Failure ProgramRun::go_to_label(const Block& block, const std::string& label,
                                            Search search) {
  const FlowStatement& flow = *block.flow;
  if (!block_number_of(label) && !frame().program->map().faults().empty()) {
    return frame().program->map().faults().front();
  }
  const auto target = find_label(label, search);
  report_choice(block, label);
  if (!target && flow.may_be_missing) return std::nullopt;
  if (!target) {
    return at(block, flow.column, "missing-label"_id, fmt::format("there is no {} to go to", label),
              "the jump names a block or label of this program");
  }
  frame().cursor.go_to(*target);
  // A jump within a repeated part does not end its repeats.
  std::vector<RepeatedPart>& parts = frame().parts;
  while (!parts.empty() &&
         (target->offset < parts.back().begin.offset || target->offset >= parts.back().end)) {
    parts.pop_back();
  }
  return std::nullopt;
}

}  // namespace frustum::parser
