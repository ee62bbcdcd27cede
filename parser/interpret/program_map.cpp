#include "parser/interpret/program_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "parser/reading/block_cursor.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kEndLabel = "ENDLABEL";

// What a statement is called in messages, and how its end is.
struct Wording {
  std::string_view begin;
  std::string_view end;
};
Wording wording(FlowKind kind) {
  switch (kind) {
    case FlowKind::branch:
    case FlowKind::else_branch:
    case FlowKind::otherwise:
    case FlowKind::end_branch:
      return {"if", "endif"};
    case FlowKind::subprogram:
    case FlowKind::end_sub:
      return {"subprogram", "end"};
    default:
      return {"loop", "end"};
  }
}

// " 100", for a message; empty for statements without label.
std::string named(const Landmark& landmark) {
  return landmark.label.empty() ? std::string{} : " " + landmark.label;
}

bool opens(FlowKind kind) {
  return kind == FlowKind::branch || kind == FlowKind::loop || kind == FlowKind::subprogram;
}
// What must be open for `kind`; nothing for statements that are whole by themselves.
std::optional<FlowKind> opener_of(FlowKind kind) {
  switch (kind) {
    case FlowKind::else_branch:
    case FlowKind::otherwise:
    case FlowKind::end_branch:
      return FlowKind::branch;
    case FlowKind::end_loop:
    case FlowKind::leave_loop:
    case FlowKind::next_turn:
      return FlowKind::loop;
    case FlowKind::end_sub:
      return FlowKind::subprogram;
    default:
      return std::nullopt;
  }
}
bool closes(FlowKind kind) {
  return kind == FlowKind::end_branch || kind == FlowKind::end_loop || kind == FlowKind::end_sub;
}

}  // namespace

ProgramMap::ProgramMap(const Program& program) {
  BlockCursor cursor(program);
  std::size_t programs = 0;
  std::size_t work = 0;
  bool begun = false;
  while (true) {
    const auto block = cursor.next();
    begun = begun || !block;
    if (!block) continue;
    if (*block == nullptr) break;
    // What is behind the closing % is no part of the program.
    if (program.dialect == Dialect::linuxcnc && begun && (*block)->tape_mark) break;
    begun = begun || (*block)->tape_mark || !(*block)->words.empty() || (*block)->flow ||
            (*block)->program || !(*block)->assignments.empty();
    const TextPlace place = cursor.block_place();
    if ((*block)->program)
      programs_.emplace(*(*block)->program, Numbered{place, (*block)->program_column});
    if (!(*block)->words.empty() || !(*block)->assignments.empty()) ++work;
    if (const auto& flow = (*block)->flow) {
      if (flow->kind == FlowKind::program) ++programs;
      landmarks_.push_back(
          {place, cursor.place(), flow->kind, flow->turns, flow->column, flow->label, programs});
      landmarks_.back().work_before = work;
      landmarks_.back().jumps_if = flow->kind == FlowKind::jump && !flow->condition.empty();
      if (!flow->block_label.empty()) {
        landmarks_.push_back({place, cursor.place(), FlowKind::label, flow->turns,
                              flow->block_label_column, flow->block_label, programs});
      }
    }
  }
  pair(program);
}

void ProgramMap::add_fault(const Program& program, Landmark& landmark, DiagnosticId id,
                           std::string message, std::string hint) {
  Diagnostic fault = error(id, std::move(message), std::move(hint));
  fault.file = program.file;
  fault.line = static_cast<int>(landmark.place.line);
  fault.column = static_cast<int>(landmark.column);
  landmark.fault = landmark.fault.value_or(faults_.size());
  faults_.push_back(std::move(fault));
}

const Diagnostic* ProgramMap::fault_of(const Landmark& landmark, bool any) const {
  if (any) return faults_.empty() ? nullptr : &faults_.front();
  return landmark.fault ? &faults_[*landmark.fault] : nullptr;
}

// ENDIF directly behind IF .. GOTOF, or behind other ENDIFs that are: nothing is left out by it,
// whatever it is taken to close.
bool ProgramMap::ends_a_jump(std::size_t index) const {
  const Landmark& here = landmarks_[index];
  if (here.kind != FlowKind::end_branch) return false;
  for (std::size_t i = index; i-- > 0;) {
    const Landmark& before = landmarks_[i];
    if (before.work_before != here.work_before) return false;
    if (before.jumps_if) return true;
    if (before.kind != FlowKind::end_branch) return false;
  }
  return false;
}

void ProgramMap::pair(const Program& program) {
  struct Open {
    std::size_t begin;
    std::size_t last;  // part
  };
  std::vector<Open> open;
  const auto unended = [&](const Open& statement) {
    Landmark& begin = landmarks_[statement.begin];
    add_fault(program, begin, "flow-unpaired"_id,
              fmt::format("{}{} has no end", wording(begin.kind).begin, named(begin)),
              fmt::format("close it with its {}", wording(begin.kind).end));
  };
  const auto twice = [&](Landmark& here, const Landmark& first) {
    add_fault(program, here, "flow-name-twice"_id,
              fmt::format("{} is already on line {}", here.label, first.place.line),
              "give each its own name");
  };
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    Landmark& here = landmarks_[i];
    here.begin = here.next = here.end = i;
    if (here.kind == FlowKind::program) {
      // PROC NAME after %_N_NAME_SPF is the same program.
      const bool again = i > 0 && landmarks_[i - 1].kind == FlowKind::program &&
                         landmarks_[i - 1].label == here.label;
      const auto [first, fresh] = heads_.emplace(here.label, i);
      if (!fresh && !again) twice(here, landmarks_[first->second]);
    } else if ((here.kind == FlowKind::subprogram || here.kind == FlowKind::label) &&
               here.label != kEndLabel) {
      auto& known = labels_[std::pair(here.program, here.label)];
      known.push_back(i);
      const bool may_be_twice =
          program.dialect == Dialect::sinumerik && here.kind == FlowKind::label;
      if (known.size() > 1 && !may_be_twice) twice(here, landmarks_[known.front()]);
      targets_.emplace(here.label, i);
    }
    // `while` after the body of a `do` of the same label is its end.
    if (here.kind == FlowKind::loop && here.turns == Turns::while_true && !open.empty()) {
      const Landmark& begin = landmarks_[open.back().begin];
      if (begin.kind == FlowKind::loop && begin.turns == Turns::until_end && !here.label.empty() &&
          begin.label == here.label) {
        here.kind = FlowKind::end_loop;
      }
    }
    if (opens(here.kind)) {
      if (here.kind == FlowKind::subprogram && !open.empty()) {
        add_fault(program, here, "flow-unpaired"_id,
                  fmt::format("subprogram{} begins within another statement", named(here)),
                  fmt::format("that of line {} is open", landmarks_[open.back().begin].place.line));
      }
      open.push_back({i, i});
      continue;
    }
    const auto opener = opener_of(here.kind);
    if (!opener) continue;
    const bool inner_only = *opener != FlowKind::loop || here.kind == FlowKind::end_loop;
    auto statement = std::find_if(open.rbegin(), open.rend(), [&](const Open& candidate) {
      const Landmark& begin = landmarks_[candidate.begin];
      return begin.kind == *opener &&
             (begin.label == here.label || (here.label.empty() && !inner_only));
    });
    if (statement == open.rend() && program.dialect == Dialect::sinumerik && ends_a_jump(i)) {
      continue;
    }
    if (statement == open.rend()) {
      add_fault(program, here, "flow-unpaired"_id,
                fmt::format("there is no {}{} to which this belongs", wording(*opener).begin,
                            named(here)),
                fmt::format("it is after its {}, with the same label", wording(*opener).begin));
      continue;
    }
    if (inner_only) {
      while (&*statement != &open.back()) {
        unended(open.back());
        open.pop_back();
        statement = open.rbegin();
        while (landmarks_[statement->begin].kind != *opener ||
               landmarks_[statement->begin].label != here.label)
          ++statement;
      }
    }
    here.begin = statement->begin;
    if (!inner_only) continue;
    Landmark& last = landmarks_[statement->last];
    if (last.kind == FlowKind::otherwise && !closes(here.kind)) {
      add_fault(program, here, "flow-unpaired"_id, "a part of the if after its else",
                fmt::format("else of line {} is the last part", last.place.line));
    }
    last.next = i;
    statement->last = i;
    if (!closes(here.kind)) continue;
    // Every part knows its end.
    for (std::size_t part = here.begin; part != i; part = landmarks_[part].next) {
      landmarks_[part].end = i;
    }
    open.pop_back();
  }
  for (const Open& statement : open) unended(statement);
  // break and continue go by the end of their loop.
  for (Landmark& landmark : landmarks_) {
    if (landmark.kind == FlowKind::leave_loop || landmark.kind == FlowKind::next_turn) {
      landmark.end = landmarks_[landmark.begin].end;
    }
  }
}

const Landmark& ProgramMap::at(TextPlace place) const {
  return *std::lower_bound(landmarks_.begin(), landmarks_.end(), place.offset,
                           [](const Landmark& landmark, std::uint64_t offset) {
                             return landmark.place.offset < offset;
                           });
}

const Landmark* ProgramMap::target(std::string_view label) const {
  const auto found = targets_.find(label);
  return found == targets_.end() ? nullptr : &landmarks_[found->second];
}

const Landmark* ProgramMap::head(std::string_view name) const {
  const auto found = heads_.find(name);
  return found == heads_.end() ? nullptr : &landmarks_[found->second];
}

const Landmark* ProgramMap::target(std::string_view label, TextPlace from, Search search) const {
  const auto found = labels_.find(std::pair(program_at(from), std::string(label)));
  if (found == labels_.end()) return nullptr;
  const Landmark* ahead = nullptr;
  const Landmark* before = nullptr;
  for (const std::size_t index : found->second) {
    const Landmark& candidate = landmarks_[index];
    if (candidate.place.offset <= from.offset) {
      before = &candidate;
    } else if (ahead == nullptr) {
      ahead = &candidate;
    }
  }
  switch (search) {
    case Search::forward:
      return ahead;
    case Search::backward:
      return before;
    case Search::forward_then_backward:
      return ahead != nullptr ? ahead : before;
    case Search::from_start:
      break;
  }
  return &landmarks_[found->second.front()];
}

bool ProgramMap::is_there_twice(std::string_view label, TextPlace from) const {
  const auto found = labels_.find(std::pair(program_at(from), std::string(label)));
  return found != labels_.end() && found->second.size() > 1;
}

const Landmark* ProgramMap::end_label(TextPlace from, std::uint64_t to) const {
  const auto found =
      std::find_if(landmarks_.begin(), landmarks_.end(), [&](const Landmark& landmark) {
        return landmark.place.offset > from.offset && landmark.place.offset < to &&
               landmark.program == program_at(from) && landmark.label == kEndLabel;
      });
  return found == landmarks_.end() ? nullptr : &*found;
}

std::size_t ProgramMap::program_at(TextPlace place) const {
  const auto behind = std::upper_bound(landmarks_.begin(), landmarks_.end(), place.offset,
                                       [](std::uint64_t offset, const Landmark& landmark) {
                                         return offset < landmark.place.offset;
                                       });
  return behind == landmarks_.begin() ? 0 : std::prev(behind)->program;
}

}  // namespace frustum::parser
