#include "parser/writing/sinumerik_statement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "parser/dialects/expressions.hpp"
#include "parser/dialects/sinumerik_words.hpp"
#include "parser/writing/block_parts.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

class StatementWriter {
 public:
  explicit StatementWriter(const Block& block) : block_(block), flow_(*block.flow) {}

  [[nodiscard]] std::string operator()() const {
    switch (flow_.kind) {
      case FlowKind::label:
        return flow_.label + ":";
      case FlowKind::branch:
        return "IF " + condition();
      case FlowKind::otherwise:
        return "ELSE";
      case FlowKind::end_branch:
        return "ENDIF";
      case FlowKind::loop:
        return loop();
      case FlowKind::end_loop:
        return flow_.condition.empty() ? "ENDLOOP" : "UNTIL " + condition();
      case FlowKind::give_back:
        return "RET";
      case FlowKind::program:
        return procedure();
      case FlowKind::call:
        return call();
      case FlowKind::repeat_part:
        return repeat();
      case FlowKind::choice:
        return choices();
      default:
        return (flow_.condition.empty() ? "" : "IF " + condition() + " ") +
               jump(flow_.search, flow_.label, flow_.may_be_missing);
    }
  }

 private:
  [[nodiscard]] std::string text(ExpressionRange range, ExpressionLevel level) const {
    return range_text(expressions_of(Dialect::sinumerik), block_, range, level);
  }
  [[nodiscard]] std::string condition() const { return text(flow_.condition, disjunction); }

  static std::string jump(Search search, const std::string& label, bool may_be_missing) {
    const char* word = may_be_missing               ? "GOTOC"
                       : search == Search::forward  ? "GOTOF"
                       : search == Search::backward ? "GOTOB"
                                                    : "GOTO";
    return fmt::format("{} {}", word, label);
  }

  [[nodiscard]] std::string loop() const {
    switch (flow_.turns) {
      case Turns::while_true:
        return "WHILE " + condition();
      case Turns::stepped:
        return fmt::format("FOR {}={} TO {}", block_.names[flow_.variable],
                           text(flow_.condition, sum), text(flow_.limit, sum));
      default:
        return "LOOP";  // which UNTIL may end, too
    }
  }

  [[nodiscard]] std::string procedure() const {
    std::string parameters;
    for (const FormalParameter& parameter : flow_.parameters) {
      parameters += fmt::format("{}{}{} {}", parameters.empty() ? "" : ",",
                                parameter.gives_back ? "VAR " : "", sinumerik_type(parameter.kind),
                                block_.names[parameter.name]);
      for (std::size_t i = 0; i < parameter.sizes.size(); ++i) {
        parameters += i == 0 ? "[" : ",";
        if (!parameter.sizes[i].empty()) parameters += text(parameter.sizes[i], sum);
      }
      if (!parameter.sizes.empty()) parameters += "]";
      if (!parameter.otherwise.empty()) parameters += "=" + text(parameter.otherwise, sum);
    }
    return fmt::format("PROC {}({}){}", flow_.label, parameters, flow_.keeps_modes ? " SAVE" : "");
  }

  [[nodiscard]] std::string call() const {
    std::string arguments;
    for (std::size_t i = 0; i < flow_.arguments.size(); ++i) {
      arguments += (i == 0 ? "" : ",") + text(flow_.arguments[i], disjunction);
    }
    std::string written = flow_.label;
    if (!flow_.arguments.empty()) written += "(" + arguments + ")";
    if (!flow_.condition.empty()) written += " P=" + text(flow_.condition, sum);
    return written;
  }

  [[nodiscard]] std::string repeat() const {
    const bool one_block = flow_.part_end == PartEnd::last && flow_.last_label.empty();
    std::string written = (one_block ? "REPEATB " : "REPEAT ") + flow_.label;
    if (!flow_.last_label.empty()) written += " " + flow_.last_label;
    if (!flow_.condition.empty()) written += " P=" + text(flow_.condition, sum);
    return written;
  }

  [[nodiscard]] std::string choices() const {
    std::string written = fmt::format("CASE {} OF", condition());
    for (const Choice& choice : flow_.choices) {
      written +=
          fmt::format(" {} {}", choice.value.empty() ? "DEFAULT" : text(choice.value, operand),
                      jump(choice.search, choice.label, false));
    }
    return written;
  }

  const Block& block_;
  const FlowStatement& flow_;
};

}  // namespace

std::string_view sinumerik_measure(Measure measure) {
  const auto* found = std::ranges::find(kMeasureNames, measure, &MeasureName::measure);
  return found != kMeasureNames.end() ? found->name : std::string_view{};
}

std::string_view sinumerik_type(VariableKind kind) {
  // A text needs its greatest length.
  if (kind == VariableKind::text) return "STRING[200]";
  return std::ranges::find(kTypeNames, kind, &TypeName::kind)->name;
}

std::string sinumerik_statement(const Block& block) {
  const std::string& label = block.flow->block_label;
  return (label.empty() ? "" : label + ": ") + StatementWriter(block)();
}

}  // namespace frustum::parser
