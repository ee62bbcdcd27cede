#include "cutter/tool_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>

namespace frustum::cutter {
namespace {

constexpr std::string_view kLetters = "TPXYZABCUVWDIJQ";

struct Line {
  std::map<char, double> words{};
  std::map<char, int> columns{};
};

class LineReader {
 public:
  LineReader(std::string_view text, const std::filesystem::path& file, int line)
      : text_(text), file_(file), line_(line) {}

  Result<Line> read() {
    Line line;
    for (skip_blanks(); at_ < text_.size() && text_[at_] != ';'; skip_blanks()) {
      const std::size_t start = at_;
      const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text_[at_++])));
      if (kLetters.find(letter) == std::string_view::npos) {
        return problem(start, fmt::format("'{}' is no word of a tool table", word_at(start)),
                       "a word is a letter and a number: T1 P1 D12 Z100; remarks follow ';'");
      }
      const auto value = number();
      if (!value) {
        return problem(start, fmt::format("'{}' has no number", word_at(start)),
                       "a word is a letter and a number: T1 P1 D12 Z100");
      }
      if (!line.words.emplace(letter, *value).second) {
        return problem(start, fmt::format("{} stands twice on the line", letter),
                       "one tool has a line of its own");
      }
      line.columns.emplace(letter, static_cast<int>(start) + 1);
    }
    return line;
  }

  [[nodiscard]] Diagnostic problem(std::size_t at, std::string message, std::string hint) const {
    Diagnostic d = error(std::move(message), std::move(hint));
    d.file = file_.string();
    d.line = line_;
    d.column = static_cast<int>(at) + 1;
    return d;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  std::optional<double> number() {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    double value = 0.0;
    const char* first = text_.data() + at_;
    const auto [end, failure] = std::from_chars(first, text_.data() + text_.size(), value);
    if (failure != std::errc() || !std::isfinite(value)) return std::nullopt;
    at_ += static_cast<std::size_t>(end - first);
    return value;
  }
  [[nodiscard]] std::string word_at(std::size_t start) const {
    std::size_t end = start;
    while (end < text_.size() && text_[end] != ';' &&
           std::isspace(static_cast<unsigned char>(text_[end])) == 0) {
      ++end;
    }
    return std::string(text_.substr(start, end - start));
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  int line_;
  std::size_t at_ = 0;
};

}  // namespace

Result<ToolList> read_tool_table(std::string_view text, const std::filesystem::path& file,
                                 double mm_per_unit) {
  ToolList tools;
  std::map<int, int> lines;
  Diagnostics problems;
  int number_of_line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    LineReader reader(text.substr(0, end), file, ++number_of_line);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto line = reader.read();
    if (!line) {
      problems.insert(problems.end(), line.error().begin(), line.error().end());
      continue;
    }
    const auto& words = line->words;
    if (words.empty()) continue;
    const double tool = words.contains('T') ? words.at('T') : -1.0;
    if (!(tool >= 0.0 && tool <= 99999.0 && tool == std::floor(tool))) {
      const int column = words.contains('T') ? line->columns.at('T') : 1;
      problems.push_back(reader.problem(static_cast<std::size_t>(column) - 1,
                                        "a line without a tool number",
                                        "T and a whole number from 0 to 99999"));
      continue;
    }
    const int number = static_cast<int>(tool);
    if (const auto [first, is_new] = lines.emplace(number, number_of_line); !is_new) {
      problems.push_back(reader.problem(0, fmt::format("tool {} is described twice", number),
                                        fmt::format("first on line {}", first->second)));
      continue;
    }
    const auto value = [&](char letter) {
      return words.contains(letter) ? words.at(letter) * mm_per_unit : 0.0;
    };
    if (number == 0 || !(value('D') > 0.0) || !(value('Z') > 0.0)) continue;
    tools.emplace(number, CutterSpec{.diameter = {value('D')}, .length = {value('Z')}});
  }
  if (problems.empty() && tools.empty()) {
    Diagnostic none = error("the tool table has no tool with a diameter and a length",
                            "one tool a line: T1 P1 D12 Z100 ; remark");
    none.file = file.string();
    problems.push_back(std::move(none));
  }
  if (!problems.empty()) return problems;
  return tools;
}

Result<ToolList> load_tool_table(const std::filesystem::path& file, double mm_per_unit) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || !std::filesystem::is_regular_file(file)) {
    Diagnostic unreadable = error("the tool table cannot be read", "give the path of a .tbl file");
    unreadable.file = file.string();
    return unreadable;
  }
  text << in.rdbuf();
  return read_tool_table(text.str(), file, mm_per_unit);
}

}  // namespace frustum::cutter
