// Sinumerik part programs: address words, X=value, named words, calls with arguments.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxBlockNumber = 99'999'999;

struct Address {
  std::string_view name;
  char letter;
  const char* spelled;
};
// Words that are written with = and longer than their letter.
constexpr std::array kAddresses{Address{"A3", 'a', "A3="}, Address{"B3", 'b', "B3="},
                                Address{"C3", 'c', "C3="}, Address{"CR", 'R', "CR="},
                                Address{"TURN", 'e', "TURN="}};

struct Function {
  std::string_view name;
  Operation operation;
  int arguments;
};
constexpr std::array kFunctions{
    Function{"SIN", Operation::sine, 1},         Function{"COS", Operation::cosine, 1},
    Function{"TAN", Operation::tangent, 1},      Function{"ASIN", Operation::arc_sine, 1},
    Function{"ACOS", Operation::arc_cosine, 1},  Function{"ATAN2", Operation::arc_tangent, 2},
    Function{"SQRT", Operation::square_root, 1}, Function{"ABS", Operation::absolute, 1},
    Function{"ROUND", Operation::round, 1},      Function{"LN", Operation::logarithm, 1},
    Function{"EXP", Operation::exponential, 1},
};

// Statements that take anything in brackets and change nothing that is simulated.
constexpr std::array<const char*, 7> kEvents{"CYCLE832",    "WORKPIECE", "FGROUP", "FGREF",
                                             "GROUP_BEGIN", "GROUP_END", "EXTERN"};

// The parameters of CYCLE800 in their order; those without a letter are looked at by the reader.
constexpr std::array kSwivelParameters{
    Address{"_FR", 0, ""},           Address{"_TC", 0, ""},         Address{"_ST", 0, ""},
    Address{"_MODE", 'Q', "_MODE="}, Address{"_X0", 'X', "_X0="},   Address{"_Y0", 'Y', "_Y0="},
    Address{"_Z0", 'Z', "_Z0="},     Address{"_A", 'A', "_A="},     Address{"_B", 'B', "_B="},
    Address{"_C", 'C', "_C="},       Address{"_X1", 'u', "_X1="},   Address{"_Y1", 'v', "_Y1="},
    Address{"_Z1", 'w', "_Z1="},     Address{"_DIR", 'd', "_DIR="}, Address{"_FR_I", 0, ""},
    Address{"_DMODE", 0, ""}};
constexpr std::size_t kSwivelData = 1;
constexpr std::size_t kSwivelStatus = 2;

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

class SinumerikReader {
 public:
  SinumerikReader(std::string_view text, std::uint32_t line) : in_(text, line) {
    block_.line = line;
  }

  Result<Block> operator()() {
    read_start();
    while (!in_.at_end()) read_element();
    return in_.finish(std::move(block_));
  }

 private:
  void read_start() {
    if (in_.take('%')) {
      block_.tape_mark = true;
      const std::uint32_t column = in_.column();
      std::string name = in_.text_to();
      if (!name.empty()) block_.comments.push_back({column, false, std::move(name), nullptr});
      return;
    }
    if (in_.take('/')) {
      block_.deletable = true;
      if (const auto level = in_.digits(); level.size() > 1) {
        in_.fail(in_.column(), "/ has a level from 0 to 9", "write /1");
      }
    }
    const std::uint32_t column = in_.column();
    if (in_.take(':') || (in_.peek() == 'N' && in_.letters() == "N")) {
      const auto digits = in_.digits();
      std::uint32_t number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (!digits.empty() && digits.size() <= 8 && number <= kMaxBlockNumber) {
        block_.number = number;
        return;
      }
      if (digits.empty() && in_.peek() != '=') in_.go_back_to(column);
      if (!digits.empty())
        in_.fail(column, "the block number is too large", "N has up to 8 digits");
    }
  }

  void read_element() {
    const std::uint32_t column = in_.column();
    const char first = in_.peek();
    if (first == ';') {
      in_.take(';');
      block_.comments.push_back({column, true, in_.text_to(), nullptr});
      return;
    }
    if (first == '$') {
      in_.fail(column, "system variables are not read", "give a number or an R parameter");
      return;
    }
    if ((first < 'A' || first > 'Z') && first != '_') {
      in_.fail_unexpected("a block consists of words such as G1 X10 and X=R1+2; comments follow ;");
      return;
    }
    const std::string letters = in_.letters();
    const char next = in_.peek_byte();
    if (letters.size() == 1 && letters != "_") {
      if (next >= '0' && next <= '9') {
        const auto digits = in_.digits();
        const bool extended = in_.peek() == '=';
        if (extended) return read_extended(letters + std::string(digits), column);
        in_.go_back_to(column);
        (void)in_.letters();
      }
      return read_word(letters.front(), column);
    }
    in_.go_back_to(column);
    read_named(in_.name(), column);
  }

  // A letter with a number or with =.
  void read_word(char letter, std::uint32_t column) {
    if (letter == 'N') {
      in_.fail(column, "N is not the first word", "put the block number at the start of the block");
      return;
    }
    if (letter == 'R' && in_.peek() != '=') {
      in_.fail(column, "R has no =", "write R1=value to set a parameter, X=R1 to use one");
      return;
    }
    Word word;
    word.letter = letter;
    word.column = column;
    if (in_.take('=')) {
      read_value(word, std::string(1, letter));
    } else {
      const bool negative = in_.take('-');
      if (!negative) in_.take('+');
      const auto number = in_.number();
      if (!number) {
        in_.fail(column, fmt::format("{} has no number", letter),
                 fmt::format("write {0}10 or {0}=R1+10", letter));
        return;
      }
      word.number = (negative ? -number->value : number->value) + 0.0;
      word.decimal_point = number->decimal_point;
    }
    block_.words.push_back(word);
  }

  // A3=, R1=: a letter, digits and =.
  void read_extended(const std::string& name, std::uint32_t column) {
    if (name.front() == 'R') {
      in_.take('=');
      Assignment setting;
      setting.column = column;
      setting.name = add_name(name);
      setting.value.first = first_step();
      read_sum(0);
      setting.value.count = first_step() - setting.value.first;
      block_.assignments.push_back(setting);
      return;
    }
    if (read_address(name, column)) return;
    const bool direction = name.size() == 2 && name.front() >= 'A' && name.front() <= 'C';
    in_.fail(column, fmt::format("{}= is not simulated", name),
             direction ? "give the tool vector by A3= B3= C3="
                       : "give the words of the one spindle and of X Y Z A B C without numbers");
  }

  bool read_address(const std::string& name, std::uint32_t column) {
    const auto* address = std::find_if(kAddresses.begin(), kAddresses.end(),
                                       [&](const Address& a) { return a.name == name; });
    if (address == kAddresses.end() || !in_.take('=')) return false;
    Word word;
    word.letter = address->letter;
    word.spelled = address->spelled;
    word.column = column;
    read_value(word, name);
    block_.words.push_back(word);
    return true;
  }

  void read_named(const std::string& name, std::uint32_t column) {
    if (read_address(name, column)) return;
    if (in_.peek() == ':') return read_label(name, column);
    if (const auto* flow = flow_word(name); flow != nullptr) return read_flow(*flow, column);
    if (name == "MSG") return read_event("message", column, true);
    if (name == "SPOS" || name == "SPOSA") {
      if (!in_.take('=')) return in_.fail(column, name + " has no =", "write SPOS=0");
      block_.comments.push_back({column, false, in_.text_to(";"), "SPOS"});
      return;
    }
    if (name == "CYCLE800") return read_swivel(column);
    for (const char* event : kEvents) {
      if (name == event) return read_event(event, column, false);
    }
    if (const Code* code = find_code(Dialect::sinumerik, name); code != nullptr) {
      add_code(block_, *code, column);
      if (name == "TRAORI" && in_.take('(')) {
        if (const auto number = in_.digits(); number != "1" && !number.empty()) {
          in_.fail(column, "TRAORI(" + std::string(number) + ") is not simulated",
                   "there is one transformation: TRAORI or TRAORI(1)");
        }
        close("TRAORI");
      }
      return;
    }
    if (const auto remedy = remedy_for(Dialect::sinumerik, name); !remedy.empty()) {
      in_.fail(column, name + " is not simulated", std::string(remedy));
      return;
    }
    in_.fail(column, "unknown word " + name, "known are " + known_words(Dialect::sinumerik));
  }

  // NAME: before a block, the place of a jump.
  void read_label(const std::string& name, std::uint32_t column) {
    in_.take(':');
    begin_flow(FlowKind::label, column);
    if (!in_.failed()) block_.flow->label = name;
  }

  void read_flow(const FlowWord& word, std::uint32_t column) {
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

  void begin_flow(FlowKind kind, std::uint32_t column) {
    if (block_.flow || !block_.words.empty() || !block_.assignments.empty()) {
      in_.fail(column, "a statement behind other words", "write it in a block of its own");
      return;
    }
    block_.flow.emplace();
    block_.flow->kind = kind;
    block_.flow->column = column;
  }

  void read_condition(std::string_view whose) {
    if (in_.at_end()) {
      in_.fail(in_.column(), fmt::format("{} has no condition", whose),
               fmt::format("write for example {} R1<5", whose));
      return;
    }
    block_.flow->condition = read_range([this] { read_logic(0); });
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
    const bool parameter = name.size() > 1 && name.front() == 'R' &&
                           name.find_first_not_of("0123456789", 1) == std::string::npos;
    if (!parameter || !in_.take('=')) {
      in_.fail(column, "FOR has no R parameter to count", "write FOR R1=1 TO 5");
      return;
    }
    block_.flow->variable = add_name(name);
    block_.flow->condition = read_range([this] { read_sum(0); });
    if (!in_.take_name("TO")) {
      in_.fail(in_.column(), "FOR has no TO", "write FOR R1=1 TO 5");
      return;
    }
    block_.flow->limit = read_range([this] { read_sum(0); });
  }

  template <typename Read>
  ExpressionRange read_range(const Read& read) {
    ExpressionRange range{first_step(), 0};
    read();
    range.count = first_step() - range.first;
    return range;
  }

  // NAME(...), kept as text.
  void read_event(const char* name, std::uint32_t column, bool message) {
    if (!in_.take('(')) {
      in_.fail(in_.column(), "the opening bracket is missing", "write the text in ( )");
      return;
    }
    std::string text;
    if (in_.take('"')) {
      text = in_.text_to("\"");
      if (!in_.take('"')) in_.fail(column, "the text is not closed", "close it with \"");
    }
    if (!message || text.empty()) text += in_.text_to(")");
    close(name);
    block_.comments.push_back({column, false, std::move(text), name});
  }

  void read_swivel(std::uint32_t column) {
    const bool bare = !in_.take('(');
    std::string data = "0";
    std::string written;
    bool any = false;
    std::vector<Word> words;
    for (std::size_t i = 0; !bare && !in_.failed(); ++i) {
      if (in_.at_end()) {
        in_.fail(column, "the bracket of CYCLE800 is not closed", "close it with )");
        return;
      }
      if (i >= kSwivelParameters.size()) {
        in_.fail(in_.column(), "CYCLE800 has too many parameters",
                 fmt::format("it takes {}", kSwivelParameters.size()));
        return;
      }
      if (in_.peek() != ',' && in_.peek() != ')') {
        any = true;
        read_swivel_parameter(i, words, data);
      }
      if (in_.take(')')) break;
      if (in_.at_end()) continue;
      if (!in_.take(',')) in_.fail_unexpected("separate the parameters of CYCLE800 by ,");
    }
    const bool cancels = !any || data == "0";
    add_code(block_, *find_code(Dialect::sinumerik, cancels ? "CYCLE800()" : "CYCLE800"), column);
    if (cancels) return;
    block_.words.insert(block_.words.end(), words.begin(), words.end());
    if (std::none_of(words.begin(), words.end(), [](const Word& w) { return w.letter == 'Q'; })) {
      in_.fail(column, "CYCLE800 without a swivel mode", "give 57 as the fourth parameter");
    }
  }

  void read_swivel_parameter(std::size_t i, std::vector<Word>& words, std::string& data) {
    const Address& parameter = kSwivelParameters.at(i);
    const std::uint32_t column = in_.column();
    if (i == kSwivelData) {
      if (!in_.take('"')) {
        in_.fail(column, "the swivel data record is a text", "write its name in \"\"");
        return;
      }
      data = in_.text_to("\"");
      // No name is the first record, which is in use.
      if (!in_.take('"')) in_.fail(column, "the text is not closed", "close it with \"");
      return;
    }
    Word word;
    word.letter = parameter.letter;
    word.spelled = parameter.spelled;
    word.column = column;
    read_value(word, std::string(parameter.name));
    if (parameter.letter != 0) {
      words.push_back(word);
    } else if (i == 0 && (word.number != 0.0 || !word.expression.empty())) {
      block_.comments.push_back({column, false, "the retract before the swivel", "CYCLE800"});
    } else if (i == kSwivelStatus && (!word.expression.empty() ||
                                      static_cast<long>(std::min(word.number, 1e6)) % 10 == 1)) {
      in_.fail(column, "CYCLE800 on top of another swivel is not simulated",
               "give the whole turn in one call: 0 as the third parameter");
    }
  }

  // After =: a sum, or AC() IC() DC() around one.
  void read_value(Word& word, const std::string& name) {
    const bool rotary = name == "A" || name == "B" || name == "C";
    const std::string measure = in_.next_name();
    const std::uint32_t column = in_.column();
    if (measure == "ACP" || measure == "ACN") {
      in_.fail(column, measure + " is not simulated", "use DC(), the shorter way, or AC()");
      return;
    }
    if (in_.peek() == '"') {
      in_.fail(column, fmt::format("{} has a name instead of a number", name),
               "tools go by their numbers here: T1");
      return;
    }
    const bool measured = measure == "AC" || measure == "IC" || measure == "DC";
    if (measured) {
      (void)in_.name();
      word.measure = measure == "AC"   ? Measure::absolute
                     : measure == "IC" ? Measure::incremental
                                       : Measure::shortest;
      if (measure == "DC" && !rotary) {
        in_.fail(column, "DC() is for rotary axes", "write AC() or the plain value");
        return;
      }
      if (!in_.take('(')) {
        in_.fail(in_.column(), measure + " needs its value in ( )", "write X=" + measure + "(1)");
        return;
      }
    }
    word.expression.first = first_step();
    read_sum(0);
    if (measured) close(measure);
    word.expression.count = first_step() - word.expression.first;
    // A plain number needs no expression.
    if (word.expression.count == 1 && !in_.failed() &&
        block_.steps.back().operation == Operation::number) {
      word.number = block_.steps.back().number;
      word.expression = {};
      block_.steps.pop_back();
    }
  }

  void close(std::string_view whose) {
    if (in_.take(')')) return;
    if (in_.at_end()) {
      in_.fail(in_.column(), fmt::format("the bracket of {} is not closed", whose),
               "close it with )");
    } else {
      in_.fail_unexpected("close the bracket with )");
    }
  }

  // OR and XOR of AND of comparisons.
  void read_logic(int depth) {
    read_conjunction(depth);
    while (!in_.failed()) {
      const std::uint32_t column = in_.column();
      const bool either = in_.take_name("OR");
      if (!either && !in_.take_name("XOR")) return;
      read_conjunction(depth);
      push(either ? Operation::logical_or : Operation::logical_xor, column);
    }
  }

  void read_conjunction(int depth) {
    read_comparison(depth);
    while (!in_.failed()) {
      const std::uint32_t column = in_.column();
      if (!in_.take_name("AND")) return;
      read_comparison(depth);
      push(Operation::logical_and, column);
    }
  }

  void read_comparison(int depth) {
    const std::uint32_t column = in_.column();
    if (depth < kMaxExpressionDepth && in_.take_name("NOT")) {
      read_comparison(depth + 1);
      if (in_.failed()) return;
      block_.steps.push_back({Operation::number, column, 0.0});
      return push(Operation::equal, column);
    }
    read_sum(depth);
    const std::uint32_t sign = in_.column();
    if (const auto comparison = take_comparison()) {
      read_sum(depth);
      push(*comparison, sign);
    }
  }

  std::optional<Operation> take_comparison() {
    if (in_.take('=')) {
      if (!in_.take('=')) in_.fail_unexpected("compare by ==");
      return Operation::equal;
    }
    if (in_.take('<')) {
      if (in_.take('>')) return Operation::not_equal;
      return in_.take('=') ? Operation::less_or_equal : Operation::less;
    }
    if (in_.take('>')) return in_.take('=') ? Operation::greater_or_equal : Operation::greater;
    return std::nullopt;
  }

  void read_sum(int depth) {
    read_product(depth);
    while (!in_.failed()) {
      const std::uint32_t column = in_.column();
      const Operation operation = in_.peek() == '+' ? Operation::add : Operation::subtract;
      if (!in_.take('+') && !in_.take('-')) return;
      read_product(depth);
      push(operation, column);
    }
  }

  void read_product(int depth) {
    read_factor(depth);
    while (!in_.failed()) {
      const std::uint32_t column = in_.column();
      Operation operation = Operation::multiply;
      if (in_.take('/')) {
        operation = Operation::divide;
      } else if (in_.take_name("MOD")) {
        operation = Operation::modulo;
      } else if (!in_.take('*')) {
        return;
      }
      read_factor(depth);
      push(operation, column);
    }
  }

  void read_factor(int depth) {
    const std::uint32_t column = in_.column();
    if (depth >= kMaxExpressionDepth) {
      in_.fail(column, "too many brackets within each other", "compute a part into an R parameter");
      return;
    }
    if (in_.take('-')) {
      read_factor(depth + 1);
      if (in_.failed()) return;
      // A negative number is a number.
      if (block_.steps.back().operation == Operation::number) {
        block_.steps.back().number = -block_.steps.back().number + 0.0;
      } else {
        push(Operation::negate, column);
      }
      return;
    }
    if (in_.take('+')) return read_factor(depth + 1);
    if (in_.take('(')) {
      read_logic(depth + 1);
      return close("the expression");
    }
    if (const auto number = in_.number()) {
      block_.steps.push_back({Operation::number, column, number->value});
      return;
    }
    read_operand(in_.name(), column, depth);
  }

  void read_operand(const std::string& name, std::uint32_t column, int depth) {
    if (name.size() > 1 && name.front() == 'R' &&
        name.find_first_not_of("0123456789", 1) == std::string::npos) {
      block_.steps.push_back(
          {Operation::named_parameter, column, static_cast<double>(add_name(name))});
      return;
    }
    const auto* function = std::find_if(kFunctions.begin(), kFunctions.end(),
                                        [&](const Function& f) { return f.name == name; });
    if (function == kFunctions.end()) {
      if (name.empty()) {
        in_.fail(column, "a number is missing",
                 "write a number, an R parameter, a function or an expression in ( )");
      } else {
        in_.fail(column, "unknown operand " + name,
                 "known are R parameters and SIN COS TAN ASIN ACOS ATAN2 SQRT ABS ROUND LN EXP");
      }
      return;
    }
    if (!in_.take('(')) {
      in_.fail(in_.column(), name + " needs its argument in ( )", "write for example SIN(30)");
      return;
    }
    read_sum(depth + 1);
    if (function->arguments == 2) {
      if (!in_.take(',')) in_.fail(column, name + " needs two values", "write ATAN2(y,x)");
      read_sum(depth + 1);
    }
    close(name);
    push(function->operation, column);
  }

  void push(Operation operation, std::uint32_t column) {
    if (!in_.failed()) block_.steps.push_back({operation, column, 0.0});
  }
  [[nodiscard]] std::uint32_t first_step() const {
    return static_cast<std::uint32_t>(block_.steps.size());
  }
  std::uint32_t add_name(const std::string& name) {
    block_.names.push_back(name);
    return static_cast<std::uint32_t>(block_.names.size() - 1);
  }

  LineScanner in_;
  Block block_;
};

}  // namespace

Result<Block> read_sinumerik_block(std::string_view text, std::uint32_t line) {
  return SinumerikReader(text, line)();
}

}  // namespace frustum::parser
