#include "app/job/named_amount.hpp"

#include <fmt/format.h>

#include <cmath>

#include "trials/parameter.hpp"

namespace frustum::app {

Result<NamedAmount> named_amount(const kinematics::Machine& machine, const std::string& text,
                                 const char* option) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    return error("malformed-option"_id, fmt::format("{} {}: expected NAME=VALUE", option, text),
                 "for example gamma_YX=5urad");
  }
  const auto parameter = trials::Parameter::named(machine, text.substr(0, equals));
  if (!parameter) return parameter.error();
  const std::string amount = text.substr(equals + 1);
  double value = 0.0;
  if (amount == "0") return NamedAmount{parameter->name, value};  // of either kind
  if (parameter->angular) {
    const auto angle = parse_angle(amount);
    if (!angle) return angle.error();
    value = angle->value;
  } else {
    const auto length = parse_length(amount);
    if (!length) return length.error();
    value = length->value;
  }
  if (!(value >= 0.0) || !std::isfinite(value)) {
    return error("out-of-range"_id, fmt::format("{} {}: must be 0 or more", option, text),
                 "a standard deviation has no sign");
  }
  return NamedAmount{parameter->name, value};
}

}  // namespace frustum::app
