#include "metrology/plan/report_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <regex>

namespace frustum::metrology {
namespace {

// A day that there is, alone or with a time of day, that with its distance from UTC or without.
bool is_date(const std::string& text) {
  static const std::regex kForm(R"((\d{4})-(\d\d)-(\d\d)(T([01]\d|2[0-3]):[0-5]\d:[0-5]\d)"
                                R"((Z|[+-](0\d|1[0-3]):[0-5]\d|[+-]14:00)?)?)");
  std::smatch parts;
  if (!std::regex_match(text, parts, kForm)) return false;
  const auto number = [&](std::size_t k) { return std::atoi(parts[k].str().c_str()); };
  constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const int year = number(1), month = number(2), day = number(3);
  if (month < 1 || month > 12 || day < 1) return false;
  const bool is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return day <= kDays.at(static_cast<std::size_t>(month - 1)) + (month == 2 && is_leap ? 1 : 0);
}

}  // namespace

ReportHeader read_report_header(const TomlTable& table) {
  ReportHeader header;
  for (const HeaderKey& row : kHeaderKeys) {
    if (!table.has(row.key)) continue;
    header.*row.value = table.text(row.key);
    if ((header.*row.value).empty() && table.is_sound()) {
      table.fail(row.key, "empty-text"_id, "the text is empty", "leave the key out");
    }
  }
  if (!header.date.empty() && !is_date(header.date)) {
    table.fail("date", "wrong-date"_id, fmt::format("'{}' is no date", header.date),
               "year, month, day: \"2026-11-23\", \"2026-11-23T14:05:00\" or "
               "\"2026-11-23T14:05:00Z\"");
  }
  return header;
}

std::string to_toml(const ReportHeader& header) {
  if (header == ReportHeader{}) return {};
  std::string text = "\n[report]\n";
  for (const HeaderKey& row : kHeaderKeys) {
    if ((header.*row.value).empty()) continue;
    text += fmt::format("{} = {}\n", row.key, toml_text(header.*row.value));
  }
  return text;
}

ReportHeader joined(const ReportHeader& first, const ReportHeader& second) {
  ReportHeader header = first;
  for (const HeaderKey& row : kHeaderKeys) {
    if ((header.*row.value).empty()) header.*row.value = second.*row.value;
  }
  return header;
}

}  // namespace frustum::metrology
