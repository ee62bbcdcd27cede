// What the sections of a page are made of: tables, facts, numbers with units.
//
// Units: as printed. Errors: none; texts from outside are to be escaped before (html_text.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "metrology/measurement.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// cards: on a narrow screen each row becomes a block whose cells say what they are.
enum class TableStyle { rows, cards };

// A table row by row; cells are HTML already.
class Table {
 public:
  // A heading that starts with '>' is over a column of numbers. `label` is read out for a table
  // that is scrolled.
  Table(std::string_view label, const std::vector<std::string>& headings,
        TableStyle style = TableStyle::rows);
  void row(const std::vector<std::string>& cells);
  [[nodiscard]] std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::string html_;
  std::vector<std::string> headings_;
  std::vector<bool> numbers_;
};

[[nodiscard]] std::string section(std::string_view id, std::string_view heading,
                                  const std::string& content);
// A number as people write it: with a minus sign, a narrow space and the unit's symbol; "–" for
// none.
[[nodiscard]] std::string with_unit(const std::string& number, std::string_view unit);
// The same with the unit that is shown for `unit`; the number is in that already.
[[nodiscard]] std::string with_unit(const std::string& number, std::string_view unit,
                                    const Wording& words);
// <div><dt>name</dt><dd>value</dd></div>; nothing for an empty value.
[[nodiscard]] std::string fact(std::string_view name, const std::string& value);
// What ends the main part of a page: the version that made it.
[[nodiscard]] std::string page_end(const Wording& words = Wording());
// "Pass", "Fail", "Uncertain".
[[nodiscard]] std::string capital(metrology::Verdict verdict, const Wording& words);

}  // namespace frustum::report
