// Derivatives in the units that people use.
// Units: inside mm and rad; outside um and urad. Errors: none.
#pragma once

#include <string>

#include "report/page/sensitivity_table.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::app {

[[nodiscard]] report::SensitivityTable sensitivity_table(const trials::Sensitivity& derivatives,
                                                         const std::string& title,
                                                         const std::string& machine,
                                                         const std::string& method);

}  // namespace frustum::app
