#include "report/page/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "core/base64.hpp"
#include "report/csv_field.hpp"
#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/page_parts.hpp"

namespace frustum::report {
namespace {

// A link to the numbers of a figure, which are in the page itself.
std::string csv_link(const std::string& name, const std::string& csv) {
  const std::span bytes(reinterpret_cast<const unsigned char*>(csv.data()), csv.size());
  return fmt::format(
      "<p class=\"csv\"><a download=\"{0}\" href=\"data:text/csv;base64,{1}\">{0}</a></p>\n",
      html_text(name), base64(bytes));
}

std::string file_name(std::string text) {
  for (char& c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && c != '.' && c != '_') c = '-';
  }
  return text;
}

std::string note(const std::string& html) { return "<p class=\"note\">" + html + "</p>"; }

std::string titled(const std::string& name, const std::string& unit, const Wording& words) {
  return name + ", " + words.symbol(unit);
}

void shows(std::vector<double>& values, const std::string& unit, const Wording& words) {
  for (double& value : values) value = words.shown(value, unit);
}

BoxRow shown_box(const StudyPageCharacteristic& c, const Wording& words) {
  BoxRow row = c.box;
  for (double* value : {&row.min, &row.low, &row.middle, &row.high, &row.max}) {
    *value = words.shown(*value, c.unit);
  }
  shows(row.limits, c.unit, words);
  return row;
}

std::string table_section(const StudyPage& page, const Wording& words) {
  Table table(words("Characteristics"),
              {words("characteristic"), ">5 %", ">" + words("median (95 % interval)"), ">95 %",
               ">" + words("limit"), ">" + words("conforming (95 % interval)")},
              TableStyle::cards);
  for (const StudyPageCharacteristic& c : page.characteristics) {
    std::vector<std::string> cells{html_text(titled(c.name, c.unit, words))};
    for (const std::string& text : c.row) cells.push_back(html_text(text));
    table.row(cells);
  }
  std::string content = table.html();
  if (!page.all_conform.empty()) {
    content += note(words("Parts within all limits: {0}.", html_text(page.all_conform))) + "\n";
  }
  if (!page.remarks.empty()) {
    content += "<ul class=\"remarks\">";
    for (const std::string& remark : page.remarks) {
      content += fmt::format("<li class=\"warning\">{}</li>", html_text(remark));
    }
    content += "</ul>\n";
  }
  return section("characteristics", words("What the machines make"), content);
}

// Boxes of one unit share a scale.
std::string box_section(const StudyPage& page, const Wording& words) {
  std::map<std::string, std::vector<BoxRow>> by_unit;
  std::string csv = "characteristic,unit,min,q1,median,q3,max,lower_limit,upper_limit\n";
  for (const StudyPageCharacteristic& c : page.characteristics) {
    by_unit[c.unit].push_back(shown_box(c, words));
    const auto& limits = c.box.limits;  // upper, or lower and upper
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(c.name), c.unit, c.box.min,
                       c.box.low, c.box.middle, c.box.high, c.box.max,
                       limits.size() < 2 ? "" : fmt::format("{}", limits.front()),
                       limits.empty() ? "" : fmt::format("{}", limits.back()));
  }
  std::string content;
  for (const auto& [unit, rows] : by_unit) {
    content += box_figure(words("Smallest, quartiles, largest, {0}", words.symbol(unit)),
                          words.symbol(unit), rows, words);
  }
  content += csv_link("boxes.csv", csv);
  content += note(
      words("Each box holds the middle half of the machines, its bar is the median; the whiskers "
            "reach the smallest and the largest value. Dashed: the limits, where they are near."));
  return section("boxes", words("Box plots"), content);
}

std::string distribution_section(const StudyPage& page, const Wording& words) {
  std::string content;
  for (const StudyPageCharacteristic& c : page.characteristics) {
    if (c.distribution.value.empty()) continue;
    DistributionLine line = c.distribution;
    shows(line.value, c.unit, words);
    shows(line.limits, c.unit, words);
    content += distribution_figure(c.name, titled(c.name, c.unit, words), line, words);
    std::string csv = fmt::format("value_{},share,low,high\n", c.unit);
    for (std::size_t i = 0; i < c.distribution.value.size(); ++i) {
      const double p = c.distribution.p[i], w = c.distribution.half_width;
      csv += fmt::format("{},{},{},{}\n", c.distribution.value[i], p, std::max(0.0, p - w),
                         std::min(1.0, p + w));
    }
    content += csv_link(file_name(c.name) + ".distribution.csv", csv);
  }
  content += note(
      words("The share of machines whose value is not larger. With 95 % confidence the whole line "
            "of all machines is in the band (Dvoretzky, Kiefer, Wolfowitz)."));
  return section("distributions", words("Distributions"), content);
}

std::string risk_section(const StudyPage& page, const Wording& words) {
  // What is rarer would be an empty picture.
  constexpr double kShownRisk = 1e-4;
  const auto is_shown = [](const RiskCurve& curve) {
    const auto counts = [](double risk) { return risk > kShownRisk; };
    return std::ranges::any_of(curve.consumer, counts) ||
           std::ranges::any_of(curve.producer, counts);
  };
  std::string content, without;
  for (const StudyPageCharacteristic& c : page.characteristics) {
    if (!c.risk) continue;
    if (!is_shown(*c.risk)) {
      without += (without.empty() ? "" : ", ") + html_text(c.name);
      continue;
    }
    content += risk_figure(c.name, *c.risk, words);
    std::string csv = "guard_U,consumer,producer\n";
    for (std::size_t i = 0; i < c.risk->guard.size(); ++i) {
      csv += fmt::format("{},{},{}\n", c.risk->guard[i], c.risk->consumer[i], c.risk->producer[i]);
    }
    content += csv_link(file_name(c.name) + ".risk.csv", csv);
  }
  if (!without.empty()) {
    content += note(words("Both risks are below {0} with any of these guard bands: {1}.",
                          words.general(kShownRisk), without)) +
               "\n";
  }
  if (content.empty()) return {};
  return section("risks", words("What a guard band costs"), content);
}

std::string scatter_section(const StudyPage& page, const Wording& words) {
  if (!page.scatter) return {};
  const auto& [along, up] = *page.scatter;
  std::string csv = csv_field(along.title) + "," + csv_field(up.title) + "\n";
  for (std::size_t i = 0; i < along.values.size(); ++i) {
    csv += fmt::format("{},{}\n", along.values[i], up.values[i]);
  }
  const auto& [shown_along, shown_up] = page.shown_scatter ? *page.shown_scatter : *page.scatter;
  return section("scatter", words("Two characteristics of each machine"),
                 scatter_figure(words("{0} over {1}", shown_up.title, shown_along.title),
                                shown_along, shown_up, words) +
                     csv_link("scatter.csv", csv) +
                     note(words("The first machines of the study. Dashed: limits.")));
}

std::string share_section(const StudyPage& page, const Wording& words) {
  if (page.shares.empty()) return {};
  std::string csv = "errors,total,mean_square\n";
  for (const TornadoRow& row : page.shares) {
    csv += fmt::format("{},{},{}\n", csv_field(row.label), row.total, row.share);
  }
  return section(
      "shares", words("Which errors make it"),
      tornado_figure(words("Errors of {0}", page.share_characteristic), page.shares, words) +
          csv_link("shares.csv", csv) +
          note(words("Total index: the share of the variance that would be left if all other "
                     "errors were known. Share of the mean square: of the deviations of all "
                     "points; these shares add up to 1.")));
}

std::string allocation_section(const StudyPage& page, const Wording& words) {
  if (page.allocation.empty()) return {};
  Table table(words("Tolerances"), {words("errors"), ">" + words("factor on their tolerances")});
  for (const auto& [group, factor] : page.allocation) table.row({html_text(group), factor});
  return section("allocation", words("Tolerances that would do"),
                 table.html() + note(html_text(page.allocation_text)) + "\n");
}

std::string map_section(const StudyPage& page, const Wording& words) {
  if (page.maps.empty()) return {};
  const HeatMap& first = page.maps.front();
  std::string csv =
      "quantity," + csv_field(first.row_title) + "," + csv_field(first.column_title) + ",value\n";
  std::string content;
  for (const HeatMap& map : page.shown_maps.empty() ? page.maps : page.shown_maps) {
    content += heat_map_figure(map, words);
  }
  for (const HeatMap& map : page.maps) {
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      if (!map.values[i]) continue;
      csv += fmt::format("{},{},{},{}\n", csv_field(map.title),
                         csv_field(map.rows[i / map.columns.size()]),
                         csv_field(map.columns[i % map.columns.size()]), *map.values[i]);
    }
  }
  content += csv_link("set-ups.csv", csv);
  content += note(
      words("Signal: root mean square of all points' deviations over all machines. Errors that "
            "show: how many of them, alone and at their limits, make 1 µm of form or more. "
            "Directions: in how many independent ways the deviations scatter (participation "
            "ratio). A strong signal in few directions does not separate one error from another."));
  return section("maps", words("Set-ups"), content);
}

}  // namespace

std::string study_html(const StudyPage& page) {
  const Wording words(page.style);
  std::string body = "<header><p class=\"brand\"><b>Frustum</b> " +
                     words("Study of many machines") + "</p>\n<div class=\"top\"><h1>" +
                     html_text(page.title) + "</h1></div><dl class=\"facts\">";
  for (const auto& [name, value] : page.facts) body += fact(html_text(name), html_text(value));
  body += "</dl></header>\n<main>" + table_section(page, words) + box_section(page, words) +
          distribution_section(page, words) + scatter_section(page, words) +
          risk_section(page, words) + share_section(page, words) + allocation_section(page, words) +
          map_section(page, words);
  body += page_end(words);
  return filled_page(html_text(page.title), body, "{}", words.code());
}

}  // namespace frustum::report
