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

std::string trace_section(const MotionPage& page, const Wording& words) {
  std::string content;
  if (!page.polar.empty()) {
    content += "<div class=\"pair\">" +
               polar_traces_figure(words("Polar trace"), page.polar, words) + "</div>\n";
  }
  if (!page.arrows.empty()) {
    content += "<div class=\"pair\">" +
               vector_figure(words("Displacements in the plane of the table"), page.arrows, words) +
               "</div>\n";
  }
  for (const TraceChart& chart : page.charts) content += trace_figure(chart, words);
  return content.empty() ? "" : section("traces", words("Traces"), content);
}

std::string setup_section(const MotionPage& page, const Wording& words) {
  if (!page.setup) return {};
  return section("setup", html_text(page.setup->title), bar_figure_of(*page.setup, words));
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

std::string contribution_section(const MotionPage& page, const Wording& words) {
  if (page.contributions.empty()) return {};
  return section(
      "contributions", words("Ranked contributions"),
      bar_figure(words("G of each term alone, and its share of the sum"), page.contributions) +
          table_note(words("The sum of all exceeds G where terms cancel.")));
}

std::string list_of(const std::vector<std::string>& items, const Wording& words) {
  if (items.empty()) return "<p>" + words("Nothing.") + "</p>\n";
  return "<p>" +
         html_text(fmt::format("{}", fmt::join(items, words.decimal_sign() == ',' ? "; " : ", "))) +
         ".</p>\n";
}

std::string told_section(const MotionPage& page, const Wording& words) {
  if (page.told.empty() && page.not_told.empty()) return {};
  return section("told", words("What the test identifies"),
                 "<h3>" + words("Identified, whatever the set-up") + "</h3>\n" +
                     list_of(page.told, words) + "<h3>" + words("Not identified alone") +
                     "</h3>\n" + list_of(page.not_told, words));
}

}  // namespace

std::string motion_html(const MotionPage& page) {
  const Wording words(page.style);
  std::string body = "<header><p class=\"brand\"><b>Frustum</b> " + words("Motion test") +
                     "</p>\n<div class=\"top\"><h1>" + html_text(page.title) +
                     "</h1></div><dl class=\"facts\">";
  for (const auto& [name, value] : page.facts) body += fact(html_text(name), html_text(value));
  body += "</dl></header>\n<main>";
  if (!page.remarks.empty()) {
    // Messages are in English, and a page in another language says so.
    if (page.style.language != Language::english) {
      body += "<p class=\"note\">" + words("Remarks") + "</p>\n";
    }
    body += "<ul class=\"remarks\">";
    for (const std::string& remark : page.remarks) {
      body += "<li class=\"warning\">" + html_text(remark) + "</li>";
    }
    body += "</ul>\n";
  }
  body += setup_section(page, words) + trace_section(page, words) + table_sections(page) +
          contribution_section(page, words) + told_section(page, words);
  body += page_end(words);
  return filled_page(html_text(page.title), body, "{}", words.code());
}

}  // namespace frustum::report
