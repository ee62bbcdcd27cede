#include "parser/reading/rs274/macro_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "parser/language/letter_case.hpp"
#include "parser/reading/comment_text.hpp"
#include "parser/reading/line_scanner.hpp"
#include "parser/reading/rs274/grammar.hpp"
#include "parser/reading/rs274/rs274_values.hpp"

namespace frustum::parser {
namespace {

// What writes to a file or a screen: reported with the text as it is written.
struct OutputStatement {
  const char* keyword;
  bool has_text;  // in [ ]
};
constexpr std::array kOutputs{OutputStatement{"POPEN", false}, OutputStatement{"PCLOS", false},
                              OutputStatement{"DPRNT", true}, OutputStatement{"BPRNT", true},
                              OutputStatement{"SETVN", true}};

constexpr std::string_view kShortWhile = "WH";

// The words around a statement (N, /, comments, what THEN does) are read by the grammar of blocks,
// with the statement blanked out so that columns stay what they are.
class MacroReader {
 public:
  MacroReader(std::string_view text, std::uint32_t line, std::size_t start)
      : text_(text), in_(text, line), start_(start) {
    block_.line = line;
    in_.go_to(static_cast<std::uint32_t>(start) + 1);
  }

  Result<Block> operator()() {
    flow_.column = in_.column();
    const std::string keyword = in_.letters();
    if (keyword == "WHILE" || keyword == kShortWhile) {
      read_while();
    } else if (keyword == "DO") {
      flow_.kind = FlowKind::loop;
      flow_.turns = Turns::until_end;
      read_loop_number();
    } else if (keyword == "END") {
      flow_.kind = FlowKind::end_loop;
      read_loop_number();
    } else if (keyword == "IF") {
      read_if();
    } else if (keyword != "GOTO") {
      read_output(keyword);
      return in_.failed() ? in_.finish(std::move(block_)) : around_output();
    } else {
      read_jump();
    }
    if (in_.failed()) return in_.finish(std::move(block_));
    return around_statement();
  }

 private:
  void read_while() {
    flow_.kind = FlowKind::loop;
    read_condition("WHILE");
    if (in_.failed()) return;
    const std::uint32_t at = in_.column();
    if (in_.letters() != "DO")
      return in_.fail("keyword-missing"_id, at, "WHILE has no DO", "write WHILE [#1 LT 5] DO1");
    read_loop_number();
  }

  void read_if() {
    read_condition("IF");
    if (in_.failed()) return;
    const std::uint32_t at = in_.column();
    const std::string keyword = in_.letters();
    if (keyword == "GOTO") return read_jump();
    if (keyword != "THEN") {
      return in_.fail("keyword-missing"_id, at, "IF has neither GOTO nor THEN",
                      "write IF [c] GOTO 100 or IF [c] THEN #1=2");
    }
    flow_.kind = FlowKind::only_if;
  }

  void read_jump() {
    flow_.kind = FlowKind::jump;
    flow_.search = Search::forward_then_backward;
    flow_.label = std::string(1, 'N');
    if (const std::string digits = number(); !digits.empty()) {
      flow_.label += digits;
    } else if (in_.peek() == '#' || in_.peek() == '[') {
      read_expression(flow_.label_value);
    } else {
      in_.fail("name-missing"_id, in_.column(), "GOTO has no block number",
               "write GOTO 100, or GOTO #1");
    }
  }

  void read_output(std::string_view keyword) {
    const auto output = std::find_if(kOutputs.begin(), kOutputs.end(),
                                     [&](const auto& known) { return known.keyword == keyword; });
    if (output == kOutputs.end())
      return in_.fail_unexpected("write statements in blocks of their own");
    if (keyword == "SETVN") {
      return in_.fail("not-supported"_id, flow_.column, "SETVN is not simulated",
                      "it names variables for the screen: leave it out of the simulated program");
    }
    comment_ = {flow_.column, false, {}, output->keyword};
    if (!output->has_text) return;
    const std::uint32_t opening = in_.column();
    if (!in_.take('[')) {
      return in_.fail("value-missing"_id, opening, fmt::format("{} has no text", keyword),
                      fmt::format("write it in brackets: {}[X#1[53]]", keyword));
    }
    const std::size_t closing = closing_bracket(opening);
    if (closing == std::string_view::npos) {
      return in_.fail("bracket-not-closed"_id, opening, "the bracket is not closed",
                      "close it with ]");
    }
    comment_.text = utf8_of(text_.substr(opening, closing - opening));
    in_.go_to(static_cast<std::uint32_t>(closing) + 2);
  }

  // Of the bracket that is open before `from`; others may be within it.
  [[nodiscard]] std::size_t closing_bracket(std::size_t from) const {
    int open = 1;
    for (std::size_t at = from; at < text_.size(); ++at) {
      if (text_[at] == '[') ++open;
      if (text_[at] == ']' && --open == 0) return at;
    }
    return std::string_view::npos;
  }

  void read_loop_number() {
    const std::uint32_t at = in_.column();
    flow_.label = number();
    if (flow_.label != "1" && flow_.label != "2" && flow_.label != "3") {
      in_.fail("out-of-range"_id, at, "DO and END take a number from 1 to 3", "write DO1 and END1");
    }
  }

  void read_condition(std::string_view keyword) {
    if (in_.peek() != '[') {
      return in_.fail("value-missing"_id, in_.column(), fmt::format("{} has no condition", keyword),
                      fmt::format("write it in brackets: {} [#1 LT 5]", keyword));
    }
    read_expression(flow_.condition);
  }

  // The block without the statement, which is blanked out.
  Result<Block> around() {
    std::string text(text_);
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(start_),
              text.begin() + static_cast<std::ptrdiff_t>(in_.column() - 1), ' ');
    auto read = parse_block(text, block_.line, Dialect::fanuc);
    if (!read || !read->tape_mark) return read;
    in_.fail_unexpected("% is alone on its line");
    return in_.finish(std::move(block_));
  }

  Result<Block> around_statement() {
    auto read = around();
    if (!read) return read;
    Block whole = *std::move(read);
    const bool acts = !whole.words.empty() || !whole.assignments.empty();
    if (flow_.kind == FlowKind::only_if && !acts) {
      in_.fail("value-missing"_id, in_.column(), "THEN does nothing",
               "write a setting after it: THEN #1=2");
    } else if (flow_.kind != FlowKind::only_if && acts) {
      in_.fail("statement-not-alone"_id,
               whole.words.empty() ? whole.assignments.front().column : whole.words.front().column,
               "words beside a statement", "write two blocks");
    }
    if (in_.failed()) return in_.finish(std::move(block_));
    append_steps(whole);
    whole.flow = std::move(flow_);
    return whole;
  }

  Result<Block> around_output() {
    auto read = around();
    if (read) read->comments.insert(read->comments.begin(), comment_);
    return read;
  }

  // The statement's own expressions, after those of the rest.
  void append_steps(Block& whole) {
    const auto shift = static_cast<std::uint32_t>(whole.steps.size());
    const auto names = static_cast<double>(whole.names.size());
    for (ExpressionStep step : block_.steps) {
      if (step.operation == Operation::named_parameter || step.operation == Operation::exists) {
        step.number += names;
      }
      whole.steps.push_back(step);
    }
    whole.names.insert(whole.names.end(), block_.names.begin(), block_.names.end());
    for (ExpressionRange* range : {&flow_.condition, &flow_.label_value}) {
      if (!range->empty()) range->first += shift;
    }
  }

  // Digits without leading zeros; empty when there are none.
  std::string number() {
    const std::string_view digits = in_.digits();
    const std::size_t nonzero = digits.find_first_not_of('0');
    if (digits.empty() || nonzero != std::string_view::npos) {
      return std::string(digits.substr(std::min(nonzero, digits.size())));
    }
    return "0";
  }
  void read_expression(ExpressionRange& range) {
    ExpressionReader reader(in_, block_, rs274_expressions(Dialect::fanuc));
    range = reader.read(ExpressionLevel::operand);
  }

  std::string_view text_;
  LineScanner in_;
  std::size_t start_;
  Block block_{};
  FlowStatement flow_{};
  Comment comment_{};  // of an output statement
};

// Where a statement begins, after N and /; npos when the block has none.
std::size_t statement_start(std::string_view text) {
  std::size_t place = std::min(text.find_first_not_of(" \t\r/"), text.size());
  // The switch of /2.
  if (place > 0 && place < text.size() && text[place - 1] == '/' && text[place] >= '1' &&
      text[place] <= '9') {
    place = std::min(text.find_first_not_of(" \t\r", place + 1), text.size());
  }
  if (place < text.size() && (text[place] == 'N' || text[place] == 'n')) {
    place = std::min(text.find_first_not_of("0123456789 \t/", place + 1), text.size());
  }
  const auto begins_with = [&](std::string_view keyword) {
    if (text.size() - place < keyword.size()) return false;
    return std::equal(keyword.begin(), keyword.end(),
                      text.begin() + static_cast<std::ptrdiff_t>(place),
                      [](char wanted, char c) { return upper(c) == wanted; });
  };
  // I and a function, IFUP[..], is a word.
  const bool letter_behind =
      place + 2 < text.size() && std::isalpha(static_cast<unsigned char>(text[place + 2])) != 0;
  if (begins_with("IF") && !letter_behind) return place;
  if (begins_with(kShortWhile)) {
    const std::size_t behind = text.find_first_not_of(' ', place + kShortWhile.size());
    if (behind != std::string_view::npos && text[behind] == '[') return place;
  }
  for (const std::string_view keyword : {"WHILE", "GOTO", "END", "DO"}) {
    if (begins_with(keyword)) return place;
  }
  for (const OutputStatement& output : kOutputs) {
    if (begins_with(output.keyword)) return place;
  }
  return std::string_view::npos;
}

// Where a second block begins after the ; that ends the first: G0X1.;G1X2. A remark follows a
// blank: G0X1. ; X2.
std::size_t second_block(std::string_view text) {
  const std::size_t remark = std::min(text.find('('), text.size());
  for (std::size_t at = text.find(';'); at < remark; at = text.find(';', at + 1)) {
    const auto is = [&](std::size_t place, auto test) {
      return place < remark && test(static_cast<unsigned char>(text[place])) != 0;
    };
    const bool behind_word = at > 0 && !is(at - 1, [](int c) { return std::isspace(c); });
    const bool word = is(at + 1, [](int c) { return std::isalpha(c); }) &&
                      is(at + 2, [](int c) { return std::isdigit(c) || c == '-' || c == '.'; });
    if (behind_word && word) return at + 1;
  }
  return std::string_view::npos;
}

}  // namespace

Result<Block> read_fanuc_block(std::string_view text, std::uint32_t line) {
  if (const std::size_t second = second_block(text); second != std::string_view::npos) {
    Diagnostic twice =
        error("statement-not-alone"_id, "a second block after ;", "start a line for each block");
    twice.line = static_cast<int>(line);
    twice.column = static_cast<int>(second) + 1;
    return twice;
  }
  const std::size_t start = statement_start(text);
  if (start == std::string_view::npos) return parse_block(text, line, Dialect::fanuc);
  return MacroReader(text, line, start)();
}

}  // namespace frustum::parser
