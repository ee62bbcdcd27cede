#include "parser/reading/rs274/grammar.hpp"

#include <fmt/format.h>

#include <boost/spirit/home/x3.hpp>
#include <cctype>
#include <charconv>
#include <functional>
#include <optional>

#include "parser/reading/comment_text.hpp"
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
  return static_cast<char>(std::toupper(static_cast<unsigned char>(written)));
}

// Thrown by actions for what the shape of the text alone cannot tell; never leaves this file.
struct SyntaxStop {
  Diagnostic diagnostic;
};

// Collects the block while the grammar reads it. The grammar decides by the next character alone,
// so no action is ever undone.
class BlockBuilder {
 public:
  BlockBuilder(std::string_view text, std::uint32_t line, Arithmetic arithmetic)
      : text_(text), macro_(arithmetic == Arithmetic::custom_macro) {
    block_.line = line;
  }
  // Goes on with a block.
  BlockBuilder(std::string_view text, Block&& block, Arithmetic arithmetic)
      : text_(text), block_(std::move(block)), macro_(arithmetic == Arithmetic::custom_macro) {}

  [[nodiscard]] bool is_macro() const { return macro_; }

  Block take() { return std::move(block_); }

  [[nodiscard]] std::uint32_t first_step() const {
    return static_cast<std::uint32_t>(block_.steps.size());
  }

  void set_tape_mark() { block_.tape_mark = true; }
  void set_deletable() { block_.deletable = true; }
  void set_delete_switch(char digit) {
    block_.delete_switch = static_cast<std::uint8_t>(digit - '0');
  }
  void set_number(std::string_view digits) { block_.number = whole(digits); }
  void set_program(std::string_view digits) {
    // The O stands one byte or some blanks before its digits; the column of the O was noted.
    if (block_.program)
      stop("word-twice"_id, opening_word_column_, "two O words in a block",
           "start a line for each");
    block_.program = whole(digits);
    block_.program_column = opening_word_column_;
  }
  void begin_program(Iterator after) { opening_word_column_ = column_of(after - 1); }

  void begin_word(Iterator after) {
    const auto letter = letter_of(after[-1]);
    if (block_.words.empty()) block_.words.reserve(kUsualWords);
    block_.words.push_back({letter, false, column_of(after - 1), 0.0, {first_step(), 0}});
    if (letter == kPolarRadius || letter == kPolarAngle) {
      block_.words.back().spelled = letter == kPolarRadius ? "@" : "^";
    }
    in_word_ = true;
  }
  void end_word() {
    ExpressionRange& expression = block_.words.back().expression;
    expression.count = first_step() - expression.first;
    in_word_ = false;
  }

  void begin_setting(Iterator after) {
    block_.assignments.push_back({column_of(after - 1), std::nullopt, {first_step(), 0}, {}});
  }
  void name_setting(std::string_view name) { block_.assignments.back().name = add_name(name); }
  void end_setting_index() {
    Assignment& setting = block_.assignments.back();
    setting.index.count = first_step() - setting.index.first;
    setting.value.first = first_step();
  }
  void end_setting() {
    Assignment& setting = block_.assignments.back();
    setting.value.count = first_step() - setting.value.first;
  }

  void begin_comment(Iterator after, bool to_line_end) {
    block_.comments.push_back({column_of(after - 1), to_line_end, {}});
    in_comment_ = true;
  }
  void end_comment_text(std::string_view text) { block_.comments.back().text = utf8_of(text); }
  void end_comment() { in_comment_ = false; }

  void push_number(std::string_view digits, double sign) {
    double value = 0.0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (read.ec == std::errc::result_out_of_range &&
        digits.find_first_of("123456789") < std::min(digits.find('.'), digits.size())) {
      stop("number-too-large"_id, column_of(digits.data()), "the number is too large",
           "numbers go up to 1.8e308");
    }
    // The sum turns -0 into 0, which is what X-0 means.
    value = sign * value + 0.0;
    if (in_word_ && openings_.empty()) {
      // A plain number, by far the most common value, needs no expression.
      block_.words.back().number = value;
      block_.words.back().decimal_point = digits.find('.') != std::string_view::npos;
    } else {
      push({Operation::number, column_of(digits.data()), value});
    }
  }
  void push_negation(Iterator after) { push({Operation::negate, column_of(after - 1), 0.0}); }

  // An operation whose operands follow: written down now, put after them by emit().
  void pend(Operation operation, Iterator begin) {
    pending_.push_back({operation, column_of(begin), 0.0});
  }
  void pend_function(Operation operation, Iterator after) {
    for (const std::span<const FunctionName> table : {function_names(), macro_function_names()}) {
      for (const FunctionName& function : table) {
        if (function.operation == operation) pend(operation, after - function.name.size());
      }
    }
  }
  // The second argument that ATAN[x] does without.
  void push_one(Iterator begin) { push({Operation::number, column_of(begin), 1.0}); }
  void emit() {
    push(pending_.back());
    pending_.pop_back();
  }
  void emit_named(std::string_view name) {
    pending_.back().operation = Operation::named_parameter;
    emit_existence(name);
  }
  void emit_existence(std::string_view name) {
    pending_.back().number = add_name(name);
    emit();
  }

  void open(Iterator after) {
    if (openings_.size() >= kMaxExpressionDepth) {
      stop("brackets-too-deep"_id, column_of(after - 1),
           fmt::format("more than {} brackets within each other", kMaxExpressionDepth),
           "compute a part of the expression into a parameter first");
    }
    openings_.push_back(column_of(after - 1));
  }
  void close() { openings_.pop_back(); }

  [[nodiscard]] Diagnostic failure(Iterator where, const std::string& expected) const {
    SyntaxFailure failure;
    failure.text = text_;
    failure.offset = std::min(text_.find_first_not_of(" \t\r", offset_of(where)), text_.size());
    failure.expected = expected;
    if (expected == "value" && !openings_.empty()) {
      failure.expected = "operand";
    } else if (expected == "value" && !in_word_) {
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
    if (in_comment_) {
      failure.opening_column = block_.comments.back().column;
    } else if (!openings_.empty()) {
      failure.opening_column = openings_.back();
    }
    return describe(failure);
  }

 private:
  [[noreturn]] static void stop(DiagnosticId id, std::uint32_t column, std::string message,
                                std::string hint) {
    Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
    diagnostic.column = static_cast<int>(column);
    throw SyntaxStop{std::move(diagnostic)};
  }
  [[nodiscard]] std::size_t offset_of(Iterator where) const {
    return static_cast<std::size_t>(where - text_.data());
  }
  [[nodiscard]] std::uint32_t column_of(Iterator where) const {
    return static_cast<std::uint32_t>(offset_of(where)) + 1;
  }
  void push(const ExpressionStep& step) { block_.steps.push_back(step); }

  // Names ignore case and blanks, as in RS-274.
  std::uint32_t add_name(std::string_view name) {
    std::string plain;
    for (const char c : name) {
      if (c != ' ' && c != '\t')
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    if (plain.empty())
      stop("name-missing"_id, column_of(name.data()), "the parameter has no name", "write #<name>");
    block_.names.push_back(std::move(plain));
    return static_cast<std::uint32_t>(block_.names.size() - 1);
  }
  [[nodiscard]] std::uint32_t whole(std::string_view digits) const {
    std::uint32_t value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (read.ec != std::errc{}) {
      stop("number-too-large"_id, column_of(digits.data()), "the number is too large",
           "N and O numbers have up to 8 digits");
    }
    return value;
  }

  std::string_view text_;
  Block block_;
  bool macro_ = false;
  std::vector<ExpressionStep> pending_;
  std::vector<std::uint32_t> openings_;  // columns of the open brackets and parameter signs
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
// An action that calls `act(builder, position behind the match)`.
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
constexpr auto pend(Operation operation, int length) {
  return after(
      [operation, length](BlockBuilder& b, Iterator end) { b.pend(operation, end - length); });
}
constexpr auto kEmit = then([](BlockBuilder& b) { b.emit(); });

// Alternatives of one arithmetic alone; what follows is not looked at in the other.
constexpr auto only_if(bool macro) {
  return x3::eps[([macro](const auto& context) {
    x3::_pass(context) = x3::get<BuilderTag>(context).get().is_macro() == macro;
  })];
}
const auto kInMacro = only_if(true);
const auto kInRs274 = only_if(false);

struct FunctionTable : x3::symbols<Operation> {
  explicit FunctionTable(std::span<const FunctionName> functions) {
    for (const FunctionName& function : functions) {
      if (function.operation == Operation::arc_tangent) continue;  // takes two brackets
      std::string lower;
      for (const char c : function.name) lower += static_cast<char>(std::tolower(c));
      add(lower, function.operation);
    }
  }
};
const FunctionTable kFunctionTable(function_names());
const FunctionTable kMacroFunctionTable(macro_function_names());

const auto kDigit = x3::char_('0', '9');
const auto kDigits = x3::raw[x3::lexeme[+kDigit]];
const auto kNumber = x3::raw[x3::lexeme[(+kDigit >> -('.' >> *kDigit)) | ('.' >> +kDigit)]];
const auto kBlank = x3::char_(" \t\r");

// The names are what syntax_error.cpp words the failures by.
const x3::rule<struct ValueRule> value = "value";
const x3::rule<struct PositiveRule> positive_value = "value";
const x3::rule<struct NegativeRule> negative_value = "value";
const x3::rule<struct LogicRule> logic = "value";
const x3::rule<struct RelationRule> relation = "value";
const x3::rule<struct SumRule> sum = "value";
const x3::rule<struct ProductRule> product = "value";
const x3::rule<struct PowerRule> power = "value";
const x3::rule<struct PrimaryRule> primary = "value";
const x3::rule<struct ParameterRule> parameter = "parameter";
const x3::rule<struct IndexRule> parameter_index = "parameter";
const x3::rule<struct NameBeginRule> name_begin = "parameter";
const x3::rule<struct NameEndRule> name_end = "parameter name";
const x3::rule<struct OpeningRule> opening = "opening bracket";
const x3::rule<struct ClosingRule> closing = "closing bracket";
const x3::rule<struct BracketedRule> bracketed = "opening bracket";
const x3::rule<struct SecondArgumentRule> second_argument = "closing bracket";
const x3::rule<struct CommaRule> comma = "comma";
const x3::rule<struct ArgumentSeparatorRule> argument_separator = "second argument";
const x3::rule<struct EqualsRule> equals = "equals";
const x3::rule<struct SettingTargetRule> setting_target = "parameter";
const x3::rule<struct CommentEndRule> comment_end = "closing parenthesis";
const x3::rule<struct BlockNumberRule> block_number = "block number";
const x3::rule<struct ProgramNumberRule> program_number = "program number";
const x3::rule<struct BlockEndRule> block_end = "end of block";

const auto opening_def = x3::lit('[')[after([](BlockBuilder& b, Iterator end) { b.open(end); })];
const auto closing_def = x3::lit(']')[then([](BlockBuilder& b) { b.close(); })];
const auto bracketed_def = opening > logic > closing;

const auto kPushNumber = token([](BlockBuilder& b, std::string_view t) { b.push_number(t, 1.0); });
const auto kPushNegative =
    token([](BlockBuilder& b, std::string_view t) { b.push_number(t, -1.0); });

const auto kName = x3::raw[*(x3::char_ - '>')];
const auto name_begin_def = x3::lit('#') >> '<';
const auto name_end_def = x3::lit('>');
// # pends the reading of a parameter; its name or its index completes it.
const auto parameter_index_def =
    ('<' > kName[token([](BlockBuilder& b, std::string_view name) { b.emit_named(name); })] >
     name_end) |
    (kDigits[kPushNumber] | bracketed | parameter)[kEmit];
const auto parameter_def = (x3::lit('#')[after([](BlockBuilder& b, Iterator end) {
                              b.open(end);
                              b.pend(Operation::parameter, end - 1);
                            })] > parameter_index)[then([](BlockBuilder& b) { b.close(); })];

const auto argument_separator_def = x3::lit('/');
const auto second_argument_def =
    (',' > logic > closing) |
    (closing >> ((kInMacro >> !x3::lit('/') >>
                  x3::eps[after([](BlockBuilder& b, Iterator end) { b.push_one(end); })]) |
                 (x3::eps > argument_separator > bracketed)));
const auto comma_def = x3::lit(',');
const auto kArcTangent = (x3::no_case["atan"][pend(Operation::arc_tangent, 4)] > opening > logic >
                          second_argument)[kEmit];
const auto kPendFunction = [](const auto& context) {
  x3::get<BuilderTag>(context).get().pend_function(x3::_attr(context), x3::_where(context).begin());
};
const auto kFunction =
    ((kInMacro >> x3::no_case[kMacroFunctionTable][kPendFunction]) > bracketed)[kEmit] |
    (x3::no_case[kFunctionTable][kPendFunction] > bracketed)[kEmit];
const auto kPower = ((kInMacro >> x3::no_case["pow"][pend(Operation::power, 3)]) > opening > logic >
                     comma > logic > closing)[kEmit];
const auto kExists =
    x3::no_case["exists"][pend(Operation::exists, 6)] > opening > name_begin >
    kName[token([](BlockBuilder& b, std::string_view name) { b.emit_existence(name); })] >
    name_end > closing;
const auto primary_def = parameter | bracketed | kArcTangent | kExists | kPower | kFunction;

const auto negative_value_def =
    kNumber[kPushNegative] |
    primary[after([](BlockBuilder& b, Iterator end) { b.push_negation(end); })];
const auto positive_value_def = kNumber[kPushNumber] | primary;
const auto value_def =
    kNumber[kPushNumber] | ('-' > negative_value) | ('+' > positive_value) | primary;
const auto power_def = value >> *((x3::lit("**")[pend(Operation::power, 2)] > value)[kEmit]);
const auto product_def =
    power >>
    *((((x3::lit('*')[pend(Operation::multiply, 1)]) | (x3::lit('/')[pend(Operation::divide, 1)]) |
        (kInRs274 >> x3::no_case["mod"][pend(Operation::modulo, 3)]) |
        (kInMacro >> x3::no_case["mod"][pend(Operation::remainder, 3)]) |
        (kInMacro >> x3::no_case["and"][pend(Operation::bit_and, 3)])) > power)[kEmit]);
const auto sum_def = product >> *(((x3::lit('+')[pend(Operation::add, 1)] |
                                    x3::lit('-')[pend(Operation::subtract, 1)] |
                                    (kInMacro >> x3::no_case["or"][pend(Operation::bit_or, 2)]) |
                                    (kInMacro >> x3::no_case["xor"][pend(Operation::bit_xor, 3)])) >
                                   product)[kEmit]);

// Operators of one level, spelled as words.
const auto kRelations = (x3::no_case["eq"][pend(Operation::equal, 2)]) |
                        (x3::no_case["ne"][pend(Operation::not_equal, 2)]) |
                        (x3::no_case["gt"][pend(Operation::greater, 2)]) |
                        (x3::no_case["ge"][pend(Operation::greater_or_equal, 2)]) |
                        (x3::no_case["lt"][pend(Operation::less, 2)]) |
                        (x3::no_case["le"][pend(Operation::less_or_equal, 2)]);
const auto kLogic = (x3::no_case["and"][pend(Operation::logical_and, 3)]) |
                    (x3::no_case["or"][pend(Operation::logical_or, 2)]) |
                    (x3::no_case["xor"][pend(Operation::logical_xor, 3)]);
const auto relation_def = sum >> -(((kRelations > sum)[kEmit]) >>
                                   *(((kInRs274 >> kRelations) > sum)[kEmit]));
const auto logic_def = relation >> *((kLogic > relation)[kEmit]);

const auto kWord =
    (x3::char_("a-mp-zA-MP-Z@^")[after([](BlockBuilder& b, Iterator end) { b.begin_word(end); })] >
     value)[then([](BlockBuilder& b) { b.end_word(); })];

const auto setting_target_def =
    ('<' > kName[token([](BlockBuilder& b, std::string_view name) { b.name_setting(name); })] >
     name_end) |
    kDigits[kPushNumber] | bracketed | parameter;
const auto equals_def = x3::lit('=')[then([](BlockBuilder& b) { b.end_setting_index(); })];
const auto kSetting =
    (x3::lit('#')[after([](BlockBuilder& b, Iterator end) { b.begin_setting(end); })] >
     setting_target > equals > logic)[then([](BlockBuilder& b) { b.end_setting(); })];

const auto kCommentText = token([](BlockBuilder& b, std::string_view t) { b.end_comment_text(t); });
const auto comment_end_def = x3::lit(')')[then([](BlockBuilder& b) { b.end_comment(); })];
const auto kComment =
    (x3::lit('(')[after([](BlockBuilder& b, Iterator end) { b.begin_comment(end, false); })] >
     x3::no_skip[x3::raw[*~x3::char_("()")][kCommentText]] > comment_end) |
    (x3::lit(';')[after([](BlockBuilder& b, Iterator end) { b.begin_comment(end, true); })] >
     x3::no_skip[x3::raw[*x3::char_][kCommentText]]);

const auto block_number_def =
    kDigits[token([](BlockBuilder& b, std::string_view digits) { b.set_number(digits); })];
const auto program_number_def =
    kDigits[token([](BlockBuilder& b, std::string_view digits) { b.set_program(digits); })];
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
    ((kTapeMark >> *kComment) | (-kDelete >> -((x3::no_case['n'] > block_number) >> -kDelete) >>
                                 *(kWord | kComment | kSetting | kProgram))) > block_end;

BOOST_SPIRIT_DEFINE(value, positive_value, negative_value, logic, relation, sum, product, power,
                    primary, parameter, parameter_index, name_begin, name_end, opening, closing,
                    bracketed, second_argument, argument_separator, equals, setting_target, comma,
                    comment_end, block_number, program_number, block_end)

Diagnostic on_line(Diagnostic diagnostic, std::uint32_t line) {
  diagnostic.line = static_cast<int>(line);
  return diagnostic;
}

}  // namespace

Result<Block> parse_block(std::string_view text, std::uint32_t line, Arithmetic arithmetic) {
  BlockBuilder builder(text, line, arithmetic);
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

void append_rs274_expression(LineScanner& in, Block& block, ExpressionRange& range,
                             Arithmetic arithmetic) {
  const std::string_view text = in.text();
  BlockBuilder builder(text, std::move(block), arithmetic);
  Iterator first = text.data() + (in.column() - 1);
  const Iterator last = text.data() + text.size();
  try {
    range.first = builder.first_step();
    x3::phrase_parse(first, last, x3::with<BuilderTag>(std::ref(builder))[x3::eps > value], kBlank);
    range.count = builder.first_step() - range.first;
  } catch (const x3::expectation_failure<Iterator>& stopped) {
    in.fail(builder.failure(stopped.where(), stopped.which()));
  } catch (const SyntaxStop& stopped) {
    in.fail(stopped.diagnostic);
  }
  in.go_to(static_cast<std::uint32_t>(first - text.data()) + 1);
  block = builder.take();
}

}  // namespace frustum::parser
