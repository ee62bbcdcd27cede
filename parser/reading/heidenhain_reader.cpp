// Heidenhain Klartext: a statement a line, with its own elements.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kLineHint =
    "a line is a statement such as L X+10 R0 FMAX, with its number before it";

struct Element {
  std::string_view name;
  char letter;
  const char* spelled;
};
constexpr std::array kIncremental{Element{"IX", 'X', "IX"}, Element{"IY", 'Y', "IY"},
                                  Element{"IZ", 'Z', "IZ"}, Element{"IA", 'A', "IA"},
                                  Element{"IB", 'B', "IB"}, Element{"IC", 'C', "IC"}};
constexpr std::array kToolVector{Element{"TX", 'a', "TX"}, Element{"TY", 'b', "TY"},
                                 Element{"TZ", 'c', "TZ"}};
constexpr std::array kSpatialAngles{Element{"SPA", 'A', "SPA"}, Element{"SPB", 'B', "SPB"},
                                    Element{"SPC", 'C', "SPC"}};

template <std::size_t N>
const Element* find(const std::array<Element, N>& elements, std::string_view name) {
  for (const Element& element : elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

struct Function {
  std::string_view name;
  Operation operation;
};
constexpr std::array kFunctions{
    Function{"SIN", Operation::sine},        Function{"COS", Operation::cosine},
    Function{"TAN", Operation::tangent},     Function{"ASIN", Operation::arc_sine},
    Function{"ACOS", Operation::arc_cosine}, Function{"SQRT", Operation::square_root},
    Function{"ABS", Operation::absolute},    Function{"INT", Operation::fix},
    Function{"LN", Operation::logarithm},    Function{"EXP", Operation::exponential}};
constexpr const char* kFnJump = "write FN 9: IF +Q1 EQU +Q3 GOTO LBL 5";

class HeidenhainReader {
 public:
  HeidenhainReader(std::string_view text, std::uint32_t line) : in_(text, line) {
    block_.line = line;
  }

  Result<Block> operator()() {
    if (const auto digits = in_.digits(); !digits.empty()) {
      std::uint32_t number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (digits.size() > 8) in_.fail(1, "the line number is too large", "it has up to 8 digits");
      block_.number = number;
    }
    if (in_.take('/')) block_.deletable = true;
    if (!in_.at_end()) read_statement();
    return in_.finish(std::move(block_));
  }

 private:
  void read_statement() {
    const std::uint32_t column = in_.column();
    if (in_.peek() == ';') return read_comment();
    if (in_.take('*')) {
      in_.take('-');
      return note("structure", column, in_.text_to());
    }
    const std::string name = in_.name();
    if (name == "L" || name == "LN" || name == "C" || name == "CR") return read_path(name, column);
    if (name == "CC") return read_pole(column);
    if (name == "TOOL") return read_tool(column);
    if (name == "PLANE") return read_plane(column);
    if (name == "FUNCTION") return read_function(column);
    if (name == "CYCL") return read_cycle(column);
    if (name == "BEGIN" || name == "END") return read_frame_of_program(name, column);
    if (name == "BLK" && in_.take_name("FORM")) return note("BLK FORM", column, in_.text_to(";"));
    if (name == "STOP") {
      add_code(block_, *find_code(Dialect::heidenhain, "STOP"), column);
      return read_elements("STOP", {});
    }
    if (name.size() > 1 && name.front() == 'M' &&
        name.find_first_not_of("0123456789", 1) == std::string::npos) {
      in_.go_back_to(column);
      return read_elements("M", {});
    }
    if (is_parameter(name)) return read_setting(name, column);
    if (name == "FN") return read_fn(column);
    if (name == "LBL") return read_label(column);
    if (name == "CALL") return read_call(column);
    if (const auto remedy = remedy_for(Dialect::heidenhain, name); !remedy.empty()) {
      return in_.fail(column, name + " is not simulated", std::string(remedy));
    }
    if (name.empty()) return in_.fail_unexpected(std::string(kLineHint));
    in_.fail(
        column, "unknown statement " + name,
        "known are L LN CC C CR TOOL CALL, TOOL DEF, PLANE SPATIAL, PLANE RESET, FUNCTION TCPM, "
        "FUNCTION RESET TCPM, CYCL DEF 247, STOP, BLK FORM, BEGIN PGM, END PGM");
  }

  void read_comment() {
    const std::uint32_t column = in_.column();
    in_.take(';');
    block_.comments.push_back({column, true, in_.text_to(), nullptr});
  }
  void note(const char* event, std::uint32_t column, std::string text) {
    block_.comments.push_back({column, false, std::move(text), event});
    while (in_.peek() == ';') read_comment();
    if (!in_.at_end()) in_.fail_unexpected("start a line for each statement");
  }

  // --- path statements --------------------------------------------------------------------------

  struct Path {
    bool axes = false;
    bool vector = false;
    bool radius = false;
    bool sense = false;
    bool feed = false;
  };

  void read_path(const std::string& statement, std::uint32_t column) {
    const bool arc = statement.front() == 'C';
    // The place of the statement's word; which word it is, the elements tell.
    block_.words.push_back({kNamedWord, false, column, 0.0, {}});
    Path path;
    path.axes = true;
    path.vector = statement == "LN";
    path.radius = statement == "CR";
    path.sense = arc;
    path.feed = true;
    read_elements(statement, path);
    if (in_.failed()) return;
    std::string word = statement;
    if (arc) {
      if (sense_ == 0) {
        return in_.fail(column, statement + " has no direction", "end it with DR+ or DR-");
      }
      if (rapid_) return in_.fail(column, statement + " with FMAX", "give an arc a feed");
      word += sense_ == '+' ? " DR+" : " DR-";
    } else if (rapid_) {
      word += " FMAX";
    }
    block_.words.front().number = row_of(*find_code(Dialect::heidenhain, word));
    if (statement == "CR" && !has_radius_) {
      in_.fail(column, "CR has no radius", "give R and the radius, for example R+10");
    }
  }

  void read_elements(const std::string& statement, const Path& path) {
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        read_comment();
        continue;
      }
      read_element(statement, path);
    }
  }

  void read_element(const std::string& statement, const Path& path) {
    const std::uint32_t column = in_.column();
    const std::string name = in_.letters();
    const auto is_axis = [&](std::string_view letters) {
      return path.axes && name.size() == 1 && letters.find(name.front()) != std::string_view::npos;
    };
    if (name == "M") return read_m(column);
    if (is_axis("XYZABC")) return add_measured(name.front(), Measure::modal, nullptr, column);
    if (const Element* element = find(kIncremental, name); path.axes && element != nullptr) {
      return add_measured(element->letter, Measure::incremental, element->spelled, column);
    }
    if (const Element* element = find(kToolVector, name); path.vector && element != nullptr) {
      return add_value(element->letter, name, column, element->spelled);
    }
    if (path.vector && (name == "NX" || name == "NY" || name == "NZ")) {
      // The surface normal matters to oversized tools only, which TOOL CALL refuses.
      (void)number(name, column);
      return;
    }
    if (path.sense && name == "DR" && (in_.peek() == '+' || in_.peek() == '-')) {
      if (sense_ != 0) return in_.fail(column, "DR is given twice", "leave one of them out");
      sense_ = in_.peek();
      in_.take(sense_);
      return;
    }
    if (name == "R") return read_radius(statement, path, column);
    if (name == "RL" || name == "RR") {
      return in_.fail(column, name + " is not simulated",
                      "program the path of the tool centre and use R0");
    }
    if (path.feed && name.starts_with('F')) return read_feed(name, column);
    if (name.empty()) {
      return in_.fail_unexpected("elements of a statement are such as X+10, R0, F500, FMAX, M3");
    }
    in_.fail(column, fmt::format("{} has no meaning in {}", name, statement),
             "known are X Y Z A B C, I before them, R0, F, FMAX, F AUTO, FT, M; TX TY TZ in LN; "
             "DR+ and DR- in C and CR");
  }

  void read_radius(const std::string& statement, const Path& path, std::uint32_t column) {
    const bool is_signed = in_.peek_byte() == '+' || in_.peek_byte() == '-';
    const double value = number("R", column);
    if (!is_signed && value == 0.0) {
      add_code(block_, *find_code(Dialect::heidenhain, "R0"), column);
      return;
    }
    if (!path.radius) {
      return in_.fail(column, fmt::format("a radius in {}", statement),
                      "R0 is no radius compensation; a radius belongs to CR");
    }
    has_radius_ = true;
    add_number(block_, 'R', value, column);
  }

  void read_feed(const std::string& name, std::uint32_t column) {
    const bool spaced = name == "F";
    if (name == "FMAX" || (spaced && in_.take_name("MAX"))) {
      rapid_ = true;
      return;
    }
    if (name == "FAUTO" || (spaced && in_.take_name("AUTO"))) {
      add_code(block_, *find_code(Dialect::heidenhain, "F AUTO"), column);
      return;
    }
    if (name == "FT") return add_number(block_, 't', number(name, column), column, "FT");
    if (!spaced) {
      return in_.fail(column, name + " is not simulated",
                      "give F, FMAX, F AUTO or FT; feed per revolution is M136");
    }
    add_value('F', name, column, nullptr);
  }

  void read_m(std::uint32_t column) {
    const double code = number("M", column);
    if (code == 140.0) {
      return in_.fail(column, "M140 is not simulated", "retract by L Z... R0 FMAX M91");
    }
    const auto add = [&](double m) { add_number(block_, 'M', m, column); };
    if (code == 13.0 || code == 14.0) {  // spindle and coolant
      add(code - 10.0);
      return add(8.0);
    }
    add(code);
    if (code != 128.0 || in_.peek() != 'F') return;
    const std::uint32_t feed_column = in_.column();
    if (in_.letters() != "F" || in_.next_name() == "MAX") return in_.go_back_to(feed_column);
    // The feed of the balancing moves.
    block_.comments.push_back(
        {feed_column, false, fmt::format("F{}", number("F", feed_column)), "M128"});
  }

  void read_pole(std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "CC"), column);
    while (!in_.at_end() && in_.peek() != ';') {
      const std::uint32_t place = in_.column();
      const std::string name = in_.letters();
      const Element* element = find(kIncremental, name);
      const std::string axis = element == nullptr ? name : std::string(1, element->letter);
      if (axis != "X" && axis != "Y") {
        if (name.empty()) return in_.fail_unexpected("write CC X+0 Y+0");
        return in_.fail(place, fmt::format("{} has no meaning in CC", name),
                        "the pole has X and Y: CC X+0 Y+0");
      }
      add_measured(axis.front(), element == nullptr ? Measure::modal : Measure::incremental,
                   element == nullptr ? nullptr : element->spelled, place);
    }
    if (in_.peek() == ';') read_comment();
  }

  void add_measured(char letter, Measure measure, const char* spelled, std::uint32_t column) {
    add_value(letter, spelled != nullptr ? spelled : std::string(1, letter), column, spelled);
    if (!block_.words.empty()) block_.words.back().measure = measure;
  }

  // --- Q parameters -----------------------------------------------------------------------------

  // Q1, QL1, QR1
  static bool is_parameter(std::string_view name) {
    const std::size_t digits = name.find_first_of("0123456789");
    if (digits == std::string_view::npos ||
        name.find_first_not_of("0123456789", digits) != std::string_view::npos)
      return false;
    const std::string_view letters = name.substr(0, digits);
    return letters == "Q" || letters == "QL" || letters == "QR";
  }

  // A word with [ + | - ] and a number or a parameter.
  void add_value(char letter, std::string_view whose, std::uint32_t column, const char* spelled) {
    const std::uint32_t place = in_.column();
    const bool negative = in_.take('-');
    if (!negative) in_.take('+');
    if (in_.peek() != 'Q') {
      in_.go_back_to(place);
      return add_number(block_, letter, number(whose, column), column, spelled);
    }
    Word word;
    word.letter = letter;
    word.column = column;
    word.spelled = spelled;
    word.expression.first = first_step();
    push_parameter();
    if (negative) push(Operation::negate, place);
    word.expression.count = first_step() - word.expression.first;
    block_.words.push_back(word);
  }

  void push_parameter() {
    const std::uint32_t column = in_.column();
    const std::string name = in_.name();
    if (!is_parameter(name)) {
      return in_.fail(column, fmt::format("{} is no parameter", name.empty() ? "this" : name),
                      "parameters are Q1, QL1 and QR1");
    }
    block_.names.push_back(name);
    block_.steps.push_back(
        {Operation::named_parameter, column, static_cast<double>(block_.names.size() - 1)});
  }

  // Q1 = Q2 + 3 * SIN(Q4)
  void read_setting(const std::string& name, std::uint32_t column) {
    if (!in_.take('=')) {
      return in_.fail(in_.column(), name + " has no =", fmt::format("write {} = 5", name));
    }
    begin_setting(name, column);
    read_sum(0);
    end_setting();
    end_statement();
  }
  void begin_setting(const std::string& name, std::uint32_t column) {
    Assignment setting;
    setting.column = column;
    block_.names.push_back(name);
    setting.name = static_cast<std::uint32_t>(block_.names.size() - 1);
    setting.value.first = first_step();
    block_.assignments.push_back(setting);
  }
  void end_setting() {
    ExpressionRange& value = block_.assignments.back().value;
    value.count = first_step() - value.first;
  }
  void end_statement() {
    if (in_.peek() == ';') read_comment();
    if (!in_.at_end()) in_.fail_unexpected("start a line for each statement");
  }

  // FN 0: Q5 = +60, FN 9: IF +Q1 EQU +Q3 GOTO LBL 5.
  void read_fn(std::uint32_t column) {
    const auto number = in_.number();
    if (!number || !in_.take(':')) {
      return in_.fail(column, "FN has no number", "write FN 0: Q5 = +60");
    }
    const auto fn = static_cast<int>(number->value);
    constexpr std::array kComparisons{Operation::equal, Operation::not_equal, Operation::greater,
                                      Operation::less};
    if (fn >= 9 && fn <= 12)
      return read_fn_jump(kComparisons.at(static_cast<std::size_t>(fn - 9)), column);
    const std::uint32_t place = in_.column();
    const std::string target = in_.name();
    if (fn > 7) {
      return in_.fail(column, fmt::format("FN {} is not simulated", fn),
                      "known are FN 0 to FN 7 and FN 9 to FN 12");
    }
    if (!is_parameter(target) || !in_.take('=')) {
      return in_.fail(place, "FN sets no parameter", "write FN 0: Q5 = +60");
    }
    begin_setting(target, place);
    const auto operand = [&] { read_signed(0); };
    const auto with = [&](std::string_view word, Operation operation) {
      const std::uint32_t sign = in_.column();
      if (!in_.take_name(word)) {
        return in_.fail(sign, fmt::format("FN {} has no {}", fn, word),
                        "write FN 1: Q1 = -Q2 + -5, FN 3: Q2 = +3 * +3, FN 4: Q4 = +4 DIV +Q2");
      }
      operand();
      push(operation, sign);
    };
    const auto sign_with = [&](char sign, Operation operation) {
      const std::uint32_t at = in_.column();
      if (!in_.take(sign)) {
        return in_.fail(at, fmt::format("FN {} has no {}", fn, sign),
                        "write FN 1: Q1 = -Q2 + -5, FN 3: Q2 = +3 * +3, FN 4: Q4 = +4 DIV +Q2");
      }
      operand();
      push(operation, at);
    };
    const auto function = [&](std::string_view word, Operation operation) {
      const std::uint32_t at = in_.column();
      if (!in_.take_name(word)) {
        return in_.fail(at, fmt::format("FN {} has no {}", fn, word), "write FN 6: Q20 = SIN -Q5");
      }
      operand();
      push(operation, at);
    };
    if (fn == 5) {
      function("SQRT", Operation::square_root);
    } else if (fn == 6) {
      function("SIN", Operation::sine);
    } else if (fn == 7) {
      function("COS", Operation::cosine);
    } else {
      operand();
      if (fn == 1) sign_with('+', Operation::add);
      if (fn == 2) sign_with('-', Operation::subtract);
      if (fn == 3) sign_with('*', Operation::multiply);
      if (fn == 4) with("DIV", Operation::divide);
    }
    end_setting();
    end_statement();
  }

  void read_fn_jump(Operation comparison, std::uint32_t column) {
    if (!in_.take_name("IF")) return in_.fail(in_.column(), "FN has no IF", kFnJump);
    begin_flow(FlowKind::jump, column);
    block_.flow->condition.first = first_step();
    read_signed(0);
    const std::uint32_t place = in_.column();
    const std::string word = in_.name();
    if (word != "EQU" && word != "NE" && word != "GT" && word != "LT") {
      return in_.fail(place, "FN compares by EQU, NE, GT or LT", kFnJump);
    }
    read_signed(0);
    push(comparison, place);
    block_.flow->condition.count = first_step() - block_.flow->condition.first;
    if (!in_.take_name("GOTO") || !in_.take_name("LBL")) {
      return in_.fail(in_.column(), "FN has no GOTO LBL", kFnJump);
    }
    read_label_name();
    end_statement();
  }

  void read_sum(int depth) {
    read_product(depth);
    while (!in_.failed() && (in_.peek() == '+' || in_.peek() == '-')) {
      const std::uint32_t column = in_.column();
      const Operation operation = in_.take('+') ? Operation::add : Operation::subtract;
      if (operation == Operation::subtract) in_.take('-');
      read_product(depth);
      push(operation, column);
    }
  }
  void read_product(int depth) {
    read_signed(depth);
    while (!in_.failed()) {
      const std::uint32_t column = in_.column();
      Operation operation = Operation::multiply;
      if (in_.take('/')) {
        operation = Operation::divide;
      } else if (in_.take('^')) {
        operation = Operation::power;
      } else if (!in_.take('*')) {
        return;
      }
      read_signed(depth);
      push(operation, column);
    }
  }
  // [ + | - ] number, parameter, function or ( sum )
  void read_signed(int depth) {
    const std::uint32_t column = in_.column();
    if (depth >= kMaxExpressionDepth) {
      return in_.fail(column, "too many brackets within each other", "compute a part before");
    }
    if (in_.take('-')) {
      read_signed(depth + 1);
      return push(Operation::negate, column);
    }
    if (in_.take('+')) return read_signed(depth + 1);
    if (in_.take('(')) {
      read_sum(depth + 1);
      if (!in_.failed() && !in_.take(')')) {
        in_.fail(column, "the bracket is not closed", "close it with )");
      }
      return;
    }
    if (const auto found = in_.number()) {
      block_.steps.push_back({Operation::number, column, found->value});
      return;
    }
    const std::string name = in_.next_name();
    for (const Function& function : kFunctions) {
      if (name != function.name) continue;
      (void)in_.name();
      read_signed(depth + 1);
      return push(function.operation, column);
    }
    push_parameter();
  }
  void push(Operation operation, std::uint32_t column) {
    if (!in_.failed()) block_.steps.push_back({operation, column, 0.0});
  }
  [[nodiscard]] std::uint32_t first_step() const {
    return static_cast<std::uint32_t>(block_.steps.size());
  }

  // --- labels -----------------------------------------------------------------------------------

  void begin_flow(FlowKind kind, std::uint32_t column) {
    block_.flow.emplace();
    block_.flow->kind = kind;
    block_.flow->column = column;
  }

  // 5 or "NAME".
  void read_label_name() {
    const std::uint32_t column = in_.column();
    if (in_.take('"')) {
      block_.flow->label = in_.text_to("\"");
      if (!in_.take('"')) in_.fail(column, "the name is not closed", "close it with \"");
    } else {
      block_.flow->label = std::string(in_.digits());
    }
    if (!in_.failed() && block_.flow->label.empty()) {
      in_.fail(column, "LBL has no number or name", "write LBL 1 or LBL \"SLOT\"");
    }
  }

  void read_label(std::uint32_t column) {
    begin_flow(FlowKind::label, column);
    read_label_name();
    // The end of a subprogram.
    if (block_.flow->label == "0") block_.flow->kind = FlowKind::give_back;
    end_statement();
  }

  // CALL LBL 1, CALL LBL 1 REP 3.
  void read_call(std::uint32_t column) {
    if (!in_.take_name("LBL")) {
      return in_.fail(column, "CALL without LBL is not simulated", "write CALL LBL 1");
    }
    begin_flow(FlowKind::call, column);
    read_label_name();
    if (in_.take_name("REP")) {
      block_.flow->kind = FlowKind::repeat_part;
      block_.flow->condition.first = first_step();
      read_signed(0);
      block_.flow->condition.count = first_step() - block_.flow->condition.first;
      // Older controls show how many are left.
      if (in_.take('/')) (void)in_.digits();
    }
    end_statement();
  }

  double number(std::string_view whose, std::uint32_t column) {
    return in_.signed_number(whose, column);
  }

  // --- other statements -------------------------------------------------------------------------

  void read_tool(std::uint32_t column) {
    const std::string kind = in_.name();
    if (kind == "DEF") return note("TOOL DEF", column, in_.text_to(";"));
    if (kind != "CALL")
      return in_.fail(column, "TOOL without CALL or DEF", "write TOOL CALL 1 Z S5000");
    if (in_.peek() == '"' || in_.peek() == 'Q') {
      return in_.fail(in_.column(), "TOOL CALL has a name instead of a number",
                      "tools go by their numbers here: TOOL CALL 1 Z S5000");
    }
    const std::uint32_t place = in_.column();
    if (const auto tool = in_.number()) {
      add_code(block_, *find_code(Dialect::heidenhain, "TOOL CALL"), column);
      add_number(block_, 'T', tool->value, place, "tool ");
    }
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        read_comment();
        continue;
      }
      read_tool_element();
    }
  }

  void read_tool_element() {
    const std::uint32_t column = in_.column();
    std::string name = in_.letters();
    if (name == "Z") return;
    if (name == "X" || name == "Y") {
      return in_.fail(column, fmt::format("tool axis {} is not simulated", name),
                      "the tool is along Z");
    }
    if (name == "S") return add_number(block_, 'S', number(name, column), column);
    if (name == "F") return add_number(block_, 'F', number(name, column), column);
    if (name == "DL" || name == "DR") {
      if (in_.peek_byte() == '2') (void)in_.digits();
      if (number(name, column) != 0.0) {
        in_.fail(column, name + " is not simulated", "give the tool's true size in the job");
      }
      return;
    }
    if (name.empty()) return in_.fail_unexpected("write TOOL CALL 1 Z S5000 F500");
    in_.fail(column, fmt::format("{} has no meaning in TOOL CALL", name),
             "known are the tool's number, Z, S, F, DL, DR, DR2");
  }

  void read_plane(std::uint32_t column) {
    const std::string kind = in_.name();
    if (kind != "SPATIAL" && kind != "RESET") {
      return in_.fail(column, fmt::format("PLANE {} is not simulated", kind),
                      "use PLANE SPATIAL SPA SPB SPC, or PLANE RESET");
    }
    add_code(block_, *find_code(Dialect::heidenhain, "PLANE " + kind), column);
    int angles = 0;
    bool behaviour = false;
    while (!in_.at_end()) {
      const std::uint32_t place = in_.column();
      if (in_.peek() == ';') {
        read_comment();
        continue;
      }
      const std::string name = in_.letters();
      if (const Element* angle = find(kSpatialAngles, name);
          angle != nullptr && kind == "SPATIAL") {
        add_number(block_, angle->letter, number(name, place), place, angle->spelled);
        ++angles;
      } else if (name == "TURN" || name == "STAY") {
        behaviour = true;
        if (name == "TURN") add_number(block_, 'd', 1.0, place, "TURN ");
      } else if (name == "MOVE") {
        in_.fail(place, "PLANE ... MOVE is not simulated",
                 "retract the tool and use TURN, or STAY and turn the axes by L");
      } else {
        read_plane_option(name, place);
      }
    }
    if (kind == "SPATIAL" && angles < 3) {
      in_.fail(column, "PLANE SPATIAL needs three angles", "give SPA, SPB and SPC, zero or not");
    }
    if (!behaviour) {
      in_.fail(column, fmt::format("PLANE {} does not say whether the axes turn", kind),
               "end it with TURN or STAY");
    }
  }

  // How the axes get there, which is not simulated.
  void read_plane_option(const std::string& name, std::uint32_t place) {
    const auto pass = [&](const char* event, std::string text) {
      block_.comments.push_back({place, false, std::move(text), event});
    };
    if (name == "FMAX" || name == "FAUTO") return;
    if (name == "F") {
      if (in_.take_name("MAX") || in_.take_name("AUTO")) return;
      (void)number(name, place);
      return;
    }
    if (name == "MB" || name == "DIST" || name == "ABST") {
      if (in_.take_name("MAX")) return pass("PLANE MB", "MAX");
      return pass("PLANE MB", fmt::format("{}", number(name, place)));
    }
    if (name == "SEQ" || name == "SYM") {
      const char sign = in_.peek();
      if (!in_.take('+') && !in_.take('-')) {
        return in_.fail(place, name + " has no sign", "write SEQ+ or SEQ-");
      }
      return pass("PLANE SEQ", std::string(1, sign));
    }
    if ((name == "TABLE" || name == "COORD") && in_.take_name("ROT")) {
      return pass("PLANE ROT", name);
    }
    if (name.empty()) return in_.fail_unexpected("write PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY");
    in_.fail(place, fmt::format("{} has no meaning in PLANE", name),
             "known are SPA SPB SPC, TURN, STAY, MB, F, SEQ, SYM, TABLE ROT, COORD ROT");
  }

  void read_function(std::uint32_t column) {
    const std::string kind = in_.name();
    if (kind == "RESET") {
      if (!in_.take_name("TCPM")) {
        return in_.fail(column, "FUNCTION RESET without TCPM", "write FUNCTION RESET TCPM");
      }
      add_code(block_, *find_code(Dialect::heidenhain, "FUNCTION RESET TCPM"), column);
      return read_elements("FUNCTION RESET TCPM", {});
    }
    if (kind == "MODE") return note("FUNCTION MODE", column, in_.text_to(";"));
    if (kind == "DWELL") {
      const std::uint32_t place = in_.column();
      if (!in_.take_name("TIME")) {
        return in_.fail(place, "FUNCTION DWELL without TIME", "write FUNCTION DWELL TIME2");
      }
      return add_dwell(in_.signed_number("TIME", place), column);
    }
    if (kind.starts_with("TCPM")) return read_tcpm(column);
    in_.fail(column, fmt::format("FUNCTION {} is not simulated", kind),
             "known are FUNCTION TCPM, FUNCTION RESET TCPM, FUNCTION MODE and FUNCTION DWELL");
  }

  void read_tcpm(std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "FUNCTION TCPM"), column);
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        read_comment();
        continue;
      }
      const std::uint32_t place = in_.column();
      const std::string name = in_.name();
      const std::string value = in_.name();
      const auto refused = [&](const char* remedy) {
        in_.fail(place, fmt::format("{} {} is not simulated", name, value), remedy);
      };
      if (name == "F") {
        if (value != "TCP") refused("the feed is that of the tool tip: F TCP");
      } else if (name == "AXIS") {
        if (value != "POS") refused("rotary words are axis positions: AXIS POS");
      } else if (name == "PATHCTRL" && (value == "AXIS" || value == "VECTOR")) {
        add_code(block_, *find_code(Dialect::heidenhain, "PATHCTRL " + value), place);
      } else if (name == "REFPNT") {
        const bool at_tip = value == "TIP" && in_.take('-') && in_.take_name("TIP");
        if (!at_tip) refused("the reference point is the tool tip: REFPNT TIP-TIP");
      } else if (name.empty()) {
        in_.fail_unexpected("write FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS");
      } else {
        in_.fail(place, fmt::format("{} has no meaning in FUNCTION TCPM", name),
                 "write FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS");
      }
    }
  }

  void add_dwell(double seconds, std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "DWELL"), column);
    add_number(block_, 'P', seconds, column, "TIME");
    while (in_.peek() == ';') read_comment();
    if (!in_.at_end()) in_.fail_unexpected("start a line for each statement");
  }

  void read_cycle(std::uint32_t column) {
    const bool defines = in_.take_name("DEF");
    const auto number = defines ? in_.number() : std::nullopt;
    if (!number) {
      return in_.fail(column, defines ? "CYCL DEF has no number" : "CYCL CALL is not simulated",
                      "write the cycle out as L blocks");
    }
    const double cycle = std::floor(number->value + 1e-6);
    const int part = static_cast<int>(std::lround((number->value - cycle) * 10.0));
    if (cycle == 247.0) return read_preset(column);
    if (cycle == 9.0) return read_dwell_cycle(part, column);
    if (cycle == 32.0) return note("CYCL DEF 32", column, in_.text_to(";"));
    in_.fail(column, fmt::format("CYCL DEF {} is not simulated", cycle),
             cycle == 19.0  ? "use PLANE SPATIAL"
             : cycle == 7.0 ? "set the work offset in the job, and call it by CYCL DEF 247 Q339=1"
                            : "write the cycle out as L blocks");
  }

  void read_preset(std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL DEF 247"), column);
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        read_comment();
        continue;
      }
      const std::uint32_t place = in_.column();
      const std::string name = in_.name();
      if (name.empty()) return in_.fail_unexpected("write CYCL DEF 247 DATUM SETTING Q339=+1");
      if (!in_.take('=')) continue;  // the cycle's name
      if (name != "Q339") {
        return in_.fail(place, fmt::format("{} has no meaning in CYCL DEF 247", name),
                        "the preset's number is Q339");
      }
      add_number(block_, 'P', number(name, place), place, "Q339=");
    }
  }

  void read_dwell_cycle(int part, std::uint32_t column) {
    if (part == 0) return note("CYCL DEF 9", column, in_.text_to(";"));
    const std::uint32_t place = in_.column();
    // "DWELL 2", "V.ZEIT 2", "V.TIME2"
    while (!in_.letters().empty() || in_.take('.')) {
    }
    add_dwell(in_.signed_number("CYCL DEF 9.1", place), column);
  }

  void read_frame_of_program(const std::string& name, std::uint32_t column) {
    if (!in_.take_name("PGM")) {
      return in_.fail(column, name + " without PGM", "write BEGIN PGM NAME MM or END PGM NAME MM");
    }
    const std::uint32_t place = in_.column();
    std::string text = in_.text_to();
    if (name == "END") {
      add_code(block_, *find_code(Dialect::heidenhain, "END PGM"), column);
      return;
    }
    const bool metric = text.ends_with(" MM") || text == "MM";
    if (!metric && !text.ends_with(" INCH") && text != "INCH") {
      return in_.fail(place, "BEGIN PGM has no unit", "end it with MM or INCH");
    }
    add_code(block_, *find_code(Dialect::heidenhain, metric ? "BEGIN PGM MM" : "BEGIN PGM INCH"),
             column);
    block_.comments.push_back({column, false, std::move(text), "BEGIN PGM"});
  }

  LineScanner in_;
  Block block_;
  char sense_ = 0;
  bool rapid_ = false;
  bool has_radius_ = false;
};

}  // namespace

Result<Block> read_heidenhain_block(std::string_view text, std::uint32_t line) {
  return HeidenhainReader(text, line)();
}

}  // namespace frustum::parser
