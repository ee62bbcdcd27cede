// TOOL CALL and TOOL DEF of Klartext.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "parser/dialects/code_table.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

class ToolReader {
 public:
  explicit ToolReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_tool(std::uint32_t column) {
    const std::uint32_t kind_column = in_.column();
    const std::string kind = in_.letters();
    if (kind != "DEF" && kind != "CALL") in_.go_to(kind_column);
    if (kind == "DEF") return read_definition(column);
    if (kind != "CALL")
      return in_.fail("keyword-missing"_id, column, "TOOL without CALL or DEF",
                      "write TOOL CALL 1 Z S5000");
    const std::string next = in_.next_name();
    const std::uint32_t place = in_.column();
    const bool by_name = in_.peek() == '"' || is_text_parameter(next);
    if (by_name || is_q_parameter(next)) {
      add_code(block_, *find_code(Dialect::heidenhain, "TOOL CALL"), column);
      Word word;
      word.letter = 'T';
      word.column = place;
      word.spelled = "tool ";
      word.expression = draft_.read_expression(ExpressionLevel::operand);
      block_.words.push_back(word);
    } else if (const auto tool = in_.number()) {
      add_code(block_, *find_code(Dialect::heidenhain, "TOOL CALL"), column);
      if (tool->value == std::floor(tool->value)) {
        add_number(block_, 'T', tool->value, place, "tool ");
      } else {
        read_tool_step(place);
      }
    }
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      read_tool_element();
    }
  }

 private:
  // TOOL DEF 5 L+0 R+5; without data it says which tool comes next.
  void read_definition(std::uint32_t column) {
    const std::uint32_t start = in_.column();
    std::string text = in_.text_to(";");
    const bool named = text.find('"') != std::string::npos;
    if (named || upper_case(text).find_first_of("LR") == std::string::npos) {
      return note(draft_, "TOOL DEF", column, std::move(text));
    }
    in_.go_to(start);
    add_code(block_, *find_code(Dialect::heidenhain, "TOOL DEF"), column);
    add_value(draft_, 'e', "TOOL DEF", start, "");
    while (!in_.failed() && !in_.at_end() && in_.peek() != ';') {
      const std::uint32_t place = in_.column();
      const char letter = in_.peek();
      // Without meaning there.
      if (in_.take('F')) {
        draft_.add_event("TOOL DEF F", place, in_.text_to(" ;"));
        continue;
      }
      if (!in_.take('L') && !in_.take('R')) {
        return in_.fail_unexpected("TOOL DEF takes the tool's number, L and R: TOOL DEF 5 L+0 R+5");
      }
      add_value(draft_, letter, std::string_view(&letter, 1), place, nullptr);
    }
    end_statement(draft_);
  }

  // TOOL CALL 5.1: a step of tool 5, which has data of its own, as a tool by that name.
  void read_tool_step(std::uint32_t place) {
    in_.go_to(place);
    std::string name(in_.digits());
    in_.take('.');
    name += '.' + std::string(in_.digits());
    Word word;
    word.letter = 'T';
    word.column = place;
    word.spelled = "tool ";
    word.expression = {static_cast<std::uint32_t>(block_.steps.size()), 1};
    block_.steps.push_back({Operation::text, place, static_cast<double>(draft_.add_name(name))});
    block_.words.push_back(word);
  }

  void read_tool_element() {
    const std::uint32_t column = in_.column();
    std::string name = in_.letters();
    if (name == "Z") return;
    if (name == "X" || name == "Y") {
      return in_.fail("not-supported"_id, column,
                      fmt::format("tool axis {} is not simulated", name), "the tool is along Z");
    }
    // SQ1, FQ2
    // S( VC = 120 ): a cutting speed, of which the control makes one of the spindle.
    if (name == "S" && in_.peek() == '(') {
      std::string speed = in_.text_to(")");
      in_.take(')');
      return draft_.add_event("TOOL CALL VC", column, speed.erase(0, 1));
    }
    const bool by_parameter =
        (name.starts_with('S') || name.starts_with('F')) && name.size() > 1 && name[1] == 'Q';
    if (by_parameter) {
      in_.go_to(column + 1);
      name.resize(1);
    }
    if (name == "S" || name == "F") return add_value(draft_, name[0], name, column, nullptr);
    if (name == "DR" && in_.peek_byte() != '2') return add_value(draft_, 'j', name, column, "DR");
    if (name == "DL") return add_value(draft_, 'U', name, column, "DL");
    if (name == "DR") {
      if (in_.peek_byte() == '2') {
        name += '2';
        (void)in_.digits();
      }
      if (in_.signed_number(name, column) != 0.0) {
        in_.fail("not-supported"_id, column, name + " is not simulated",
                 "give the tool's true size in the job");
      }
      return;
    }
    if (name.empty()) return in_.fail_unexpected("write TOOL CALL 1 Z S5000 F500");
    in_.fail("unknown-word"_id, column, fmt::format("{} has no meaning in TOOL CALL", name),
             "known are the tool's number, Z, S, F, DL, DR, DR2");
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_tool(BlockDraft& draft, std::uint32_t column) {
  ToolReader(draft).read_tool(column);
}

}  // namespace frustum::parser
