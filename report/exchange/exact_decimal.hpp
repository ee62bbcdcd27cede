// Numbers as files hold them: the shortest digits that read back to the same double, never an
// exponent.
//
// Units: none. Errors: none; call it for finite numbers only (others give "0").
#pragma once

#include <string>

namespace frustum::report {

[[nodiscard]] std::string exact_decimal(double value);

}  // namespace frustum::report
