// A tool in words, in the language and the units of a report.
//
// Units  : as the text says. Errors: none
#pragma once

#include <string>

#include "cutter/body/cutter_spec.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// "flat end mill, diameter 12 mm, length 150 mm"; those of the other words as cutter::description.
[[nodiscard]] std::string tool_text(const cutter::CutterSpec& tool, const Wording& words);

}  // namespace frustum::report
