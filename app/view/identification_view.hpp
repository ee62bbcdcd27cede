// Identified machine errors for people and for programs.
// Units: um and urad. Errors: none.
#pragma once

#include <string>

#include "app/job/identification.hpp"

namespace frustum::app {

[[nodiscard]] std::string identification_text(const Study& study, const StudyResult& result);
[[nodiscard]] std::string identification_json(const Study& study, const StudyResult& result);

}  // namespace frustum::app
