#include "parser/reading/sinumerik_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "parser/reading/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

// What follows a flow word.
enum class FlowForm : std::uint8_t { alone, condition, branch, until, steps, target };
struct FlowWord {
  std::string_view name;
  FlowKind kind;
  FlowForm form = FlowForm::alone;
  Turns turns = Turns::while_true;
  Search search = Search::from_start;
};
constexpr std::array kFlowWords{
    FlowWord{"IF", FlowKind::branch, FlowForm::branch},
    FlowWord{"ELSE", FlowKind::otherwise},
    FlowWord{"ENDIF", FlowKind::end_branch},
    FlowWord{"WHILE", FlowKind::loop, FlowForm::condition},
    FlowWord{"ENDWHILE", FlowKind::end_loop},
    FlowWord{"FOR", FlowKind::loop, FlowForm::steps, Turns::stepped},
    FlowWord{"ENDFOR", FlowKind::end_loop},
    FlowWord{"LOOP", FlowKind::loop, FlowForm::alone, Turns::until_end},
    FlowWord{"ENDLOOP", FlowKind::end_loop},
    FlowWord{"REPEAT", FlowKind::loop, FlowForm::alone, Turns::until_end},
    FlowWord{"UNTIL", FlowKind::end_loop, FlowForm::until},
    FlowWord{"GOTOF", FlowKind::jump, FlowForm::target, Turns::while_true, Search::forward},
    FlowWord{"GOTOB", FlowKind::jump, FlowForm::target, Turns::while_true, Search::backward},
    FlowWord{"GOTO", FlowKind::jump, FlowForm::target, Turns::while_true,
             Search::forward_then_backward},
};
const FlowWord* flow_word(std::string_view name) {
  const auto* found = std::find_if(kFlowWords.begin(), kFlowWords.end(),
                                   [name](const FlowWord& word) { return word.name == name; });
  return found == kFlowWords.end() ? nullptr : found;
}

class FlowReader {
 public:
  explicit FlowReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read(const FlowWord& word, std::uint32_t column) {
    begin_flow(word.kind, column);
    if (in_.failed()) return;
    block_.flow->turns = word.turns;
    block_.flow->search = word.search;
    switch (word.form) {
      case FlowForm::alone:
        break;
      case FlowForm::condition:
        read_condition(word.name);
        break;
      case FlowForm::branch:
        read_condition(word.name);
        read_jump_behind_condition();
        break;
      case FlowForm::until:
        read_condition(word.name);
        block_.flow->negated = true;
        break;
      case FlowForm::steps:
        read_steps();
        break;
      case FlowForm::target:
        read_target(word.name);
        break;
    }
    if (word.name == "REPEAT" && !in_.at_end() && in_.peek() != ';') {
      in_.fail(column, "REPEAT of labelled blocks is not simulated", "write them in FOR or LOOP");
    } else if (!in_.at_end() && in_.peek() != ';') {
      in_.fail_unexpected(fmt::format("{} stands alone in its block", word.name));
    }
  }

  void read_label(const std::string& name, std::uint32_t column) {
    in_.take(':');
    begin_flow(FlowKind::label, column);
    if (!in_.failed()) block_.flow->label = name;
  }

 private:
  void begin_flow(FlowKind kind, std::uint32_t column) {
    if (block_.flow || !block_.words.empty() || !block_.assignments.empty()) {
      in_.fail(column, "a statement behind other words", "write it in a block of its own");
      return;
    }
    draft_.begin_flow(kind, column);
  }

  void read_condition(std::string_view whose) {
    if (in_.at_end()) {
      in_.fail(in_.column(), fmt::format("{} has no condition", whose),
               fmt::format("write for example {} R1<5", whose));
      return;
    }
    block_.flow->condition = draft_.read_expression(ExpressionLevel::disjunction);
  }

  // IF R1<5 GOTOF NAME.
  void read_jump_behind_condition() {
    const auto* jump = flow_word(in_.next_name());
    if (in_.failed() || jump == nullptr || jump->form != FlowForm::target) return;
    (void)in_.name();
    block_.flow->kind = FlowKind::jump;
    block_.flow->search = jump->search;
    read_target(jump->name);
  }

  void read_target(std::string_view whose) {
    const std::uint32_t column = in_.column();
    block_.flow->label = in_.name();
    if (!in_.failed() && block_.flow->label.empty()) {
      in_.fail(column, fmt::format("{} has no label", whose),
               fmt::format("write for example {} LABEL1 or {} N100", whose, whose));
    }
  }

  // FOR R1=1 TO 5.
  void read_steps() {
    const std::uint32_t column = in_.column();
    const std::string name = in_.name();
    if (!is_r_parameter(name) || !in_.take('=')) {
      in_.fail(column, "FOR has no R parameter to count", "write FOR R1=1 TO 5");
      return;
    }
    block_.flow->variable = draft_.add_name(name);
    block_.flow->condition = draft_.read_expression(ExpressionLevel::sum);
    if (!in_.take_name("TO")) {
      in_.fail(in_.column(), "FOR has no TO", "write FOR R1=1 TO 5");
      return;
    }
    block_.flow->limit = draft_.read_expression(ExpressionLevel::sum);
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

bool read_sinumerik_flow(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  const FlowWord* word = flow_word(name);
  if (word == nullptr) return false;
  FlowReader(draft).read(*word, column);
  return true;
}

void read_sinumerik_label(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  FlowReader(draft).read_label(name, column);
}

}  // namespace frustum::parser
