#include "parser/reading/sinumerik/sinumerik_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "parser/dialects/sinumerik_words.hpp"
#include "parser/reading/sinumerik/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

// What may follow PROC; but for SAVE it concerns the display alone.
constexpr std::array<std::string_view, 8> kAttributes{"SAVE",  "DISPLOF", "DISPLON", "ACTBLOCNO",
                                                      "SBLOF", "SBLON",   "PREPRO",  "ICYCON"};

bool ends(LineScanner& in) { return in.at_end() || in.peek() == ';'; }

std::optional<VariableKind> read_type(LineScanner& in) {
  const std::uint32_t column = in.column();
  const std::string name = in.name();
  for (const TypeName& type : kTypeNames) {
    if (name == type.name) return type.kind;
  }
  in.fail("not-supported"_id, column,
          name.empty() ? "a type is missing" : fmt::format("{} is not simulated", name),
          name == "VAR" ? "give results back in R parameters" : "known are REAL, INT and BOOL");
  return std::nullopt;
}

std::string read_variable_name(LineScanner& in) {
  const std::uint32_t column = in.column();
  std::string name = in.name();
  if (in.failed()) return {};
  if (!is_variable(name)) {
    in.fail("variable-name"_id, column,
            name.empty() ? "a name is missing" : fmt::format("{} cannot be defined", name),
            "a name begins with two letters: WIDTH, _X1");
  } else if (in.peek() == '[') {
    in.fail("not-supported"_id, column, fmt::format("{} is an array", name),
            "use R parameters: R[10+R1]");
  }
  return name;
}

bool stands_alone(BlockDraft& draft, std::uint32_t column, bool behind_label = true) {
  if (behind_label && draft.labelled()) return true;
  if (!draft.begun()) return true;
  draft.in.fail("statement-not-alone"_id, column, "a statement after other words",
                "write it in a block of its own");
  return false;
}

}  // namespace

void read_sinumerik_head(BlockDraft& draft) {
  Block& block = draft.block;
  block.tape_mark = true;
  const std::uint32_t column = draft.in.column();
  const std::string written = draft.in.text_to();
  if (written.empty()) return;
  block.comments.push_back({column, false, written, nullptr});
  // _N_SLOT_SPF is the program SLOT.
  std::string_view name = written;
  if (name.starts_with("_N_")) name.remove_prefix(3);
  if (name.ends_with("_SPF") || name.ends_with("_MPF")) name.remove_suffix(4);
  draft.begin_flow(FlowKind::program, column);
  for (const char c : name) {
    block.flow->label += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
}

void read_sinumerik_procedure(BlockDraft& draft, std::uint32_t column) {
  LineScanner& in = draft.in;
  if (!stands_alone(draft, column, false)) return;
  draft.begin_flow(FlowKind::program, column);
  FlowStatement& flow = *draft.block.flow;
  const std::uint32_t place = in.column();
  flow.label = in.name();
  if (flow.label.empty())
    in.fail("name-missing"_id, place, "PROC has no name", "write PROC SLOT(REAL WIDTH)");
  if (in.take('(') && !in.take(')')) {
    do {
      const auto kind = read_type(in);
      const std::string name = read_variable_name(in);
      if (in.failed()) return;
      FormalParameter parameter{draft.add_name(name), *kind, {}};
      if (in.take('=')) parameter.otherwise = draft.read_expression(ExpressionLevel::sum);
      flow.parameters.push_back(parameter);
    } while (in.take(','));
    close_bracket(in, "PROC");
  }
  while (!ends(in)) {
    const std::uint32_t at = in.column();
    const std::string attribute = in.name();
    if (std::find(kAttributes.begin(), kAttributes.end(), attribute) == kAttributes.end()) {
      in.fail("unknown-word"_id, at,
              attribute.empty() ? "unexpected text after PROC"
                                : fmt::format("{} has no meaning after PROC", attribute),
              "known are SAVE, DISPLOF and SBLOF");
      return;
    }
    if (attribute == "SAVE") flow.keeps_modes = true;
  }
}

void read_sinumerik_definition(BlockDraft& draft, std::uint32_t column) {
  LineScanner& in = draft.in;
  if (!stands_alone(draft, column)) return;
  const auto kind = read_type(in);
  do {
    const std::uint32_t place = in.column();
    const std::string name = read_variable_name(in);
    if (in.failed()) return;
    draft.begin_setting(name, place);
    draft.block.assignments.back().defines = kind;
    if (in.take('=')) {
      (void)draft.read_expression(ExpressionLevel::disjunction);
    } else {
      draft.block.steps.push_back({Operation::number, place, 0.0});
    }
    draft.end_setting();
  } while (in.take(','));
  if (!ends(in)) in.fail_unexpected("separate the variables by ,");
}

void read_sinumerik_call(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  LineScanner& in = draft.in;
  if (!stands_alone(draft, column)) return;
  draft.begin_flow(FlowKind::call, column);
  FlowStatement& flow = *draft.block.flow;
  flow.label = name;
  if (in.take('(') && !in.take(')')) {
    do {
      const bool left_out = in.peek() == ',' || in.peek() == ')';
      flow.arguments.push_back(left_out ? ExpressionRange{}
                                        : draft.read_expression(ExpressionLevel::disjunction));
    } while (in.take(','));
    close_bracket(in, name);
  }
  if (!ends(in)) {
    const std::uint32_t place = in.column();
    if (!in.take('P')) {
      in.fail("statement-not-alone"_id, place, "words beside a call",
              "write the call in a block of its own");
    }
    in.take('=');
    flow.condition = draft.read_expression(ExpressionLevel::sum);
  }
  if (!ends(in)) in.fail_unexpected("a call is alone in its block");
}

}  // namespace frustum::parser
