// Text of files and of the user for terminals and logs: what would move the cursor, colour the
// screen or begin a line of its own is written as \xHH.
//
// Units: none. Errors: none; bytes that are no UTF-8 stay.
#pragma once

#include <string>
#include <string_view>

namespace frustum {

// Tabs stay.
[[nodiscard]] std::string printable(std::string_view text);

// What messages and hints of diagnostics are: words that nobody reads to their end are cut short,
// of more than 40 digits, and of more than 300 characters of any kind, which is longer than names
// of files are. What is left says how long it was.
[[nodiscard]] std::string shortened(std::string text);

}  // namespace frustum
