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
    bare.lines.insert({ahead.block.place_of(word.column).line, 1, ahead.file});
    if (bare.count++ > 0) continue;
    bare.place = ahead.block.place_of(word.column);
    bare.place.file = ahead.file;
    bare.text = fmt::format("{}{:g}", word.letter, word.number);
  }
}

void DecimalPoints::told(const parser::Event& event, const parser::SourcePlace& place) {
  if (event.text.empty()) return;
  Bare& bare = told_[event.text.front()];
  if (bare.count++ == 0) {
    bare.place = place;
    bare.text = event.text;
  }
  bare.lines.insert(place);
}

void DecimalPoints::report(char letter, const Bare& bare, const std::string& what,
                           FindingList& findings) {
  findings.raise(Check::decimal_point, static_cast<FindingList::Key>(letter), bare.place, [&] {
    return Words{.message = what,
                 .hint =
                     "controls read it in mm or in 0.001 mm: write the point, or say which by "
                     "--decimal-point or [controller] decimal_point",
                 .alike = std::string(1, letter),
                 .places = bare.lines.size()};
  });
}

void DecimalPoints::finish(FindingList& findings) const {
  const auto finish = [&](const std::map<char, Bare>& words) {
    for (const auto& [letter, bare] : words) {
      // One finding a letter: what the interpreter says of it goes before.
      if (told_.contains(letter) || (&words == &bare_ && long_.contains(letter))) continue;
      std::string message = fmt::format("{} has no decimal point", bare.text);
      if (bare.count > 1) message += fmt::format(" (and {} more of {})", bare.count - 1, letter);
      report(letter, bare, message, findings);
    }
  };
  for (const auto& [letter, bare] : told_) {
    Bare all = bare;
    for (const auto* words : {&bare_, &long_}) {
      const auto same = words->find(letter);
      if (same != words->end() && same->second.lines.size() > all.lines.size()) {
        all.lines = same->second.lines;
      }
    }
    report(letter, all, bare.text, findings);
  }
  finish(long_);
  if (has_points_) finish(bare_);
}

}  // namespace frustum::lint
