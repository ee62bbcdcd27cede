// Sinumerik part programs: address words, X=value, named words, calls with arguments.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "parser/dialects/code_table.hpp"
#include "parser/dialects/dialect_rules.hpp"
#include "parser/reading/block_draft.hpp"
#include "parser/reading/block_reader.hpp"
#include "parser/reading/rs274/plain_block.hpp"
#include "parser/reading/sinumerik/sinumerik_call.hpp"
#include "parser/reading/sinumerik/sinumerik_cycle.hpp"
#include "parser/reading/sinumerik/sinumerik_flow.hpp"
#include "parser/reading/sinumerik/sinumerik_settings.hpp"
#include "parser/reading/sinumerik/sinumerik_swivel.hpp"
#include "parser/reading/sinumerik/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxBlockNumber = 99'999'999;

struct Address {
  std::string_view name;
  char letter;
  const char* spelled;
};
// Words that are written with = and longer than their letter.
constexpr std::array kAddresses{
    Address{"A3", 'a', "A3="},     Address{"B3", 'b', "B3="},     Address{"C3", 'c', "C3="},
    Address{"CR", 'R', "CR="},     Address{"TURN", 'e', "TURN="}, Address{"RPL", 'R', "RPL="},
    Address{"AP", 'q', "AP="},     Address{"RP", 'p', "RP="},     Address{"I1", 'u', "I1="},
    Address{"J1", 'v', "J1="},     Address{"K1", 'w', "K1="},     Address{"RND", 'r', "RND="},
    Address{"RNDM", 'm', "RNDM="}, Address{"CHF", 'h', "CHF="},   Address{"CHR", 'i', "CHR="},
    Address{"FRC", 'f', "FRC="},   Address{"FRCM", 'l', "FRCM="}, Address{"ANG", 'n', "ANG="},
    Address{"AR", 'o', "AR="}};
// Words of these letters with plain numbers need no more than their letter.
constexpr LetterSet kPlainLetters{"ABCDFGIJKMSTXYZ"};

class SinumerikReader {
 public:
  SinumerikReader(std::string_view text, std::uint32_t line)
      : draft_(text, line, sinumerik_expressions()) {}

  Result<Block> operator()() {
    read_start();
    while (!in_.at_end()) read_element();
    check_positioning();
    return draft_.finish();
  }

 private:
  // What goes by itself is not part of the path of the block.
  void check_positioning() {
    const auto goes_alone = [](const Word& word) {
      return word.spelled != nullptr && std::string_view(word.spelled) == "POS";
    };
    if (std::ranges::none_of(block_.words, goes_alone)) return;
    for (const Word& word : block_.words) {
      if (std::string_view("XYZABC").find(word.letter) == std::string_view::npos) continue;
      if (goes_alone(word)) continue;
      in_.fail("word-ambiguous"_id, word.column,
               fmt::format("{} of the path beside POS", word.letter), "write two blocks");
    }
  }

  void read_start() {
    if (in_.take('%')) {
      return read_sinumerik_head(draft_);
    }
    if (in_.take('/')) {
      block_.deletable = true;
      if (const auto level = in_.digits(); level.size() > 1) {
        in_.fail("out-of-range"_id, in_.column(), "/ has a level from 0 to 9", "write /1");
      }
    }
    pass_over_mark();
    const std::uint32_t column = in_.column();
    const bool numbered = in_.take(':') || (in_.peek() == 'N' && in_.letters() == "N");
    // NORM is a word.
    if (!numbered) in_.go_to(column);
    if (numbered) {
      const auto digits = in_.digits();
      std::uint32_t number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (!digits.empty() && digits.size() <= 8 && number <= kMaxBlockNumber) {
        block_.number = number;
        return;
      }
      if (digits.empty() && in_.peek() != '=') in_.go_to(column);
      if (!digits.empty())
        in_.fail("number-too-large"_id, column, "the block number is too large",
                 "N has up to 8 digits");
    }
  }

  // : of a main block without its number.
  void pass_over_mark() {
    const std::uint32_t column = in_.column();
    if (!in_.take(':')) return;
    const char next = in_.peek();
    if (next >= '0' && next <= '9') return in_.go_to(column);
    draft_.add_event(":", column, "without a number it is passed over");
    block_.comments.back().assumed = true;
  }

  void read_element() {
    const std::uint32_t column = in_.column();
    const char first = in_.peek();
    if (first == ';') return draft_.read_comment();
    if (first == '$') return read_system_setting(draft_, column);
    if ((first < 'A' || first > 'Z') && first != '_') {
      in_.fail_unexpected("a block consists of words such as G1 X10 and X=R1+2; comments follow ;");
      return;
    }
    const std::string letters = in_.letters();
    const char next = in_.peek_byte();
    if (letters.size() == 1 && letters != "_") {
      if (letters == "R" && in_.take('[')) return read_indexed_setting(column);
      if (next == '[') return read_variable_setting(draft_, letters, column);
      if (next >= '0' && next <= '9') {
        const auto digits = in_.digits();
        const bool extended = in_.peek() == '=';
        // Leading zeros count: L1 is not L01.
        if (letters == "L" && !extended) {
          return read_sinumerik_call(draft_, letters + std::string(digits), column);
        }
        if (extended) return read_extended(letters + std::string(digits), column);
        if (letters == "M" && in_.peek() == '(') {
          return read_builder_call(draft_, "M" + std::string(digits), column);
        }
        in_.go_to(column);
        (void)in_.letters();
      }
      return read_word(letters.front(), column);
    }
    in_.go_to(column);
    read_named(in_.name(), column);
  }

  // A letter with a number or with =.
  void read_word(char letter, std::uint32_t column) {
    if (letter == 'N') {
      in_.fail("word-order"_id, column, "N is not the first word",
               "put the block number at the start of the block");
      return;
    }
    if (letter == 'R' && in_.peek() != '=') {
      in_.fail("keyword-missing"_id, column,
               "R has no =", "write R1=value to set a parameter, X=R1 to use one");
      return;
    }
    if (letter == 'G') {
      // The limits of the spindle and of the working area have words of their own.
      const std::uint32_t start = in_.column();
      std::string_view digits = in_.digits();
      digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
      if (digits == "25" || digits == "26") {
        return draft_.add_event(digits == "25" ? "G25" : "G26", column, in_.text_to(";"));
      }
      in_.go_to(start);
    }
    if (letter == 'H') return read_auxiliary(draft_, "H", column);
    if (read_parallel_axis(draft_, letter, column)) return;
    Word word;
    word.letter = letter;
    word.column = column;
    if (in_.take('=')) {
      read_sinumerik_value(draft_, word, std::string(1, letter));
    } else {
      const bool negative = in_.take('-');
      if (!negative) in_.take('+');
      const auto number = in_.number();
      if (!number) {
        in_.fail("value-missing"_id, column, fmt::format("{} has no number", letter),
                 fmt::format("write {0}10 or {0}=R1+10", letter));
        return;
      }
      word.number = (negative ? -number->value : number->value) + 0.0;
      word.decimal_point = number->decimal_point;
    }
    block_.words.push_back(word);
  }

  // R[R1+1]=5
  void read_indexed_setting(std::uint32_t column) {
    Assignment setting;
    setting.column = column;
    setting.index = draft_.read_expression(ExpressionLevel::sum);
    if (!in_.take(']'))
      in_.fail("bracket-not-closed"_id, in_.column(), "the index is not closed", "close it with ]");
    if (!in_.take('='))
      in_.fail("keyword-missing"_id, column, "R has no =", "write R[R1]=value to set a parameter");
    setting.value = draft_.read_expression(ExpressionLevel::sum);
    block_.assignments.push_back(setting);
  }

  // A3=, R1=: a letter, digits and =.
  void read_extended(const std::string& name, std::uint32_t column) {
    if (name.front() == 'R') {
      in_.take('=');
      draft_.begin_setting(name, column);
      (void)draft_.read_expression(ExpressionLevel::sum);
      return draft_.end_setting();
    }
    if (read_address(name, column)) return;
    const char letter = name.front();
    if (read_machine_axis(name, column)) return;
    if (letter == 'H') return read_auxiliary(draft_, "H", column);
    if (letter == 'M' || letter == 'S' || letter == 'T') {
      // S1=1000: of the first spindle, which is the one that is simulated.
      if (name.substr(1) == "1") return read_word(letter, column);
      return read_auxiliary(draft_, letter == 'M' ? "M" : letter == 'S' ? "S" : "T", column);
    }
    const bool direction = name.size() == 2 && name.front() >= 'A' && name.front() <= 'C';
    in_.fail("not-supported"_id, column, fmt::format("{}= is not simulated", name),
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
    read_sinumerik_value(draft_, word, name);
    block_.words.push_back(word);
    return true;
  }

  // G74 X1=0: the value says nothing.
  bool read_machine_axis(const std::string& name, std::uint32_t column) {
    constexpr double kFixedPoints = 74.0;  // and 75
    const bool approaches = std::ranges::any_of(block_.words, [](const Word& word) {
      return word.letter == 'G' &&
             (word.number == kFixedPoints || word.number == kFixedPoints + 1.0);
    });
    const bool axis = name.size() == 2 && name.back() == '1' &&
                      std::string_view("XYZABC").find(name.front()) != std::string_view::npos;
    return approaches && axis && in_.take('=') && read_axis_value(name, column);
  }

  bool read_axis_value(const std::string& name, std::uint32_t column) {
    Word word;
    word.letter = name.front();
    word.column = column;
    read_sinumerik_value(draft_, word, std::string(1, name.front()));
    block_.words.push_back(word);
    return true;
  }

  // POS[X]=5: after the name.
  void read_positioning(std::uint32_t column) {
    const bool begun = std::ranges::any_of(block_.words, [](const Word& word) {
      return word.letter == kNamedWord && code_at(word.number).word == "POS";
    });
    if (!begun) add_code(block_, *find_code(Dialect::sinumerik, "POS"), column);
    const bool bracket = in_.take('[');
    const std::string axis = in_.name();
    if (!bracket || axis.size() != 1 ||
        std::string_view("XYZABC").find(axis) == std::string::npos || !in_.take(']') ||
        !in_.take('=')) {
      return in_.fail("not-supported"_id, column, "POS of another axis than X Y Z A B C",
                      "write POS[X]=5, or move the axis by G0");
    }
    (void)read_axis_value(axis, column);
    block_.words.back().spelled = "POS";
  }

  void read_named(const std::string& name, std::uint32_t column) {
    if (read_address(name, column)) return;
    if (in_.peek() == ':') return read_sinumerik_label(draft_, name, column);
    if (read_sinumerik_flow(draft_, name, column)) return;
    if (read_sinumerik_setting(draft_, name, column)) return;
    if (name == "CYCLE800") return read_sinumerik_swivel(draft_, column);
    if (name == "MCALL") return read_sinumerik_modal_call(draft_, column);
    if (is_sinumerik_cycle(name)) return read_sinumerik_cycle(draft_, name, column);
    if (name == "POS") return read_positioning(column);
    if (name == "PROC") return read_sinumerik_procedure(draft_, column);
    if (name == "DEF") return read_sinumerik_definition(draft_, column);
    if (name == "EXTERN") return draft_.add_event("EXTERN", column, in_.text_to(";"));
    if (const Code* code = find_code(Dialect::sinumerik, name); code != nullptr) {
      add_code(block_, *code, column);
      return read_brackets_of_word(draft_, name, column);
    }
    if (std::ranges::find(rules_of(Dialect::sinumerik).turning_words, name) !=
        rules_of(Dialect::sinumerik).turning_words.end()) {
      return in_.fail("not-milling"_id, column, "a lathe program: " + name + " is of turning",
                      "only programs of milling machines are simulated");
    }
    if (const auto remedy = remedy_for(Dialect::sinumerik, name); !remedy.empty()) {
      in_.fail("not-supported"_id, column, name + " is not simulated", std::string(remedy));
      return;
    }
    const char next = in_.peek();
    if ((next == '=' || next == '[') && is_variable(name)) {
      return read_variable_setting(draft_, name, column);
    }
    if (name == "CALL" || name == "EXTCALL" || name == "PCALL") {
      return read_sinumerik_named_call(draft_, column);
    }
    const bool first =
        block_.words.empty() && block_.assignments.empty() && (!block_.flow || draft_.labelled());
    if (first && name.size() > 1) return read_sinumerik_call(draft_, name, column);
    in_.fail("unknown-word"_id, column, "unknown word " + name,
             "known are " + known_words(Dialect::sinumerik));
  }

  BlockDraft draft_;
  LineScanner& in_ = draft_.in;
  Block& block_ = draft_.block;
};

}  // namespace

bool read_plain_sinumerik_block(Block& block, std::string_view text, std::uint32_t line) {
  return read_plain_block(block, text, line, kPlainLetters) &&
         block.number.value_or(0) <= kMaxBlockNumber &&
         std::ranges::none_of(block.words, [](const Word& word) {
           return word.letter == 'G' && (word.number == 25.0 || word.number == 26.0);
         });
}

Result<Block> read_sinumerik_block(std::string_view text, std::uint32_t line) {
  return SinumerikReader(text, line)();
}

}  // namespace frustum::parser
