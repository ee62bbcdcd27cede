#include "parser/writing/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/decimal.hpp"

namespace frustum::parser {

std::string fixed(double value, int decimals, WholeNumbers ending) {
  std::string text = with_point(fixed_decimal(value, decimals));
  text.erase(text.find_last_not_of('0') + 1);
  if (ending == WholeNumbers::without_point && text.back() == '.') text.pop_back();
  return text;
}

std::string significant(double value, int digits) {
  const int before =
      value == 0.0 ? 1 : 1 + static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixed(value, std::max(0, digits - before), WholeNumbers::without_point);
}

std::string with_sign(std::string number) {
  return number.starts_with('-') ? number : "+" + std::move(number);
}

std::string with_point(std::string number) {
  return number.find('.') != std::string::npos ? number : std::move(number) + '.';
}

}  // namespace frustum::parser
