#include "report/page/history_page.hpp"

#include <fmt/format.h>

#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/page_parts.hpp"

namespace frustum::report {
namespace {

std::string history_table(const HistoryTable& table, TableStyle style) {
  if (table.rows.empty()) return {};
  Table html(table.heading, table.columns, style);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const std::string& cell : row) cells.push_back(html_text(cell));
    html.row(cells);
  }
  const std::string note =
      table.note.empty() ? "" : "<p class=\"note\">" + html_text(table.note) + "</p>\n";
  return section(table.id, html_text(table.heading), html.html() + note);
}

std::string listed(const std::vector<std::string>& texts, const char* kind) {
  if (texts.empty()) return {};
  std::string html = "<ul class=\"remarks\">";
  for (const std::string& text : texts) {
    html += fmt::format("<li class=\"{}\">{}</li>", kind, html_text(text));
  }
  return html + "</ul>\n";
}

constexpr Phrase kChartNote =
    "Dots: as found; rings: as left after an adjustment, which do not enter the limits; orange: "
    "beyond a limit or the tolerance; whiskers: 95 % interval of the value, where it is stated. "
    "Grey, dashed: control limits, mean ± 2.66 times the mean moving range, below them the moving "
    "ranges with their limit of 3.267 times their mean (ISO 7870-2). Red, dashed: tolerance, where "
    "it is near. Green, dashed: least-squares trend.";

}  // namespace

std::string history_html(const HistoryPage& page) {
  const Wording words(page.style);
  const char* const verdict = page.passes ? "pass" : "fail";
  std::string body = fmt::format(
      "<header><p class=\"brand\"><b>Frustum</b> {}</p>\n<div class=\"top\">"
      "<h1>{}</h1><p class=\"verdict {}\"><b>{}</b>{}</p></div><dl class=\"facts\">",
      words("History of a machine"), html_text(page.title), verdict,
      page.passes ? words("Pass") : words("Fail"), html_text(page.reason));
  for (const auto& [name, value] : page.facts) body += fact(html_text(name), html_text(value));
  body += "</dl></header>\n<main>" + history_table(page.values, TableStyle::cards);
  if (!page.failures.empty()) {
    body += section("failures", words("What fails"), listed(page.failures, "error"));
  }
  std::string charts;
  for (const ControlChart& chart : page.charts) charts += control_figure(chart, words);
  if (!charts.empty()) {
    body += section("charts", words("Control charts"),
                    charts + "<p class=\"note\">" + html_text(words(kChartNote)) + "</p>\n");
  }
  for (const HistoryTable& table : page.tables) body += history_table(table, TableStyle::rows);
  if (!page.remarks.empty()) {
    body += section("remarks", words("Remarks"), listed(page.remarks, "warning"));
  }
  body += page_end(words);
  return filled_page(html_text(page.title), body, "{}", words.code());
}

}  // namespace frustum::report
