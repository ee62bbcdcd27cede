// Whose part it was, and who measured it when: the head of a report, as a plan or a job states it.
//
// Nothing of it is found out: the clock and the user's name never are, so that the same job gives
// the same report.
// Units  : none
// Errors : read_report_header notes misspelt keys, empty texts and dates that are none in the
//          table's document
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/toml_document.hpp"

namespace frustum::metrology {

// Empty: not stated.
struct ReportHeader {
  std::string part{};
  std::string part_number{};
  std::string serial_number{};
  std::string order{};
  std::string operated_by{};
  std::string date{};  // ISO 8601: 2026-11-23, 2026-11-23T14:05:00, 2026-11-23T14:05:00Z
  std::string cmm{};   // maker, type and number of the machine that measures

  bool operator==(const ReportHeader&) const = default;
};

struct HeaderKey {
  std::string_view key;    // in files
  std::string_view label;  // for people
  std::string ReportHeader::*value;
};
inline constexpr std::array kHeaderKeys{
    HeaderKey{"part", "Part", &ReportHeader::part},
    HeaderKey{"part_number", "Part number", &ReportHeader::part_number},
    HeaderKey{"serial_number", "Serial number", &ReportHeader::serial_number},
    HeaderKey{"order", "Order", &ReportHeader::order},
    HeaderKey{"operator", "Operator", &ReportHeader::operated_by},
    HeaderKey{"date", "Date", &ReportHeader::date},
    HeaderKey{"cmm", "CMM", &ReportHeader::cmm}};

// The keys of [report], all optional.
[[nodiscard]] ReportHeader read_report_header(const TomlTable& table);
// As a table of a file; empty when nothing is stated.
[[nodiscard]] std::string to_toml(const ReportHeader& header);
// What `first` states, and what `second` does where it does not.
[[nodiscard]] ReportHeader joined(const ReportHeader& first, const ReportHeader& second);

}  // namespace frustum::metrology
