#include "parser/tool_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/units.hpp"
#include "core/whole_file.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/language/letter_set.hpp"

namespace frustum::parser {
namespace {

constexpr double kMaxNumber = 99'999'999.0;
constexpr int kOrientations = 9;
constexpr LetterSet kWholeWords{"TPQ"};
constexpr LetterSet kUnusedAxes{"UVW"};
constexpr LetterSet kLengthWords{"DXYZ"};
constexpr LetterSet kToolWords{"TPDXYZABCUVWIJQ"};
constexpr std::string_view kBlanks = " \t\r";

// One line of the table at a time, from left to right.
class TableLine {
 public:
  TableLine(std::string_view text, double scale) : text_(text), scale_(scale) {}

  struct Mistake {
    std::size_t column;
    std::string message;
    std::string hint;
  };

  // The number of the tool; none for a line without one.
  std::optional<Mistake> read_into(std::optional<int>& number, Tool& tool) {
    LetterSet given;
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      if (text_[at_] == ';') {
        tool.remark = trimmed(text_.substr(at_ + 1));
        break;
      }
      const std::size_t column = at_ + 1;
      const char letter = upper(text_[at_]);
      if (letter < 'A' || letter > 'Z' || !kToolWords.has(letter)) {
        return Mistake{column, fmt::format("'{}' is no word of a tool table", word_at(column)),
                       "words are T P D X Y Z A B C U V W I J Q with a number: T1 P1 D12 Z100; a "
                       "remark begins with ;"};
      }
      if (given.has(letter)) {
        return Mistake{column, fmt::format("{} is twice on the line", letter),
                       "one tool has a line of its own"};
      }
      given.add(letter);
      ++at_;
      double value = 0.0;
      if (auto mistake = number_of(letter, column, value)) return mistake;
      if (letter == 'T') {
        number = static_cast<int>(value);
      } else if (auto fault = set(tool, letter, column, value)) {
        return fault;
      }
    }
    tool.has_diameter = given.has('D');
    if (!given.empty() && !number) {
      return Mistake{1, "a line without a tool number", "begin the line with T and its number"};
    }
    return std::nullopt;
  }

 private:
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size()); }

  static std::string trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return std::string(text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1));
  }
  // From there to the next blank, bytes that are no text as ?.
  [[nodiscard]] std::string word_at(std::size_t column) const {
    std::string word;
    for (const char c : text_.substr(column - 1)) {
      if (c == ';' || kBlanks.find(c) != std::string_view::npos) break;
      word += c > ' ' && c < '\x7F' ? c : '?';
    }
    return word;
  }

  std::optional<Mistake> number_of(char letter, std::size_t column, double& value) {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    const char* begin = text_.data() + at_;
    const auto read =
        std::from_chars(begin, text_.data() + text_.size(), value, std::chars_format::fixed);
    const bool sign_twice = at_ > 0 && text_[at_ - 1] == '+' && begin != read.ptr && *begin == '-';
    if (read.ec != std::errc{} || sign_twice || !std::isfinite(value)) {
      return Mistake{column, fmt::format("'{}' has no number", word_at(column)),
                     fmt::format("write a number after it, for example {}1", letter)};
    }
    at_ += static_cast<std::size_t>(read.ptr - begin);
    if (std::abs(value) > kMaxNumber) {
      return Mistake{column, fmt::format("{} is too large", letter),
                     fmt::format("numbers go up to {:.0f}", kMaxNumber)};
    }
    if (kWholeWords.has(letter) && (value != std::floor(value) || value < 0.0)) {
      return Mistake{column,
                     letter == 'T' ? fmt::format("{} is no tool number", word_at(column))
                                   : fmt::format("{} is not a whole number", word_at(column)),
                     "tools, pockets and orientations are counted from 0"};
    }
    return std::nullopt;
  }

  std::optional<Mistake> set(Tool& tool, char letter, std::size_t column, double value) const {
    const double scaled = kLengthWords.has(letter) ? value * scale_ : value;
    if (kUnusedAxes.has(letter)) {
      if (value == 0.0) return std::nullopt;
      return Mistake{column, fmt::format("an offset along {} is not simulated", letter),
                     "leave it out: the axes are X Y Z A B C"};
    }
    for (std::size_t i = 0; i < kAxisLetters.size(); ++i) {
      if (to_char(kAxisLetters.at(i)) != letter) continue;
      tool.offset.at(i) = is_rotary(kAxisLetters.at(i)) ? value * kRadPerDeg : scaled;
    }
    if (letter == 'P') tool.pocket = static_cast<int>(value);
    if (letter == 'D') tool.diameter = scaled;
    if (letter == 'I') tool.front_angle = value;
    if (letter == 'J') tool.back_angle = value;
    if (letter != 'Q') return std::nullopt;
    if (value > kOrientations) {
      return Mistake{column, fmt::format("orientation {:.0f} does not exist", value),
                     "Q goes from 0 to 9"};
    }
    tool.orientation = static_cast<int>(value);
    return std::nullopt;
  }

  std::string_view text_;
  double scale_;
  std::size_t at_ = 0;
};

}  // namespace

Tool& entry_of(ToolTable& tools, int number) {
  const auto [place, fresh] = tools.try_emplace(number);
  if (fresh) place->second.has_length = place->second.has_diameter = false;
  return place->second;
}

Result<ToolTable> tool_table_of(std::string_view text, const std::string& file, LengthUnit unit) {
  const double scale = unit == LengthUnit::millimetre ? 1.0 : kMmPerInch;
  ToolTable table;
  std::map<int, int> lines;
  Diagnostics mistakes;
  const auto complain = [&](int line, const TableLine::Mistake& mistake) {
    Diagnostic diagnostic = error("tool-table"_id, mistake.message, mistake.hint);
    diagnostic.file = file;
    diagnostic.line = line;
    diagnostic.column = static_cast<int>(mistake.column);
    mistakes.push_back(std::move(diagnostic));
  };
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Tool tool;
    std::optional<int> number;
    auto mistake = TableLine(text.substr(0, end), scale).read_into(number, tool);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!mistake && number) {
      const auto [first, fresh] = lines.try_emplace(*number, line);
      if (fresh) {
        table.insert_or_assign(*number, std::move(tool));
      } else {
        mistake = {1, fmt::format("tool {} is described twice", *number),
                   fmt::format("first on line {}", first->second)};
      }
    }
    if (mistake) complain(line, *mistake);
  }
  if (!mistakes.empty()) return mistakes;
  return table;
}

Result<ToolTable> read_tool_table(const std::filesystem::path& file, LengthUnit unit) {
  const auto text = read_whole_file(file);
  if (!text) {
    Diagnostic diagnostic =
        error("file-unreadable"_id, "the tool table cannot be read", "is the path right?");
    diagnostic.file = file.string();
    return diagnostic;
  }
  return tool_table_of(*text, file.string(), unit);
}

}  // namespace frustum::parser
