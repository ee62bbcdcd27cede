#include "report/page/dynamics_page.hpp"

#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/page_parts.hpp"

namespace frustum::report {
namespace {

std::string note_of(const std::string& text) {
  return text.empty() ? "" : "<p class=\"note\">" + html_text(text) + "</p>\n";
}

std::string table_of(const DynamicsTable& table) {
  Table html(html_text(table.heading), table.columns);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const std::string& cell : row) cells.push_back(html_text(cell));
    html.row(cells);
  }
  return section(table.id, table.heading, html.html() + note_of(table.note));
}

std::string responses_of(const DynamicsPage& page) {
  std::string content;
  for (const FrequencyChart& chart : page.responses) content += frequency_figure(chart);
  if (content.empty()) return {};
  return section(
      "responses", "Frequency responses of the tip",
      content + note_of("Motion of the tool against the workpiece for a force on the tool, "
                        "its reaction on the workpiece. Grey: 2 % of the direct response; "
                        "below it a hammer that is askew by 1° shows nothing. Dashed: "
                        "measured."));
}

std::string maps_of(const DynamicsPage& page) {
  if (page.maps.empty()) return {};
  std::string content;
  for (const HeatMap& map : page.maps) content += heat_map_figure(map);
  content += box_figure("Over the working space", page.box_scale, page.boxes);
  return section("map", "Over the working space", content);
}

std::string modes_of(const DynamicsPage& page) {
  if (page.modes.empty()) return {};
  std::string content;
  for (const ModeDrawing& mode : page.modes) {
    // What moves is shown to those who open it.
    content += "<details><summary>" + html_text(mode.title) + "</summary>\n" + mode_figure(mode) +
               "</details>\n";
  }
  return section(
      "modes", "Shapes of the modes",
      content + note_of("Each body is the even box that has its mass and inertia, the bed "
                        "in grey. The swing is enlarged."));
}

}  // namespace

std::string dynamics_html(const DynamicsPage& page) {
  std::string body =
      "<header><p class=\"brand\"><b>Frustum</b> Dynamics of a machine</p>\n"
      "<div class=\"top\"><h1>" +
      html_text(page.title) + "</h1></div><dl class=\"facts\">";
  for (const auto& [name, value] : page.facts) body += fact(html_text(name), html_text(value));
  body += "</dl></header>\n<main>";
  for (const DynamicsTable& table : page.tables) body += table_of(table);
  body += responses_of(page) + maps_of(page) + modes_of(page);
  body += page_end();
  return filled_page(html_text(page.title), body, "{}");
}

}  // namespace frustum::report
