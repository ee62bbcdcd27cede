// The parts of the page that a metrologist asks for first: whose part and whether it conforms, the
// characteristics, how was measured and from which files.
//
// Units: as printed. Errors: none; every text from outside is escaped (html_text.hpp).
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string head_html(const RunReport& report, const Wording& words);
[[nodiscard]] std::string characteristics_html(const RunReport& report, const Wording& words);
// Machine, probe, alignment, filter, uncertainty, decision rule; fingerprints of the files.
[[nodiscard]] std::string measuring_html(const RunReport& report, const Wording& words);

}  // namespace frustum::report
