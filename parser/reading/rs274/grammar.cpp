#include "parser/reading/rs274/grammar.hpp"

#include <fmt/format.h>

#include <boost/spirit/home/x3.hpp>
#include <cctype>
#include <functional>
#include <utility>

#include "parser/language/letter_case.hpp"
#include "parser/reading/comment_text.hpp"
#include "parser/reading/line_scanner.hpp"
#include "parser/reading/rs274/rs274_values.hpp"
#include "parser/reading/syntax_error.hpp"

namespace frustum::parser {
namespace {

namespace x3 = boost::spirit::x3;
using Iterator = const char*;

// Room for the words of most blocks, so that they are allocated once.
constexpr std::size_t kUsualWords = 8;

// The polar words have no letter of their own.
char letter_of(char written) {
  if (written == '@') return kPolarRadius;
  if (written == '^') return kPolarAngle;
  return upper(written);
}

// Thrown by actions for what the shape of the text alone does not show; never leaves this file.
struct SyntaxStop {
  Diagnostic diagnostic;
};

// Collects the block while the grammar reads it. The grammar decides by the next character alone,
// so no action is ever undone.
class BlockBuilder {
 public:
  BlockBuilder(std::string_view text, std::uint32_t line, Dialect dialect)
      : text_(text), in_(text, line), dialect_(dialect) {
    block_.line = line;
  }

  [[nodiscard]] bool is_macro() const { return dialect_ == Dialect::fanuc; }

  Block take() { return std::move(block_); }

  void set_tape_mark() { block_.tape_mark = true; }
  void set_deletable() { block_.deletable = true; }
  void set_delete_switch(char digit) {
    block_.delete_switch = static_cast<std::uint8_t>(digit - '0');
  }
  void begin_program(Iterator after) { opening_word_column_ = column_of(after - 1); }

  void begin_word(Iterator after) {
    const auto letter = letter_of(after[-1]);
    if (block_.words.empty()) block_.words.reserve(kUsualWords);
    block_.words.push_back({letter, false, column_of(after - 1), 0.0, {}});
    if (letter == kPolarRadius || letter == kPolarAngle) {
      block_.words.back().spelled = letter == kPolarRadius ? "@" : "^";
    }
    in_word_ = true;
  }
  // The parts that the scanner reads begin here; where they end, or null when there is nothing.
  Iterator read_block_number(Iterator begin) {
    in_.go_to(column_of(begin));
    block_.number = in_.block_number();
    if (dialect_ == Dialect::linuxcnc) in_.skip_decimals();
    if (!block_.number && is_macro() && std::isalpha(static_cast<unsigned char>(in_.peek())) != 0) {
      block_.comments.push_back(
          {column_of(begin) - 1, false, "without a number it is passed over", "N", false, true});
      return begin;
    }
    return block_.number ? end_of_reading() : nullptr;
  }
  Iterator read_program_number(Iterator begin) {
    in_.go_to(column_of(begin));
    if (in_.peek() < '0' || in_.peek() > '9') return nullptr;
    // The O is one byte or some blanks before its digits; its column was noted.
    if (block_.program) {
      in_.fail("word-twice"_id, opening_word_column_, "two O words in a block",
               "start a line for each");
    }
    block_.program = in_.block_number();
    block_.program_column = opening_word_column_;
    return end_of_reading();
  }
  // A colon that begins a block, without a number: the alignment character of ISO 6983. With one it
  // is the O of a program.
  Iterator read_mark(Iterator begin) {
    in_.go_to(column_of(begin));
    if (in_.peek() != ':') return nullptr;
    const std::uint32_t column = in_.column();
    in_.take(':');
    const char next = in_.peek();
    const bool goes_on = next == '\0' || next == '(' || next == ';' || next == '/' ||
                         std::isalpha(static_cast<unsigned char>(next)) != 0;
    if (!goes_on) return nullptr;
    block_.comments.push_back(
        {column, false, "without a number it is passed over", ":", false, true});
    return end_of_reading();
  }
  // A plain number, by far the most common value, needs no expression.
  Iterator read_word_value(Iterator begin) {
    Word& word = block_.words.back();
    in_.go_to(column_of(begin));
    const bool negative = in_.take('-');
    if (!negative) in_.take('+');
    if (const auto number = in_.number()) {
      // The sum turns -0 into 0, which is what X-0 means.
      word.number = (negative ? -number->value : number->value) + 0.0;
      word.decimal_point = number->decimal_point;
      return end_of_reading();
    }
    return read_expression(begin, ExpressionLevel::operand, word.expression);
  }
  void end_word() { in_word_ = false; }

  Iterator read_setting_value(Iterator begin) {
    return read_expression(begin, ExpressionLevel::disjunction, block_.assignments.back().value);
  }
  void begin_setting(Iterator after) {
    block_.assignments.push_back({column_of(after - 1), std::nullopt, {}, {}});
  }
  // What is after the #.
  Iterator read_setting_target(Iterator begin) {
    Assignment& setting = block_.assignments.back();
    ExpressionReader reader = reader_at(begin);
    setting.index.first = static_cast<std::uint32_t>(block_.steps.size());
    std::string name = read_parameter_index(reader, dialect_);
    setting.index.count = static_cast<std::uint32_t>(block_.steps.size()) - setting.index.first;
    if (!name.empty()) {
      setting.name = static_cast<std::uint32_t>(block_.names.size());
      block_.names.push_back(std::move(name));
    }
    return end_of_reading();
  }

  void begin_comment(Iterator after, bool to_line_end) {
    block_.comments.push_back({column_of(after - 1), to_line_end, {}});
    in_comment_ = true;
  }
  // Up to the bracket that closes the comment. In Custom Macro others may be within it, in pairs.
  Iterator read_comment_text(Iterator begin) {
    const std::string_view rest = text_.substr(offset_of(begin));
    std::size_t end = std::min(rest.find_first_of("()"), rest.size());
    if (is_macro()) {
      end = std::min(rest.find(')'), rest.size());
      int open = 1;
      for (std::size_t at = 0; at < rest.size() && open > 0; ++at) {
        if (rest[at] == '(') ++open;
        if (rest[at] == ')' && --open == 0) end = at;
      }
    }
    end_comment_text(rest.substr(0, end));
    return begin + end;
  }
  // %00214: the number of the program.
  Iterator read_tape_name(Iterator begin) {
    in_.go_to(column_of(begin));
    const std::string_view digits = in_.digits();
    if (digits.empty()) return nullptr;
    block_.comments.push_back({column_of(begin), false, std::string(digits), "%"});
    return end_of_reading();
  }
  // ,R and ,C: corners.
  Iterator begin_corner(Iterator begin) {
    in_.go_to(column_of(begin));
    const std::uint32_t column = in_.column() - 1;
    const bool rounds = in_.take('R');
    if (!rounds && !in_.take('C')) return nullptr;
    const char letter = rounds ? kCornerRadius : kCornerChamfer;
    block_.words.push_back({letter, false, column, 0.0, {}});
    block_.words.back().spelled = rounds ? ",R" : ",C";
    in_word_ = true;
    return end_of_reading();
  }
  void end_comment_text(std::string_view text) { block_.comments.back().text = utf8_of(text); }
  void end_comment() { in_comment_ = false; }

  [[nodiscard]] Diagnostic failure(Iterator where, const std::string& expected) const {
    SyntaxFailure failure;
    failure.text = text_;
    failure.offset = std::min(text_.find_first_not_of(" \t\r", offset_of(where)), text_.size());
    failure.expected = expected;
    if (expected == "value" && !in_word_) {
      failure.expected = "setting value";
    } else if (expected == "value" && block_.program) {
      failure.expected = "flow control";
    }
    if (in_word_) {
      failure.word_letter = block_.words.back().letter;
      failure.word_column = block_.words.back().column;
    } else if (!block_.assignments.empty()) {
      failure.word_column = block_.assignments.back().column;
    }
    if (in_comment_) failure.opening_column = block_.comments.back().column;
    return describe(failure);
  }

 private:
  [[nodiscard]] std::size_t offset_of(Iterator where) const {
    return static_cast<std::size_t>(where - text_.data());
  }
  [[nodiscard]] std::uint32_t column_of(Iterator where) const {
    return static_cast<std::uint32_t>(offset_of(where)) + 1;
  }
  [[nodiscard]] ExpressionReader reader_at(Iterator begin) {
    in_.go_to(column_of(begin));
    return {in_, block_, rs274_expressions(dialect_)};
  }
  [[nodiscard]] Iterator read_expression(Iterator begin, ExpressionLevel level,
                                         ExpressionRange& range) {
    ExpressionReader reader = reader_at(begin);
    range = reader.read(level);
    return reader.found_nothing() ? nullptr : end_of_reading();
  }
  [[nodiscard]] Iterator end_of_reading() {
    if (in_.failed()) throw SyntaxStop{in_.failure()};
    return text_.data() + (in_.column() - 1);
  }
  std::string_view text_;
  LineScanner in_;
  Dialect dialect_;
  Block block_{};
  std::uint32_t opening_word_column_ = 0;
  bool in_word_ = false;
  bool in_comment_ = false;
};

struct BuilderTag;

// An action that calls `act(builder, token)`: the token is the text that raw[] matched.
template <typename Act>
constexpr auto token(Act act) {
  return [act](const auto& context) {
    const auto& range = x3::_attr(context);
    act(x3::get<BuilderTag>(context).get(),
        std::string_view(range.begin(), static_cast<std::size_t>(range.end() - range.begin())));
  };
}
// An action that calls `act(builder, position after the match)`.
template <typename Act>
constexpr auto after(Act act) {
  return [act](const auto& context) {
    act(x3::get<BuilderTag>(context).get(), x3::_where(context).begin());
  };
}
// An action that calls `act(builder)`.
template <typename Act>
constexpr auto then(Act act) {
  return [act](const auto& context) { act(x3::get<BuilderTag>(context).get()); };
}
// What Custom Macro alone has; what follows is not looked at in LinuxCNC.
const auto kInMacro = x3::eps[([](const auto& context) {
  x3::_pass(context) = x3::get<BuilderTag>(context).get().is_macro();
})];

// A part of the block that a member of the builder reads.
struct PartReader : x3::parser<PartReader> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  using Read = Iterator (BlockBuilder::*)(Iterator begin);

  explicit constexpr PartReader(Read read) : read_(read) {}

  template <typename Context, typename RuleContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& /*last*/, const Context& context,
             const RuleContext& /*rule*/, Attribute& /*attribute*/) const {
    const Iterator end = (x3::get<BuilderTag>(context).get().*read_)(first);
    if (end != nullptr) first = end;
    return end != nullptr;
  }

 private:
  Read read_;
};

const auto kBlank = x3::char_(" \t\r");

// The names are what syntax_error.cpp words the failures by.
const x3::rule<struct WordValueRule> word_value = "value";
const x3::rule<struct SettingValueRule> setting_value = "value";
const x3::rule<struct CornerLetterRule> corner_letter = "R or C";
const x3::rule<struct EqualsRule> equals = "equals";
const x3::rule<struct CommentEndRule> comment_end = "closing parenthesis";
const x3::rule<struct BlockNumberRule> block_number = "block number";
const x3::rule<struct ProgramNumberRule> program_number = "program number";
const x3::rule<struct BlockEndRule> block_end = "end of block";

const auto word_value_def = PartReader(&BlockBuilder::read_word_value);
const auto corner_letter_def = PartReader(&BlockBuilder::begin_corner);
const auto setting_value_def = PartReader(&BlockBuilder::read_setting_value);

const auto kWord =
    (x3::char_("a-mp-zA-MP-Z@^")[after([](BlockBuilder& b, Iterator end) { b.begin_word(end); })] >
     word_value)[then([](BlockBuilder& b) { b.end_word(); })];

const auto kCorner = (kInMacro >> x3::lit(',') > corner_letter >
                      word_value)[then([](BlockBuilder& b) { b.end_word(); })];

const auto equals_def = x3::lit('=');
const auto kSetting =
    x3::lit('#')[after([](BlockBuilder& b, Iterator end) { b.begin_setting(end); })] >
    PartReader(&BlockBuilder::read_setting_target) > equals > setting_value;

const auto kCommentText = token([](BlockBuilder& b, std::string_view t) { b.end_comment_text(t); });
const auto comment_end_def = x3::lit(')')[then([](BlockBuilder& b) { b.end_comment(); })];
const auto kComment =
    (x3::lit('(')[after([](BlockBuilder& b, Iterator end) { b.begin_comment(end, false); })] >
     x3::no_skip[PartReader(&BlockBuilder::read_comment_text)] > comment_end) |
    (x3::lit(';')[after([](BlockBuilder& b, Iterator end) { b.begin_comment(end, true); })] >
     x3::no_skip[x3::raw[*x3::char_][kCommentText]]);

const auto block_number_def = PartReader(&BlockBuilder::read_block_number);
const auto program_number_def = PartReader(&BlockBuilder::read_program_number);
const auto kProgram =
    (x3::no_case['o'] |
     (kInMacro >>
      x3::lit(':')))[after([](BlockBuilder& b, Iterator end) { b.begin_program(end); })] >
    program_number;
const auto kDelete =
    x3::lit('/')[then([](BlockBuilder& b) { b.set_deletable(); })] >>
    -(kInMacro >>
      x3::char_('1',
                '9')[after([](BlockBuilder& b, Iterator end) { b.set_delete_switch(end[-1]); })]);
const auto kTapeMark = x3::lit('%')[then([](BlockBuilder& b) { b.set_tape_mark(); })];
const auto block_end_def = x3::eoi;
const auto kBlock =
    ((kTapeMark >> -(kInMacro >> PartReader(&BlockBuilder::read_tape_name)) >> *kComment) |
     (-(kInMacro >> PartReader(&BlockBuilder::read_mark)) >> -kDelete >>
      -((x3::no_case['n'] > block_number) >> -kDelete) >>
      *(kWord | kComment | kSetting | kProgram | kCorner))) > block_end;

BOOST_SPIRIT_DEFINE(word_value, corner_letter, setting_value, equals, comment_end, block_number,
                    program_number, block_end)

Diagnostic on_line(Diagnostic diagnostic, std::uint32_t line) {
  diagnostic.line = static_cast<int>(line);
  return diagnostic;
}

}  // namespace

Result<Block> parse_block(std::string_view text, std::uint32_t line, Dialect dialect) {
  BlockBuilder builder(text, line, dialect);
  Iterator first = text.data();
  const Iterator last = first + text.size();
  try {
    x3::phrase_parse(first, last, x3::with<BuilderTag>(std::ref(builder))[kBlock], kBlank);
  } catch (const x3::expectation_failure<Iterator>& failure) {
    return on_line(builder.failure(failure.where(), failure.which()), line);
  } catch (const SyntaxStop& stop) {
    return on_line(stop.diagnostic, line);
  }
  return builder.take();
}

}  // namespace frustum::parser
