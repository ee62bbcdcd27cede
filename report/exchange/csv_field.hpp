// A text as one field of a CSV file.
//
// Units: none. Errors: none.
#pragma once

#include <string>

namespace frustum::report {

// One with a separator, quote, comment sign or line end is quoted as RFC 4180 says.
[[nodiscard]] std::string csv_field(const std::string& text);

}  // namespace frustum::report
