// Klartext: a statement and its elements, parameters, labels and calls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "parser/dialects/expressions.hpp"
#include "parser/language/point_pattern.hpp"
#include "parser/writing/block_parts.hpp"
#include "parser/writing/block_writer.hpp"
#include "parser/writing/number_text.hpp"

namespace frustum::parser {
namespace {

using enum ExpressionLevel;

// Words of the code table that are elements of a line, no statements.
constexpr std::array<std::string_view, 6> kElements{
    "R0", "RL", "RR", "F AUTO", "PATHCTRL AXIS", "PATHCTRL VECTOR"};
// Statements that are written in another way, and axes without a name of their own that the reader
// adds to them.
struct Spelling {
  std::string_view code;
  std::string_view written;
  std::string_view implied{};
};
constexpr std::array kSpellings{
    Spelling{"DWELL", "FUNCTION DWELL"},
    Spelling{"BEGIN PGM MM", "BEGIN PGM"},
    Spelling{"BEGIN PGM INCH", "BEGIN PGM"},
    Spelling{"FN 14", "FN 14:"},
    Spelling{"CYCL DEF 7", "CYCL DEF 7.1"},
    Spelling{"CYCL DEF 8", "CYCL DEF 8.1"},
    Spelling{"CYCL DEF 8 OFF", "CYCL DEF 8.1"},
    Spelling{"CYCL DEF 10", "CYCL DEF 10.1", "XY"},
    Spelling{"CYCL DEF 11", "CYCL DEF 11.1", "XYZ"},
    Spelling{"CYCL DEF 19", "CYCL DEF 19.1"},
    Spelling{"CYCL DEF 19 OFF", "CYCL DEF 19.1"},
    Spelling{"CYCL DEF 26", "CYCL DEF 26.1", "XYZ"},
    Spelling{"CYCL DEF 1.1", "CYCL DEF 1.1 SET UP"},
    Spelling{"CYCL DEF 1.2", "CYCL DEF 1.2 DEPTH"},
    Spelling{"CYCL DEF 1.3", "CYCL DEF 1.3 PECKG"},
    Spelling{"CYCL DEF 1.4", "CYCL DEF 1.4 DWELL"},
    Spelling{"CYCL DEF 1.5", "CYCL DEF 1.5 F"},
    Spelling{"CYCL DEF 2.1", "CYCL DEF 2.1 SET UP"},
    Spelling{"CYCL DEF 2.2", "CYCL DEF 2.2 DEPTH"},
    Spelling{"CYCL DEF 2.3", "CYCL DEF 2.3 DWELL"},
    Spelling{"CYCL DEF 2.4", "CYCL DEF 2.4 F"},
    Spelling{"CYCL DEF 17.1", "CYCL DEF 17.1 SET UP"},
    Spelling{"CYCL DEF 17.2", "CYCL DEF 17.2 DEPTH"},
    Spelling{"CYCL DEF 17.3", "CYCL DEF 17.3 PITCH"},
};
// Known and not simulated: what is before and after their text.
struct EventForm {
  std::string_view event;
  std::string_view before;
  std::string_view behind{};
};
constexpr std::array kEvents{
    EventForm{"structure", "* - "},
    EventForm{"BEGIN PGM", ""},
    EventForm{"M128", ""},
    EventForm{"PLANE MB", "MB "},
    EventForm{"PLANE SEQ", "SEQ"},
    EventForm{"PLANE ROT", "", " ROT"},
    EventForm{"CYCL DEF 7", "CYCL DEF 7.0 "},
    EventForm{"CYCL DEF 8", "CYCL DEF 8.0 "},
    EventForm{"CYCL DEF 9", "CYCL DEF 9.0 "},
    EventForm{"CYCL DEF 10", "CYCL DEF 10.0 "},
    EventForm{"CYCL DEF 11", "CYCL DEF 11.0 "},
    EventForm{"FN 15", "FN 15: "},
    EventForm{"FN 16", "FN 16: "},
    EventForm{"FN 17", "FN 17: "},
    EventForm{"FN 19", "FN 19: "},
    EventForm{"FN 20", "FN 20: "},
    EventForm{"FN 26", "FN 26: "},
    EventForm{"FN 27", "FN 27: "},
    EventForm{"FN 29", "FN 29: "},
    EventForm{"FN 37", "FN 37: "},
    EventForm{"FN 38", "FN 38: "},
    EventForm{"QS", ""},
    EventForm{"END PGM", ""},
    EventForm{"CYCL DEF 1", "CYCL DEF 1.0 "},
    EventForm{"CYCL DEF 2", "CYCL DEF 2.0 "},
    EventForm{"CYCL DEF 17", "CYCL DEF 17.0 "},
    EventForm{"TOOL CALL VC", "S( ", " )"},
    EventForm{"CYCL DEF 12", "CYCL DEF 12.0 "},
    EventForm{"CYCL DEF 19", "CYCL DEF 19.0 "},
    EventForm{"CYCL DEF 19 SETUP", "SETUP "},
    EventForm{"CYCL DEF 26", "CYCL DEF 26.0 "},
    EventForm{"TCPM F", "F "},
    EventForm{"TOOL DEF F", "F"},
    EventForm{"PLANE DIST", "DIST "},
};

const ExpressionSpelling& spelling() { return expressions_of(Dialect::heidenhain); }
// The operators of FN: their sides are operands, as those of a power.
constexpr std::array kFnOperators{BinaryOperator{power, "EQU", Operation::equal},
                                  BinaryOperator{power, "NE", Operation::not_equal},
                                  BinaryOperator{power, "GT", Operation::greater},
                                  BinaryOperator{power, "LT", Operation::less},
                                  BinaryOperator{power, "ANG", Operation::arc_tangent}};
std::string fn_text(const Block& block, ExpressionRange range) {
  ExpressionSpelling of_fn = spelling();
  std::vector<BinaryOperator> operators(of_fn.operators.begin(), of_fn.operators.end());
  operators.insert(operators.end(), kFnOperators.begin(), kFnOperators.end());
  of_fn.operators = operators;
  return range_text(of_fn, block, range, power);
}

// 5, "SLOT"
std::string label_text(const std::string& label) {
  const bool number = label.find_first_not_of("0123456789") == std::string::npos;
  return number ? label : fmt::format("\"{}\"", label);
}

std::string event_text(const Comment& comment) {
  const std::string_view event = comment.event;
  const auto* form = std::ranges::find(kEvents, event, &EventForm::event);
  if (form == kEvents.end()) return fmt::format("{} {}", event, comment.text);
  return fmt::format("{}{}{}", form->before, comment.text, form->behind);
}

// M128 F2000, M120 LA5: what belongs to the M word of that name.
bool is_operand_of_m(const Comment& comment) {
  return comment.event != nullptr && comment.event[0] == 'M' && comment.event[1] >= '0' &&
         comment.event[1] <= '9';
}

class KlartextBlock {
 public:
  KlartextBlock(const Block& block, std::string& program) : block_(block), program_(program) {}

  std::string operator()() {
    if (block_.number) text_.add(fmt::format("{}", *block_.number));
    if (block_.deletable) text_.add("/");
    if (block_.flow) text_.add(flow_text(*block_.flow));
    find_statement();
    text_.add(name_);
    add_elements();
    for (const FramePart& part : block_.pattern) text_.add(pattern_text(part));
    for (const Assignment& setting : block_.assignments) text_.add(setting_text(setting));
    for (const Comment& comment : block_.comments) {
      if (comment.event == nullptr || is_operand_of_m(comment)) continue;
      if (std::string_view(comment.event) == "BEGIN PGM") {
        program_ = comment.text.substr(0, comment.text.find(' '));
      }
      text_.add(event_text(comment));
    }
    text_.add(ending_);
    add_comments();
    return text_.take();
  }

 private:
  // The word that names the statement, and what is at the end of its line.
  void find_statement() {
    for (const Word& word : block_.words) {
      const std::string_view code = named_word(word);
      if (code.empty() || std::ranges::find(kElements, code) != kElements.end()) continue;
      statement_ = &word;
      return name_statement(std::string(code));
    }
    // A tool call without a tool.
    const bool calls = !block_.words.empty() &&
                       (block_.words.front().letter == 'S' || block_.words.front().letter == 'F' ||
                        block_.words.front().letter == 'j');
    if (calls) name_ = "TOOL CALL";
  }

  void name_statement(const std::string& code) {
    name_ = code;
    const auto* spelling = std::ranges::find(kSpellings, code, &Spelling::code);
    if (spelling != kSpellings.end()) {
      name_ = spelling->written;
      implied_ = spelling->implied;
    } else if (code == "END PGM" && !program_.empty() && !has_event("END PGM")) {
      name_ += " " + program_;
    } else if (code.starts_with("PLANE ")) {
      if (!has('d') && !has('m')) ending_ = "STAY";
    }
    for (const std::string_view ending : {" FMAX", " DR+", " DR-"}) {
      if (!name_.ends_with(ending)) continue;
      name_.resize(name_.size() - ending.size());
      ending_ = ending.substr(1);
    }
    if (!has(kPolarRadius) && !has(kPolarAngle)) return;
    if (name_ == "L" || name_ == "C" || name_ == "CT") name_ += 'P';
    if (name_.starts_with("APPR ") || name_.starts_with("DEP ")) {
      name_.insert(name_.find(' ') + 1, "P");
    }
  }

  [[nodiscard]] bool has_event(std::string_view event) const {
    return std::ranges::any_of(block_.comments, [&](const Comment& comment) {
      return comment.event != nullptr && event == comment.event;
    });
  }

  [[nodiscard]] bool has(char letter) const {
    return std::ranges::find(block_.words, letter, &Word::letter) != block_.words.end();
  }

  void add_elements() {
    auto operand_of_m = std::ranges::find_if(block_.comments, is_operand_of_m);
    for (const Word& word : block_.words) {
      const bool implied =
          word.spelled == nullptr && implied_.find(word.letter) != std::string_view::npos;
      if (&word == statement_ || implied) continue;
      text_.add(element_text(word));
      const Word* const next = &word == &block_.words.back() ? nullptr : &word + 1;
      while (word.letter == 'M' && operand_of_m != block_.comments.end() &&
             operand_of_m->event == fmt::format("M{:g}", word.number) &&
             (next == nullptr || operand_of_m->column < next->column)) {
        text_.add(operand_of_m->text);
        operand_of_m = std::find_if(operand_of_m + 1, block_.comments.end(), is_operand_of_m);
      }
    }
  }

  // X+10, IX-Q1, F500, TX+0.5.
  [[nodiscard]] std::string element_text(const Word& word) const {
    if (word.letter == kNamedWord) return std::string(named_word(word));
    if (word.letter == kTangential) return "";
    const bool parameter = word.spelled != nullptr && word.spelled[0] == 'Q';
    if (word.letter == 'd' && !parameter) return name_.starts_with("PLANE") ? "TURN" : "FMAX";
    if (word.letter == 'm') return "MOVE";
    // The axes that are mirrored have no numbers.
    if (name_ == "CYCL DEF 8.1") return std::string(1, word.letter);
    const std::string value = value_text(spelling(), block_, word, operand);
    if (word.letter == 'T') return value;
    if (word.source == ValueSource::tool_call) return address_of(word) + "AUTO";
    if (word.source == ValueSource::fastest) return address_of(word) + "MAX";
    const bool bare = word.expression.empty() &&
                      std::string_view("FSMt").find(word.letter) != std::string_view::npos;
    return address_of(word) + (bare ? value : with_sign(value));
  }

  // POS1 (X+10 Y+20)
  [[nodiscard]] std::string pattern_text(const FramePart& part) const {
    std::string text;
    for (std::size_t i = 0; i < part.axes.size(); ++i) {
      text += fmt::format("{}{}{}", i == 0 ? "" : " ", pattern_word(part.axes[i]),
                          with_sign(range_text(spelling(), block_, part.values[i], operand)));
    }
    return fmt::format("{} ({})", part.name, text);
  }

  [[nodiscard]] std::string setting_text(const Assignment& setting) const {
    const std::string& name = block_.names[*setting.name];
    const auto steps = steps_of(block_, setting.value);
    // The one computation that formulas do not have: the angle from 0 to 360 degrees.
    const bool angle = steps.size() > 3 && steps.back().operation == Operation::modulo &&
                       steps[steps.size() - 3].operation == Operation::arc_tangent;
    if (angle) return angle_text(name, setting.value);
    if (steps.back().operation == Operation::element) return system_data_text(name, steps);
    return fmt::format("{} = {}", name, range_text(spelling(), block_, setting.value, sum));
  }

  // FN 18: SYSREAD Q1 = ID270 NR1 IDX3, of which NR is one step.
  [[nodiscard]] std::string system_data_text(const std::string& name,
                                             std::span<const ExpressionStep> steps) const {
    const ExpressionStep& element = steps.back();
    const std::string group = block_.names[name_of_element(element)].substr(1);
    const auto first = static_cast<std::uint32_t>(&steps.front() - block_.steps.data());
    const auto count = static_cast<std::uint32_t>(steps.size() - 1);
    const std::uint32_t of_number = 1;
    std::string text = fmt::format("FN 18: SYSREAD {} = {} NR{}", name, group,
                                   range_text(spelling(), block_, {first, of_number}, operand));
    if (of_number == count) return text;
    return text +
           fmt::format(" IDX{}", range_text(spelling(), block_,
                                            {first + of_number, count - of_number}, operand));
  }

  // FN 13: Q1 = +Q2 ANG +Q3, which ends with the operations of ANG and MOD 360.
  [[nodiscard]] std::string angle_text(const std::string& name, ExpressionRange range) const {
    range.count -= 2;
    return fmt::format("FN 13: {} = {}", name, fn_text(block_, range));
  }

  [[nodiscard]] std::string flow_text(const FlowStatement& flow) const {
    switch (flow.kind) {
      case FlowKind::label:
      case FlowKind::give_back:
        return "LBL " + label_text(flow.label);
      case FlowKind::call:
        if (!flow.of_file) return "CALL LBL " + label_text(flow.label);
        return fmt::format("{} PGM \"{}.H\"", flow.by_cycle ? "CYCL DEF 12.1" : "CALL", flow.label);
      case FlowKind::repeat_part:
        return fmt::format("CALL LBL {} REP {}", label_text(flow.label),
                           range_text(spelling(), block_, flow.condition, operand));
      default:
        return jump_text(flow);
    }
  }

  // FN 9: IF +Q1 EQU +Q3 GOTO LBL 5
  [[nodiscard]] std::string jump_text(const FlowStatement& flow) const {
    constexpr std::array kComparisons{Operation::equal, Operation::not_equal, Operation::greater,
                                      Operation::less};
    const auto steps = steps_of(block_, flow.condition);
    const Operation comparison = steps.back().operation;
    if (steps.front().operation == Operation::exists) {
      return fmt::format("FN 9: IF {} IS {} GOTO LBL {}",
                         block_.names[static_cast<std::size_t>(steps.front().number)],
                         comparison == Operation::equal ? "UNDEFINED" : "DEFINED",
                         label_text(flow.label));
    }
    const auto fn = 9 + (std::ranges::find(kComparisons, comparison) - kComparisons.begin());
    return fmt::format("FN {}: IF {} GOTO LBL {}", fn, fn_text(block_, flow.condition),
                       label_text(flow.label));
  }

  // Each to the end of a line.
  void add_comments() {
    bool commented = false;
    for (const Comment& comment : block_.comments) {
      if (comment.event != nullptr) continue;
      if (commented) text_.add("~\n");
      text_.add(";" + comment.text);
      commented = true;
    }
  }

  const Block& block_;
  std::string& program_;  // of BEGIN PGM
  SpacedText text_{};
  const Word* statement_ = nullptr;
  std::string name_{};
  std::string ending_{};
  std::string_view implied_{};
};

}  // namespace

BlockWriter heidenhain_writer() {
  return [program = std::string()](const Block& block) mutable {
    return KlartextBlock(block, program)();
  };
}

}  // namespace frustum::parser
