#include "parser/reading/rs274/o_word_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "parser/dialects/o_words.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/comment_text.hpp"
#include "parser/reading/line_scanner.hpp"
#include "parser/reading/rs274/blank_free_text.hpp"
#include "parser/reading/rs274/grammar.hpp"
#include "parser/reading/rs274/rs274_values.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kKnown =
    "known are sub endsub call return if elseif else endif while endwhile do repeat endrepeat "
    "break "
    "continue";

class OWordReader {
 public:
  OWordReader(std::string_view text, std::uint32_t line) : in_(text, line) { block_.line = line; }

  // The statement, when the block begins with one.
  std::optional<Result<Block>> operator()() {
    if (in_.take('/')) block_.deletable = true;
    if (in_.take('N')) {
      block_.number = in_.block_number();
      in_.skip_decimals();
    }
    if (in_.take('/')) block_.deletable = true;
    flow_.column = in_.column();
    if (!in_.take('O')) return std::nullopt;
    if (!read_label()) return in_.finish(std::move(block_));
    const std::uint32_t keyword_column = in_.column();
    const std::string keyword = lower_case(in_.letters());
    // O100 alone begins a numbered program.
    if (keyword.empty() && only_digits_) return std::nullopt;
    // O<part> alone is the title of the program.
    if (keyword.empty() && flow_.label_value.empty() && at_comments()) {
      flow_.kind = FlowKind::program;
      read_comments();
      block_.flow = std::move(flow_);
      return in_.finish(std::move(block_));
    }
    const auto* known = std::ranges::find(kOWords, keyword, &OWord::name);
    if (known == kOWords.end()) {
      in_.fail("unknown-word"_id, keyword_column,
               keyword.empty() ? "the O word has no keyword" : "unknown O word " + keyword,
               std::string(kKnown));
      return in_.finish(std::move(block_));
    }
    flow_.kind = known->kind;
    flow_.turns = known->turns;
    read_values(*known);
    read_comments();
    block_.flow = std::move(flow_);
    return in_.finish(std::move(block_));
  }

 private:
  bool read_label() {
    const std::uint32_t start = in_.column();
    if (in_.take('<')) {
      flow_.label = bare_name(in_.bytes_to(">"));
      if (!in_.take('>'))
        in_.fail("text-not-closed"_id, start, "the name is not closed", "write o<name>");
      if (flow_.label.empty())
        in_.fail("name-missing"_id, start, "the O word has no name", "write o<name>");
      return !in_.failed();
    }
    if (const auto digits = in_.block_number()) {
      flow_.label = std::to_string(*digits);
      only_digits_ = true;
      return true;
    }
    if (in_.peek() == '[' || in_.peek() == '#') return read_expression(flow_.label_value);
    in_.fail("name-missing"_id, start, "O has no number or name", "write o100 or o<name>");
    return false;
  }

  void read_values(const OWord& keyword) {
    const bool given = in_.peek() == '[';
    if (keyword.needs == OWordNeeds::expression && !given) {
      in_.fail("value-missing"_id, in_.column(), fmt::format("{} has no expression", keyword.name),
               fmt::format("write it in brackets: {} [#1 LT 5]", keyword.name));
    } else if (keyword.needs == OWordNeeds::nothing && given) {
      in_.fail("argument-count"_id, in_.column(),
               fmt::format("{} takes no expression", keyword.name), "leave it out");
    } else if (keyword.needs == OWordNeeds::arguments) {
      while (!in_.failed() && (in_.peek() == '[' || in_.peek() == '(')) {
        if (in_.peek() == '(') {
          read_comment();
          continue;
        }
        flow_.arguments.emplace_back();
        read_expression(flow_.arguments.back());
      }
    } else if (given) {
      read_expression(flow_.condition);
    }
  }

  bool at_comments() { return in_.at_end() || in_.peek() == '(' || in_.peek() == ';'; }

  void read_comments() {
    while (!in_.at_end()) read_comment();
  }

  void read_comment() {
    const std::uint32_t start = in_.column();
    if (in_.take(';')) {
      block_.comments.push_back({start, true, utf8_of(in_.bytes_to()), nullptr});
    } else if (in_.take('(')) {
      block_.comments.push_back({start, false, utf8_of(in_.bytes_to(")")), nullptr});
      if (!in_.take(')'))
        in_.fail("comment-not-closed"_id, start, "the comment is not closed", "close it with )");
    } else {
      in_.fail("statement-not-alone"_id, start, "text after an O word",
               "an O word is alone in its block");
    }
  }

  bool read_expression(ExpressionRange& range) {
    ExpressionReader reader(in_, block_, rs274_expressions(Dialect::linuxcnc));
    range = reader.read(ExpressionLevel::operand);
    return !in_.failed();
  }

  LineScanner in_;
  Block block_{};
  FlowStatement flow_{};
  bool only_digits_ = false;
};

Result<Block> read_line(std::string_view text, std::uint32_t line) {
  if (text.find('o') != std::string_view::npos || text.find('O') != std::string_view::npos) {
    if (auto statement = OWordReader(text, line)()) return *std::move(statement);
  }
  return parse_block(text, line);
}

}  // namespace

Result<Block> read_linuxcnc_block(std::string_view text, std::uint32_t line) {
  auto block = read_line(text, line);
  if (block) return block;
  // Blanks within numbers and names: seldom, so that they are looked for last. What is wrong is
  // reported of the line as it is written.
  const BlankFreeText free = without_blanks(text);
  auto again = read_line(free.text, line);
  if (!again) return block;
  restore_columns(*again, free);
  return again;
}

}  // namespace frustum::parser
