// A text as one field of a CSV file.
//
// Units: none. Errors: none.
#pragma once

#include <string>

namespace frustum::report {

// One with a separator, quote, comment sign or line end is quoted as RFC 4180 says. A text that
// spreadsheets would take for a formula, beginning with = + - @ or a tab, gets an apostrophe before
// it; so that it can be taken off again (point_file.hpp), one that begins with such an apostrophe
// gets another.
[[nodiscard]] std::string csv_field(const std::string& text);

}  // namespace frustum::report
