#include "lint/program_structure.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lint/run_errors.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/block_cursor.hpp"

namespace frustum::lint {
namespace {

using parser::Block;
using parser::BlockCursor;
using parser::Dialect;
using parser::FlowKind;
using parser::Program;
using parser::SourcePlace;

// P00032000: three times O2000.
constexpr std::uint32_t kRepeatsFactor = 10'000;
// The label that ends what REPEAT repeats.
constexpr const char* kEndOfPart = "ENDLABEL";

std::optional<std::uint32_t> plain_word(const Block& block, char letter) {
  for (const parser::Word& word : block.words) {
    if (word.letter != letter || !word.expression.empty()) continue;
    if (word.number < 0.0 || word.number > 1e9) return std::nullopt;
    return static_cast<std::uint32_t>(std::lround(word.number));
  }
  return std::nullopt;
}
bool has_word(const Block& block, char letter) {
  for (const parser::Word& word : block.words) {
    if (word.letter == letter) return true;
  }
  return false;
}
bool has_code(const Block& block, char letter, double number) {
  for (const parser::Word& word : block.words) {
    if (word.letter == letter && word.expression.empty() && word.number == number) return true;
  }
  return false;
}

bool is_end_of_klartext(const Block& block) {
  static const parser::Code* const kEnd = find_code(Dialect::heidenhain, "END PGM");
  return block.words.size() == 1 && block.words[0].letter == parser::kNamedWord &&
         block.words[0].number == row_of(*kEnd);
}

// "120" of the label "N120".
std::optional<std::uint32_t> block_number_of(const std::string& label) {
  std::uint32_t number = 0;
  if (label.size() < 2 || label.front() != 'N') return std::nullopt;
  const char* end = label.data() + label.size();
  const auto read = std::from_chars(label.data() + 1, end, number);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return number;
}

struct Definition {
  SourcePlace place{};
  std::string name{};  // as messages have it
};

// Blocks after an end, up to where something may bring the program there.
struct PathSegment {
  SourcePlace place{};
  std::string end{};  // "M30 on line 12"
  std::uint64_t blocks = 0;
  // Block numbers in it, with the blocks before each.
  std::vector<std::pair<std::uint32_t, std::uint64_t>> numbers{};
};

class Structure {
 public:
  explicit Structure(const Program& program) : program_(program) {}

  WrongLines check(FindingList& findings) {
    read(findings);
    tell_unused(findings);
    tell_unreachable(findings);
    if (!numbers_jumped_to_.empty()) tell_duplicates(findings);
    return wrong_lines_;
  }

 private:
  void read(FindingList& findings) {
    BlockCursor cursor(program_);
    while (true) {
      const auto next = cursor.next();
      if (!next) {
        // Where no run comes, nothing needs to be a block; a run that does tells it.
        if (!ended_) tell_syntax(next.error().front(), findings);
        begun_ = true;
        continue;
      }
      if (*next == nullptr) break;
      // Nothing of LinuxCNC's is behind the closing %.
      if (program_.dialect == Dialect::linuxcnc && (*next)->tape_mark && begun_) break;
      follow_end(**next);
      see(**next);
    }
    close_segment();
  }

  // Whether the program has ended, so that what follows is read by nobody, up to the head of the
  // next program or subprogram.
  void follow_end(const Block& block) {
    if (block.program || (block.flow && (block.flow->kind == FlowKind::program ||
                                         block.flow->kind == FlowKind::subprogram))) {
      ended_ = false;
    } else if (block.tape_mark) {
      ended_ = begun_;
    }
    if (program_.dialect == Dialect::heidenhain && is_end_of_klartext(block)) ended_ = true;
    if (program_.dialect != Dialect::linuxcnc) return;
    if (block.flow) open_statements_ += step_of(block.flow->kind);
    const bool ends = has_code(block, 'M', 2) || has_code(block, 'M', 30);
    if (ends && open_statements_ == 0 && !block.deletable) ended_ = true;
  }
  static int step_of(FlowKind kind) {
    switch (kind) {
      case FlowKind::branch:
      case FlowKind::loop:
      case FlowKind::subprogram:
        return 1;
      case FlowKind::end_branch:
      case FlowKind::end_loop:
      case FlowKind::end_sub:
        return -1;
      default:
        return 0;
    }
  }

  void tell_syntax(const Diagnostic& error, FindingList& findings) {
    wrong_lines_.insert(static_cast<std::uint32_t>(error.line));
    findings.raise(check_of(error, Check::program_error), error,
                   {static_cast<std::uint32_t>(error.line),
                    static_cast<std::uint32_t>(error.column), nullptr});
  }

  void see(const Block& block) {
    const bool acts = !block.words.empty() || !block.assignments.empty();
    // END PGM stands after M30 in every program of Klartext.
    if (program_.dialect == Dialect::heidenhain && is_end_of_klartext(block)) return;
    if (block.program) define_program(block);
    if (block.flow) follow(block);
    if (has_code(block, 'M', 99)) return_to(block);
    if (has_code(block, 'M', 98) || has_code(block, 'G', 65) || has_code(block, 'G', 66)) {
      call_by_number(block);
    }
    if (block.program || block.tape_mark || block.flow) close_segment();
    if (segment_) {
      if (block.number) segment_->numbers.emplace_back(*block.number, segment_->blocks);
      if (acts) {
        if (segment_->blocks++ == 0) segment_->place = {block.line, 1, nullptr};
      }
    } else if (!block.flow && !block.deletable) {
      open_segment(block);
    }
    anything_ = anything_ || acts || block.program || block.flow;
    begun_ = begun_ || anything_;
  }

  void define_program(const Block& block) {
    if (!anything_) return;  // the main program
    programs_.emplace(*block.program, Definition{block.place_of(block.program_column),
                                                 fmt::format("subprogram O{}", *block.program)});
  }

  void call_by_number(const Block& block) {
    const auto number = plain_word(block, 'P');
    if (!number) {
      computed_call_ = computed_call_ || has_word(block, 'P');
      return;
    }
    called_.insert(*number);
    called_.insert(*number % kRepeatsFactor);
  }

  // M99 P20: the caller goes on at its N20, or the main program there.
  void return_to(const Block& block) {
    if (program_.dialect != Dialect::fanuc || !has_word(block, 'P')) return;
    if (const auto number = plain_word(block, 'P')) {
      numbers_jumped_to_.insert(*number);
    } else {
      computed_label_ = true;
    }
  }

  void follow(const Block& block) {
    const parser::FlowStatement& flow = *block.flow;
    if (!flow.block_label.empty() && flow.block_label != kEndOfPart) {
      labels_.emplace(flow.block_label, Definition{block.place_of(flow.block_label_column),
                                                   "label " + flow.block_label});
    }
    switch (flow.kind) {
      case FlowKind::subprogram:
        // A file that begins with it is that subprogram.
        if (anything_) subprograms_.emplace(flow.label, definition(block, "subprogram"));
        break;
      case FlowKind::label:
        if (flow.label != kEndOfPart) labels_.emplace(flow.label, definition(block, "label"));
        break;
      case FlowKind::call:
      case FlowKind::jump:
      case FlowKind::repeat_part:
        refer(flow.label, !flow.label_value.empty());
        if (!flow.last_label.empty()) refer(flow.last_label, false);
        break;
      case FlowKind::choice:
        for (const parser::Choice& choice : flow.choices) refer(choice.label, false);
        break;
      default:
        break;
    }
  }

  static Definition definition(const Block& block, const char* what) {
    return {block.place_of(block.flow->column), fmt::format("{} {}", what, block.flow->label)};
  }

  void refer(const std::string& label, bool computed) {
    if (computed) {
      computed_label_ = true;
    } else if (const auto number = block_number_of(label)) {
      numbers_jumped_to_.insert(*number);
    }
    named_.insert(label);
  }

  void open_segment(const Block& block) {
    for (const double code : {30.0, 2.0, 99.0}) {
      // M99 of Klartext calls the cycle.
      if (code == 99.0 && program_.dialect == Dialect::heidenhain) continue;
      if (!has_code(block, 'M', code)) continue;
      segment_.emplace();
      segment_->end = fmt::format("M{:g} on line {}", code, block.line);
      return;
    }
  }
  void close_segment() {
    if (segment_ && segment_->blocks > 0) segments_.push_back(*std::move(segment_));
    segment_.reset();
  }

  void tell_unused(FindingList& findings) const {
    if (!computed_call_) {
      for (const auto& [number, program] : programs_) {
        if (!called_.contains(number)) unused(Check::unused_subprogram, program, findings);
      }
    }
    if (computed_label_) return;
    for (const auto& [label, subprogram] : subprograms_) {
      if (!named_.contains(label)) unused(Check::unused_subprogram, subprogram, findings);
    }
    for (const auto& [label, target] : labels_) {
      // LBL 0 of Klartext and the like end a subprogram; an empty name is nobody's.
      if (!label.empty() && !named_.contains(label)) unused(Check::unused_label, target, findings);
    }
  }
  static void unused(Check check, const Definition& definition, FindingList& findings) {
    findings.raise(check, FindingList::key_of(definition.place), definition.place, [&] {
      return Words{fmt::format("{} is not used", definition.name), "call it, or leave it out"};
    });
  }

  void tell_unreachable(FindingList& findings) const {
    for (const PathSegment& segment : segments_) {
      std::uint64_t blocks = segment.blocks;
      for (const auto& [number, before] : segment.numbers) {
        if (!computed_label_ && !numbers_jumped_to_.contains(number)) continue;
        blocks = before;
        break;
      }
      if (blocks == 0) continue;
      findings.raise(
          Check::unreachable_code, FindingList::key_of(segment.place), segment.place, [&] {
            return Words{
                fmt::format("{} {} after {} never run{}", blocks, blocks == 1 ? "block" : "blocks",
                            segment.end, blocks == 1 ? "s" : ""),
                "leave out what is not wanted, or move the end"};
          });
    }
  }

  void tell_duplicates(FindingList& findings) const {
    std::map<std::uint32_t, std::uint32_t> first_line;
    BlockCursor cursor(program_);
    while (true) {
      const auto next = cursor.next();
      if (!next) continue;
      if (*next == nullptr) return;
      const Block& block = **next;
      // Each program of the file has numbers of its own.
      if (block.program) first_line.clear();
      if (!block.number || !numbers_jumped_to_.contains(*block.number)) continue;
      const auto known = first_line.emplace(*block.number, block.line);
      if (known.second) continue;
      const std::uint32_t first = known.first->second;
      const SourcePlace place{block.line, 1, nullptr};
      findings.raise(Check::duplicate_number, FindingList::key_of(place), place, [&] {
        return Words{
            fmt::format("N{} is jumped to, and is on line {} already", *block.number, first),
            "give the blocks numbers of their own"};
      });
    }
  }

  const Program& program_;
  bool anything_ = false;
  bool begun_ = false;  // something stands before, be it wrong
  bool ended_ = false;
  int open_statements_ = 0;  // of LinuxCNC
  std::map<std::uint32_t, Definition> programs_{};
  std::map<std::string, Definition> subprograms_{};
  std::map<std::string, Definition> labels_{};
  std::set<std::uint32_t> called_{};
  std::set<std::string> named_{};
  std::set<std::uint32_t> numbers_jumped_to_{};
  bool computed_call_ = false;
  bool computed_label_ = false;
  std::optional<PathSegment> segment_{};
  std::vector<PathSegment> segments_{};
  WrongLines wrong_lines_{};
};

}  // namespace

WrongLines check_structure(const Program& program, FindingList& findings) {
  return Structure(program).check(findings);
}

}  // namespace frustum::lint
