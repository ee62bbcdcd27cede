#include "report/csv_field.hpp"

namespace frustum::report {
namespace {

bool looks_like_formula(const std::string& text) {
  const auto first = text.find_first_not_of('\'');
  return first != std::string::npos &&
         std::string_view("=+-@\t").find(text[first]) != std::string_view::npos;
}

}  // namespace

std::string csv_field(const std::string& name) {
  const std::string text = looks_like_formula(name) ? '\'' + name : name;
  if (text.find_first_of(",;#\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace frustum::report
