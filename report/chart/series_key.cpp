#include "report/chart/series_key.hpp"

#include <fmt/format.h>

#include "report/html/html_text.hpp"

namespace frustum::report {

std::string series_class(std::string_view kind, std::size_t series) {
  return fmt::format("{} s{}", kind, series % kSeriesColours + 1);
}

std::string series_key(const std::vector<std::string>& names,
                       const std::vector<std::string>& marks) {
  if (names.empty()) return {};
  std::string html = "<span class=\"key\">";
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string kind = k < marks.size() ? marks[k] : "";
    html += fmt::format("<span class=\"{}\">{}</span>", series_class(kind, k), html_text(names[k]));
  }
  return html + "</span>";
}

}  // namespace frustum::report
