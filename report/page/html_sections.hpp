// The static part of the page's body: head, tables and the places where the script draws.
//
// Units: as printed. Errors: none; every text from outside is escaped (html_text.hpp).
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string html_sections(const RunReport& report);

}  // namespace frustum::report
