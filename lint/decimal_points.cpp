#include "lint/decimal_points.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace frustum::lint {
namespace {

constexpr std::string_view kLetters = "XYZABCUVWIJKR";
constexpr double kFiveDigits = 10'000.0;

// G10, G65 and such have numbers in these letters that are no lengths.
bool has_other_meaning(const parser::Block& block) {
  for (const parser::Word& word : block.words) {
    if (word.letter == 'G' && (word.number == 4.0 || word.number == 10.0 || word.number >= 65.0)) {
      return word.number < 68.0 || word.number >= 100.0;
    }
  }
  return false;
}

}  // namespace

void DecimalPoints::see(const parser::BlockAhead& ahead) {
  if (!looks_ || has_other_meaning(ahead.block)) return;
  for (const parser::Word& word : ahead.block.words) {
    if (kLetters.find(word.letter) == std::string_view::npos || !word.expression.empty()) continue;
    has_points_ = has_points_ || word.decimal_point;
    if (word.decimal_point || word.number == 0.0) continue;
    const bool is_long = std::abs(word.number) >= kFiveDigits;
    Bare& bare = (is_long ? long_ : bare_)[word.letter];
    if (bare.count++ > 0) continue;
    bare.place = ahead.block.place_of(word.column);
    bare.place.file = ahead.file;
    bare.text = fmt::format("{}{:g}", word.letter, word.number);
  }
}

void DecimalPoints::finish(FindingList& findings) const {
  const auto report = [&](const std::map<char, Bare>& words) {
    for (const auto& [letter, bare] : words) {
      findings.raise(Check::decimal_point, static_cast<FindingList::Key>(letter), bare.place, [&] {
        std::string message = fmt::format("{} has no decimal point", bare.text);
        if (bare.count > 1) message += fmt::format(" (and {} more of {})", bare.count - 1, letter);
        return Words{std::move(message),
                     "controls read it in mm or in 0.001 mm: write the point, or say which by "
                     "--decimal-point or [controller] decimal_point"};
      });
    }
  };
  report(long_);
  if (has_points_) report(bare_);
}

}  // namespace frustum::lint
