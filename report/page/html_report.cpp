#include "report/page/html_report.hpp"

#include "core/whole_file.hpp"
#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/chart_data.hpp"
#include "report/page/html_sections.hpp"

namespace frustum::report {

std::string html_report(const RunReport& report) {
  const Wording words(report.style);
  const std::string title = html_text(report.title.empty() ? words("Untitled run") : report.title);
  const std::string body = html_sections(report);
  const std::string data = json_in_script(chart_data(report));
  return filled_page(title, body, data, words.code());
}

Result<std::filesystem::path> write_html_report(const std::filesystem::path& path,
                                                const RunReport& report) {
  return write_whole_file(path, html_report(report));
}

}  // namespace frustum::report
