#include "report/page/html_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"
#include "report/page/chart_data.hpp"

namespace frustum::report {
namespace {

using Characteristic = metrology::CharacteristicResult;

// A table row by row; cells are HTML already.
class Table {
 public:
  // A heading that starts with '>' is over a column of numbers.
  explicit Table(const std::vector<std::string>& headings) {
    html_ = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string& heading : headings) {
      const bool is_number = heading.front() == '>';
      numbers_.push_back(is_number);
      html_ += fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"n\"" : "",
                           heading.substr(is_number ? 1 : 0));
    }
    html_ += "</tr></thead><tbody>\n";
  }
  void row(const std::vector<std::string>& cells) {
    html_ += "<tr>";
    for (std::size_t k = 0; k < cells.size(); ++k) {
      html_ += fmt::format("<td{}>{}</td>", numbers_[k] ? " class=\"n\"" : "", cells[k]);
    }
    html_ += "</tr>\n";
  }
  [[nodiscard]] std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::string html_;
  std::vector<bool> numbers_;
};

std::string section(std::string_view id, std::string_view heading, const std::string& content) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, heading, content);
}

std::string with_unit(const std::string& number, std::string_view unit) {
  const std::string symbol = html_text(unit_symbol(unit));
  if (number == "-") return "–";
  const std::string shown = number.front() == '-' ? "\u2212" + number.substr(1) : number;
  if (symbol.empty() || symbol == "°") return shown + symbol;
  return shown + "\u202f" + symbol;
}

std::string_view capital(metrology::Verdict verdict) {
  constexpr std::array<std::string_view, 3> kWords{"Pass", "Fail", "Uncertain"};
  return kWords.at(static_cast<std::size_t>(verdict));
}

std::string verdict_mark(metrology::Verdict verdict) {
  return fmt::format("<span class=\"mark {}\">{}</span>", metrology::name_of(verdict),
                     capital(verdict));
}

std::string fact(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value);
}

std::string head_html(const RunReport& report) {
  const auto& characteristics = report.measurement.characteristics;
  const auto passed = std::count_if(characteristics.begin(), characteristics.end(),
                                    [](const Characteristic& c) { return c.pass; });
  std::size_t points = 0;
  for (const auto& feature : report.measurement.features) points += feature.points.size();
  std::string reason =
      fmt::format("{} of {} characteristics within tolerance", passed, characteristics.size());
  if (!report.collisions.empty()) {
    reason += fmt::format(", {} collision{}", report.collisions.size(),
                          report.collisions.size() == 1 ? "" : "s");
  }
  std::string tools;
  for (const auto& [number, tool] : report.tools) {
    tools += fmt::format("{}T{} {}", tools.empty() ? "" : "<br>", number,
                         html_text(cutter::description(tool)));
  }
  const metrology::Verdict verdict = report.verdict();
  const std::string title = html_text(report.title.empty() ? "Untitled run" : report.title);
  std::string html = "<header><p class=\"brand\"><b>Frustum</b> Measurement report</p>\n";
  html +=
      fmt::format("<div class=\"top\"><h1>{}</h1><p class=\"verdict {}\"><b>{}</b>{}</p></div>\n",
                  title, metrology::name_of(verdict), capital(verdict), reason);
  html += "<dl class=\"facts\">";
  html += fact("Machine", html_text(report.machine));
  html += fact("Structure",
               report.structure.empty() ? "" : "<code>" + html_text(report.structure) + "</code>");
  html += fact("Program", html_text(report.program));
  html += fact("Tool", tools);
  html += fact("Points probed", points > 0 ? std::to_string(points) : "");
  html += fact("Cycle time", report.cycle_time ? duration_text(*report.cycle_time) : "");
  return html + "</dl></header>\n";
}

// How much of the tolerance is used, as a number and a bar that ends at the limit.
std::string used_cell(const Characteristic& characteristic) {
  const std::optional<double> used = used_share(characteristic);
  if (!used) return "–";
  return fmt::format(
      "<span class=\"used\"><span class=\"bar\"><i class=\"{}\" style=\"width:{:.0f}%\"></i></span>"
      "{}\u202f%</span>",
      metrology::name_of(characteristic.verdict()), 100.0 * std::min(*used, 1.0),
      fixed_text(100.0 * *used, 0));
}

std::string characteristics_html(const RunReport& report) {
  if (report.measurement.characteristics.empty()) return "";
  const auto& all = report.measurement.characteristics;
  const bool nominals = std::any_of(
      all.begin(), all.end(), [](const Characteristic& c) { return !nominal_text(c).empty(); });
  std::vector<std::string> headings{"Characteristic", ">Value"};
  if (nominals) headings.emplace_back(">Nominal");
  const bool intervals = std::any_of(
      all.begin(), all.end(), [](const Characteristic& c) { return c.simulated.has_value(); });
  headings.emplace_back(">Tolerance");
  headings.emplace_back(">U (k = 2)");
  if (intervals) headings.emplace_back(">95\u202f% interval");
  headings.emplace_back(">Used");
  headings.emplace_back("Verdict");
  Table table(headings);
  for (const Characteristic& c : all) {
    const std::string kind =
        c.kind.empty() ? "" : fmt::format("<small>{}</small>", html_text(c.kind));
    std::vector<std::string> cells{fmt::format("<b>{}</b>{}", html_text(c.name), kind),
                                   with_unit(result_text(c), c.unit)};
    if (nominals) {
      cells.push_back(nominal_text(c).empty() ? "" : with_unit(nominal_text(c), c.unit));
    }
    cells.push_back((c.nominal ? "± " : "") + with_unit(value_text(c.tolerance, c.unit), c.unit));
    cells.push_back(with_unit(uncertainty_text(c.expanded_uncertainty), c.unit));
    if (intervals) cells.push_back(c.simulated ? with_unit(interval_text(c), c.unit) : "");
    cells.push_back(used_cell(c));
    cells.push_back(verdict_mark(c.verdict()));
    table.row(cells);
  }
  return section("characteristics", "Characteristics",
                 table.html() +
                     "<p class=\"note\">U is the expanded measurement uncertainty (k = 2). Used: "
                     "share of the tolerance taken by the value, or by its distance from the "
                     "nominal where there is one." +
                     (intervals ? " The interval holds the true value in 95\u202f% of measurements "
                                  "(Monte Carlo)."
                                : std::string()) +
                     "</p>\n");
}

std::string form_html(const RunReport& report) {
  std::string figures;
  std::size_t index = 0;
  for (const Characteristic& c : report.measurement.characteristics) {
    if (!has_polar_chart(c)) continue;
    figures += fmt::format(
        "<figure class=\"polar\"><figcaption><b>{}</b><span class=\"scale\"></span></figcaption>"
        "<div class=\"chart\" data-polar=\"{}\"></div></figure>\n",
        html_text(c.name), index++);
  }
  if (figures.empty()) return "";
  return section(
      "form", "Form",
      "<div class=\"pair\">" + figures +
          "</div><p class=\"note\">Deviation from the least-squares element over the "
          "angle about its axis, outward where material is left. Dashed: zero deviation; "
          "dotted: largest and smallest.</p>\n");
}

std::string profiles_html(const RunReport& report) {
  std::string figures;
  std::size_t index = 0;
  for (const Characteristic& c : report.measurement.characteristics) {
    if (!has_profile_chart(report, c)) continue;
    figures += fmt::format(
        "<figure class=\"profile\"><figcaption><b>{}</b> <span class=\"scale\">{}</span>"
        "</figcaption><div class=\"chart\" data-profile=\"{}\"></div></figure>\n",
        html_text(c.name), with_unit(result_text(c), c.unit), index++);
  }
  if (figures.empty()) return "";
  return section(
      "profiles", "Profiles",
      "<div class=\"profiles\">" + figures +
          "</div><p class=\"note\">Where two lines are compared: how far their points are from the "
          "planned lines, in the direction measured, over the place along the lines from the "
          "planned point of the first. Dashed: least-squares straight lines. A distance is that of "
          "the dashed lines at position 0, second less first.</p>\n");
}

std::string surface_html(const RunReport& report) {
  if (!has_surface(report)) return "";
  return section(
      "surface", "Workpiece",
      "<figure class=\"surface\"><div class=\"view\" data-surface tabindex=\"0\" role=\"img\" "
      "aria-label=\"Finished workpiece coloured by deviation\"></div>"
      "<div class=\"legend\" hidden></div><div class=\"tools\">"
      "<button type=\"button\" data-view=\"iso\">Oblique</button>"
      "<button type=\"button\" data-view=\"top\">Top</button>"
      "<button type=\"button\" data-view=\"front\">Front</button>"
      "<button type=\"button\" data-view=\"side\">Side</button>"
      "<output class=\"reading\"></output></div></figure>\n"
      "<p class=\"note\">Drag to turn, wheel to zoom, right button to move; click the surface to "
      "read its deviation. Blue: material missing; red: material left; grey: no nominal "
      "surface.</p>\n");
}

std::string axes_html(const RunReport& report) {
  if (report.traces.empty()) return "";
  std::string content;
  for (std::size_t k = 0; k < report.traces.size(); ++k) {
    content += fmt::format(
        "<figure class=\"axes\"><figcaption><b>{}</b></figcaption>"
        "<div class=\"chart\" data-trace=\"{}\"></div></figure>\n",
        html_text(report.traces[k].operation), k);
  }
  Table table({"Operation", "Axis", ">From", ">To", ">Range"});
  for (const AxisTrace& trace : report.traces) {
    for (const AxisSeries& series : trace.axes) {
      const std::optional<AxisRange> range = range_of(series);
      if (!range) continue;
      const char* unit = series.rotary ? "deg" : "mm";
      const auto cell = [&](double value) { return with_unit(fixed_text(value, 3), unit); };
      table.row({html_text(trace.operation), "<b>" + html_text(series.axis) + "</b>",
                 cell(range->low), cell(range->high), cell(range->width())});
    }
  }
  return section("axes", "Axis positions", content + table.html());
}

std::string errors_html(const RunReport& report) {
  if (report.errors.empty()) {
    return section("errors", "Injected errors",
                   "<p>None: the machine is geometrically ideal.</p>\n");
  }
  Table table({"Error", "Value", "Meaning"});
  for (const InjectedError& injected : report.errors) {
    table.row({"<code>" + html_text(injected.name) + "</code>", html_text(injected.written),
               html_text(injected.meaning)});
  }
  return section("errors", "Injected errors", table.html());
}

std::string features_html(const RunReport& report) {
  if (report.measurement.features.empty()) return "";
  Table table({"Feature", "Element", ">Points", ">Radius", ">Half angle", ">Form", ">RMS"});
  for (const metrology::MeasuredFeature& feature : report.measurement.features) {
    const auto parameter = [&](const char* name, double scale, const char* unit) -> std::string {
      const auto found = feature.parameters.find(name);
      if (found == feature.parameters.end() || found->second.size() != 1) return "";
      return with_unit(value_text(found->second.front() * scale, unit), unit);
    };
    table.row({"<b>" + html_text(feature.name) + "</b>", html_text(feature.kind),
               std::to_string(feature.points.size()), parameter("radius", 1.0, "mm"),
               parameter("half_angle", kDegPerRad, "deg"),
               with_unit(value_text(feature.form * kUmPerMm, "um"), "um"),
               with_unit(value_text(feature.rms * kUmPerMm, "um"), "um")});
  }
  return section("features", "Features", table.html());
}

std::string cycle_html(const RunReport& report) {
  if (!report.cycle_time || report.slowed.empty()) return "";
  Table table({">Line", "Axis", ">Programmed feed, mm/min", ">Reached feed, mm/min"});
  // The worst are shown; the JSON document has them all.
  const std::size_t shown = std::min<std::size_t>(report.slowed.size(), 20);
  for (std::size_t k = 0; k < shown; ++k) {
    const SlowedBlock& block = report.slowed[k];
    table.row({std::to_string(block.line), html_text(block.axis),
               fixed_text(block.programmed_feed, 0), fixed_text(block.reached_feed, 0)});
  }
  return section("cycle",
                 fmt::format("Slowed by axis limits: {} block{}", report.slowed.size(),
                             report.slowed.size() == 1 ? "" : "s"),
                 table.html());
}

std::string collisions_html(const RunReport& report) {
  if (report.collisions.empty()) return "";
  Table table({">Line", "Collision"});
  for (const Collision& collision : report.collisions) {
    table.row(
        {collision.line > 0 ? std::to_string(collision.line) : "–", html_text(collision.text)});
  }
  return section("collisions", "Collisions", table.html());
}

std::string remarks_html(const RunReport& report) {
  std::string items;
  const auto add = [&](std::string_view kind, const std::string& text) {
    items += fmt::format("<li class=\"{}\">{}</li>\n", kind, html_text(text));
  };
  for (const Diagnostic& d : report.diagnostics) add(to_string(d.severity), to_string(d));
  for (const Diagnostic& d : report.measurement.diagnostics)
    add(to_string(d.severity), to_string(d));
  for (const std::string& note : report.notes) add("note", note);
  if (items.empty()) return "";
  return section("remarks", "Remarks", "<ul class=\"remarks\">" + items + "</ul>\n");
}

std::string process_html(const RunReport& report) {
  std::string columns;
  const auto column = [&](std::string_view heading, const Table& table) {
    columns += fmt::format("<div><h3>{}</h3>{}</div>", heading, table.html());
  };
  const Volumes& volumes = report.volumes;
  if (volumes.blank || volumes.finished || volumes.removed) {
    Table table({"Volume", ">cm³"});
    const auto row = [&](const char* name, const std::optional<double>& mm3) {
      if (mm3) table.row({name, fixed_text(*mm3 / 1e3, 3)});
    };
    row("Blank", volumes.blank);
    row("Removed", volumes.removed);
    row("Finished", volumes.finished);
    column("Volumes", table);
  }
  if (!report.budget.empty()) {
    Table table({"Approximation", ">Bound", ">Worst seen"});
    for (const BudgetEntry& entry : report.budget) {
      const auto cell = [&](double value) {
        return std::isfinite(value) ? with_unit(fmt::format("{:.3g}", value), entry.unit) : "–";
      };
      table.row({html_text(entry.name), cell(entry.bound), entry.worst ? cell(*entry.worst) : ""});
    }
    column("Numbers budget", table);
  }
  if (!report.timings.empty()) {
    Table table({"Step", ">Time"});
    double sum = 0.0;
    for (const Timing& timing : report.timings) {
      table.row({html_text(timing.name), with_unit(fixed_text(timing.seconds, 2), "s")});
      sum += timing.seconds;
    }
    table.row({"<b>Together</b>", "<b>" + with_unit(fixed_text(sum, 2), "s") + "</b>"});
    column("Timings", table);
  }
  if (columns.empty()) return "";
  return section("process", "Process", "<div class=\"columns\">" + columns + "</div>\n");
}

}  // namespace

std::string html_sections(const RunReport& report) {
  std::string html = head_html(report) + "<main>\n";
  html += characteristics_html(report);
  html += cycle_html(report);
  html += collisions_html(report);
  html += form_html(report);
  html += profiles_html(report);
  html += surface_html(report);
  html += errors_html(report);
  html += axes_html(report);
  html += features_html(report);
  html += process_html(report);
  html += remarks_html(report);
  html += "</main>\n<footer><p>Made by Frustum";
  if (!report.version.empty()) html += " " + html_text(report.version);
  html +=
      ". Charts: plotly.js (MIT licence). Workpiece view: three.js (MIT licence). The notices of "
      "all "
      "bundled packages are in the source of this page.</p></footer>\n";
  return html;
}

}  // namespace frustum::report
