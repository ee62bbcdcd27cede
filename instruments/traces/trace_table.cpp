#include "instruments/traces/trace_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.hpp"
#include "core/spelling.hpp"
#include "core/text_encoding.hpp"
#include "core/text_words.hpp"
#include "core/whole_file.hpp"
#include "metrology/points/line_words.hpp"

namespace frustum::instruments {
namespace {

struct Noted {
  std::string key{}, value{}, next{};
};

// "# radius 150 mm": key, value and the word after it.
std::optional<Noted> noted(std::string_view comment) {
  TextWords words(comment);
  std::string key(words.next());
  if (key.ends_with(':') || key.ends_with('=')) key.pop_back();
  std::string value(words.next());
  if (value == "=" || value == ":") value = words.next();
  if (key.empty() || value.empty()) return std::nullopt;
  return Noted{std::move(key), std::move(value), std::string(words.next())};
}

// "150mm" as "150" and "mm".
std::pair<std::string, std::string> without_unit(const TraceNote& note) {
  const std::size_t digits = note.value.find_first_not_of("+-0123456789.,");
  if (digits == std::string::npos || digits == 0) return {note.value, note.next};
  if (const char e = note.value[digits]; e == 'e' || e == 'E') return {note.value, note.next};
  return {note.value.substr(0, digits), note.value.substr(digits)};
}

std::optional<double> number_of(std::string text, bool decimal_comma) {
  if (decimal_comma) std::ranges::replace(text, ',', '.');
  const auto value = metrology::number_in(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

Diagnostic TraceTable::placed(Diagnostic problem, int line, int column) const {
  problem.file = file_.string();
  problem.line = line;
  problem.column = column;
  return problem;
}

std::optional<std::size_t> TraceTable::place_of(std::string_view column) const {
  const auto at = std::ranges::find(columns_, column);
  if (at == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns_.begin());
}

const std::string& TraceTable::text(std::size_t row, std::string_view column) const {
  return rows_[row].cells[*place_of(column)].text;
}

Result<double> TraceTable::number(std::size_t row, std::string_view column) const {
  const Cell& cell = rows_[row].cells[*place_of(column)];
  if (const auto value = number_of(cell.text, decimal_comma_)) return *value;
  return placed(
      error("not-a-number"_id, fmt::format("'{}' in column {} is not a number", cell.text, column)),
      rows_[row].line, cell.column);
}

std::optional<TraceNote> TraceTable::note(std::string_view key) const {
  const auto at = notes_.find(key);
  return at == notes_.end() ? std::nullopt : std::optional(at->second);
}

Result<std::optional<double>> TraceTable::number_note(std::string_view key,
                                                      const std::vector<std::string>& units) const {
  const auto found = note(key);
  if (!found) return std::optional<double>{};
  const auto [number, unit] = without_unit(*found);
  if (!unit.empty() && std::ranges::find(units, unit) == units.end()) {
    return placed(error("wrong-unit"_id,
                        fmt::format("'# {} {} {}' is not in {}", key, number, unit, units.front()),
                        fmt::format("write \"# {} NUMBER {}\"", key, units.front())),
                  found->line);
  }
  if (const auto value = number_of(number, true)) return std::optional(*value);
  return placed(
      error("not-a-number"_id, fmt::format("'# {} {}' does not state a number", key, found->value)),
      found->line);
}

Result<TraceTable> TraceTable::read(const std::filesystem::path& file,
                                    const std::vector<std::string>& columns) {
  const auto bytes = read_whole_file(file);
  if (!bytes) return bytes.error();
  const auto text = utf8_text(*bytes);
  if (!text) {
    Diagnostics problems = text.error();
    for (Diagnostic& each : problems) each.file = file.string();
    return problems;
  }
  return parse(*text, file, columns);
}

Result<TraceTable> TraceTable::parse(std::string_view text, const std::filesystem::path& file,
                                     const std::vector<std::string>& known) {
  TraceTable table;
  table.file_ = file;
  int line_number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", from), text.size());
    std::string line(text.substr(from, end - from));
    from = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    ++line_number;
    const auto [content, comment] = metrology::split_comment(line);
    if (const auto said = noted(comment)) {
      table.notes_.try_emplace(said->key, TraceNote{said->value, said->next, line_number});
    }
    std::string row(content);
    if (row.find_first_not_of(" \t") == std::string::npos) continue;
    const bool is_header = table.columns_.empty();
    if (is_header)
      table.decimal_comma_ =
          row.find(',') == std::string::npos || row.find(';') != std::string::npos;
    // Between blanks a comma can only be a decimal one.
    const bool by_blanks = table.decimal_comma_ && row.find(';') == std::string::npos;
    if (by_blanks) std::ranges::replace(row, ',', '.');
    Row found{line_number, {}};
    for (const metrology::Word& word : metrology::words_of(row)) {
      found.cells.push_back({word.text, word.column});
    }
    if (!is_header) {
      if (found.cells.size() != table.columns_.size()) {
        return table.placed(
            error("number-count"_id,
                  fmt::format("the row has {}, the header {}", counted(found.cells.size(), "field"),
                              table.columns_.size())),
            line_number);
      }
      table.rows_.push_back(std::move(found));
      continue;
    }
    table.header_line_ = line_number;
    for (const Cell& cell : found.cells) {
      if (std::ranges::find(known, cell.text) == known.end()) {
        return table.placed(
            error("unknown-column"_id, fmt::format("'{}' is no column that is known", cell.text),
                  fmt::format("{}; a first line has the names of the columns with their units",
                              suggestion(cell.text, known))),
            line_number, cell.column);
      }
      if (table.has(cell.text)) {
        return table.placed(
            error("given-twice"_id, fmt::format("column {} is there twice", cell.text)),
            line_number, cell.column);
      }
      table.columns_.push_back(cell.text);
    }
  }
  if (table.rows_.empty()) {
    return table.placed(error("no-samples"_id, "the file has no rows of numbers",
                              fmt::format("columns: {}", fmt::join(known, ", "))),
                        line_number);
  }
  return table;
}

Result<std::vector<double>> all_readings(const TraceTable& table,
                                         std::span<const std::optional<double>> readings,
                                         const std::function<std::string(std::size_t)>& name_of) {
  std::vector<double> all;
  for (std::size_t t = 0; t < readings.size(); ++t) {
    if (!readings[t]) {
      return table.placed(
          error("touch-missing"_id, fmt::format("{} of {} touches are there: {} is missing",
                                                table.rows(), readings.size(), name_of(t))),
          table.header_line());
    }
    all.push_back(*readings[t]);
  }
  return all;
}

}  // namespace frustum::instruments
