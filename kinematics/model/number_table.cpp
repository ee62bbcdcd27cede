#include "kinematics/model/number_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "core/counted.hpp"
#include "core/whole_file.hpp"

namespace frustum::kinematics {
namespace {

constexpr const char* kHeaderHint =
    "the first line names each column with its unit, for example X_mm,EXX_um,EBX_urad";

struct Cell {
  std::string_view text{};
  int place = 0;
};

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t from = 0;
  while (true) {
    const std::size_t comma = line.find(',', from);
    std::size_t begin = from, end = comma == std::string_view::npos ? line.size() : comma;
    while (begin < end && (line[begin] == ' ' || line[begin] == '\t')) ++begin;
    while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\t')) --end;
    cells.push_back({line.substr(begin, end - begin), static_cast<int>(begin) + 1});
    if (comma == std::string_view::npos) return cells;
    from = comma + 1;
  }
}

}  // namespace

const NumberTable::Column* NumberTable::column(std::string_view name) const {
  for (const Column& column : columns) {
    if (column.name == name) return &column;
  }
  return nullptr;
}

Diagnostic NumberTable::problem(DiagnosticId id, int line, int place, std::string message,
                                std::string hint) const {
  Diagnostic diagnostic = error(id, std::move(message), std::move(hint));
  diagnostic.file = file.string();
  diagnostic.line = line;
  diagnostic.column = place;
  return diagnostic;
}

Result<NumberTable> read_number_table(const std::filesystem::path& file) {
  NumberTable table{.file = file};
  const auto whole = read_whole_file(file);
  if (!whole) return table.problem("file-unreadable"_id, 0, 0, "the file cannot be read");
  std::istringstream in(*whole);
  std::vector<double> scales;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (line.empty() || line.front() == '#') continue;
    const std::vector<Cell> cells = cells_of(line);
    if (table.columns.empty()) {
      table.header_line = number;
      for (const Cell& cell : cells) {
        const std::size_t bar = cell.text.rfind('_');
        if (bar == std::string_view::npos || bar == 0) {
          return table.problem("unit-missing"_id, number, cell.place,
                               fmt::format("column '{}' has no unit", cell.text), kHeaderHint);
        }
        const std::string name(cell.text.substr(0, bar));
        const auto unit = parse_quantity("1 " + std::string(cell.text.substr(bar + 1)));
        if (!unit || unit->kind == UnitKind::none) {
          return table.problem(
              "number-table"_id, number, cell.place,
              fmt::format("column '{}': unknown unit '{}'", cell.text, cell.text.substr(bar + 1)),
              kHeaderHint);
        }
        if (table.column(name) != nullptr) {
          return table.problem("given-twice"_id, number, cell.place,
                               fmt::format("column '{}' is there twice", name));
        }
        table.columns.push_back({name, unit->kind, cell.place, {}});
        scales.push_back(unit->value);
      }
      continue;
    }
    if (cells.size() != table.columns.size()) {
      return table.problem(
          "number-table"_id, number, 1,
          fmt::format("{} in a row, {} in the header", counted(cells.size(), "value"),
                      counted(table.columns.size(), "column")));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view text = cells[i].text;
      double value = 0.0;
      const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return table.problem("not-a-number"_id, number, cells[i].place,
                             fmt::format("'{}' is not a number", text));
      }
      table.columns[i].values.push_back(value * scales[i]);
    }
    table.lines.push_back(number);
  }
  if (table.columns.empty())
    return table.problem("unknown-column"_id, 1, 0, "the file has no header", kHeaderHint);
  return table;
}

}  // namespace frustum::kinematics
