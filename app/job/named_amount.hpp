// "beta_CA=5urad": an error's name and an amount that suits it, 0 or more.
//
// Units  : as written; mm and rad inside
// Errors : of the text, with the option that it is of; names that the machine does not have
#pragma once

#include <string>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

struct NamedAmount {
  std::string name{};
  double amount = 0.0;
};
[[nodiscard]] Result<NamedAmount> named_amount(const kinematics::Machine& machine,
                                               const std::string& text, const char* option);

}  // namespace frustum::app
