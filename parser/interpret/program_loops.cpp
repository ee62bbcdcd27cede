// Loops and parts that are repeated.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "parser/interpret/program_run.hpp"

namespace frustum::parser {

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
      return at(block, flow.column, "unknown-parameter"_id,
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

// What is after the last block of a repeated part.
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
  report_choice(block, flow.label);
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
