// Letters of either case: of ASCII, whatever the locale.
//
// Units : none
// Errors: none
#pragma once

#include <string>
#include <string_view>

namespace frustum::parser {

[[nodiscard]] constexpr char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
[[nodiscard]] constexpr char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] inline std::string upper_case(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = upper(c);
  return capitals;
}
[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = lower(c);
  return small;
}
// A name between < and >: RS-274 ignores its case and its blanks.
[[nodiscard]] inline std::string bare_name(std::string_view text) {
  std::string name = lower_case(text);
  std::erase_if(name, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return name;
}

}  // namespace frustum::parser
