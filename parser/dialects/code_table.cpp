#include "parser/dialects/code_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/decimal.hpp"
#include "parser/dialects/dialect_rules.hpp"
#include "parser/language/expression.hpp"

namespace frustum::parser {
namespace {

constexpr int kTenthsEnd = 10'000;
constexpr int kRowsOfADialect = 4096;

// All codes of one dialect in one row, G and M codes found directly by ten times their number.
class DialectCodes {
 public:
  explicit DialectCodes(Dialect dialect) {
    for (const std::span<const Code> part : rules_of(dialect).codes) {
      // The dialect's own words come before those it shares.
      for (const Code& code : part) {
        const bool there = std::any_of(codes_.begin(), codes_.end(), [&code](const Code& other) {
          return other.letter == code.letter && other.tenths == code.tenths &&
                 other.word == code.word;
        });
        if (!there) codes_.push_back(code);
      }
    }
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      const Code& code = codes_[i];
      if (code.letter == kNamedWord) {
        named_.emplace(code.word, i);
        continue;
      }
      index(code.letter).at(static_cast<std::size_t>(code.tenths)) =
          static_cast<std::uint16_t>(i + 1);
    }
  }

  [[nodiscard]] const std::vector<Code>& all() const { return codes_; }
  [[nodiscard]] const Code* find(char letter, int tenths) const {
    const std::uint16_t position = (letter == 'G' ? g_ : m_)[static_cast<std::size_t>(tenths)];
    return position == 0 ? nullptr : &codes_[position - 1U];
  }
  [[nodiscard]] const Code* find(std::string_view word) const {
    const auto found = named_.find(word);
    return found == named_.end() ? nullptr : &codes_[found->second];
  }

 private:
  using Index = std::array<std::uint16_t, kTenthsEnd>;  // 1 + row, 0 for none
  [[nodiscard]] Index& index(char letter) { return letter == 'G' ? g_ : m_; }

  std::vector<Code> codes_{};
  Index g_{};
  Index m_{};
  std::unordered_map<std::string_view, std::size_t> named_{};  // their rows
};

const DialectCodes& codes_of(Dialect dialect) {
  static const std::array kCodes{DialectCodes(Dialect::fanuc), DialectCodes(Dialect::linuxcnc),
                                 DialectCodes(Dialect::sinumerik),
                                 DialectCodes(Dialect::heidenhain), DialectCodes(Dialect::cldata)};
  static_assert(kCodes.size() == kDialects.size());
  return kCodes[static_cast<std::size_t>(dialect)];
}

// Ten times the number when that is whole (RS-274 forgives 1e-4), else -1.
int tenths_of(double number) {
  const double tenths = number * 10.0;
  const double nearest = std::round(tenths);
  if (std::abs(tenths - nearest) > 1e-3 || nearest < 0.0 || nearest >= kTenthsEnd) return -1;
  return static_cast<int>(nearest);
}

}  // namespace

std::string Code::name() const {
  if (letter == kNamedWord) return std::string(word);
  return letter + shortest_decimal(static_cast<double>(tenths) / 10.0);
}

const Code* find_code(Dialect dialect, char letter, double number) {
  const int tenths = tenths_of(number);
  return tenths < 0 ? nullptr : codes_of(dialect).find(letter, tenths);
}

const Code* find_code(Dialect dialect, std::string_view word) {
  return codes_of(dialect).find(word);
}

double row_of(const Code& code) {
  for (const Dialect dialect : kDialects) {
    const std::vector<Code>& all = codes_of(dialect).all();
    if (std::less<>()(&code, all.data()) || !std::less<>()(&code, all.data() + all.size()))
      continue;
    return static_cast<double>(static_cast<int>(dialect) * kRowsOfADialect + (&code - all.data()));
  }
  return 0.0;
}
const Code& code_at(double row) {
  const auto [dialect, index] = std::div(static_cast<int>(row), kRowsOfADialect);
  return codes_of(static_cast<Dialect>(dialect)).all().at(static_cast<std::size_t>(index));
}

std::string_view remedy_for(Dialect dialect, char letter, double number) {
  const int tenths = tenths_of(number);
  for (const RefusedCode& code : rules_of(dialect).refused_codes) {
    if (code.letter == letter && code.first_tenths <= tenths && tenths <= code.last_tenths)
      return code.remedy;
  }
  return {};
}

std::string_view remedy_for(Dialect dialect, std::string_view word) {
  for (const RefusedWord& refused : rules_of(dialect).refused_words) {
    if (refused.word == word) return refused.remedy;
  }
  return {};
}

std::string known_words(Dialect dialect) {
  std::string names;
  for (const Code& code : codes_of(dialect).all()) {
    if (code.letter != kNamedWord) continue;
    if (!names.empty()) names += ' ';
    names += code.name();
  }
  return names;
}

std::string codes_near(Dialect dialect, char letter, double number) {
  constexpr std::size_t kShown = 5;
  std::vector<const Code*> codes;
  for (const Code& code : codes_of(dialect).all()) {
    if (code.letter == letter) codes.push_back(&code);
  }
  const auto distance = [&](const Code* code) { return std::abs(code->tenths - 10.0 * number); };
  std::sort(codes.begin(), codes.end(), [&](const Code* a, const Code* b) {
    return std::pair(distance(a), a->tenths) < std::pair(distance(b), b->tenths);
  });
  codes.resize(std::min(codes.size(), kShown));
  std::sort(codes.begin(), codes.end(),
            [](const Code* a, const Code* b) { return a->tenths < b->tenths; });
  std::string names;
  for (const Code* code : codes) names += (names.empty() ? "" : " ") + code->name();
  return names;
}

}  // namespace frustum::parser
