#include "parser/reading/o_word_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "parser/reading/comment_text.hpp"
#include "parser/reading/grammar.hpp"

namespace frustum::parser {
namespace {

constexpr std::string_view kBlanks = " \t\r";

// What follows a keyword.
enum class Needs : std::uint8_t { nothing, expression, perhaps_expression, arguments };

struct Keyword {
  std::string_view name;
  FlowKind kind;
  Needs needs;
  Turns turns = Turns::while_true;
};
constexpr std::array kKeywords{
    Keyword{"sub", FlowKind::subprogram, Needs::nothing},
    Keyword{"endsub", FlowKind::end_sub, Needs::perhaps_expression},
    Keyword{"return", FlowKind::give_back, Needs::perhaps_expression},
    Keyword{"call", FlowKind::call, Needs::arguments},
    Keyword{"if", FlowKind::branch, Needs::expression},
    Keyword{"elseif", FlowKind::else_branch, Needs::expression},
    Keyword{"else", FlowKind::otherwise, Needs::nothing},
    Keyword{"endif", FlowKind::end_branch, Needs::nothing},
    Keyword{"while", FlowKind::loop, Needs::expression},
    Keyword{"endwhile", FlowKind::end_loop, Needs::nothing},
    Keyword{"do", FlowKind::loop, Needs::nothing, Turns::until_end},
    Keyword{"repeat", FlowKind::loop, Needs::expression, Turns::counted},
    Keyword{"endrepeat", FlowKind::end_loop, Needs::nothing},
    Keyword{"break", FlowKind::leave_loop, Needs::nothing},
    Keyword{"continue", FlowKind::next_turn, Needs::nothing},
};
constexpr std::string_view kKnown =
    "known are sub endsub call return if elseif else endif while endwhile do repeat endrepeat "
    "break "
    "continue";

class OWordReader {
 public:
  OWordReader(std::string_view text, std::uint32_t line) : text_(text) { block_.line = line; }

  // The statement, when the block begins with one.
  std::optional<Result<Block>> operator()() {
    if (take('/')) block_.deletable = true;
    if (peek() == 'n') {
      ++place_;
      block_.number = number();
    }
    if (take('/')) block_.deletable = true;
    if (peek() != 'o') return std::nullopt;
    flow_.column = column();
    ++place_;
    if (!read_label()) return finish();
    const std::uint32_t keyword_column = column();
    const std::string keyword = letters();
    // O100 alone begins a numbered program.
    if (keyword.empty() && only_digits_) return std::nullopt;
    const auto* known = std::find_if(kKeywords.begin(), kKeywords.end(),
                                     [&](const Keyword& k) { return k.name == keyword; });
    if (known == kKeywords.end()) {
      fail(keyword_column,
           keyword.empty() ? "the O word has no keyword" : "unknown O word " + keyword,
           std::string(kKnown));
      return finish();
    }
    flow_.kind = known->kind;
    flow_.turns = known->turns;
    read_values(*known);
    read_comments();
    block_.flow = std::move(flow_);
    return finish();
  }

 private:
  bool read_label() {
    const std::uint32_t start = column();
    if (take('<')) {
      const std::size_t end = text_.find('>', place_);
      if (end == std::string_view::npos) {
        fail(start, "the name is not closed", "write o<name>");
        return false;
      }
      for (const char c : text_.substr(place_, end - place_)) {
        if (kBlanks.find(c) == std::string_view::npos) flow_.label += lower(c);
      }
      place_ = end + 1;
      if (flow_.label.empty()) fail(start, "the O word has no name", "write o<name>");
      return !failure_;
    }
    if (const auto digits = number()) {
      flow_.label = std::to_string(*digits);
      only_digits_ = true;
      return true;
    }
    if (peek() == '[' || peek() == '#') return read_expression(flow_.label_value);
    if (!failure_) fail(start, "O has no number or name", "write o100 or o<name>");
    return false;
  }

  void read_values(const Keyword& keyword) {
    const bool given = peek() == '[';
    if (keyword.needs == Needs::expression && !given) {
      fail(column(), fmt::format("{} has no expression", keyword.name),
           fmt::format("write it in brackets: {} [#1 LT 5]", keyword.name));
    } else if (keyword.needs == Needs::nothing && given) {
      fail(column(), fmt::format("{} takes no expression", keyword.name), "leave it out");
    } else if (keyword.needs == Needs::arguments) {
      while (!failure_ && peek() == '[') {
        flow_.arguments.emplace_back();
        read_expression(flow_.arguments.back());
      }
    } else if (given) {
      read_expression(flow_.condition);
    }
  }

  void read_comments() {
    while (!failure_ && peek() != 0) {
      const std::uint32_t start = column();
      if (take(';')) {
        block_.comments.push_back({start, true, utf8_of(text_.substr(place_)), nullptr});
        place_ = text_.size();
      } else if (take('(')) {
        const std::size_t end = text_.find(')', place_);
        if (end == std::string_view::npos) {
          return fail(start, "the comment is not closed", "close it with )");
        }
        block_.comments.push_back(
            {start, false, utf8_of(text_.substr(place_, end - place_)), nullptr});
        place_ = end + 1;
      } else {
        fail(start, "text behind an O word", "an O word stands alone in its block");
      }
    }
  }

  bool read_expression(ExpressionRange& range) {
    failure_ = append_expression(text_, place_, block_, range);
    return !failure_;
  }

  // Up to 8 digits.
  std::optional<std::uint32_t> number() {
    (void)peek();
    std::uint32_t value = 0;
    const std::size_t start = place_;
    while (place_ < text_.size() && text_[place_] >= '0' && text_[place_] <= '9') ++place_;
    if (place_ == start) return std::nullopt;
    const auto read = std::from_chars(text_.data() + start, text_.data() + place_, value);
    if (read.ec != std::errc{}) {
      fail(static_cast<std::uint32_t>(start) + 1, "the number is too large",
           "N and O numbers have up to 8 digits");
    }
    return value;
  }

  std::string letters() {
    (void)peek();
    std::string run;
    while (place_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[place_])) != 0) {
      run += lower(text_[place_++]);
    }
    return run;
  }

  // The next character that is not blank, in lower case; 0 at the end.
  char peek() {
    place_ = std::min(text_.find_first_not_of(kBlanks, place_), text_.size());
    return place_ < text_.size() ? lower(text_[place_]) : '\0';
  }
  bool take(char expected) {
    if (peek() != expected) return false;
    ++place_;
    return true;
  }
  static char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
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
  Result<Block> finish() {
    if (failure_) return *failure_;
    return std::move(block_);
  }

  std::string_view text_;
  std::size_t place_ = 0;
  Block block_{};
  FlowStatement flow_{};
  bool only_digits_ = false;
  std::optional<Diagnostic> failure_{};
};

}  // namespace

Result<Block> read_linuxcnc_block(std::string_view text, std::uint32_t line) {
  if (text.find('o') != std::string_view::npos || text.find('O') != std::string_view::npos) {
    if (auto statement = OWordReader(text, line)()) return *std::move(statement);
  }
  return parse_block(text, line);
}

}  // namespace frustum::parser
