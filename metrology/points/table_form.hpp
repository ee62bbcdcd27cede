// How a text of points is written: whether tabs separate its columns, whether decimals have a
// comma.
//
// Model    : a table whose every line semicolons separate, or tabs, and whose every number that has
//            decimals has a comma. A comma may also separate thousands (1,234): one number that
//            cannot be read so (0,5; 1,25; 1234,567) shows what all of them mean, else the file has
//            to say "# decimal: comma". Tabs separate, and blanks belong to names, where every
//            line has as many fields, none is empty, and no comma is in any
// Units    : none
// Shape    : a whole file
// Errors   : decimal-comma: points and commas in one table or number, commas that may separate
//            thousands: each with line and column
// Accuracy : exact
// Source   : ours
#pragma once

#include <string_view>

#include "core/result.hpp"

namespace frustum::metrology {

struct TableForm {
  char separator = 0;  // ';' or '\t' of the whole table; 0: line by line, as words_of does it
  bool has_decimal_commas = false;
};
[[nodiscard]] Result<TableForm> table_form(std::string_view text);

// "sep=;", which spreadsheets write above a table.
[[nodiscard]] bool is_separator_line(std::string_view line);

}  // namespace frustum::metrology
