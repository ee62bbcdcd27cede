#include "app/serve/report_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/serve/served_file.hpp"
#include "core/made_by.hpp"
#include "core/whole_file.hpp"
#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

// Documents have the name of their page, or one of these.
constexpr const char* kDocuments[] = {"result.json", "motion.json", "sensitivity.json",
                                      "volumetric.json", "dynamics.json"};
constexpr std::uintmax_t kLargestDocument = 64U << 20U;

void describe(const fs::path& page, ListedReport& listed) {
  std::vector<fs::path> documents{fs::path(page).replace_extension(".json")};
  for (const char* name : kDocuments) documents.push_back(page.parent_path() / name);
  for (const fs::path& file : documents) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored) || fs::file_size(file, ignored) > kLargestDocument) {
      continue;
    }
    const auto text = read_whole_file(file);
    if (!text) continue;
    const auto document = nlohmann::json::parse(*text, nullptr, false);
    if (!document.is_object()) continue;
    const auto text_of = [&](const char* key) {
      const auto found = document.find(key);
      return found != document.end() && found->is_string() ? found->get<std::string>()
                                                           : std::string();
    };
    if (const std::string title = text_of("title"); !title.empty()) listed.title = title;
    const std::string schema = text_of("schema");  // "frustum/result/1"
    const auto from = schema.find('/'), to = schema.rfind('/');
    if (from < to) listed.kind = schema.substr(from + 1, to - from - 1);
    listed.verdict = text_of("verdict").empty() ? text_of("status") : text_of("verdict");
    return;
  }
}

}  // namespace

std::vector<ListedReport> reports_in(const fs::path& folder) {
  std::vector<ListedReport> reports;
  std::error_code problem;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                      problem);
  for (; !problem && at != fs::recursive_directory_iterator(); at.increment(problem)) {
    const fs::path& path = at->path();
    if (path.filename().string().starts_with('.')) {
      if (at->is_directory(problem)) at.disable_recursion_pending();
      continue;
    }
    if (path.extension() != ".html" || !at->is_regular_file(problem)) continue;
    const std::string below = path.lexically_relative(folder).generic_string();
    if (!served_file(folder, "/" + below)) continue;
    ListedReport listed{.page = below, .title = below};
    describe(path, listed);
    reports.push_back(std::move(listed));
  }
  std::ranges::sort(reports, {}, &ListedReport::page);
  return reports;
}

std::string index_html(const std::string& title, const std::vector<ListedReport>& reports) {
  using report::html_text;
  std::string rows;
  for (const ListedReport& each : reports) {
    rows +=
        fmt::format("<tr><td><a href=\"{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                    html_text(url_of(each.page)), html_text(each.title), html_text(each.kind),
                    html_text(each.verdict), html_text(each.page));
  }
  const std::string content =
      reports.empty() ? "<p>There are no pages here yet.</p>"
                      : "<div class=\"scroll\"><table><thead><tr><th scope=\"col\">report</th><th "
                        "scope=\"col\">kind</th><th scope=\"col\">verdict</th><th scope=\"col\">"
                        "file</th></tr></thead><tbody>\n" +
                            rows + "</tbody></table></div>";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0} – Frustum</title><style>{1}"
      "</style></head><body><div class=\"sheet\"><header><p class=\"brand\"><b>Frustum</b> Reports"
      "</p><div class=\"top\"><h1>{0}</h1></div></header><main><section><h2>{2} {3}</h2>{4}"
      "</section></main><footer><p>{5}.</p></footer></div></body></html>\n",
      html_text(title), report::page_style(), reports.size(),
      reports.size() == 1 ? "report" : "reports", content, made_by());
}

}  // namespace frustum::app
