#include "parser/not_milling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "parser/language/letter_case.hpp"
#include "parser/language/letter_set.hpp"

namespace frustum::parser {
namespace {

// Programs say early what they are for.
constexpr std::size_t kBytesLookedAt = 32 * 1024;

// A letter and its number, of a block without comments.
struct PlainWord {
  char letter = 0;
  std::string_view digits{};  // as written
  double number = 0.0;
  std::uint32_t column = 0;
};

struct PlainLine {
  std::vector<PlainWord> words{};
  LetterSet letters{};

  [[nodiscard]] const PlainWord* find(char letter, double number) const {
    const auto found = std::find_if(words.begin(), words.end(), [&](const PlainWord& word) {
      return word.letter == letter && word.number == number;
    });
    return found == words.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool has(std::string_view all) const {
    return std::all_of(all.begin(), all.end(), [this](char c) { return letters.has(c); });
  }
};

bool is_plain_letter(char c) { return c >= 'A' && c <= 'Z'; }
bool is_part_of_number(char c) { return (c >= '0' && c <= '9') || c == '.'; }

PlainLine plain_words(std::string_view line) {
  PlainLine read;
  int depth = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == ';' || c == '%' || c == '#' || c == '[') break;
    if (c == '(') ++depth;
    if (c == ')') depth = std::max(0, depth - 1);
    const char letter = upper(c);
    if (depth > 0 || !is_plain_letter(letter)) continue;
    std::size_t begin = i + 1;
    while (begin < line.size() && (line[begin] == ' ' || line[begin] == '+')) ++begin;
    std::size_t end = begin < line.size() && line[begin] == '-' ? begin + 1 : begin;
    while (end < line.size() && is_part_of_number(line[end])) ++end;
    PlainWord word{letter, line.substr(begin, end - begin), 0.0, static_cast<std::uint32_t>(i + 1)};
    const auto number =
        std::from_chars(word.digits.data(), word.digits.data() + word.digits.size(), word.number);
    if (number.ec != std::errc{}) continue;
    read.letters.add(letter);
    read.words.push_back(word);
    i = end - 1;
  }
  return read;
}

// T0101: the turret's place and the number of the offset.
bool is_turret_word(const PlainWord& word) {
  return word.letter == 'T' && word.digits.size() == 4 && word.digits.front() == '0' &&
         word.digits.find('.') == std::string_view::npos && word.digits.substr(2) != "00" &&
         word.digits.substr(0, 2) == word.digits.substr(2);
}

struct Suspicion {
  std::string machine{};
  std::string word{};
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

// What only that machine has.
std::optional<Suspicion> sure_sign(const PlainLine& line, std::uint32_t number) {
  const auto of = [&](const char* machine, const PlainWord& word, std::string name) {
    return Suspicion{machine, std::move(name), number, word.column};
  };
  constexpr const char* kLathe = "a lathe";
  if (const auto* limit = line.find('G', 50.0);
      limit != nullptr && line.has("S") && !line.letters.has('P') && !line.letters.has('Y')) {
    return of(kLathe, *limit, "G50 S");
  }
  for (const double cycle : {70.0, 71.0, 72.0, 73.0}) {
    const auto* word = line.find('G', cycle);
    if (word == nullptr || line.letters.has('Y')) continue;
    const bool contour = line.has("PQ") && !line.letters.has('X') && !line.letters.has('Z');
    const bool depth = cycle != 73.0 && line.has("R") && (line.has("U") || line.has("W")) &&
                       !line.letters.has('X') && !line.letters.has('Z');
    if (contour || depth) return of(kLathe, *word, fmt::format("G{:g}", cycle));
  }
  for (const double heat : {104.0, 109.0, 140.0, 190.0}) {
    const auto* word = line.find('M', heat);
    if (word != nullptr && line.has("S") && line.words.front().letter == 'M') {
      return of("a 3D printer", *word, fmt::format("M{:g} S", heat));
    }
  }
  return std::nullopt;
}

Diagnostic refused(const Program& program, const Suspicion& found) {
  Diagnostic diagnostic = error(
      "not-milling"_id, fmt::format("this is a program for {}: {}", found.machine, found.word),
      "only programs of milling machines are simulated");
  diagnostic.file = program.file;
  diagnostic.line = static_cast<int>(found.line);
  diagnostic.column = static_cast<int>(found.column);
  return diagnostic;
}

}  // namespace

std::optional<Diagnostic> not_milling(const Program& program) {
  if (program.dialect != Dialect::fanuc) return std::nullopt;
  const std::string head = program.text.head(kBytesLookedAt);
  std::string_view text = head;
  std::optional<Suspicion> turret;
  LetterSet letters;
  bool changes_tools = false;
  for (std::uint32_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const PlainLine line = plain_words(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (auto found = sure_sign(line, number)) return refused(program, *found);
    letters = letters | line.letters;
    changes_tools = changes_tools || line.find('M', 6.0) != nullptr;
    for (const PlainWord& word : line.words) {
      if (!turret && is_turret_word(word)) {
        turret = Suspicion{"a lathe", "T" + std::string(word.digits) + " without M6, and no Y",
                           number, word.column};
      }
    }
  }
  // A turret turns by T alone, and moves in X and Z.
  const bool lathe =
      turret && !changes_tools && !letters.has('Y') && letters.has('X') && letters.has('Z');
  if (lathe) return refused(program, *turret);
  return std::nullopt;
}

}  // namespace frustum::parser
