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
constexpr std::array kStatements{"CC",  "TOOL", "PLANE", "FUNCTION", "CYCL", "BEGIN",
                                 "END", "BLK",  "STOP",  "FN",       "LBL",  "CALL",
                                 "M3",  "Q1",   "RND",   "CHF"};

class HeidenhainReader {
 public:
  HeidenhainReader(std::string_view text, std::uint32_t line, std::string& program)
      : draft_(text, line, heidenhain_expressions()), program_(program) {
    in_.read_decimal_commas();
  }

  Result<Block> operator()() {
    if (const auto digits = in_.digits(); !digits.empty()) {
      std::uint32_t number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (digits.size() > 8)
        in_.fail("number-too-large"_id, 1, "the line number is too large", "it has up to 8 digits");
      block_.number = number;
    }
    if (in_.take('/')) block_.deletable = true;
    if (!in_.at_end()) read_statement();
    return draft_.finish();
  }

 private:
  void read_statement() {
    const std::uint32_t column = in_.column();
    if (in_.peek() == ';') return draft_.read_comment();
    if (in_.take('*')) {
      in_.take('-');
      return note(draft_, "structure", column, in_.text_to());
    }
    const std::string name = in_.name();
    if (std::find(kPaths.begin(), kPaths.end(), name) != kPaths.end()) {
      return read_heidenhain_path(draft_, name, column);
    }
    if (name == "RND" || name == "CHF") return read_heidenhain_corner(draft_, name, column);
    if (name == "CC") return read_heidenhain_pole(draft_, column);
    if (name == "TOOL") return read_heidenhain_tool(draft_, column);
    if (name == "PLANE") return read_heidenhain_plane(draft_, column);
    if (name == "FUNCTION") return read_heidenhain_function(draft_, column);
    if (name == "CYCL") return read_heidenhain_cycle(draft_, column);
    if (name == "BEGIN" || name == "END") return read_frame_of_program(name, column);
    if (name == "BLK" && in_.take_name("FORM"))
      return note(draft_, "BLK FORM", column, in_.text_to(";"));
    if (name == "STOP") {
      add_code(block_, *find_code(Dialect::heidenhain, "STOP"), column);
      return read_heidenhain_elements(draft_, "STOP");
    }
    if (name.size() > 1 && name.front() == 'M' &&
        name.find_first_not_of("0123456789", 1) == std::string::npos) {
      in_.go_to(column);
      return read_heidenhain_elements(draft_, "M");
    }
    if (is_q_parameter(name)) return read_heidenhain_setting(draft_, name, column);
    if (name == "FN") return read_heidenhain_fn(draft_, column);
    if (name == "LBL") return read_heidenhain_label(draft_, column);
    if (name == "CALL") return read_heidenhain_call(draft_, column);
    if (const auto remedy = remedy_for(Dialect::heidenhain, name); !remedy.empty()) {
      return in_.fail("not-supported"_id, column, name + " is not simulated", std::string(remedy));
    }
    if (name.empty()) return in_.fail_unexpected(std::string(kLineHint));
    std::vector<std::string> known(kStatements.begin(), kStatements.end());
    known.insert(known.end(), kPaths.begin(), kPaths.end());
    in_.fail("unknown-word"_id, column, "unknown statement " + name, suggestion(name, known));
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
      if (!program_.empty() && upper_case(called) != upper_case(program_)) {
        return in_.fail("program-name-mismatch"_id, place,
                        fmt::format("END PGM {} of the program {}", called, program_),
                        "BEGIN PGM and END PGM have the same name");
      }
      add_code(block_, *find_code(Dialect::heidenhain, "END PGM"), column);
      return end_statement(draft_);
    }
    program_ = called;
    const std::string unit = upper_case(text.substr(text.find_last_of(' ') + 1));
    const bool metric = unit == "MM";
    if (!metric && unit != "INCH") {
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

}  // namespace

BlockReader heidenhain_reader() {
  return [program = std::string()](std::string_view text, std::uint32_t line) mutable {
    return HeidenhainReader(text, line, program)();
  };
}

}  // namespace frustum::parser
