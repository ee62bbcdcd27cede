#include "kinematics/errors/measured_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "core/whole_file.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/number_table.hpp"

namespace frustum::kinematics {
namespace {

UnitKind unit_of(const ErrorName& name) {
  return is_rotation(name.direction) ? UnitKind::angle : UnitKind::length;
}
const char* article_of(UnitKind kind) { return kind == UnitKind::angle ? "an angle" : "a length"; }

ErrorEntry entry_of(const std::string& name, ErrorShape shape, const std::filesystem::path& file) {
  ErrorEntry entry{.name = name, .file = file.string()};
  entry.terms.push_back(std::move(shape));
  entry.written = written(entry.terms);
  return entry;
}

// A place in a line of a calibration file.
struct Line {
  std::string text{};
  int number = 0;
};

class CalibrationReader {
 public:
  explicit CalibrationReader(std::filesystem::path file) : file_(std::move(file)) {}

  Result<std::vector<ErrorEntry>> read() {
    const auto all = read_whole_file(file_);
    if (!all) return problem("file-unreadable"_id, 0, 0, "the file cannot be read");
    std::istringstream in(*all);
    for (std::string text; std::getline(in, text);) {
      ++line_;
      if (const auto comment = text.find("//"); comment != std::string::npos) text.erase(comment);
      if (auto wrong = take(text)) return *wrong;
    }
    if (in_points_)
      return problem("error-file"_id, line_, 0, "the grid points are not closed",
                     "end them with }");
    if (auto wrong = finish_section()) return *wrong;
    if (entries_.empty())
      return problem("error-file"_id, 0, 0, "the file has no section such as [EXX]");
    return entries_;
  }

 private:
  std::optional<Diagnostic> take(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return std::nullopt;
    const int place = static_cast<int>(first) + 1;
    const std::string_view rest = text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
    if (in_points_) return point(rest, place);
    if (rest.front() == '[') return section(rest, place);
    if (!name_)
      return problem("error-file"_id, line_, place, fmt::format("'{}' is in no section", rest));
    const std::size_t equals = rest.find('=');
    const std::string_view key = rest.substr(0, rest.find_first_of(" \t="));
    if (equals == std::string_view::npos)
      return problem("error-file"_id, line_, place, fmt::format("'{}' is not understood", rest));
    if (key == "VALUE") {
      const std::size_t begin = std::min(rest.find_first_not_of(" \t", equals + 1), rest.size());
      const auto value = number_at(rest.substr(begin), place + static_cast<int>(begin));
      if (!value) return value.error().front();
      shape_.kind = ErrorShape::Kind::constant;
      shape_.amount.value = *value;
      given_ = true;
      return std::nullopt;
    }
    if (key == "Gridpoints" && rest.find('{', equals) != std::string_view::npos) {
      shape_.kind = ErrorShape::Kind::table;
      shape_.position_kind = is_rotary(name_->axis) ? UnitKind::angle : UnitKind::length;
      in_points_ = given_ = true;
      return std::nullopt;
    }
    return problem("unknown-key"_id, line_, place, fmt::format("unknown key '{}'", key),
                   "VALUE or Gridpoints = {");
  }

  std::optional<Diagnostic> section(std::string_view rest, int place) {
    if (auto wrong = finish_section()) return wrong;
    if (rest.back() != ']')
      return problem("error-file"_id, line_, place, fmt::format("'{}' has no ]", rest));
    const std::string_view text = rest.substr(1, rest.size() - 2);
    name_ = ErrorName::parse(text);
    if (!name_) {
      return problem("unknown-error"_id, line_, place + 1,
                     fmt::format("unknown error name '{}'", text),
                     "names are those of ISO 230-1, such as EXX or B0C");
    }
    section_line_ = line_;
    shape_ = {};
    shape_.amount.kind = unit_of(*name_);
    given_ = false;
    return std::nullopt;
  }

  std::optional<Diagnostic> point(std::string_view rest, int place) {
    if (rest == "}") {
      in_points_ = false;
      if (shape_.points.size() < 2)
        return problem("error-file"_id, line_, place, "a table needs at least two points");
      return std::nullopt;
    }
    const std::size_t gap = rest.find_first_of(" \t");
    const std::size_t second =
        gap == std::string_view::npos ? gap : rest.find_first_not_of(" \t", gap);
    if (second == std::string_view::npos)
      return problem("error-file"_id, line_, place, "expected a position and a value");
    const auto position = number_at(rest.substr(0, gap), place);
    if (!position) return position.error().front();
    const auto value = number_at(rest.substr(second), place + static_cast<int>(second));
    if (!value) return value.error().front();
    const double q = is_rotary(name_->axis) ? *position * kRadPerDeg : *position;
    if (!shape_.points.empty() && !(q > shape_.points.back().first))
      return problem("not-increasing"_id, line_, place, "the positions do not increase");
    shape_.points.emplace_back(q, *value);
    return std::nullopt;
  }

  std::optional<Diagnostic> finish_section() {
    if (!name_) return std::nullopt;
    if (!given_)
      return problem("error-file"_id, section_line_, 1,
                     fmt::format("[{}] is empty", name_->text()));
    entries_.push_back(entry_of(name_->text(), std::move(shape_), file_));
    return std::nullopt;
  }

  Result<double> number_at(std::string_view text, int place) const {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      return problem("not-a-number"_id, line_, place, fmt::format("'{}' is not a number", text));
    return value;
  }

  [[nodiscard]] Diagnostic problem(DiagnosticId id, int line, int place, std::string message,
                                   std::string hint = {}) const {
    Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
    diagnostic.file = file_.string();
    diagnostic.line = line;
    diagnostic.column = place;
    return diagnostic;
  }

  std::filesystem::path file_;
  int line_ = 0, section_line_ = 0;
  std::optional<ErrorName> name_;
  ErrorShape shape_;
  bool in_points_ = false, given_ = false;
  std::vector<ErrorEntry> entries_;
};

}  // namespace

Result<std::vector<ErrorEntry>> read_error_csv(const std::filesystem::path& file) {
  const auto table = read_number_table(file);
  if (!table) return table.error();
  const int head = table->header_line;
  const NumberTable::Column& positions = table->columns.front();
  const auto axis = axis_named(positions.name);
  if (!axis) {
    return table->problem("error-file"_id, head, positions.place,
                          fmt::format("'{}' is not an axis", positions.name),
                          "the first column holds the positions of one axis: X_mm or B_deg");
  }
  const UnitKind wanted = is_rotary(*axis) ? UnitKind::angle : UnitKind::length;
  if (positions.unit != wanted) {
    return table->problem(
        "error-file"_id, head, positions.place,
        fmt::format("the position of {} must be {}", positions.name, article_of(wanted)));
  }
  if (positions.values.size() < 2)
    return table->problem("error-file"_id, 0, 0, "a table needs at least two rows");
  for (std::size_t i = 1; i < positions.values.size(); ++i) {
    if (!(positions.values[i] > positions.values[i - 1]))
      return table->problem("not-increasing"_id, table->lines[i], positions.place,
                            "the positions do not increase");
  }
  std::vector<ErrorEntry> entries;
  for (auto column = table->columns.begin() + 1; column != table->columns.end(); ++column) {
    const auto name = ErrorName::parse(column->name);
    if (!name) {
      return table->problem("unknown-error"_id, head, column->place,
                            fmt::format("unknown error name '{}'", column->name),
                            fmt::format("errors of {} are EX{} .. EC{}", positions.name,
                                        positions.name, positions.name));
    }
    if (name->axis != *axis || name->location) {
      return table->problem("error-file"_id, head, column->place,
                            fmt::format("{} is no function of {}", column->name, positions.name),
                            "a file holds component errors of the axis in its first column");
    }
    if (column->unit != unit_of(*name)) {
      return table->problem("error-file"_id, head, column->place,
                            fmt::format("{} must be {}", column->name, article_of(unit_of(*name))));
    }
    ErrorShape shape{.kind = ErrorShape::Kind::table};
    shape.amount.kind = column->unit;
    shape.position_kind = wanted;
    for (std::size_t i = 0; i < positions.values.size(); ++i) {
      shape.points.emplace_back(positions.values[i], column->values[i]);
    }
    entries.push_back(entry_of(name->text(), std::move(shape), file));
  }
  if (entries.empty())
    return table->problem("unknown-column"_id, head, 0, "the file has no column of errors");
  return entries;
}

Result<std::vector<ErrorEntry>> read_calibration(const std::filesystem::path& file) {
  return CalibrationReader(file).read();
}

}  // namespace frustum::kinematics
