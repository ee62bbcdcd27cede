// The parts of the HTML page that do not depend on what it shows, embedded into the library.
//
// Units: none. Errors: none.
#pragma once

#include <string>
#include <string_view>

namespace frustum::report {

// report/page/template.html: HTML with the places {{language}}, {{title}}, {{style}}, {{body}},
// {{data}}, {{script}}.
[[nodiscard]] std::string_view page_template();
// One style sheet without outside references.
[[nodiscard]] std::string_view page_style();
// One script with three.js in it; free of "</script".
[[nodiscard]] std::string_view page_script();

// The template filled: title and body are HTML, data is JSON that may be in a script element.
[[nodiscard]] std::string filled_page(std::string_view title, std::string_view body,
                                      std::string_view data, std::string_view language = "en");

}  // namespace frustum::report
