#include "report/html_report.hpp"

#include <map>
#include <string_view>

#include "core/whole_file.hpp"
#include "report/chart_data.hpp"
#include "report/html_sections.hpp"
#include "report/html_text.hpp"
#include "report/page_bundle.hpp"

namespace frustum::report {

std::string html_report(const RunReport& report) {
  const std::string title = html_text(report.title.empty() ? "Untitled run" : report.title);
  const std::string body = html_sections(report);
  const std::string data = json_in_script(chart_data(report));
  const std::map<std::string_view, std::string_view> contents = {{"title", title},
                                                                 {"style", page_style()},
                                                                 {"body", body},
                                                                 {"data", data},
                                                                 {"script", page_script()}};
  // Each place of the template is filled once; what is filled in is not looked at again.
  std::string page;
  std::string_view rest = page_template();
  while (true) {
    const std::size_t open = rest.find("{{");
    const std::size_t close = open == std::string_view::npos ? open : rest.find("}}", open);
    if (close == std::string_view::npos) break;
    page += rest.substr(0, open);
    const auto content = contents.find(rest.substr(open + 2, close - open - 2));
    if (content != contents.end()) page += content->second;
    rest.remove_prefix(close + 2);
  }
  page += rest;
  return page;
}

Result<std::filesystem::path> write_html_report(const std::filesystem::path& path,
                                                const RunReport& report) {
  return write_whole_file(path, html_report(report));
}

}  // namespace frustum::report
