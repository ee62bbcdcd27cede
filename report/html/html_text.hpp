// Text made safe for the places of an HTML page.
//
// Units: none. Errors: none; control characters become spaces, bytes that are not UTF-8 become
//        U+FFFD.
#pragma once

#include <string>
#include <string_view>

namespace frustum::report {

// UTF-8 without control characters, for writers that make references of & < > themselves.
[[nodiscard]] std::string readable_text(std::string_view text);

// For element content and quoted attributes: & < > " ' are written as references.
[[nodiscard]] std::string html_text(std::string_view text);

// JSON for a <script type="application/json"> element: no "<" is left that could end it.
[[nodiscard]] std::string json_in_script(std::string_view json);

}  // namespace frustum::report
