#include "parser/interpret/state/block_words.hpp"
#include "core/decimal.hpp"
#include "parser/interpret/state/least_increment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::parser {
namespace {

constexpr double kLargestValue = 1e15;

Diagnostic at(const Block& block, std::uint32_t column, DiagnosticId id, std::string message,
              std::string hint) {
  const SourcePlace place = block.place_of(column);
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.line = static_cast<int>(place.line);
  diagnostic.column = static_cast<int>(place.column);
  return diagnostic;
}

Diagnostic unknown_code(const Block& block, Dialect dialect, const Word& word, double number) {
  const std::string name = word.letter + shortest_decimal(number);
  const std::string_view remedy = remedy_for(dialect, word.letter, number);
  if (!remedy.empty()) {
    return at(block, word.column, "not-simulated"_id, name + " is not simulated",
              std::string(remedy));
  }
  return at(block, word.column, "unknown-word"_id, "unknown word " + name,
            "near it are " + codes_near(dialect, word.letter, number));
}

// A word whose meaning may depend on I and L in its block.
const Code* code_of(const Block& block, const DialectRules& rules, char letter, double number) {
  const auto beside =
      std::find_if(rules.codes_beside_l.begin(), rules.codes_beside_l.end(), [&](const Code& code) {
        return code.letter == letter && std::abs(number * 10.0 - code.tenths) < 1e-3;
      });
  if (beside != rules.codes_beside_l.end()) {
    const auto has = [&](char wanted) {
      return std::any_of(block.words.begin(), block.words.end(),
                         [wanted](const Word& word) { return word.letter == wanted; });
    };
    if (has('I') && has('L')) return &*beside;
  }
  return find_code(rules.dialect, letter, number);
}

// A word that only the builder of the machine knows.
std::optional<ControlWord> word_of_builder(const DialectRules& rules,
                                           const ControlSettings& control, char letter,
                                           double number) {
  constexpr double kLargestNumber = 99'999.0;
  if (!(number >= 0.0 && number <= kLargestNumber)) return std::nullopt;
  const ControlWord word{letter, static_cast<int>(std::lround(number * 10.0))};
  if (std::abs(number * 10.0 - word.tenths) > 1e-3) return std::nullopt;
  const bool unknown_m = rules.unknown_m_words_are_builders && letter == 'M' &&
                         remedy_for(rules.dialect, letter, number).empty();
  return unknown_m || control.has(word) ? std::optional(word) : std::nullopt;
}

}  // namespace

char BlockWords::first_of(LetterSet letters) const {
  char first = 0;
  std::uint32_t first_column = std::numeric_limits<std::uint32_t>::max();
  for (LetterSet wanted = letters & given_; !wanted.empty(); wanted = wanted.without_first()) {
    const char letter = wanted.first();
    if ((*this)[letter].column >= first_column) continue;
    first = letter;
    first_column = (*this)[letter].column;
  }
  return first;
}

namespace {

std::string spelling_in(const Block& block, char letter) {
  for (const Word& word : block.words) {
    if (word.letter == letter && word.spelled != nullptr) return word.spelled;
  }
  return std::string(1, letter);
}

}  // namespace

std::string BlockWords::name_of(char letter) const {
  std::string name = spelling_in(*block_, letter);
  while (name.size() > 1 && std::string_view(" =/").find(name.back()) != std::string_view::npos) {
    name.pop_back();
  }
  return name;
}

std::string BlockWords::text_of(char letter) const {
  return spelling_in(*block_, letter) + shortest_decimal((*this)[letter].value);
}

std::optional<BlockWords> BlockWords::set_aside(std::span<const int> tenths) {
  const auto is_meant = [tenths](const GivenCode& given) {
    return given.code != nullptr && given.code->letter == 'M' &&
           std::find(tenths.begin(), tenths.end(), given.code->tenths) != tenths.end();
  };
  std::optional<BlockWords> aside;
  const auto others = [&]() -> BlockWords& {
    if (!aside) aside.emplace().block_ = block_;
    return *aside;
  };
  for (const CodeGroup group : {CodeGroup::spindle, CodeGroup::coolant, CodeGroup::feed_mode,
                                CodeGroup::tool_tip, CodeGroup::rotary_path}) {
    const auto slot = static_cast<std::size_t>(group);
    if (!has(group) || !is_meant(codes_[slot])) continue;
    others().codes_[slot] = codes_[slot];
    groups_ &= ~bit_of(group);
    others().groups_ |= bit_of(group);
  }
  for (auto event = events_.begin(); event != events_.end();) {
    if (!is_meant(*event)) {
      ++event;
      continue;
    }
    others().events_.push_back(*event);
    event = events_.erase(event);
  }
  return aside;
}

void BlockWords::round(char letter, double steps_of_unit) {
  double& value = values_[slot(letter)].value;
  value = std::round(value * steps_of_unit) / steps_of_unit;
}

void BlockWords::rescale(LetterSet letters, double factor) {
  for (LetterSet left = letters & given_; !left.empty(); left = left.without_first()) {
    values_[slot(left.first())].value *= factor;
  }
}

namespace {

// X="LEFT", X=$AA_IM[X]
Diagnostic symbol_in_word(const Block& block, const Parameters& parameters, const Word& word,
                          double value, const std::string& name) {
  if (is_text(value)) {
    return at(
        block, word.column, "wrong-type"_id,
        fmt::format("{} has the text \"{}\" instead of a number", name, parameters.text_of(value)),
        "texts are for T and for calls");
  }
  return at(block, word.column, "unknown-value"_id,
            fmt::format("{} depends on {}, which only the machine knows", name,
                        parameters.text_of(value)),
            "give a number");
}

// M7, which is an event only, and M8: two coolants that run at once.
bool mist_and_flood(const Code& one, const Code& other) {
  if (one.group != CodeGroup::coolant || other.group != CodeGroup::coolant) return false;
  const Code& flood = one.event ? other : one;
  return one.event != other.event && static_cast<CoolantWord>(flood.value) == CoolantWord::flood;
}

}  // namespace

void BlockWords::clear() {
  given_ = {};
  without_point_ = {};
  computed_ = {};
  groups_ = 0;
  events_.clear();
  vacant_.clear();
  builder_.clear();
}

std::optional<Diagnostic> BlockWords::read(const Block& block, const Parameters& parameters,
                                           const DialectRules& rules,
                                           const ControlSettings& control, LengthUnit unit) {
  clear();
  block_ = &block;
  for (const Word& word : block.words) {
    double number = word.number;
    if (!word.expression.empty()) {
      auto computed = evaluate(
          {block.steps, block.names, parameters, steps_of_unit(rules.dialect, word.letter, unit)},
          word.expression);
      if (!computed) {
        const Diagnostic& failure = computed.error().front();
        return at(block, static_cast<std::uint32_t>(failure.column), failure.id, failure.message,
                  failure.hint);
      }
      number = *computed;
      const bool needed = word.letter != 'F' && word.letter != 'S';
      if (is_vacant(number) && needed && parameters.rules().values_may_be_unknown) {
        return at(
            block, word.column, "unknown-parameter"_id,
            fmt::format("the value of {} is one that only the machine knows", word.letter),
            "set it in the program: values of pins (_hal), of the configuration (_ini), of "
            "tools that are in no table and of places before the first move are the machine's");
      }
      if (is_vacant(number)) {
        vacant_.push_back({nullptr, word.column});
        continue;
      }
    }
    const bool is_code = word.letter == 'G' || word.letter == 'M' || word.letter == kNamedWord;
    auto failure =
        is_code ? add_code(word, number, rules, control) : add_value(word, number, parameters);
    if (failure) return failure;
  }
  return std::nullopt;
}

std::optional<Diagnostic> BlockWords::add_value(const Word& word, double number,
                                                const Parameters& parameters) {
  if (has(word.letter)) {
    return at(*block_, word.column, "word-twice"_id,
              fmt::format("{} is given twice in a block", name_of(word.letter)),
              "leave one of them out, or write two blocks");
  }
  if (is_symbol(number) && (word.letter != 'T' || is_unknown(number))) {
    return symbol_in_word(*block_, parameters, word, number, name_of(word.letter));
  }
  // Beyond this sums and squares of positions would leave the range of numbers.
  if (!(std::abs(number) <= kLargestValue) && !is_symbol(number)) {
    return at(*block_, word.column, "out-of-range"_id, name_of(word.letter) + " is too large",
              "the values of words go up to 1e15");
  }
  given_.add(word.letter);
  const bool plain = !word.decimal_point && number != 0.0 && word.expression.empty();
  if (plain) without_point_.add(word.letter);
  if (!word.expression.empty()) computed_.add(word.letter);
  values_[slot(word.letter)] = {number, word.column, word.decimal_point, word.measure, word.source};
  return std::nullopt;
}

std::optional<Diagnostic> BlockWords::add_code(const Word& word, double number,
                                               const DialectRules& rules,
                                               const ControlSettings& control) {
  const bool named = word.letter == kNamedWord;
  const Code* code = named ? &code_at(number) : code_of(*block_, rules, word.letter, number);
  if (code == nullptr) {
    const auto of_builder =
        named ? std::nullopt : word_of_builder(rules, control, word.letter, number);
    if (!of_builder) return unknown_code(*block_, rules.dialect, word, number);
    builder_.push_back({*of_builder, word.column});
    return std::nullopt;
  }
  if (code->event) events_.push_back({code, word.column});
  if (code->group == CodeGroup::event) return std::nullopt;
  GivenCode& place = codes_[static_cast<std::size_t>(code->group)];
  if (has(code->group) && rules.mist_beside_flood && mist_and_flood(*place.code, *code)) {
    if (place.code->event) place = {code, word.column};
    return std::nullopt;
  }
  const bool replaces = rules.last_motion_counts && code->group == CodeGroup::motion;
  if (has(code->group) && !replaces) {
    return at(*block_, word.column, "word-twice"_id,
              place.code == code ? fmt::format("{} is given twice in a block", code->name())
                                 : fmt::format("{} and {} contradict each other in a block",
                                               place.code->name(), code->name()),
              "leave one of them out, or write two blocks");
  }
  place = {code, word.column};
  groups_ |= bit_of(code->group);
  return std::nullopt;
}

}  // namespace frustum::parser
