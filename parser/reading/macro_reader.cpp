#include "parser/reading/macro_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "parser/reading/grammar.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {
namespace {

// The words around a statement (N, /, comments, what THEN does) are read by the grammar of blocks, with
// the statement blanked out so that columns stay what they are.
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
    if (keyword == "WHILE") {
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
    if (in_.letters() != "DO") return in_.fail(at, "WHILE has no DO", "write WHILE [#1 LT 5] DO1");
    read_loop_number();
  }

  void read_if() {
    read_condition("IF");
    if (in_.failed()) return;
    const std::uint32_t at = in_.column();
    const std::string keyword = in_.letters();
    if (keyword == "GOTO") return read_jump();
    if (keyword != "THEN") {
      return in_.fail(at, "IF has neither GOTO nor THEN",
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
      in_.fail(in_.column(), "GOTO has no block number", "write GOTO 100, or GOTO #1");
    }
  }

  void read_loop_number() {
    const std::uint32_t at = in_.column();
    flow_.label = number();
    if (flow_.label != "1" && flow_.label != "2" && flow_.label != "3") {
      in_.fail(at, "DO and END take a number from 1 to 3", "write DO1 and END1");
    }
  }

  void read_condition(std::string_view keyword) {
    if (in_.peek() != '[') {
      return in_.fail(in_.column(), fmt::format("{} has no condition", keyword),
                      fmt::format("write it in brackets: {} [#1 LT 5]", keyword));
    }
    read_expression(flow_.condition);
  }

  Result<Block> around_statement() {
    std::string around(text_);
    std::fill(around.begin() + static_cast<std::ptrdiff_t>(start_),
              around.begin() + static_cast<std::ptrdiff_t>(in_.column() - 1), ' ');
    auto read = parse_block(around, block_.line);
    if (!read) return read;
    Block whole = *std::move(read);
    const bool acts = !whole.words.empty() || !whole.assignments.empty();
    if (flow_.kind == FlowKind::only_if && !acts) {
      in_.fail(in_.column(), "THEN does nothing", "write a setting behind it: THEN #1=2");
    } else if (flow_.kind != FlowKind::only_if && acts) {
      in_.fail(whole.words.empty() ? whole.assignments.front().column : whole.words.front().column,
               "words beside a statement", "write two blocks");
    }
    if (in_.failed()) return in_.finish(std::move(block_));
    append_steps(whole);
    whole.flow = std::move(flow_);
    return whole;
  }

  // The statement's own expressions, behind those of the rest.
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
  void read_expression(ExpressionRange& range) { append_rs274_expression(in_, block_, range); }

  std::string_view text_;
  LineScanner in_;
  std::size_t start_;
  Block block_{};
  FlowStatement flow_{};
};

// Where a statement begins, behind N and /; npos when the block has none.
std::size_t statement_start(std::string_view text) {
  std::size_t place = std::min(text.find_first_not_of(" \t\r/"), text.size());
  if (place < text.size() && (text[place] == 'N' || text[place] == 'n')) {
    place = std::min(text.find_first_not_of("0123456789 \t/", place + 1), text.size());
  }
  const auto begins_with = [&](std::string_view keyword) {
    if (text.size() - place < keyword.size()) return false;
    return std::equal(
        keyword.begin(), keyword.end(), text.begin() + static_cast<std::ptrdiff_t>(place),
        [](char wanted, char c) { return std::toupper(static_cast<unsigned char>(c)) == wanted; });
  };
  // I and a function, IFUP[..], is a word.
  const bool letter_behind =
      place + 2 < text.size() && std::isalpha(static_cast<unsigned char>(text[place + 2])) != 0;
  if (begins_with("IF") && !letter_behind) return place;
  for (const std::string_view keyword : {"WHILE", "GOTO", "END", "DO"}) {
    if (begins_with(keyword)) return place;
  }
  return std::string_view::npos;
}

}  // namespace

Result<Block> read_fanuc_block(std::string_view text, std::uint32_t line) {
  const std::size_t start = statement_start(text);
  if (start == std::string_view::npos) return parse_block(text, line);
  return MacroReader(text, line, start)();
}

}  // namespace frustum::parser
