#include "parser/reading/sinumerik/sinumerik_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "parser/dialects/sinumerik_words.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/sinumerik/sinumerik_settings.hpp"
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
    if (name != type.name) continue;
    // The greatest length of a text, which says nothing.
    if (type.kind == VariableKind::text && in.take('[')) {
      (void)in.text_to("]");
      in.take(']');
    }
    return type.kind;
  }
  in.fail("not-supported"_id, column,
          name.empty() ? "a type is missing" : fmt::format("{} is not simulated", name),
          "known are REAL, INT, BOOL, STRING, CHAR and AXIS");
  return std::nullopt;
}

std::string read_variable_name(LineScanner& in) {
  const std::uint32_t column = in.column();
  std::string name = in.name();
  if (in.failed()) return {};
  const bool array = name.size() == 1 && in.peek() == '[';
  if (!is_variable(name) && !array) {
    in.fail("variable-name"_id, column,
            name.empty() ? "a name is missing" : fmt::format("{} cannot be defined", name),
            "a name begins with two letters: WIDTH, _X1");
  }
  return name;
}

// DEF REAL FIELD[3,4]: after the bracket.
void read_dimensions(BlockDraft& draft) {
  LineScanner& in = draft.in;
  std::vector<ExpressionRange> sizes;
  do {
    sizes.push_back(draft.read_expression(ExpressionLevel::sum));
  } while (sizes.size() < kMaxIndices && in.take(','));
  if (!in.take(']'))
    in.fail("bracket-not-closed"_id, in.column(), "the index is not closed", "close it with ]");
  if (!in.failed()) draft.block.assignments.back().indices = std::move(sizes);
}

// PROC SLOT(VAR REAL FIELD[3], REAL TABLE[,2]): after the bracket.
std::vector<ExpressionRange> read_formal_sizes(BlockDraft& draft) {
  LineScanner& in = draft.in;
  std::vector<ExpressionRange> sizes;
  do {
    const bool open = in.peek() == ',' || in.peek() == ']';
    sizes.push_back(open ? ExpressionRange{} : draft.read_expression(ExpressionLevel::sum));
  } while (sizes.size() < kMaxIndices && in.take(','));
  if (!in.take(']'))
    in.fail("bracket-not-closed"_id, in.column(), "the index is not closed", "close it with ]");
  return sizes;
}

bool stands_alone(BlockDraft& draft, std::uint32_t column, bool behind_label = true) {
  if (behind_label && draft.labelled()) return true;
  if (!draft.begun()) return true;
  draft.in.fail("statement-not-alone"_id, column, "a statement after other words",
                "write it in a block of its own");
  return false;
}

// _N_SLOT_SPF is the program SLOT.
std::string program_named(std::string_view written) {
  std::string name = upper_case(written);
  if (name.starts_with("_N_")) name.erase(0, 3);
  for (const std::string_view ending : {"_SPF", "_MPF", ".SPF", ".MPF"}) {
    if (name.ends_with(ending)) name.erase(name.size() - ending.size());
  }
  return name;
}

}  // namespace

void read_sinumerik_named_call(BlockDraft& draft, std::uint32_t column) {
  LineScanner& in = draft.in;
  const bool bracket = in.take('(');
  if (in.peek() == '/' || in.peek() != '"') {
    std::string name;
    // PCALL/_N_WKS_DIR/_N_PART_WPD/SLOT(1)
    while (in.take('/')) name = in.name();
    if (name.empty()) name = in.name();
    if (name.empty() || bracket) {
      in.fail("not-supported"_id, column, "a call of a program whose name is computed",
              "write the name itself: CALL \"SLOT\"");
      return;
    }
    return read_sinumerik_call(draft, program_named(name), column);
  }
  in.take('"');
  const std::string path = in.text_to("\"");
  if (!in.take('"'))
    in.fail("text-not-closed"_id, column, "the text is not closed", "close it with \"");
  if (bracket) close_bracket(in, "EXTCALL");
  const std::size_t folder = path.find_last_of("/\\:");
  const std::string file = folder == std::string::npos ? path : path.substr(folder + 1);
  read_sinumerik_call(draft, program_named(file), column);
}

void read_sinumerik_head(BlockDraft& draft) {
  Block& block = draft.block;
  block.tape_mark = true;
  const std::uint32_t column = draft.in.column();
  const std::string written = draft.in.text_to();
  if (written.empty()) return;
  block.comments.push_back({column, false, written, nullptr});
  draft.begin_flow(FlowKind::program, column);
  block.flow->label = program_named(written);
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
      const bool gives_back = in.take_name("VAR");
      const auto kind = read_type(in);
      const std::string name = read_variable_name(in);
      if (in.failed()) return;
      FormalParameter parameter{draft.add_name(name), *kind, {}, gives_back, {}};
      if (in.take('[')) parameter.sizes = read_formal_sizes(draft);
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
    if (in.take('[')) read_dimensions(draft);
    if (in.take('=')) {
      read_setting_values(draft);
    } else if (!draft.block.assignments.back().indices.empty()) {
      // Its elements are zero.
    } else if (kind == VariableKind::text || kind == VariableKind::axis) {
      draft.block.steps.push_back(
          {Operation::text, place, static_cast<double>(draft.add_name(""))});
      draft.end_setting();
    } else {
      draft.block.steps.push_back({Operation::number, place, 0.0});
      draft.end_setting();
    }
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
