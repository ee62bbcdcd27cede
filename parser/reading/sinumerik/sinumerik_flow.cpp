#include "parser/reading/sinumerik/sinumerik_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "parser/reading/sinumerik/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

// What follows a flow word.
enum class FlowForm : std::uint8_t { alone, condition, branch, until, steps, target, part, choice };
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
    FlowWord{"REPEAT", FlowKind::loop, FlowForm::part, Turns::until_end},
    FlowWord{"REPEATB", FlowKind::repeat_part, FlowForm::part},
    FlowWord{"CASE", FlowKind::choice, FlowForm::choice},
    FlowWord{"RET", FlowKind::give_back},
    FlowWord{"UNTIL", FlowKind::end_loop, FlowForm::until},
    FlowWord{"GOTOF", FlowKind::jump, FlowForm::target, Turns::while_true, Search::forward},
    FlowWord{"GOTOB", FlowKind::jump, FlowForm::target, Turns::while_true, Search::backward},
    FlowWord{"GOTO", FlowKind::jump, FlowForm::target, Turns::while_true,
             Search::forward_then_backward},
    FlowWord{"GOTOC", FlowKind::jump, FlowForm::target, Turns::while_true,
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
        block_.flow->label = read_target(word.name);
        block_.flow->may_be_missing = word.name == "GOTOC";
        break;
      case FlowForm::part:
        read_part(word.name);
        break;
      case FlowForm::choice:
        read_choices();
        break;
    }
    if (!in_.at_end() && in_.peek() != ';') {
      in_.fail_unexpected(fmt::format("{} is alone in its block", word.name));
    }
  }

  void read_label(const std::string& name, std::uint32_t column) {
    in_.take(':');
    begin_flow(FlowKind::label, column);
    if (!in_.failed()) block_.flow->label = name;
  }

 private:
  void begin_flow(FlowKind kind, std::uint32_t column) {
    if (draft_.begun() && (!draft_.labelled() || kind == FlowKind::label)) {
      in_.fail("statement-not-alone"_id, column, "a statement after other words",
               "write it in a block of its own");
      return;
    }
    draft_.begin_flow(kind, column);
  }

  void read_condition(std::string_view whose) {
    if (in_.at_end()) {
      in_.fail("value-missing"_id, in_.column(), fmt::format("{} has no condition", whose),
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
    block_.flow->may_be_missing = jump->name == "GOTOC";
    block_.flow->label = read_target(jump->name);
  }

  std::string read_target(std::string_view whose) {
    const std::uint32_t column = in_.column();
    std::string label = in_.name();
    if (!in_.failed() && label.empty()) {
      in_.fail("name-missing"_id, column, fmt::format("{} has no label", whose),
               fmt::format("write for example {} LABEL1 or {} N100", whose, whose));
    }
    return label;
  }

  // REPEAT A, REPEAT A B, REPEATB A, each with P=3 or without; REPEAT alone is a loop.
  void read_part(std::string_view whose) {
    const bool one_block = whose == "REPEATB";
    if (!one_block && (in_.at_end() || in_.peek() == ';')) return;
    block_.flow->kind = FlowKind::repeat_part;
    block_.flow->label = read_target(whose);
    block_.flow->part_end = one_block ? PartEnd::last : PartEnd::end_label;
    if (!one_block && !in_.at_end() && in_.peek() != ';' && in_.next_name() != "P") {
      block_.flow->last_label = read_target(whose);
      block_.flow->part_end = PartEnd::last;
    }
    if (!in_.take_name("P")) return;
    if (!in_.take('='))
      in_.fail("keyword-missing"_id, in_.column(),
               "P has no =", "write the number of repeats as P=3");
    block_.flow->condition = draft_.read_expression(ExpressionLevel::sum);
  }

  // CASE R1 OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C.
  void read_choices() {
    read_condition("CASE");
    if (!in_.take_name("OF")) {
      in_.fail("keyword-missing"_id, in_.column(), "CASE has no OF",
               "write CASE R1 OF 1 GOTOF A DEFAULT GOTOF B");
    }
    while (!in_.at_end() && in_.peek() != ';') {
      Choice choice;
      const bool others = in_.take_name("DEFAULT");
      if (!others) choice.value = draft_.read_expression(ExpressionLevel::operand);
      const std::uint32_t column = in_.column();
      const FlowWord* jump = flow_word(in_.name());
      if (jump == nullptr || jump->form != FlowForm::target) {
        in_.fail("keyword-missing"_id, column, "a value of CASE has no jump",
                 "write 1 GOTOF LABEL1");
        return;
      }
      choice.search = jump->search;
      choice.label = read_target(jump->name);
      block_.flow->choices.push_back(std::move(choice));
      if (others) return;
    }
    if (block_.flow->choices.empty()) {
      in_.fail("value-missing"_id, in_.column(), "CASE has no values",
               "write CASE R1 OF 1 GOTOF A DEFAULT GOTOF B");
    }
  }

  // FOR R1=1 TO 5.
  void read_steps() {
    const std::uint32_t column = in_.column();
    const std::string name = in_.name();
    if ((!is_r_parameter(name) && !is_variable(name)) || !in_.take('=')) {
      in_.fail("value-missing"_id, column, "FOR has no R parameter to count",
               "write FOR R1=1 TO 5, or count in a variable of DEF INT");
      return;
    }
    block_.flow->variable = draft_.add_name(name);
    block_.flow->condition = draft_.read_expression(ExpressionLevel::sum);
    if (!in_.take_name("TO")) {
      in_.fail("keyword-missing"_id, in_.column(), "FOR has no TO", "write FOR R1=1 TO 5");
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
