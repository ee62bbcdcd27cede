#include "parser/reading/macro_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "parser/reading/grammar.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kBlanks = " \t\r";

// The words around a statement (N, /, comments, what THEN does) are read by the grammar of blocks, with
// the statement blanked out so that columns stay what they are.
class MacroReader {
 public:
  MacroReader(std::string_view text, std::uint32_t line, std::size_t start)
      : text_(text), place_(start), start_(start) {
    block_.line = line;
  }

  Result<Block> operator()() {
    flow_.column = column();
    const std::string keyword = letters();
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
    if (failure_) return *failure_;
    return around_statement();
  }

 private:
  void read_while() {
    flow_.kind = FlowKind::loop;
    read_condition("WHILE");
    if (failure_) return;
    const std::uint32_t at = column();
    if (letters() != "DO") return fail(at, "WHILE has no DO", "write WHILE [#1 LT 5] DO1");
    read_loop_number();
  }

  void read_if() {
    read_condition("IF");
    if (failure_) return;
    const std::uint32_t at = column();
    const std::string keyword = letters();
    if (keyword == "GOTO") return read_jump();
    if (keyword != "THEN") {
      return fail(at, "IF has neither GOTO nor THEN", "write IF [c] GOTO 100 or IF [c] THEN #1=2");
    }
    flow_.kind = FlowKind::only_if;
  }

  void read_jump() {
    flow_.kind = FlowKind::jump;
    flow_.search = Search::forward_then_backward;
    flow_.label = std::string(1, 'N');
    if (const std::string digits = number(); !digits.empty()) {
      flow_.label += digits;
    } else if (peek() == '#' || peek() == '[') {
      failure_ = append_expression(text_, place_, block_, flow_.label_value);
    } else {
      fail(column(), "GOTO has no block number", "write GOTO 100, or GOTO #1");
    }
  }

  void read_loop_number() {
    const std::uint32_t at = column();
    flow_.label = number();
    if (flow_.label != "1" && flow_.label != "2" && flow_.label != "3") {
      fail(at, "DO and END take a number from 1 to 3", "write DO1 and END1");
    }
  }

  void read_condition(std::string_view keyword) {
    if (peek() != '[') {
      return fail(column(), fmt::format("{} has no condition", keyword),
                  fmt::format("write it in brackets: {} [#1 LT 5]", keyword));
    }
    failure_ = append_expression(text_, place_, block_, flow_.condition);
  }

  Result<Block> around_statement() {
    std::string around(text_);
    std::fill(around.begin() + static_cast<std::ptrdiff_t>(start_),
              around.begin() + static_cast<std::ptrdiff_t>(place_), ' ');
    auto read = parse_block(around, block_.line);
    if (!read) return read;
    Block whole = *std::move(read);
    const bool acts = !whole.words.empty() || !whole.assignments.empty();
    if (flow_.kind == FlowKind::only_if && !acts) {
      fail(column(), "THEN does nothing", "write a setting behind it: THEN #1=2");
    } else if (flow_.kind != FlowKind::only_if && acts) {
      fail(whole.words.empty() ? whole.assignments.front().column : whole.words.front().column,
           "words beside a statement", "write two blocks");
    }
    if (failure_) return *failure_;
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

  std::string letters() {
    (void)peek();
    std::string run;
    while (place_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[place_])) != 0) {
      run += static_cast<char>(std::toupper(static_cast<unsigned char>(text_[place_++])));
    }
    return run;
  }
  // Digits without leading zeros; empty when there are none.
  std::string number() {
    (void)peek();
    const std::size_t start = place_;
    while (place_ < text_.size() && text_[place_] >= '0' && text_[place_] <= '9') ++place_;
    if (place_ == start) return {};
    const std::size_t nonzero = std::min(text_.find_first_not_of('0', start), place_ - 1);
    return std::string(text_.substr(nonzero, place_ - nonzero));
  }
  char peek() {
    place_ = std::min(text_.find_first_not_of(kBlanks, place_), text_.size());
    return place_ < text_.size() ? text_[place_] : '\0';
  }
  std::uint32_t column() {
    (void)peek();
    return static_cast<std::uint32_t>(place_) + 1;
  }
  void fail(std::uint32_t column, std::string message, std::string hint) {
    failure_ = error(std::move(message), std::move(hint));
    failure_->line = static_cast<int>(block_.line);
    failure_->column = static_cast<int>(column);
  }

  std::string_view text_;
  std::size_t place_;
  std::size_t start_;
  Block block_{};
  FlowStatement flow_{};
  std::optional<Diagnostic> failure_{};
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
