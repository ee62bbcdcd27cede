// The words of one block with their values computed and sorted by what they do.
//
// Units: as written.
// Errors: an expression that cannot be computed, an unknown or refused G or M word, a letter given
// twice, two words of one modal group; each with line and column.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "parser/control_settings.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/dialects/dialect_rules.hpp"
#include "parser/language/block.hpp"
#include "parser/language/parameters.hpp"

namespace frustum::parser {

struct GivenWord {
  double value = 0.0;
  std::uint32_t column = 0;
  bool decimal_point = false;
  Measure measure = Measure::modal;
  ValueSource source = ValueSource::number;
};

struct GivenCode {
  const Code* code = nullptr;  // in the code table, which lives for ever
  std::uint32_t column = 0;
};

// A G or M word of the machine's builder, which only he knows.
struct BuilderWord {
  ControlWord word{};
  std::uint32_t column = 0;
};

class BlockWords {
 public:
  // From now on the words of `block`, to which they refer, instead of those before. What is wrong,
  // else nothing. One object does for all blocks: what has no bit below is not looked at, and so
  // need not be cleared.
  [[nodiscard]] std::optional<Diagnostic> read(const Block& block, const Parameters& parameters,
                                               const DialectRules& rules,
                                               const ControlSettings& control, LengthUnit unit);
  [[nodiscard]] LetterSet given() const { return given_; }
  [[nodiscard]] bool has(char letter) const { return given_.has(letter); }
  // The word of that letter; zero when not given.
  [[nodiscard]] const GivenWord& operator[](char letter) const {
    return has(letter) ? values_[slot(letter)] : kNoWord;
  }
  [[nodiscard]] bool has(CodeGroup group) const { return (groups_ & bit_of(group)) != 0; }
  // The code of that group; null when not given.
  [[nodiscard]] const GivenCode& operator[](CodeGroup group) const {
    return has(group) ? codes_[static_cast<std::size_t>(group)] : kNoCode;
  }
  // What the group's word sets, or `otherwise` when the block has none of the group.
  template <typename Value>
  [[nodiscard]] Value value_or(CodeGroup group, Value otherwise) const {
    if (!has(group)) return otherwise;
    const Code* code = codes_[static_cast<std::size_t>(group)].code;
    return code->event ? otherwise : static_cast<Value>(code->value);
  }
  // The groups that the block has a code of, a bit each.
  [[nodiscard]] std::uint64_t groups() const { return groups_; }
  // Codes that are known but not simulated.
  [[nodiscard]] const std::vector<GivenCode>& events() const { return events_; }
  // The M words among `tenths` (ten times their numbers) leave the block, when there are any.
  [[nodiscard]] std::optional<BlockWords> set_aside(std::span<const int> tenths);
  // Words whose value is vacant: they count as not given.
  [[nodiscard]] const std::vector<GivenCode>& vacant() const { return vacant_; }
  // Words of the machine's builder, and the letters of the block that are theirs.
  [[nodiscard]] const std::vector<BuilderWord>& builder() const { return builder_; }
  // Letters whose values are numbers without a decimal point, and not zero.
  [[nodiscard]] LetterSet without_point() const { return without_point_; }
  // Letters whose values an expression gives.
  [[nodiscard]] LetterSet computed() const { return computed_; }
  void round(char letter, double steps_of_unit);
  // Those of the letters count in another unit.
  void rescale(LetterSet letters, double factor);
  // The first word of the block among `letters`, by column.
  [[nodiscard]] char first_of(LetterSet letters) const;
  // "X1.5", "A3=0.5": as the program spells the word and a message names it.
  [[nodiscard]] std::string text_of(char letter) const;
  // "X", "A3", "tool"
  [[nodiscard]] std::string name_of(char letter) const;

 private:
  static constexpr std::size_t slot(char letter) { return static_cast<std::size_t>(letter - 'A'); }
  static constexpr std::uint64_t bit_of(CodeGroup group) {
    return std::uint64_t{1} << static_cast<std::size_t>(group);
  }
  static constexpr GivenWord kNoWord{};
  static constexpr GivenCode kNoCode{};

  void clear();
  [[nodiscard]] std::optional<Diagnostic> add_value(const Word& word, double number,
                                                    const Parameters& parameters);
  [[nodiscard]] std::optional<Diagnostic> add_code(const Word& word, double number,
                                                   const DialectRules& rules,
                                                   const ControlSettings& control);

  const Block* block_ = nullptr;
  std::array<GivenWord, 'z' - 'A' + 1> values_{};
  LetterSet given_{};
  static_assert(kCodeGroups <= 64);
  std::array<GivenCode, kCodeGroups> codes_{};
  std::uint64_t groups_ = 0;
  std::vector<GivenCode> events_{};
  std::vector<GivenCode> vacant_{};
  std::vector<BuilderWord> builder_{};
  LetterSet without_point_{};
  LetterSet computed_{};
};

}  // namespace frustum::parser
