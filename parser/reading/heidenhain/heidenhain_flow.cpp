// Q parameters, FN, labels and calls of Klartext.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

// What speaks to the operator, to files or to the machine, and sets nothing that is read here.
struct PassedFn {
  int number;
  const char* event;
};
constexpr std::array kPassedFn{PassedFn{15, "FN 15"}, PassedFn{16, "FN 16"}, PassedFn{17, "FN 17"},
                               PassedFn{19, "FN 19"}, PassedFn{20, "FN 20"}, PassedFn{26, "FN 26"},
                               PassedFn{27, "FN 27"}, PassedFn{29, "FN 29"}, PassedFn{37, "FN 37"},
                               PassedFn{38, "FN 38"}};

constexpr const char* kFnJump = "write FN 9: IF +Q1 EQU +Q3 GOTO LBL 5";

// FN 9 to 12.
struct FnComparison {
  std::string_view word;
  Operation operation;
};
constexpr std::array kFnComparisons{
    FnComparison{"EQU", Operation::equal}, FnComparison{"NE", Operation::not_equal},
    FnComparison{"GT", Operation::greater}, FnComparison{"LT", Operation::less}};

class FlowReader {
 public:
  explicit FlowReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  // Q1 = Q2 + 3 * SIN(Q4)
  void read_setting(const std::string& name, std::uint32_t column) {
    if (!in_.take('=')) {
      return in_.fail("keyword-missing"_id, in_.column(),
                      name + " has no =", fmt::format("write {} = 5", name));
    }
    draft_.begin_setting(name, column);
    (void)draft_.read_expression(ExpressionLevel::sum);
    draft_.end_setting();
    end_statement(draft_);
  }
  // FN 0: Q5 = +60, FN 9: IF +Q1 EQU +Q3 GOTO LBL 5.
  void read_fn(std::uint32_t column) {
    const auto number = in_.number();
    if (!number || !in_.take(':')) {
      return in_.fail("value-missing"_id, column, "FN has no number", "write FN 0: Q5 = +60");
    }
    constexpr double kLastFn = 99.0;
    if (number->value > kLastFn || number->decimal_point) {
      return in_.fail("unknown-word"_id, column,
                      fmt::format("FN {} is not known", shortest_decimal(number->value)),
                      "known are FN 0 to FN 16");
    }
    const auto fn = static_cast<int>(number->value);
    if (fn >= 9 && fn <= 12) {
      return read_fn_jump(kFnComparisons.at(static_cast<std::size_t>(fn - 9)).operation, column);
    }
    if (fn == 14) return read_raised_error(column);
    if (fn == 17 && !sets_tool_data()) {
      return in_.fail(
          "not-supported"_id, column, "FN 17 is not simulated",
          "what it writes could move the datum: known is FN 17: SYSWRITE ID50, the tool "
          "table");
    }
    if (fn == 18) return read_system_data(column);
    for (const PassedFn& passed : kPassedFn) {
      if (fn == passed.number) return note(draft_, passed.event, column, in_.text_to(";"));
    }
    const std::uint32_t place = in_.column();
    const std::string target = in_.name();
    if (fn > 8 && fn != 13) {
      return in_.fail("not-supported"_id, column, fmt::format("FN {} is not simulated", fn),
                      "known are FN 0 to FN 16; set what it would read by FN 0: Q1 = +5");
    }
    if (!is_q_parameter(target) || !in_.take('=')) {
      return in_.fail("value-missing"_id, place, "FN sets no parameter", "write FN 0: Q5 = +60");
    }
    draft_.begin_setting(target, place);
    const auto operand = [&] { (void)draft_.read_expression(ExpressionLevel::operand); };
    const auto square = [&] {
      block_.steps.push_back({Operation::number, place, 2.0});
      push(Operation::power, place);
    };
    // A sign or word and the operand after it; the column of the sign.
    const auto take = [&](std::string_view sign, const char* hint) {
      const std::uint32_t at = in_.column();
      const bool name = sign.size() > 1;
      if (name ? in_.take_name(sign) : in_.take_sign(sign)) {
        operand();
      } else {
        in_.fail("value-missing"_id, at, fmt::format("FN {} has no {}", fn, sign), hint);
      }
      return at;
    };
    constexpr const char* kFunction = "write FN 6: Q20 = SIN -Q5";
    constexpr const char* kSign =
        "write FN 1: Q1 = -Q2 + -5, FN 3: Q2 = +3 * +3, FN 4: Q4 = +4 DIV +Q2";
    constexpr const char* kWord =
        "write FN 1: Q1 = -Q2 + -5, FN 3: Q2 = +3 * +3, FN 4: Q4 = +4 DIV +Q2, "
        "FN 8: Q5 = +5 LEN +4, FN 13: Q6 = +5 ANG +4";
    if (fn == 5) {
      push(Operation::square_root, take("SQRT", kFunction));
    } else if (fn == 6) {
      push(Operation::sine, take("SIN", kFunction));
    } else if (fn == 7) {
      push(Operation::cosine, take("COS", kFunction));
    } else {
      operand();
      if (fn == 1) push(Operation::add, take("+", kSign));
      if (fn == 2) push(Operation::subtract, take("-", kSign));
      if (fn == 3) push(Operation::multiply, take("*", kSign));
      if (fn == 4) push(Operation::divide, take("DIV", kWord));
      if (fn == 8) {
        square();
        take("LEN", kWord);
        square();
        push(Operation::add, place);
        push(Operation::square_root, place);
      }
      if (fn == 13) {
        // From 0 to 360 degrees.
        take("ANG", kWord);
        push(Operation::arc_tangent, place);
        block_.steps.push_back({Operation::number, place, 360.0});
        push(Operation::modulo, place);
      }
    }
    draft_.end_setting();
    end_statement(draft_);
  }

  // FN 14: ERROR = 1000
  void read_raised_error(std::uint32_t column) {
    if (!in_.take_name("ERROR") || !in_.take('=')) {
      return in_.fail("keyword-missing"_id, in_.column(),
                      "FN 14 has no ERROR =", "write FN 14: ERROR = 1000");
    }
    add_code(block_, *find_code(Dialect::heidenhain, "FN 14"), column);
    add_value(draft_, 'E', "ERROR", column, "ERROR=");
    end_statement(draft_);
  }

  void read_label(std::uint32_t column) {
    draft_.begin_flow(FlowKind::label, column);
    read_label_name();
    // The end of a subprogram.
    if (block_.flow->label == "0") block_.flow->kind = FlowKind::give_back;
    end_statement(draft_);
  }

  // CALL LBL 1, CALL LBL 1 REP 3.
  void read_call(std::uint32_t column) {
    const std::uint32_t begin = in_.column();
    const std::string kind = in_.letters();
    if (kind == "PGM") return read_program_call(false);
    if (kind != "LBL") {
      in_.go_to(begin);
      const std::string what = in_.name();
      return in_.fail("not-supported"_id, column,
                      fmt::format("CALL {} is not simulated", what.empty() ? "alone" : what),
                      "write CALL LBL 1, or CALL PGM and the name of a program");
    }
    draft_.begin_flow(FlowKind::call, column);
    read_label_name();
    const std::uint32_t place = in_.column();
    constexpr std::string_view kRepeat = "REP";
    const bool repeats = in_.letters().starts_with(kRepeat);
    in_.go_to(place);
    if (repeats) {
      // REP 6, REP6, REPQ1
      in_.go_to(place + static_cast<std::uint32_t>(kRepeat.size()));
      block_.flow->kind = FlowKind::repeat_part;
      block_.flow->condition = draft_.read_expression(ExpressionLevel::operand);
      // Older controls show how many are left.
      if (in_.take('/')) (void)in_.digits();
    }
    end_statement(draft_);
  }

  void read_program_call(bool by_cycle) {
    const std::uint32_t column = in_.column();
    const bool quoted = in_.take('"');
    std::string name = in_.text_to(quoted ? "\"" : ";");
    if (quoted && !in_.take('"')) {
      return in_.fail("text-not-closed"_id, column, "the name is not closed", "close it with \"");
    }
    if (const auto folder = name.find_last_of("\\/:"); folder != std::string::npos) {
      name.erase(0, std::min(name.find_first_not_of(' ', folder + 1), name.size()));
    }
    const std::size_t point = name.find_last_of('.');
    const std::string ending = point == std::string::npos ? ".H" : name.substr(point);
    name.resize(std::min(point, name.size()));
    if (name.find_first_not_of(". ") == std::string::npos || name.find('"') != std::string::npos) {
      return in_.fail("name-missing"_id, column, "the call names no program",
                      "write CALL PGM and a name: CALL PGM SLOT.H");
    }
    if (ending != ".H" && ending != ".h") {
      return in_.fail("not-supported"_id, column,
                      fmt::format("a program {} is called from Klartext", ending),
                      "call programs in Klartext, whose names end in .H");
    }
    draft_.begin_flow(FlowKind::call, column);
    block_.flow->label = std::move(name);
    block_.flow->of_file = true;
    block_.flow->by_cycle = by_cycle;
    end_statement(draft_);
  }

 private:
  // FN 18: SYSREAD Q1 = ID270 NR1 IDX3: an element of the control's data, by number and index.
  void read_system_data(std::uint32_t column) {
    constexpr const char* kForm = "write FN 18: SYSREAD Q1 = ID270 NR1 IDX3";
    if (!in_.take_name("SYSREAD")) {
      return in_.fail("keyword-missing"_id, column, "FN 18 has no SYSREAD", kForm);
    }
    const std::uint32_t place = in_.column();
    const std::string target = in_.name();
    if (!is_q_parameter(target) || !in_.take('=')) {
      return in_.fail("value-missing"_id, place, "FN sets no parameter", kForm);
    }
    draft_.begin_setting(target, place);
    std::string group;
    std::uint32_t indices = 0;
    for (const std::string_view word : {"ID", "NR", "IDX"}) {
      const std::uint32_t at = in_.column();
      const bool there = in_.letters().starts_with(word);
      in_.go_to(at);
      if (!there && word == "IDX") break;
      if (there) in_.go_to(at + static_cast<std::uint32_t>(word.size()));
      if (word == "ID") group = there ? std::string(in_.digits()) : std::string();
      if (!there || group.empty()) {
        return in_.fail("value-missing"_id, at, fmt::format("FN 18 has no {}", word), kForm);
      }
      if (word == "ID") continue;
      const ExpressionRange value = draft_.read_expression(ExpressionLevel::operand);
      if (word == "NR" && value.count != 1 && !in_.failed()) {
        return in_.fail("value-missing"_id, at, "NR of FN 18 is no number", kForm);
      }
      ++indices;
    }
    const std::uint32_t name = draft_.add_name("$ID" + group);
    if (!in_.failed()) {
      block_.steps.push_back({Operation::element, place, element_step(name, indices)});
    }
    draft_.end_setting();
    end_statement(draft_);
  }

  // SYSWRITE ID50 ..
  bool sets_tool_data() {
    const std::uint32_t place = in_.column();
    const bool writes = in_.take_name("SYSWRITE");
    const bool group = in_.letters() == "ID";
    const bool of_tools = writes && group && in_.digits() == "50";
    in_.go_to(place);
    return of_tools;
  }

  void read_fn_jump(Operation comparison, std::uint32_t column) {
    if (!in_.take_name("IF"))
      return in_.fail("keyword-missing"_id, in_.column(), "FN has no IF", kFnJump);
    draft_.begin_flow(FlowKind::jump, column);
    // Both sides, then the comparison.
    ExpressionRange& condition = block_.flow->condition;
    condition = draft_.read_expression(ExpressionLevel::operand);
    const std::uint32_t place = in_.column();
    const std::string word = in_.name();
    if (word == "IS") {
      read_whether_set(condition, place);
    } else {
      const auto known = std::ranges::find(kFnComparisons, word, &FnComparison::word);
      if (known == kFnComparisons.end()) {
        return in_.fail("unknown-word"_id, place, "FN compares by EQU, NE, GT or LT", kFnJump);
      }
      if (known->operation != comparison) {
        return in_.fail("word-misplaced"_id, place,
                        fmt::format("{} is not the comparison of this FN", word), kFnJump);
      }
      condition.count += draft_.read_expression(ExpressionLevel::operand).count;
      push(comparison, place);
      ++condition.count;
    }
    if (!in_.take_name("GOTO") || in_.letters() != "LBL") {
      return in_.fail("keyword-missing"_id, in_.column(), "FN has no GOTO LBL", kFnJump);
    }
    read_label_name();
    end_statement(draft_);
  }

  // Q1 IS DEFINED, Q1 IS UNDEFINED: compared with 0.
  void read_whether_set(ExpressionRange& condition, std::uint32_t column) {
    const std::string word = in_.name();
    const bool parameter = condition.count == 1 &&
                           block_.steps[condition.first].operation == Operation::named_parameter;
    if (!parameter || (word != "DEFINED" && word != "UNDEFINED")) {
      return in_.fail("unknown-word"_id, column, "IS asks whether a parameter is set",
                      "write FN 9: IF Q1 IS UNDEFINED GOTO LBL 5");
    }
    block_.steps[condition.first].operation = Operation::exists;
    block_.steps.push_back({Operation::number, column, 0.0});
    push(word == "DEFINED" ? Operation::not_equal : Operation::equal, column);
    condition.count += 2;
  }

  // 5 or "NAME".
  void read_label_name() {
    const std::uint32_t column = in_.column();
    if (in_.take('"')) {
      block_.flow->label = in_.text_to("\"");
      if (!in_.take('"'))
        in_.fail("text-not-closed"_id, column, "the name is not closed", "close it with \"");
    } else {
      block_.flow->label = std::string(in_.digits());
    }
    if (!in_.failed() && block_.flow->label.empty()) {
      in_.fail("name-missing"_id, column, "LBL has no number or name",
               "write LBL 1 or LBL \"SLOT\"");
    }
  }

  void push(Operation operation, std::uint32_t column) {
    if (!in_.failed()) block_.steps.push_back({operation, column, 0.0});
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_setting(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  FlowReader(draft).read_setting(name, column);
}
void read_heidenhain_fn(BlockDraft& draft, std::uint32_t column) {
  FlowReader(draft).read_fn(column);
}
void read_heidenhain_label(BlockDraft& draft, std::uint32_t column) {
  FlowReader(draft).read_label(column);
}
void read_heidenhain_call(BlockDraft& draft, std::uint32_t column) {
  FlowReader(draft).read_call(column);
}
void read_heidenhain_program_call(BlockDraft& draft, bool by_cycle) {
  FlowReader(draft).read_program_call(by_cycle);
}

}  // namespace frustum::parser
