#include "report/page/html_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base64.hpp"
#include "core/units.hpp"
#include "report/chart/axis_chart.hpp"
#include "report/chart/polar_chart.hpp"
#include "report/chart/profile_chart.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"
#include "report/page/chart_data.hpp"
#include "report/page/page_parts.hpp"
#include "report/page/result_sections.hpp"
#include "report/picture/picture.hpp"

namespace frustum::report {
namespace {

using Characteristic = metrology::CharacteristicResult;

std::string form_html(const RunReport& report) {
  std::string figures;
  for (const Characteristic& c : report.measurement.characteristics) {
    if (has_polar_chart(c)) figures += polar_figure(c);
  }
  if (figures.empty()) return "";
  return section("form", "Form",
                 "<div class=\"pair\">" + figures +
                     "</div><p class=\"note\">Deviation from the least-squares element over the "
                     "angle about its axis, outward where material is left. Grey circles, dashed: "
                     "the highest and the lowest point (no limits); drawn through: zero.</p>\n");
}

std::string profiles_html(const RunReport& report) {
  std::string figures;
  for (const Characteristic& c : report.measurement.characteristics) {
    if (has_profile_chart(report, c)) figures += profile_figure(c);
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

// The picture that is there without a script, and on paper.
std::string still_html(const RunReport& report) {
  PictureOptions options;
  options.width = 690;
  options.height = 428;
  options.samples = 2;
  const auto png = picture_png(report.surface, options);
  if (!png) return "";
  const auto* bytes = reinterpret_cast<const unsigned char*>(png->data());
  return "<img class=\"still\" alt=\"Finished workpiece coloured by its deviation from nominal\" "
         "width=\"920\" height=\"570\" src=\"data:image/png;base64," +
         base64({bytes, png->size()}) + "\">";
}

std::string surface_html(const RunReport& report) {
  if (!has_surface(report)) return "";
  return section(
      "surface", "Workpiece",
      "<figure class=\"surface\">" + still_html(report) +
          "<div class=\"view\" data-surface tabindex=\"0\" role=\"application\" "
          "aria-label=\"Finished workpiece coloured by its deviation, to be turned: arrow keys "
          "turn, plus and minus zoom\"></div>"
          "<div class=\"legend\" hidden></div><div class=\"tools\">"
          "<button type=\"button\" data-view=\"iso\">Oblique</button>"
          "<button type=\"button\" data-view=\"top\">Top</button>"
          "<button type=\"button\" data-view=\"front\">Front</button>"
          "<button type=\"button\" data-view=\"side\">Side</button>"
          "<output class=\"reading\"></output></div></figure>\n"
          "<p class=\"note\">Blue: material missing; red: material left; grey: no nominal "
          "surface. <span class=\"hint\">Drag or use the arrow keys to turn; + and − or the wheel "
          "with Ctrl to zoom; click the surface to read its deviation.</span></p>\n");
}

std::string axes_html(const RunReport& report) {
  if (report.traces.empty()) return "";
  std::string content;
  for (const AxisTrace& trace : report.traces) content += axis_figure(trace);
  Table table("Axis positions", {"Operation", "Axis", ">From", ">To", ">Range"});
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
  if (report.errors.empty() && report.machine.empty()) return "";  // no machine tool was simulated
  if (report.errors.empty()) {
    return section("errors", "Injected errors",
                   "<p>None: the machine is geometrically ideal.</p>\n");
  }
  Table table("Injected errors", {"Error", "Value", "Meaning"});
  for (const InjectedError& injected : report.errors) {
    table.row({"<code>" + html_text(injected.name) + "</code>", html_text(injected.written),
               html_text(injected.meaning)});
  }
  return section("errors", "Injected errors", table.html());
}

std::string features_html(const RunReport& report) {
  if (report.measurement.features.empty()) return "";
  Table table("Features",
              {"Feature", "Element", ">Points", ">Radius", ">Half angle", ">Form", ">RMS"});
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
  Table table("Slowed blocks",
              {">Line", "Axis", ">Programmed feed, mm/min", ">Reached feed, mm/min"});
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
  const std::string bodies =
      report.machine_bodies
          ? "<p>" + html_text(machine_bodies_text(*report.machine_bodies)) + "</p>\n"
          : "";
  if (report.collisions.empty()) {
    return bodies.empty() ? "" : section("collisions", "Collisions", bodies);
  }
  Table table("Collisions", {">Line", "Collision"});
  for (const Collision& collision : report.collisions) {
    table.row(
        {collision.line > 0 ? std::to_string(collision.line) : "–", html_text(collision.text)});
  }
  return section("collisions", "Collisions", table.html() + bodies);
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
    Table table("Volumes", {"Volume", ">cm³"});
    const auto row = [&](const char* name, const std::optional<double>& mm3) {
      if (mm3) table.row({name, fixed_text(*mm3 / 1e3, 3)});
    };
    row("Blank", volumes.blank);
    row("Removed", volumes.removed);
    row("Finished", volumes.finished);
    column("Volumes", table);
  }
  if (!report.budget.empty()) {
    Table table("Numbers budget", {"Approximation", ">Bound", ">Worst seen"});
    for (const BudgetEntry& entry : report.budget) {
      const auto cell = [&](double value) {
        return std::isfinite(value) ? with_unit(fmt::format("{:.3g}", value), entry.unit) : "–";
      };
      table.row({html_text(entry.name), cell(entry.bound), entry.worst ? cell(*entry.worst) : ""});
    }
    column("Numbers budget", table);
  }
  if (!report.timings.empty()) {
    Table table("Timings", {"Step", ">Time"});
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
  html += measuring_html(report);
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
      ". Workpiece view: three.js (MIT licence). The notices of all bundled packages are in the "
      "source of this page.</p></footer>\n";
  return html;
}

}  // namespace frustum::report
