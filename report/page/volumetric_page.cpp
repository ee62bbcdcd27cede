#include "report/page/volumetric_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/whole_file.hpp"
#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/page_parts.hpp"
#include "report/page/volume_drawing.hpp"

namespace frustum::report {
namespace {

using nlohmann::ordered_json;

// Nanometres and thousandths of a millimetre are more than a picture shows.
ordered_json rounded(const std::vector<Vec3>& vectors) {
  ordered_json list = ordered_json::array();
  const auto round = [](double x) { return std::round(x * 1e4) / 1e4; };
  for (const Vec3& v : vectors) list.push_back({round(v.x()), round(v.y()), round(v.z())});
  return list;
}

std::string volume_data(const VolumetricPage& page) {
  ordered_json positions = ordered_json::array();
  for (const VolumetricView& view : page.views) {
    positions.push_back({{"tool", rounded(view.tool)},
                         {"workpiece", rounded(view.workpiece)},
                         {"relative", rounded(view.relative)}});
  }
  const ordered_json data{{"volume",
                           {{"counts", page.counts},
                            {"places", rounded(page.places)},
                            {"factor", magnification(page)},
                            {"positions", positions}}}};
  return json_in_script(data.dump());
}

template <std::size_t columns>
std::string table(std::string_view label, const std::array<const char*, columns>& heads,
                  const std::vector<std::array<std::string, columns>>& rows, std::size_t words) {
  std::string html = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table>"
      "<thead><tr>",
      label);
  const auto cell = [&](const char* tag, std::size_t column, const std::string& text) {
    return fmt::format("<{0}{1}>{2}</{0}>", tag, column < words ? "" : " class=\"n\"",
                       html_text(text));
  };
  for (std::size_t i = 0; i < columns; ++i) html += cell("th", i, heads[i]);
  html += "</tr></thead><tbody>";
  for (const auto& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < columns; ++i) html += cell("td", i, row[i]);
    html += "</tr>";
  }
  return html + "</tbody></table></div>\n";
}

std::string figure(const VolumetricPage& page) {
  std::string html =
      "<figure class=\"surface\"><div class=\"still\">" + volume_drawing(page) +
      "</div><div class=\"view\" data-volume tabindex=\"0\" role=\"application\" "
      "aria-label=\"Grid of the working volume with error vectors, to be turned: arrow keys turn, "
      "plus and minus zoom\"></div><div class=\"tools\">";
  constexpr std::pair<const char*, const char*> kSides[] = {
      {"relative", "tool to workpiece"}, {"tool", "tool"}, {"workpiece", "workpiece"}};
  for (const auto& [side, text] : kSides) {
    html += fmt::format("<button type=\"button\" data-side=\"{}\">{}</button>", side, text);
  }
  if (page.views.size() > 1) {
    html += "<select aria-label=\"rotary position\">";
    for (std::size_t i = 0; i < page.views.size(); ++i) {
      html += fmt::format("<option value=\"{}\">{}</option>", i, html_text(page.views[i].position));
    }
    html += "</select>";
  }
  html +=
      "<button type=\"button\" data-scale=\"0.5\">Shorter</button>"
      "<button type=\"button\" data-scale=\"2\">Longer</button>"
      "<button type=\"button\" data-view=\"iso\">Oblique</button>"
      "<button type=\"button\" data-view=\"top\">Top</button>"
      "<button type=\"button\" data-view=\"front\">Front</button>"
      "<button type=\"button\" data-view=\"side\">Side</button></div>"
      "<div class=\"tools\"><output class=\"reading\"></output></div></figure>\n";
  return html +
         "<p class=\"note\">Thin lines: the grid of the linear axes as commanded. Blue: the grid "
         "displaced by the errors. Orange: the error at each point, tool to workpiece, in the "
         "directions of the machine's bed" +
         fmt::format(", drawn {:g} times as large", magnification(page)) +
         (page.views.empty() || page.views.front().position.empty()
              ? std::string()
              : ", at " + html_text(page.views.front().position)) +
         ". <span class=\"hint\">Drag or use the arrow keys to turn; + and − or the wheel with "
         "Ctrl to zoom.</span></p>\n";
}

}  // namespace

double magnification(const VolumetricPage& page) {
  double longest = 0.0;
  for (const VolumetricView& view : page.views) {
    for (const auto* vectors : {&view.tool, &view.workpiece, &view.relative}) {
      for (const Vec3& v : *vectors) longest = std::max(longest, v.norm());
    }
  }
  double diagonal = 0.0;
  for (const Vec3& p : page.places) diagonal = std::max(diagonal, (p - page.places.front()).norm());
  // Below a picometre there is nothing to draw.
  if (longest < 1e-6 || diagonal <= 0.0) return 1.0;
  const double wanted = diagonal / 8.0 / (longest / kUmPerMm);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : {5.0, 2.0}) {
    if (wanted >= step * power) return step * power;
  }
  return power;
}

std::string volumetric_html(const VolumetricPage& page) {
  std::string body =
      "<header><p class=\"brand\"><b>Frustum</b> Volumetric errors</p>\n<div class=\"top\"><h1>" +
      html_text(page.title) + "</h1></div><dl class=\"facts\">";
  for (const auto& [name, value] : page.facts) {
    body += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", html_text(name), html_text(value));
  }
  body += "</dl></header>\n<main><section><h2>Errors over the volume</h2>\n";
  body += table<4>("Errors over the volume", {"error of", "maximum, µm", "mean, µm", "95 %, µm"},
                   page.statistics, 1);
  body += "<p class=\"note\">" + html_text(page.worst) + "</p></section>\n";
  body += "<section><h2>The working volume</h2>\n" + figure(page) + "</section>\n";
  if (!page.ranking.empty()) {
    body += "<section><h2>Which errors weigh most</h2>\n";
    body += table<4>("Ranking of the errors",
                     {"error", "meaning", "gain, rms over the volume", "share of mean square"},
                     page.ranking, 2);
    body +=
        "<p class=\"note\">Gain: displacement of the tool relative to the workpiece by one µm or "
        "one "
        "µrad of the error. Share: of the mean square of that displacement over the volume, if the "
        "errors are independent, centred on zero, and their tolerances are the same multiple of "
        "their standard deviations.</p></section>\n";
  }
  body += page_end();
  return filled_page(html_text(page.title), body, volume_data(page));
}

Result<std::filesystem::path> write_volumetric_page(const std::filesystem::path& path,
                                                    const VolumetricPage& page) {
  return write_whole_file(path, volumetric_html(page));
}

}  // namespace frustum::report
