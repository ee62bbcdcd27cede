#include "report/exchange/dfq_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/form_parameter.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

using metrology::CharacteristicResult;

// A nanometre, or its like in the other units.
int decimals_of(const std::string& unit) {
  struct Row {
    std::string_view unit;
    int decimals;
  };
  constexpr std::array kRows{Row{"um", 4}, Row{"mm", 7}, Row{"deg", 8}, Row{"urad", 3}};
  for (const Row& row : kRows) {
    if (row.unit == unit) return row.decimals;
  }
  return 6;
}

class DfqText {
 public:
  void field(const char* key, const std::string& value) {
    text_ += fmt::format("{} {}\n", key, value);
  }
  void field(const char* key, std::size_t number, const std::string& value) {
    text_ += fmt::format("{}/{} {}\n", key, number, value);
  }
  void decimal(const char* key, std::size_t number, double value, int decimals) {
    if (std::isfinite(value)) field(key, number, fixed_text(value, decimals));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// "23.11.2026/14:05:00" of "2026-11-23T14:05:00" and of "2026-11-23T14:05:00Z", as the field has no
// place for a time zone; nothing of a date without a time of day.
std::string time_text(const std::string& date) {
  if (date.size() < std::string_view("2026-11-23T14:05:00").size()) return {};
  return date.substr(8, 2) + '.' + date.substr(5, 2) + '.' + date.substr(0, 4) + '/' +
         date.substr(11, 8);
}

// What a characteristic has no field of its own for, in one.
std::string value_remark(const CharacteristicResult& c) {
  std::string text = parameter_text(c.kind, c.parameter);
  if (const auto doubt = doubt_of(c); !doubt.empty()) {
    text += fmt::format("{}coverage of the uncertainty: {}", text.empty() ? "" : "; ", doubt);
  }
  return text;
}

void describe(DfqText& dfq, std::size_t n, const CharacteristicResult& c) {
  const int decimals = decimals_of(c.unit);
  const double nominal = c.nominal.value_or(0.0);
  dfq.field("K2001", n, std::to_string(n));
  dfq.field("K2002", n, readable_text(c.name));
  dfq.field("K2022", n, std::to_string(decimals));
  dfq.decimal("K2101", n, nominal, decimals);
  if (c.nominal) dfq.decimal("K2110", n, nominal - c.tolerance, decimals);
  dfq.decimal("K2111", n, nominal + c.tolerance, decimals);
  dfq.field("K2142", n, readable_text(c.unit));
  if (const std::string text = value_remark(c); !text.empty()) dfq.field("K2900", n, text);
}

void add_value(DfqText& dfq, std::size_t n, const CharacteristicResult& c,
               const metrology::ReportHeader& header) {
  const bool is_measured = outcome_of(c) != Outcome::not_measured;
  dfq.decimal("K0001", n, is_measured ? c.value : 0.0, decimals_of(c.unit));
  dfq.field("K0002", n, is_measured ? "0" : "255");
  if (const std::string time = time_text(header.date); !time.empty()) dfq.field("K0004", n, time);
  if (!header.serial_number.empty()) dfq.field("K0014", n, readable_text(header.serial_number));
  if (!header.order.empty()) dfq.field("K0053", n, readable_text(header.order));
}

// All facts in the part's remark: the format has fields of their own for few of them.
std::string remark(const RunReport& report) {
  std::string text;
  for (const Fact& fact : all_facts(report.evidence, report.version)) {
    text += (text.empty() ? "" : "; ") + fact.label + ": " + fact.value;
  }
  return readable_text(text);
}

}  // namespace

std::string dfq_report(const RunReport& report) {
  const auto& characteristics = report.measurement.characteristics;
  DfqText dfq;
  dfq.field("K0100", std::to_string(characteristics.size()));
  const metrology::ReportHeader& header = report.evidence.header;
  dfq.field("K1001", readable_text(header.part_number.empty() ? report.title : header.part_number));
  dfq.field("K1002", readable_text(header.part.empty() ? report.title : header.part));
  if (!header.order.empty()) dfq.field("K1053", readable_text(header.order));
  if (const std::string text = remark(report); !text.empty()) dfq.field("K1900", text);
  for (std::size_t i = 0; i < characteristics.size(); ++i) describe(dfq, i + 1, characteristics[i]);
  for (std::size_t i = 0; i < characteristics.size(); ++i) {
    add_value(dfq, i + 1, characteristics[i], header);
  }
  // Readers take a file without a mark for one of the code page of their computer.
  const std::string& text = dfq.text();
  const bool is_ascii = std::all_of(text.begin(), text.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x80U; });
  return (is_ascii ? "" : "\xEF\xBB\xBF") + text;
}

}  // namespace frustum::report
