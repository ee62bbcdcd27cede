// The parts of the HTML page that do not depend on the run, embedded into the library.
//
// Units: none. Errors: none.
#pragma once

#include <string_view>

namespace frustum::report {

// report/page/template.html: HTML with the places {{title}}, {{style}}, {{body}}, {{data}}, {{script}}.
[[nodiscard]] std::string_view page_template();
// One style sheet without outside references.
[[nodiscard]] std::string_view page_style();
// One script with plotly.js and three.js in it; free of "</script".
[[nodiscard]] std::string_view page_script();

}  // namespace frustum::report
