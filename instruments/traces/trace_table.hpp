// Tables as measuring programs export them: CSV with a header, comments, decimal comma or point.
//
// Text   : a first line with the names of the columns, separated by semicolons, commas or tabs;
//          where they are not separated by commas numbers may have a decimal comma. Comments from #
//          to the end of the line may state "key value"; blank lines. UTF-8 or UTF-16
// Units  : none
// Errors : no header, an unknown or doubled column, a row of another length, text where a number
//          belongs: with file, line and column
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::instruments {

struct TraceNote {
  std::string value{};
  std::string next{};  // the word after it: a unit
  int line = 0;
};

class TraceTable {
 public:
  // `columns`: the names that are known.
  [[nodiscard]] static Result<TraceTable> read(const std::filesystem::path& file,
                                               const std::vector<std::string>& columns);
  [[nodiscard]] static Result<TraceTable> parse(std::string_view text,
                                                const std::filesystem::path& file,
                                                const std::vector<std::string>& columns);

  [[nodiscard]] bool has(std::string_view column) const { return place_of(column).has_value(); }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] int line(std::size_t row) const { return rows_[row].line; }
  [[nodiscard]] int header_line() const { return header_line_; }
  // Of a column that the table has.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
  [[nodiscard]] Result<double> number(std::size_t row, std::string_view column) const;
  // "plane" of "# plane XY".
  [[nodiscard]] std::optional<TraceNote> note(std::string_view key) const;
  // Its number; `units`: what may follow it, that which is meant where nothing does.
  [[nodiscard]] Result<std::optional<double>> number_note(
      std::string_view key, const std::vector<std::string>& units) const;

  // With the file and a line.
  [[nodiscard]] Diagnostic placed(Diagnostic problem, int line, int column = 0) const;

 private:
  struct Cell {
    std::string text{};
    int column = 0;
  };
  struct Row {
    int line = 0;
    std::vector<Cell> cells{};
  };
  [[nodiscard]] std::optional<std::size_t> place_of(std::string_view column) const;

  std::filesystem::path file_{};
  int header_line_ = 0;
  bool decimal_comma_ = false;  // allowed
  std::vector<std::string> columns_{};
  std::vector<Row> rows_{};
  std::map<std::string, TraceNote, std::less<>> notes_{};
};

// The readings of a plan's touches; refused where one is missing, by its name.
[[nodiscard]] Result<std::vector<double>> all_readings(
    const TraceTable& table, std::span<const std::optional<double>> readings,
    const std::function<std::string(std::size_t)>& name_of);

}  // namespace frustum::instruments
