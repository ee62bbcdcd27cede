#include "metrology/points/point_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>

#include "core/spelling.hpp"
#include "core/whole_file.hpp"
#include "metrology/points/ply_points.hpp"

namespace frustum::metrology {
namespace {

struct Word {
  std::string text;
  int column;  // 1-based
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// The line without its comment, and the comment; a # within quotes begins none.
std::pair<std::string_view, std::string_view> split_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (line[at] == '#' && !quoted) return {line.substr(0, at), line.substr(at + 1)};
  }
  return {line, {}};
}

// A field in quotes, from the first of them; a doubled quote represents one.
std::string unquoted(std::string_view line, std::size_t& at) {
  std::string text;
  for (++at; at < line.size(); ++at) {
    if (line[at] == '"' && (at + 1 >= line.size() || line[at + 1] != '"')) {
      ++at;
      break;
    }
    if (line[at] == '"') ++at;
    text += line[at];
  }
  return text;
}

// Splits at commas or semicolons when the line has any, at blanks otherwise.
std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  const bool separated = line.find_first_of(",;") != std::string_view::npos;
  const auto ends_word = [&](char c) { return separated ? c == ',' || c == ';' : is_blank(c); };
  std::size_t at = 0;
  while (at <= line.size()) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (!separated && at == line.size()) break;
    const std::size_t first = at;
    std::string text;
    if (at < line.size() && line[at] == '"') text = unquoted(line, at);
    const std::size_t plain = at;
    while (at < line.size() && !ends_word(line[at])) ++at;
    std::string_view rest = line.substr(plain, at - plain);
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    words.push_back({text + std::string(rest), static_cast<int>(first) + 1});
    ++at;
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

Diagnostic unlike_units(const LengthUnit& stated, const LengthUnit& asked) {
  return error("length-unit"_id,
               fmt::format("the file states the unit {}, --unit says {}", stated.name, asked.name),
               "leave --unit out, or correct the file");
}

struct FoundPoints {
  FeaturePoints feature{};
  std::vector<double> weights{};
};

class PointReader {
 public:
  PointReader(const std::filesystem::path& file, const std::optional<LengthUnit>& unit)
      : file_(file.string()), default_unit_(unit) {}

  Result<std::vector<FoundPoints>> read(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark of spreadsheets
    bool first = true;
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      const auto [line, comment] = split_comment(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      const auto stated = stated_unit(comment);
      if (!stated) return placed(stated.error().front(), static_cast<int>(line.size()) + 1);
      if (*stated) {
        if (auto problem = take_unit(**stated, static_cast<int>(line.size()) + 1)) return *problem;
      }
      const std::vector<Word> words = words_of(line);
      if (words.empty() || (words.size() == 1 && words.front().text.empty())) continue;
      auto problem = first ? first_line(words) : point_line(words);
      first = false;
      if (problem) return *problem;
    }
    if (auto problem = wrong_count()) return *problem;
    return std::move(found_);
  }

 private:
  using Problem = std::optional<Diagnostic>;

  [[nodiscard]] Diagnostic placed(Diagnostic d, int column) const {
    d.file = file_;
    d.line = column > 0 ? line_ : 0;
    d.column = column;
    return d;
  }
  [[nodiscard]] Diagnostic fault(DiagnosticId id, int column, std::string message,
                                 std::string hint) const {
    return placed(error(id, std::move(message), std::move(hint)), column);
  }

  [[nodiscard]] Problem wrong_count() const {
    std::size_t total = 0;
    for (const FoundPoints& f : found_) total += f.feature.points.size();
    if (total == 0)
      return fault("file-without-points"_id, 0, "the file holds no points",
                   "write one point x y z (mm) a line");
    if (count_ && *count_ != static_cast<double>(total)) {
      return fault(
          "point-count"_id, 0,
          fmt::format("the first line announces {} points, the file holds {}", *count_, total),
          "correct the count or leave the line out");
    }
    return std::nullopt;
  }

  Problem take_unit(const LengthUnit& unit, int column) {
    if (!found_.empty()) {
      return fault("length-unit"_id, column, fmt::format("the unit {} is after points", unit.name),
                   "state it before the first point");
    }
    if (unit_ && *unit_ != unit) {
      return fault("length-unit"_id, column,
                   fmt::format("the unit is {} here, {} before", unit.name, unit_->name),
                   "a file has one unit");
    }
    if (default_unit_ && *default_unit_ != unit) {
      return placed(unlike_units(unit, *default_unit_), column);
    }
    unit_ = unit;
    return std::nullopt;
  }

  Problem first_line(const std::vector<Word>& words) {
    const auto number = number_in(words.front().text);
    if (words.size() == 1 && number) {
      if (!(*number >= 0.0) || *number != std::floor(*number)) {
        return fault("point-count"_id, words.front().column,
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
    stated_above_ = unit_.has_value();
    const std::vector<std::string> known{"feature", "section", "x", "y", "z", "weight"};
    columns_.clear();
    for (const Word& word : words) {
      ApproachDirection heading = approach_direction_of(word.text);
      if (std::find(known.begin(), known.end(), heading.name) == known.end()) {
        return fault("point-columns"_id, word.column, fmt::format("unknown column '{}'", word.text),
                     suggestion(heading.name, known));
      }
      if (std::find(columns_.begin(), columns_.end(), heading.name) != columns_.end()) {
        return fault("point-columns"_id, word.column,
                     fmt::format("column '{}' appears twice", word.text), "each column once");
      }
      if (auto problem = unit_of_column(heading, word)) return problem;
      columns_.push_back(std::move(heading.name));
    }
    for (const std::string needed : {"x", "y", "z"}) {
      if (std::find(columns_.begin(), columns_.end(), needed) == columns_.end()) {
        return fault("point-columns"_id, words.front().column,
                     fmt::format("the header has no column '{}'", needed),
                     "a point needs x, y and z");
      }
    }
    return partly_stated(words);
  }

  // A unit at some coordinates only, which is not the one that the others have anyway.
  [[nodiscard]] Problem partly_stated(const std::vector<Word>& words) const {
    const LengthUnit others = default_unit_.value_or(LengthUnit{"mm", 1.0});
    if (stated_above_ || !unit_ || *unit_ == others) return std::nullopt;
    const Word* with = nullptr;
    const Word* without = nullptr;
    for (const Word& word : words) {
      const ApproachDirection heading = approach_direction_of(word.text);
      if (heading.name.size() == 1) (heading.unit.empty() ? without : with) = &word;
    }
    if (with == nullptr || without == nullptr) return std::nullopt;
    return fault("length-unit"_id, without->column,
                 fmt::format("'{}' states a unit, '{}' does not", with->text, without->text),
                 fmt::format("state the unit at each of x, y and z, or once above: # unit: {}",
                             unit_->name));
  }

  Problem unit_of_column(const ApproachDirection& heading, const Word& word) {
    if (heading.unit.empty()) return std::nullopt;
    const auto unit = length_unit(heading.unit);
    const bool is_coordinate = heading.name.size() == 1;
    if (unit && is_coordinate) return take_unit(*unit, word.column);
    return fault("length-unit"_id, word.column,
                 fmt::format("'{}' is not a unit for column '{}'", heading.unit, heading.name),
                 is_coordinate ? "mm, um, nm, cm, m or inch" : "leave the unit out");
  }

  Problem point_line(const std::vector<Word>& words) {
    if (words.size() != columns_.size()) {
      return fault("point-columns"_id, words.back().column,
                   fmt::format("{} columns, expected {}", words.size(), columns_.size()),
                   fmt::format("a line holds {}", joined_columns()));
    }
    std::string_view feature;
    std::optional<std::size_t> section;
    std::optional<double> weight;
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Word& word = words[i];
      if (columns_[i] == "feature") {
        feature = word.text;
        continue;
      }
      const auto number = number_in(word.text);
      if (!number || !std::isfinite(*number)) {
        return fault("point-columns"_id, word.column,
                     fmt::format("'{}' is not a finite number", word.text),
                     fmt::format("{} expected here", columns_[i]));
      }
      if (columns_[i] == "section") {
        // Larger than any plan has: a coordinate in the wrong column.
        if (*number < 0.0 || *number != std::floor(*number) || *number > 1e6) {
          return fault("point-columns"_id, word.column,
                       fmt::format("'{}' is not a section", word.text),
                       "sections are whole numbers, the first is 0");
        }
        section = static_cast<std::size_t>(*number);
      } else if (columns_[i] == "weight") {
        if (*number < 0.0) {
          return fault("point-columns"_id, word.column,
                       fmt::format("'{}' is not a weight", word.text), "weights are 0 or more");
        }
        weight = *number;
      } else {
        point[columns_[i][0] - 'x'] = *number;
      }
    }
    auto place = std::find_if(found_.begin(), found_.end(),
                              [&](const FoundPoints& f) { return f.feature.feature == feature; });
    if (place == found_.end()) {
      found_.push_back({{std::string(feature), {}, {}, file_, line_}, {}});
      place = found_.end() - 1;
    }
    place->feature.points.push_back(mm() * point);
    if (section) place->feature.sections.push_back(*section);
    if (weight) place->weights.push_back(*weight);
    return std::nullopt;
  }

  [[nodiscard]] double mm() const {
    return unit_ ? unit_->mm : default_unit_ ? default_unit_->mm : 1.0;
  }

  [[nodiscard]] std::string joined_columns() const {
    std::string text;
    for (const std::string& name : columns_) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  std::string file_;
  std::optional<LengthUnit> default_unit_;
  std::optional<LengthUnit> unit_;  // as the file says
  bool stated_above_ = false;       // of the header
  int line_ = 0;
  std::vector<std::string> columns_{"x", "y", "z"};
  std::optional<double> count_;
  std::vector<FoundPoints> found_;
};

Result<std::vector<FoundPoints>> parse_ply(std::string_view bytes,
                                           const std::filesystem::path& file,
                                           const std::optional<LengthUnit>& unit) {
  auto ply = parse_ply_points(bytes);
  Diagnostics problems = ply ? Diagnostics() : ply.error();
  if (ply && ply->points.empty())
    problems.push_back(error("file-without-points"_id, "the file holds no points"));
  if (ply && ply->unit && unit && *ply->unit != *unit) {
    problems.push_back(unlike_units(*ply->unit, *unit));
  }
  for (Diagnostic& d : problems) d.file = file.string();
  if (!problems.empty()) return problems;
  const double mm = ply->unit ? ply->unit->mm : unit ? unit->mm : 1.0;
  for (Vec3& point : ply->points) point *= mm;
  return std::vector<FoundPoints>{{{"", std::move(ply->points), {}, file.string(), 0}, {}}};
}

Result<std::vector<FoundPoints>> read_file(const std::filesystem::path& file,
                                           const std::optional<LengthUnit>& unit) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    Diagnostic d = error("file-unreadable"_id, "this is a directory, not a file of points",
                         "name one of the files in it");
    d.file = file.string();
    return d;
  }
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".ply" ? parse_ply(*text, file, unit) : PointReader(file, unit).read(*text);
}

Result<std::vector<FeaturePoints>> without_weights(Result<std::vector<FoundPoints>> found,
                                                   const std::filesystem::path& file) {
  if (!found) return std::move(found).error();
  std::vector<FeaturePoints> features;
  for (FoundPoints& f : *found) {
    if (!f.weights.empty()) {
      Diagnostic d = error("point-columns"_id, "points of a plan have no weights",
                           "leave the column weight out");
      d.file = file.string();
      return d;
    }
    features.push_back(std::move(f.feature));
  }
  return features;
}

}  // namespace

Result<std::vector<FeaturePoints>> parse_feature_points(std::string_view text,
                                                        const std::filesystem::path& file,
                                                        const std::optional<LengthUnit>& unit) {
  return without_weights(PointReader(file, unit).read(text), file);
}

Result<std::vector<FeaturePoints>> read_feature_points(const std::filesystem::path& file,
                                                       const std::optional<LengthUnit>& unit) {
  return without_weights(read_file(file, unit), file);
}

Result<PointCloud> read_point_cloud(const std::filesystem::path& file,
                                    const std::optional<LengthUnit>& unit) {
  auto found = read_file(file, unit);
  if (!found) return std::move(found).error();
  if (found->size() > 1) {
    std::string names;
    for (const FoundPoints& f : *found) names += (names.empty() ? "" : ", ") + f.feature.feature;
    Diagnostic several =
        error("several-features"_id,
              fmt::format("the file has points of {} features: {}", found->size(), names),
              "one element goes through the points of one feature; leave the others out");
    several.file = file.string();
    return several;
  }
  PointCloud cloud;
  for (const FoundPoints& f : *found) {
    cloud.points.insert(cloud.points.end(), f.feature.points.begin(), f.feature.points.end());
    cloud.weights.insert(cloud.weights.end(), f.weights.begin(), f.weights.end());
  }
  return cloud;
}

}  // namespace frustum::metrology
