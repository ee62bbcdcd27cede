// What each check means at the machine, and what to do about it: for those who meet a finding where
// its document is not at hand.
//
// Units : none
// Errors: none
#pragma once

#include <string_view>

#include "lint/check.hpp"

namespace frustum::lint {

struct CheckHelp {
  std::string_view meaning{};
  std::string_view remedy{};
};

[[nodiscard]] CheckHelp help_of(Check check);

}  // namespace frustum::lint
