#include "metrology/points/text_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

#include "core/counted.hpp"
#include "core/spelling.hpp"
#include "core/text_encoding.hpp"
#include "metrology/points/column_heading.hpp"
#include "metrology/points/line_words.hpp"
#include "metrology/points/pcdmis_line.hpp"
#include "metrology/points/table_form.hpp"

namespace frustum::metrology {
namespace {

class PointReader {
 public:
  PointReader(const std::filesystem::path& file, const std::optional<LengthUnit>& unit)
      : file_(file.string()), default_unit_(unit) {}

  Result<std::vector<FoundPoints>> read(std::string_view bytes) {
    const auto decoded = utf8_text(bytes);
    if (!decoded) return placed(decoded.error().front(), 0);
    std::string_view text = *decoded;
    auto form = table_form(text);
    if (!form) {
      Diagnostic d = std::move(form).error().front();
      d.file = file_;
      return d;
    }
    form_ = *form;
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      if (auto problem = take_line(text.substr(0, end))) return *problem;
      text.remove_prefix(end);
      text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
    }
    if (auto problem = wrong_count()) return *problem;
    return std::move(found_);
  }

 private:
  using Problem = std::optional<Diagnostic>;

  Problem take_line(std::string_view whole) {
    const auto [line, comment] = split_comment(whole);
    const int after = static_cast<int>(line.size()) + 1;
    const auto stated = stated_unit(comment);
    if (!stated) return placed(stated.error().front(), after);
    if (*stated) {
      if (auto problem = take_unit(**stated, after)) return problem;
    }
    if (!has_begun_ && is_separator_line(line)) return std::nullopt;
    const std::vector<Word> words =
        form_.separator != 0 ? words_between(line, form_.separator) : words_of(line);
    if (words.empty() || (words.size() == 1 && words.front().text.empty())) return std::nullopt;
    const bool is_first = !has_begun_;
    has_begun_ = true;
    auto problem = is_first ? first_line(words, line) : point_line(words);
    if (!problem || form_.has_decimal_commas) return problem;
    // What is wrong with the columns comes of the comma.
    const auto written = decimal_comma(line);
    if (!written) return problem;
    return fault("decimal-comma"_id, written->column,
                 fmt::format("'{}' is written with a decimal comma", written->text),
                 "write a decimal point, or separate all columns by semicolons or by tabs: then "
                 "decimal commas are read");
  }

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
      return fault("point-count"_id, 0,
                   fmt::format("the first line announces {}, the file holds {}",
                               counted(static_cast<std::size_t>(*count_), "point"), total),
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

  // A field of this file as a number.
  [[nodiscard]] std::optional<double> number_of(const Word& word) const {
    if (form_.has_decimal_commas) {
      if (const auto number = comma_number_in(word.text)) return number;
    }
    return number_in(word.text);
  }

  Problem first_line(const std::vector<Word>& words, std::string_view line) {
    if (is_pcdmis_header(line)) return pcdmis_header(line);
    const auto number = number_of(words.front());
    if (words.size() == 1 && number) {
      if (!(*number >= 0.0) || *number != std::floor(*number)) {
        return fault("point-count"_id, words.front().column,
                     fmt::format("'{}' is not a number of points", words.front().text),
                     "a line with one number announces how many points follow");
      }
      count_ = *number;
      return std::nullopt;
    }
    if (number || number_of(words.back())) return point_line(words);
    // Calypso's tables of results: one line a characteristic.
    if (words.front().text == "planid" && words.size() > 5) {
      return fault("point-columns"_id, words.front().column,
                   "a table of characteristics as Calypso writes it (_chr.txt) holds no points",
                   "export the measured points of the features as text, one point a line");
    }
    return header(words);
  }

  Problem pcdmis_header(std::string_view line) {
    const auto unit = pcdmis_unit(line);
    if (!unit) return placed(unit.error().front(), unit.error().front().column);
    is_pcdmis_ = true;
    return take_unit(*unit, 1);
  }

  Problem pcdmis_line(const std::vector<Word>& words) {
    const auto point = pcdmis_point(words, mm());
    if (!point) return placed(point.error().front(), point.error().front().column);
    keep({}, *point);
    return std::nullopt;
  }

  Problem header(const std::vector<Word>& words) {
    stated_above_ = unit_.has_value();
    has_header_ = true;
    const std::vector<std::string> known(known_columns().begin(), known_columns().end());
    columns_.clear();
    for (const Word& word : words) {
      ColumnHeading heading = column_heading(word.text);
      if (std::find(known.begin(), known.end(), heading.name) == known.end()) {
        return fault("point-columns"_id, word.column, fmt::format("unknown column '{}'", word.text),
                     suggestion(heading.name, known));
      }
      const auto twin = std::find(columns_.begin(), columns_.end(), heading.name);
      if (twin != columns_.end()) {
        const std::string& first = words[static_cast<std::size_t>(twin - columns_.begin())].text;
        return fault("point-columns"_id, word.column,
                     first == word.text
                         ? fmt::format("column '{}' appears twice", word.text)
                         : fmt::format("'{}' and '{}' are both column {}", first, word.text, *twin),
                     "each column once");
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
      const ColumnHeading heading = column_heading(word.text);
      if (is_coordinate(heading.name)) (heading.unit.empty() ? without : with) = &word;
    }
    if (with == nullptr || without == nullptr) return std::nullopt;
    return fault("length-unit"_id, without->column,
                 fmt::format("'{}' states a unit, '{}' does not", with->text, without->text),
                 fmt::format("state the unit at each of x, y and z, or once above: # unit: {}",
                             unit_->name));
  }

  Problem unit_of_column(const ColumnHeading& heading, const Word& word) {
    if (heading.unit.empty()) return std::nullopt;
    const auto unit = length_unit(heading.unit);
    const bool has_unit = is_coordinate(heading.name);
    if (unit && has_unit) return take_unit(*unit, word.column);
    if (unit && is_length_beside(heading.name)) return std::nullopt;
    return fault("length-unit"_id, word.column,
                 fmt::format("'{}' is not a unit for column '{}'", heading.unit, heading.name),
                 has_unit ? "mm, um, nm, cm, m or inch" : "leave the unit out");
  }

  // Without a header six numbers are a point and the unit direction of its surface or approach.
  [[nodiscard]] bool has_direction(const std::vector<Word>& words) {
    if (words.size() != 6) return false;
    Vec3 direction;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = number_of(words[3 + k]);
      if (!number) return false;
      direction[static_cast<Eigen::Index>(k)] = *number;
    }
    // Files round directions to three digits or more.
    return std::abs(direction.norm() - 1.0) < 0.01;
  }

  Problem point_line(const std::vector<Word>& words) {
    if (is_pcdmis_) return pcdmis_line(words);
    if (!has_header_ && found_.empty() && has_direction(words)) {
      columns_ = {"x", "y", "z", "i", "j", "k"};
    }
    if (words.size() != columns_.size() ||
        (!has_header_ && words.size() == 6 && !has_direction(words))) {
      return wrong_columns(words);
    }
    std::string_view feature;
    std::optional<std::size_t> section;
    std::optional<double> weight;
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Word& word = words[i];
      if (columns_[i] == "feature") {
        feature = without_guard(word.text);
        continue;
      }
      if (is_text_column(columns_[i])) continue;
      const auto number = number_of(word);
      const double scale = is_coordinate(columns_[i]) ? mm() : 1.0;
      if (!number || !std::isfinite(scale * *number)) {
        return fault("point-columns"_id, word.column,
                     fmt::format("'{}' is not a finite number{}", word.text,
                                 number && std::isfinite(*number) ? " of mm" : ""),
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
      } else if (is_coordinate(columns_[i])) {
        point[columns_[i][0] - 'x'] = scale * *number;
      }
    }
    FoundPoints& place = keep(feature, point);
    if (section) place.feature.sections.push_back(*section);
    if (weight) place.weights.push_back(*weight);
    return std::nullopt;
  }

  [[nodiscard]] Diagnostic wrong_columns(const std::vector<Word>& words) const {
    if (!has_header_ && words.size() == 6) {
      return fault("point-columns"_id, words[3].column,
                   "6 columns, and the last three are no unit direction",
                   "a line holds x, y, z, or x, y, z and the direction i, j, k of length 1; "
                   "decimals have a point");
    }
    return fault("point-columns"_id, words.back().column,
                 fmt::format("{}, expected {}", counted(words.size(), "column"), columns_.size()),
                 fmt::format("a line holds {}", joined_columns()));
  }

  // The apostrophe that keeps spreadsheets from taking a name for a formula.
  [[nodiscard]] static std::string_view without_guard(std::string_view name) {
    const auto first = name.find_first_not_of('\'');
    const bool guarded = first != 0 && first != std::string_view::npos &&
                         std::string_view("=+-@\t").find(name[first]) != std::string_view::npos;
    return name.substr(guarded ? 1 : 0);
  }

  FoundPoints& keep(std::string_view feature, const Vec3& point) {
    FoundPoints& place = points_of(feature);
    place.feature.points.push_back(point);
    place.feature.lines.push_back(line_);
    return place;
  }

  FoundPoints& points_of(std::string_view feature) {
    const auto [place, is_new] = places_.try_emplace(std::string(feature), found_.size());
    if (is_new) {
      found_.push_back({});
      found_.back().feature.feature = feature;
      found_.back().feature.file = file_;
      found_.back().feature.line = line_;
    }
    return found_[place->second];
  }

  // Those that have the unit of the file.
  [[nodiscard]] static bool is_coordinate(std::string_view column) {
    return column == "x" || column == "y" || column == "z";
  }
  // Lengths in a unit of their own, which nobody reads.
  [[nodiscard]] static bool is_length_beside(std::string_view column) {
    return column.starts_with("nominal_") || column.starts_with("deviation");
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
  TableForm form_{};
  bool is_pcdmis_ = false;
  int line_ = 0;
  bool has_begun_ = false;  // a line that is not blank
  bool has_header_ = false;
  std::vector<std::string> columns_{"x", "y", "z"};
  std::optional<double> count_;
  std::vector<FoundPoints> found_;
  std::unordered_map<std::string, std::size_t> places_;  // in it, by the name of the feature
};

}  // namespace

Result<std::vector<FoundPoints>> parse_text_points(std::string_view bytes,
                                                   const std::filesystem::path& file,
                                                   const std::optional<LengthUnit>& unit) {
  return PointReader(file, unit).read(bytes);
}

}  // namespace frustum::metrology
