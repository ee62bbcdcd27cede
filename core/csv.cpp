#include "core/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/counted.hpp"
#include "core/printable_text.hpp"
#include "core/spelling.hpp"
#include "core/text_words.hpp"
#include "core/whole_file.hpp"

namespace frustum {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Nothing where a quote is not closed: then the column where it opens.
struct SplitLine {
  std::vector<CsvField> fields{};
  int open_quote = 0;
};
SplitLine split(std::string_view line) {
  SplitLine out;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_blank(line[at])) ++at;
    CsvField field{{}, static_cast<int>(at) + 1};
    if (at < line.size() && line[at] == '"') {
      const std::size_t open = at++;
      bool closed = false;
      while (at < line.size() && !closed) {
        if (line[at] != '"') {
          field.text += line[at++];
        } else if (at + 1 < line.size() && line[at + 1] == '"') {
          field.text += '"';
          at += 2;
        } else {
          ++at;
          closed = true;
        }
      }
      if (!closed) {
        out.open_quote = static_cast<int>(open) + 1;
        return out;
      }
    }
    const std::size_t end = std::min(line.find(',', at), line.size());
    field.text += trimmed(line.substr(at, end - at));
    out.fields.push_back(std::move(field));
    if (end == line.size()) return out;
    at = end + 1;
  }
}

}  // namespace

Result<CsvTable> CsvTable::parse(std::string_view text, const std::filesystem::path& file,
                                 const std::vector<std::string>& columns) {
  CsvTable table;
  table.file_ = file;
  const auto wrong = [&](int line, int column, std::string message, std::string hint) {
    Diagnostic failure = error("csv"_id, std::move(message), std::move(hint));
    failure.file = file.string();
    failure.line = line;
    failure.column = column;
    return failure;
  };
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  int line = 0;
  while (!text.empty()) {
    ++line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view whole = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view content = trimmed(whole);
    if (content.empty() || content.front() == '#') continue;
    SplitLine parts = split(whole);
    if (parts.open_quote > 0) return wrong(line, parts.open_quote, "this quote is not closed", "");
    if (table.columns_.empty()) {
      for (const CsvField& field : parts.fields) table.columns_.push_back(field.text);
      if (columns.empty() || table.columns_ == columns) continue;
      return wrong(line, 1,
                   fmt::format("the header is {}",
                               printable(fmt::format("{}", fmt::join(table.columns_, ",")))),
                   fmt::format("expected: {}", fmt::join(columns, ",")));
    }
    if (parts.fields.size() != table.columns_.size()) {
      return wrong(line, 1,
                   fmt::format("{}, the header has {}", counted(parts.fields.size(), "field"),
                               table.columns_.size()),
                   fmt::format("expected: {}", fmt::join(table.columns_, ",")));
    }
    table.rows_.push_back({line, std::move(parts.fields)});
  }
  if (table.columns_.empty()) {
    return wrong(1, 1, "the file has no header",
                 columns.empty() ? "" : fmt::format("expected: {}", fmt::join(columns, ",")));
  }
  return table;
}

Result<CsvTable> CsvTable::load(const std::filesystem::path& file,
                                const std::vector<std::string>& columns) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  return parse(*text, file, columns);
}

Result<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(columns_, name);
  const bool once =
      found != columns_.end() && std::find(found + 1, columns_.end(), name) == columns_.end();
  if (once) return static_cast<std::size_t>(found - columns_.begin());
  Diagnostic failure = error("csv"_id,
                             fmt::format("the header has {} column '{}'",
                                         found == columns_.end() ? "no" : "more than one", name),
                             suggestion(name, columns_));
  failure.file = file_.string();
  failure.line = 1;
  return failure;
}

Diagnostic CsvTable::about(const CsvRow& row, std::size_t column, DiagnosticId id,
                           std::string message, std::string hint) const {
  Diagnostic failure = error(id, std::move(message), std::move(hint));
  failure.file = file_.string();
  failure.line = row.line;
  failure.column = row.fields.at(column).column;
  return failure;
}

Result<double> CsvTable::number(const CsvRow& row, std::size_t column) const {
  const std::string& text = row.fields.at(column).text;
  if (const auto value = finite_number_in_word(text)) return *value;
  return about(row, column, "csv"_id,
               fmt::format("{} '{}' is no finite number", columns_.at(column), printable(text)));
}

}  // namespace frustum
