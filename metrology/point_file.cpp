#include "metrology/point_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/spelling.hpp"

namespace frustum::metrology {
namespace {

struct Word {
  std::string_view text;
  int column;  // 1-based
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Splits at commas or semicolons when the line has any, at blanks otherwise.
std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  const bool separated = line.find_first_of(",;") != std::string_view::npos;
  std::size_t at = 0;
  while (at <= line.size()) {
    if (!separated) {
      while (at < line.size() && is_blank(line[at])) ++at;
      if (at == line.size()) break;
    }
    std::size_t end = at;
    while (end < line.size() &&
           !(separated ? line[end] == ',' || line[end] == ';' : is_blank(line[end]))) {
      ++end;
    }
    std::size_t first = at;
    std::size_t last = end;
    while (first < last && is_blank(line[first])) ++first;
    while (last > first && is_blank(line[last - 1])) --last;
    words.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    at = end + 1;
  }
  return words;
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class PointReader {
 public:
  explicit PointReader(const std::filesystem::path& file) : file_(file.string()) {}

  Result<std::vector<FeaturePoints>> read(std::string_view text) {
    bool first = true;
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
        line = line.substr(0, comment);
      }
      const std::vector<Word> words = words_of(line);
      if (words.empty() || (words.size() == 1 && words.front().text.empty())) continue;
      auto problem = first ? first_line(words) : point_line(words);
      first = false;
      if (problem) return *problem;
    }
    std::size_t total = 0;
    for (const FeaturePoints& f : found_) total += f.points.size();
    if (total == 0)
      return fault(0, "the file holds no points", "write one point x y z (mm) a line");
    if (count_ && *count_ != static_cast<double>(total)) {
      return fault(
          0, fmt::format("the first line announces {} points, the file holds {}", *count_, total),
          "correct the count or leave the line out");
    }
    return std::move(found_);
  }

 private:
  using Problem = std::optional<Diagnostic>;

  [[nodiscard]] Diagnostic fault(int column, std::string message, std::string hint) const {
    Diagnostic d = error(std::move(message), std::move(hint));
    d.file = file_;
    d.line = column > 0 ? line_ : 0;
    d.column = column;
    return d;
  }

  Problem first_line(const std::vector<Word>& words) {
    const auto number = number_in(words.front().text);
    if (words.size() == 1 && number) {
      if (!(*number >= 0.0) || *number != std::floor(*number)) {
        return fault(words.front().column,
                     fmt::format("'{}' is not a number of points", words.front().text),
                     "a line with one number announces how many points follow");
      }
      count_ = *number;
      return std::nullopt;
    }
    if (number || number_in(words.back().text)) return point_line(words);
    return header(words);
  }

  Problem header(const std::vector<Word>& words) {
    const std::vector<std::string> known{"feature", "section", "x", "y", "z"};
    columns_.clear();
    for (const Word& word : words) {
      std::string name(word.text);
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        return fault(word.column, fmt::format("unknown column '{}'", word.text),
                     suggestion(name, known));
      }
      if (std::find(columns_.begin(), columns_.end(), name) != columns_.end()) {
        return fault(word.column, fmt::format("column '{}' appears twice", word.text),
                     "each column once");
      }
      columns_.push_back(std::move(name));
    }
    for (const std::string needed : {"x", "y", "z"}) {
      if (std::find(columns_.begin(), columns_.end(), needed) == columns_.end()) {
        return fault(words.front().column, fmt::format("the header has no column '{}'", needed),
                     "a point needs x, y and z");
      }
    }
    return std::nullopt;
  }

  Problem point_line(const std::vector<Word>& words) {
    if (words.size() != columns_.size()) {
      return fault(words.back().column,
                   fmt::format("{} columns, expected {}", words.size(), columns_.size()),
                   fmt::format("a line holds {}", joined_columns()));
    }
    std::string_view feature;
    std::optional<std::size_t> section;
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Word& word = words[i];
      if (columns_[i] == "feature") {
        feature = word.text;
        continue;
      }
      const auto number = number_in(word.text);
      if (!number || !std::isfinite(*number)) {
        return fault(word.column, fmt::format("'{}' is not a finite number", word.text),
                     fmt::format("{} expected here", columns_[i]));
      }
      if (columns_[i] == "section") {
        // Larger than any plan has: a coordinate in the wrong column.
        if (*number < 0.0 || *number != std::floor(*number) || *number > 1e6) {
          return fault(word.column, fmt::format("'{}' is not a section", word.text),
                       "sections are whole numbers, the first is 0");
        }
        section = static_cast<std::size_t>(*number);
      } else {
        point[columns_[i][0] - 'x'] = *number;
      }
    }
    auto place = std::find_if(found_.begin(), found_.end(),
                              [&](const FeaturePoints& f) { return f.feature == feature; });
    if (place == found_.end()) {
      found_.push_back({std::string(feature), {}, {}});
      place = found_.end() - 1;
    }
    place->points.push_back(point);
    if (section) place->sections.push_back(*section);
    return std::nullopt;
  }

  [[nodiscard]] std::string joined_columns() const {
    std::string text;
    for (const std::string& name : columns_) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  std::string file_;
  int line_ = 0;
  std::vector<std::string> columns_{"x", "y", "z"};
  std::optional<double> count_;
  std::vector<FeaturePoints> found_;
};

}  // namespace

Result<std::vector<FeaturePoints>> parse_feature_points(std::string_view text,
                                                        const std::filesystem::path& file) {
  return PointReader(file).read(text);
}

Result<std::vector<FeaturePoints>> read_feature_points(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in || !text) {
    Diagnostic d = error("the file cannot be read", "check the path and permissions");
    d.file = file.string();
    return d;
  }
  return parse_feature_points(text.str(), file);
}

Result<std::vector<Vec3>> read_points(const std::filesystem::path& file) {
  auto features = read_feature_points(file);
  if (!features) return std::move(features).error();
  std::vector<Vec3> all;
  for (const FeaturePoints& f : *features) {
    all.insert(all.end(), f.points.begin(), f.points.end());
  }
  return all;
}

}  // namespace frustum::metrology
