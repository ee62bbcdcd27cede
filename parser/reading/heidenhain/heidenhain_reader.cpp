// Heidenhain Klartext: a statement a line, with its own elements.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "core/spelling.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kLineHint =
    "a line is a statement such as L X+10 R0 FMAX, with its number before it";

constexpr std::array kPaths{"L", "LN", "C", "CR", "CT", "LP", "CP", "CTP"};
// By their first words.
constexpr std::array kStatements{"CC",    "TOOL",   "PLANE", "FUNCTION", "CYCL", "BEGIN",
                                 "END",   "BLK",    "STOP",  "FN",       "LBL",  "CALL",
                                 "M3",    "Q1",     "RND",   "CHF",      "APPR", "DEP",
                                 "TRANS", "PRESET", "TCH",   "PATTERN"};
// Statements that change nothing that is simulated.
constexpr std::array kPassedStatements{"SEL TABLE", "CONTOUR DEF", "SEL CONTOUR", "SECTION",
                                       "MONITORING HEATMAP"};
// Words whose number may follow without a blank: LBL1, FN0:, RND5.
constexpr std::array<std::string_view, 5> kRunOn{"LBL", "FN", "RND", "CHF", "N"};

bool is_axis_word(std::string_view name) {
  if (name.starts_with('I')) name.remove_prefix(1);
  return !name.empty() && std::string_view("XYZABC").find(name.front()) != std::string_view::npos &&
         name.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

class HeidenhainReader {
 public:
  HeidenhainReader(std::string_view text, std::uint32_t line, std::string& program)
      : draft_(text, line, heidenhain_expressions()), program_(program) {
    in_.read_decimal_commas();
  }

  Result<Block> operator()() {
    read_line_number();
    if (in_.take('/')) {
      block_.deletable = true;
      if (!block_.number) read_line_number();
    }
    if (!in_.at_end()) read_statement();
    return draft_.finish();
  }

 private:
  void read_line_number() {
    const auto digits = in_.digits();
    if (digits.empty()) return;
    std::uint32_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (digits.size() > 8)
      in_.fail("number-too-large"_id, 1, "the line number is too large", "it has up to 8 digits");
    block_.number = number;
  }

  void read_statement() {
    const std::uint32_t column = in_.column();
    const char first = in_.peek();
    if (first == ';') return draft_.read_comment();
    if (in_.take('*')) {
      in_.take('-');
      return note(draft_, "structure", column, in_.text_to());
    }
    // Of a simulator or a transfer program, before the program itself.
    if (first == '(' && program_.empty()) {
      block_.comments.push_back({column, true, in_.text_to(), nullptr});
      return;
    }
    std::string name = in_.name();
    if (std::find(kPaths.begin(), kPaths.end(), name) != kPaths.end()) {
      return read_heidenhain_path(draft_, name, column);
    }
    for (const std::string_view word : kRunOn) {
      const bool runs_on = name.size() > word.size() && name.starts_with(word) &&
                           name.find_first_not_of("0123456789", word.size()) == std::string::npos;
      if (!runs_on) continue;
      in_.go_to(column + static_cast<std::uint32_t>(word.size()));
      if (word == "N") return read_numbered();
      name = word;
    }
    if (name == "RND" || name == "CHF") return read_heidenhain_corner(draft_, name, column);
    if (name == "RNDR") {
      in_.go_to(column + 3);
      return read_heidenhain_corner(draft_, "RND", column);
    }
    if (name == "CC") return read_heidenhain_pole(draft_, column);
    if (name == "APPR" || name == "DEP") return read_heidenhain_link(draft_, name, column);
    if (name == "TOOL") return read_heidenhain_tool(draft_, column);
    if (name == "PLANE") return read_heidenhain_plane(draft_, column);
    if (name == "FUNCTION") return read_heidenhain_function(draft_, column);
    if (name == "CYCL" || name == "CYCLE") return read_heidenhain_cycle(draft_, column);
    if (name == "PATTERN") return read_heidenhain_pattern(draft_, column);
    if (name == "TCH") return read_heidenhain_probing(draft_, column);
    if (name == "BEGIN" || name == "END") return read_frame_of_program(name, column);
    if (name == "BLK" && in_.take_name("FORM"))
      return note(draft_, "BLK FORM", column, in_.text_to(";"));
    if (name == "STOP") {
      // A stop beside an M word that stops is nothing of its own.
      constexpr std::array kStops{"M0", "M00", "M1", "M01", "M2", "M02", "M30"};
      const std::string next = in_.next_name();
      if (std::find(kStops.begin(), kStops.end(), next) != kStops.end()) {
        draft_.add_event("STOP", column, "");
        return read_heidenhain_elements(draft_, "STOP");
      }
      add_code(block_, *find_code(Dialect::heidenhain, "STOP"), column);
      return read_heidenhain_elements(draft_, "STOP");
    }
    if (is_element(name)) {
      in_.go_to(column);
      return read_heidenhain_elements(draft_, "a line without a statement");
    }
    // A line goes on.
    if (is_axis_word(name)) {
      in_.go_to(column);
      return read_heidenhain_path(draft_, "L", column);
    }
    if (is_q_parameter(name)) return read_heidenhain_setting(draft_, name, column);
    if (name == "DECLARE" && in_.take_name("STRING")) {
      const std::uint32_t place = in_.column();
      return read_text_setting(in_.name(), place);
    }
    if (is_text_parameter(name)) return read_text_setting(name, column);
    if (name == "FN") return read_heidenhain_fn(draft_, column);
    if (name == "LBL") return read_heidenhain_label(draft_, column);
    if (name == "CALL") return read_heidenhain_call(draft_, column);
    if (name == "TRANS" || name == "PRESET") return read_heidenhain_transform(draft_, name, column);
    for (const std::string_view passed : kPassedStatements) {
      const std::size_t blank = passed.find(' ');
      if (name != passed.substr(0, blank)) continue;
      if (blank != std::string_view::npos && !in_.take_name(passed.substr(blank + 1))) continue;
      return note(draft_, passed.data(), column, in_.text_to(";"));
    }
    if (name == "GLOBAL" && in_.take_name("DEF")) return read_global_definition(column);
    if (const auto remedy = remedy_for(Dialect::heidenhain, name); !remedy.empty()) {
      return in_.fail("not-supported"_id, column, name + " is not simulated", std::string(remedy));
    }
    if (name.empty()) return in_.fail_unexpected(std::string(kLineHint));
    std::vector<std::string> known(kStatements.begin(), kStatements.end());
    known.insert(known.end(), kPaths.begin(), kPaths.end());
    in_.fail("unknown-word"_id, column, "unknown statement " + name, suggestion(name, known));
  }

  // QS1 = "MILL" || QS2; what else a text is made of is left to the control.
  void read_text_setting(const std::string& name, std::uint32_t column) {
    const std::uint32_t place = in_.column();
    const std::string whole = in_.text_to(";");
    bool plain = is_text_parameter(name);
    bool quoted = false;
    for (const char c : whole) {
      if (c == '"') quoted = !quoted;
      plain = plain && (quoted || std::string_view("\"QSqs0123456789|=\t ").find(c) !=
                                      std::string_view::npos);
    }
    if (!plain || quoted || whole.find('"') == std::string::npos) {
      in_.go_to(column);
      return note(draft_, "QS", column, in_.text_to());
    }
    in_.go_to(place);
    read_heidenhain_setting(draft_, name, column);
  }

  // GLOBAL DEF 100: values for cycles that ask for them by PREDEF, which none of ours does.
  void read_global_definition(std::uint32_t column) {
    constexpr double kPositioning = 125.0;  // heights between the holes of a pattern
    const std::uint32_t place = in_.column();
    const auto number = in_.number();
    if (!number || number->value >= kPositioning) {
      return in_.fail("not-supported"_id, place, "this GLOBAL DEF is not simulated",
                      "leave it out, and give each cycle its own values");
    }
    in_.go_to(place);
    std::string text;
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
      } else {
        text += (text.empty() ? "" : " ") + in_.text_to(";");
      }
    }
    draft_.add_event("GLOBAL DEF", column, std::move(text));
  }

  // N10 L X+5
  void read_numbered() {
    block_.number = in_.block_number();
    if (!in_.failed() && !in_.at_end()) read_statement();
  }

  // M3, R0, FMAX, F500, S2000 at the start of a line.
  [[nodiscard]] static bool is_element(std::string_view name) {
    if (name == "RL" || name == "RR" || name == "R" || name == "FMAX" || name == "FAUTO") {
      return true;
    }
    if (name.empty() || std::string_view("MFSR").find(name.front()) == std::string_view::npos) {
      return false;
    }
    return name.size() == 1 || name.find_first_not_of("0123456789", 1) == std::string_view::npos ||
           (name[1] == 'Q' && name.front() != 'R');
  }

  void read_frame_of_program(const std::string& name, std::uint32_t column) {
    if (!in_.take_name("PGM")) {
      return in_.fail("keyword-missing"_id, column, name + " without PGM",
                      "write BEGIN PGM NAME MM or END PGM NAME MM");
    }
    const std::uint32_t place = in_.column();
    std::string text = in_.text_to(";");
    const std::string called = text.substr(0, text.find(' '));
    if (name == "END") {
      add_code(block_, *find_code(Dialect::heidenhain, "END PGM"), column);
      if (!program_.empty() && upper_case(called) != upper_case(program_)) {
        return note(draft_, "END PGM", column, std::move(text));
      }
      return end_statement(draft_);
    }
    program_ = called;
    const std::string unit = upper_case(text.substr(text.find_last_of(' ') + 1));
    const bool metric = unit == "MM";
    if (!metric && unit != "INCH" && unit != "IN") {
      return in_.fail("keyword-missing"_id, place, "BEGIN PGM has no unit",
                      "end it with MM or INCH");
    }
    add_code(block_, *find_code(Dialect::heidenhain, metric ? "BEGIN PGM MM" : "BEGIN PGM INCH"),
             column);
    note(draft_, "BEGIN PGM", column, std::move(text));
  }

  BlockDraft draft_;
  LineScanner& in_ = draft_.in;
  Block& block_ = draft_.block;
  std::string& program_;  // of BEGIN PGM
};

// Simulators have remarks in brackets at the end of a line, where no value is computed: the column
// of one, or 0.
std::size_t remark_in(std::string_view text) {
  const std::size_t last = text.find_last_not_of(" \t\r");
  if (last == std::string_view::npos || text[last] != ')') return 0;
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos || text.find_first_of("=;\"~") != std::string_view::npos ||
      text.find("PATTERN") < open) {
    return 0;
  }
  const std::size_t before = open == 0 ? open : text.find_last_not_of(" \t", open - 1);
  const bool apart = open > 0 && (text[open - 1] == ' ' || text[open - 1] == '\t');
  const bool alone = text.find('(', open + 1) == std::string_view::npos && text.find(')') == last;
  return apart && alone && before != std::string_view::npos ? open + 1 : 0;
}

}  // namespace

BlockReader heidenhain_reader() {
  return [program = std::string()](std::string_view text,
                                   std::uint32_t line) mutable -> Result<Block> {
    const std::size_t column = remark_in(text);
    if (column == 0) return HeidenhainReader(text, line, program)();
    auto block = HeidenhainReader(text.substr(0, column - 1), line, program)();
    if (block) {
      std::string remark(text.substr(column, text.rfind(')') - column));
      block->comments.push_back(
          {static_cast<std::uint32_t>(column), false, std::move(remark), nullptr});
    }
    return block;
  };
}

}  // namespace frustum::parser
