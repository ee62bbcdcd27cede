// The numbers that most of a long program consists of: digits and a point, without sign or
// exponent.
//
// Units : none
// Errors: none; nothing where there is no digit
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace frustum::parser {

struct PlainNumber {
  double value = 0.0;
  bool decimal_point = false;
  const char* end = nullptr;  // behind it
};

// The number that begins at `start`.
[[nodiscard]] inline std::optional<PlainNumber> read_plain_number(const char* start,
                                                                  const char* end) {
  constexpr std::array kPowersOfTen{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* at = start;
  std::uint64_t digits = 0;
  const auto read_digits = [&] {
    for (; at != end && *at >= '0' && *at <= '9'; ++at) {
      digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
    }
  };
  read_digits();
  const bool decimal_point = at != end && *at == '.';
  std::size_t decimals = 0;
  if (decimal_point) {
    const char* const behind_point = ++at;
    read_digits();
    decimals = static_cast<std::size_t>(at - behind_point);
  }
  const auto length = static_cast<std::size_t>(at - start);
  if (length == (decimal_point ? 1U : 0U)) return std::nullopt;
  // Up to 15 digits are a whole number without loss, which one division by a power of ten rounds as
  // the decimal number is.
  if (length < kPowersOfTen.size()) {
    return PlainNumber{static_cast<double>(digits) / kPowersOfTen[decimals], decimal_point, at};
  }
  double value = 0.0;
  if (std::from_chars(start, at, value).ec != std::errc{}) return std::nullopt;
  return PlainNumber{value, decimal_point, at};
}

}  // namespace frustum::parser
