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

}  // namespace frustum
