#include "report/page/motion_page.hpp"

#include <fmt/format.h>

#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/page_parts.hpp"

namespace frustum::report {
namespace {

std::string table_note(const std::string& text) {
  return text.empty() ? "" : "<p class=\"note\">" + html_text(text) + "</p>\n";
}

// A number with the sign that printers use.
std::string with_minus(const std::string& cell) {
  const bool negative = cell.size() > 1 && cell[0] == '-' && cell[1] >= '0' && cell[1] <= '9';
  return negative ? "\u2212" + cell.substr(1) : cell;
}

std::string trace_section(const MotionPage& page) {
  std::string content;
  if (!page.polar.empty()) {
    content += "<div class=\"pair\">" + polar_traces_figure("Polar trace", page.polar) + "</div>\n";
  }
  if (!page.arrows.empty()) {
    content += "<div class=\"pair\">" +
               vector_figure("Displacements in the plane of the table", page.arrows) + "</div>\n";
  }
  for (const TraceChart& chart : page.charts) content += trace_figure(chart);
  return content.empty() ? "" : section("traces", "Traces", content);
}

std::string setup_section(const MotionPage& page) {
  if (!page.setup) return {};
  return section("setup", html_text(page.setup->title), bar_figure_of(*page.setup));
}

std::string table_sections(const MotionPage& page) {
  std::string html;
  for (std::size_t k = 0; k < page.tables.size(); ++k) {
    const MotionTable& each = page.tables[k];
    Table table(each.heading, each.columns);
    for (const auto& row : each.rows) {
      std::vector<std::string> cells;
      for (const std::string& cell : row) cells.push_back(html_text(with_minus(cell)));
      table.row(cells);
    }
    html += section(fmt::format("table-{}", k + 1), html_text(each.heading),
                    table.html() + table_note(each.note));
  }
  return html;
}

std::string contribution_section(const MotionPage& page) {
  if (page.contributions.empty()) return {};
  return section("contributions", "Ranked contributions",
                 bar_figure("G of each term alone, and its share of the sum", page.contributions) +
                     table_note("The sum of all exceeds G where terms cancel."));
}

std::string list_of(const std::vector<std::string>& items) {
  if (items.empty()) return "<p>Nothing.</p>\n";
  return "<p>" + html_text(fmt::format("{}", fmt::join(items, ", "))) + ".</p>\n";
}

std::string told_section(const MotionPage& page) {
  if (page.told.empty() && page.not_told.empty()) return {};
  return section("told", "What the test tells",
                 "<h3>Identified, whatever the set-up</h3>\n" + list_of(page.told) +
                     "<h3>Not identified alone</h3>\n" + list_of(page.not_told));
}

}  // namespace

std::string motion_html(const MotionPage& page) {
  std::string body =
      "<header><p class=\"brand\"><b>Frustum</b> Motion test</p>\n<div class=\"top\"><h1>" +
      html_text(page.title) + "</h1></div><dl class=\"facts\">";
  for (const auto& [name, value] : page.facts) body += fact(html_text(name), html_text(value));
  body += "</dl></header>\n<main>";
  if (!page.remarks.empty()) {
    body += "<ul class=\"remarks\">";
    for (const std::string& remark : page.remarks) {
      body += "<li class=\"warning\">" + html_text(remark) + "</li>";
    }
    body += "</ul>\n";
  }
  body += setup_section(page) + trace_section(page) + table_sections(page) +
          contribution_section(page) + told_section(page);
  body += page_end();
  return filled_page(html_text(page.title), body, "{}");
}

}  // namespace frustum::report
