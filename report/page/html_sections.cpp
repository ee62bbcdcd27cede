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

std::string note_html(const std::string& html) { return "<p class=\"note\">" + html + "</p>\n"; }

std::string form_html(const RunReport& report, const Wording& words) {
  std::string figures;
  for (const Characteristic& c : report.measurement.characteristics) {
    if (has_polar_chart(c)) figures += polar_figure(c, words);
  }
  if (figures.empty()) return "";
  return section(
      "form", words("Form"),
      "<div class=\"pair\">" + figures + "</div>" +
          note_html(words("Deviation from the least-squares element over the angle about its axis, "
                          "outward where material is left. Grey circles, dashed: the highest and "
                          "the lowest point (no limits); drawn through: zero.")));
}

std::string profiles_html(const RunReport& report, const Wording& words) {
  std::string figures;
  for (const Characteristic& c : report.measurement.characteristics) {
    if (has_profile_chart(report, c)) figures += profile_figure(c, words);
  }
  if (figures.empty()) return "";
  return section(
      "profiles", words("Profiles"),
      "<div class=\"profiles\">" + figures + "</div>" +
          note_html(words(
              "Where two lines are compared: how far their points are from the planned lines, in "
              "the direction measured, over the place along the lines from the planned point of "
              "the first. Dashed: least-squares straight lines. A distance is that of the dashed "
              "lines at position 0, second less first.")));
}

// The picture that is there without a script, and on paper.
std::string still_html(const RunReport& report, const Wording& words) {
  PictureOptions options;
  options.width = 690;
  options.height = 428;
  options.samples = 2;
  const auto png = picture_png(report.surface, options);
  if (!png) return "";
  const auto* bytes = reinterpret_cast<const unsigned char*>(png->data());
  return "<img class=\"still\" alt=\"" +
         words("Finished workpiece coloured by its deviation from nominal") +
         "\" width=\"920\" height=\"570\" src=\"data:image/png;base64," +
         base64({bytes, png->size()}) + "\">";
}

std::string surface_html(const RunReport& report, const Wording& words) {
  if (!has_surface(report)) return "";
  const auto button = [](const char* view, const std::string& text) {
    return fmt::format("<button type=\"button\" data-view=\"{}\">{}</button>", view, text);
  };
  const std::string view = fmt::format(
      "<div class=\"view\" data-surface tabindex=\"0\" role=\"application\" aria-label=\"{}\">"
      "</div><div class=\"legend\" hidden></div><div class=\"tools\">",
      words("Finished workpiece coloured by its deviation, to be turned: arrow keys turn, plus and "
            "minus zoom"));
  const std::string hint = words(
      "Drag or use the arrow keys to turn; + and − or the wheel with Ctrl to zoom; click the "
      "surface to read its deviation.");
  return section(
      "surface", words("Workpiece"),
      "<figure class=\"surface\">" + still_html(report, words) + view +
          button("iso", words("Oblique")) + button("top", words("Top")) +
          button("front", words("Front")) + button("side", words("Side")) +
          "<output class=\"reading\"></output></div></figure>\n" +
          note_html(words("Blue: material missing; red: material left; grey: no nominal surface.") +
                    " <span class=\"hint\">" + hint + "</span>"));
}

std::string axes_html(const RunReport& report, const Wording& words) {
  if (report.traces.empty()) return "";
  std::string content;
  for (const AxisTrace& trace : report.traces) content += axis_figure(trace, words);
  Table table(words("Axis positions"), {words("Operation"), words("Axis"), ">" + words("From"),
                                        ">" + words("To"), ">" + words("Range")});
  for (const AxisTrace& trace : report.traces) {
    for (const AxisSeries& series : trace.axes) {
      const std::optional<AxisRange> range = range_of(series);
      if (!range) continue;
      const char* unit = series.rotary ? "deg" : "mm";
      const int decimals = words.is_inch() && !series.rotary ? 4 : 3;
      const auto cell = [&](double value) {
        return with_unit(words.fixed(words.shown(value, unit), decimals), unit, words);
      };
      table.row({html_text(trace.operation), "<b>" + html_text(series.axis) + "</b>",
                 cell(range->low), cell(range->high), cell(range->width())});
    }
  }
  return section("axes", words("Axis positions"), content + table.html());
}

std::string errors_html(const RunReport& report, const Wording& words) {
  if (report.errors.empty() && report.machine.empty()) return "";  // no machine tool was simulated
  if (report.errors.empty()) {
    return section("errors", words("Injected errors"),
                   fmt::format("<p>{}</p>\n", words("None: the machine is geometrically ideal.")));
  }
  Table table(words("Injected errors"), {words("Error"), words("Value"), words("Meaning")});
  for (const InjectedError& injected : report.errors) {
    table.row({"<code>" + html_text(injected.name) + "</code>", html_text(injected.written),
               html_text(words.sentence(injected.meaning))});
  }
  return section("errors", words("Injected errors"), table.html());
}

std::string features_html(const RunReport& report, const Wording& words) {
  if (report.measurement.features.empty()) return "";
  Table table(words("Features"),
              {words("Feature"), words("Element"), ">" + words("Points"), ">" + words("Radius"),
               ">" + words("Half angle"), ">" + words("Form"), ">" + words("RMS")});
  for (const metrology::MeasuredFeature& feature : report.measurement.features) {
    const auto parameter = [&](const char* name, double scale, const char* unit) -> std::string {
      const auto found = feature.parameters.find(name);
      if (found == feature.parameters.end() || found->second.size() != 1) return "";
      return with_unit(words.value(found->second.front() * scale, unit), unit, words);
    };
    table.row({"<b>" + html_text(feature.name) + "</b>", html_text(words.word(feature.kind)),
               std::to_string(feature.points.size()), parameter("radius", 1.0, "mm"),
               parameter("half_angle", kDegPerRad, "deg"),
               with_unit(words.value(feature.form * kUmPerMm, "um"), "um", words),
               with_unit(words.value(feature.rms * kUmPerMm, "um"), "um", words)});
  }
  return section("features", words("Features"), table.html());
}

std::string cycle_html(const RunReport& report, const Wording& words) {
  if (!report.cycle_time || report.slowed.empty()) return "";
  const std::string unit = words.symbol("mm/min");
  Table table(words("Slowed blocks"),
              {">" + words("Line"), words("Axis"), ">" + words("Programmed feed, {0}", unit),
               ">" + words("Reached feed, {0}", unit)});
  const auto feed = [&](double value) {
    return words.fixed(words.shown(value, "mm/min"), words.is_inch() ? 2 : 0);
  };
  // The worst are shown; the JSON document has them all.
  const std::size_t shown = std::min<std::size_t>(report.slowed.size(), 20);
  for (std::size_t k = 0; k < shown; ++k) {
    const SlowedBlock& block = report.slowed[k];
    table.row({std::to_string(block.line), html_text(block.axis), feed(block.programmed_feed),
               feed(block.reached_feed)});
  }
  const std::size_t count = report.slowed.size();
  return section("cycle",
                 count == 1 ? words("Slowed by axis limits: 1 block")
                            : words("Slowed by axis limits: {0} blocks", count),
                 table.html());
}

std::string collisions_html(const RunReport& report, const Wording& words) {
  const std::string bodies =
      report.machine_bodies
          ? "<p>" + html_text(machine_bodies_text(*report.machine_bodies, words)) + "</p>\n"
          : "";
  if (report.collisions.empty()) {
    return bodies.empty() ? "" : section("collisions", words("Collisions"), bodies);
  }
  Table table(words("Collisions"), {">" + words("Line"), words("Collision")});
  for (const Collision& collision : report.collisions) {
    table.row(
        {collision.line > 0 ? std::to_string(collision.line) : "–", html_text(collision.text)});
  }
  return section("collisions", words("Collisions"), table.html() + bodies);
}

std::string remarks_html(const RunReport& report, const Wording& words) {
  std::string items;
  const auto add = [&](std::string_view kind, const std::string& text) {
    items += fmt::format("<li class=\"{}\">{}</li>\n", kind, html_text(text));
  };
  for (const Diagnostic& d : report.diagnostics) add(to_string(d.severity), to_string(d));
  for (const Diagnostic& d : report.measurement.diagnostics)
    add(to_string(d.severity), to_string(d));
  for (const std::string& note : report.notes) add("note", note);
  if (items.empty()) return "";
  return section("remarks", words("Remarks"), "<ul class=\"remarks\">" + items + "</ul>\n");
}

std::string process_html(const RunReport& report, const Wording& words) {
  std::string columns;
  const auto column = [&](std::string_view heading, const Table& table) {
    columns += fmt::format("<div><h3>{}</h3>{}</div>", heading, table.html());
  };
  const Volumes& volumes = report.volumes;
  if (volumes.blank || volumes.finished || volumes.removed) {
    Table table(words("Volumes"),
                {words("Volume"), words.is_inch() ? ">" + words.symbol("mm3") : ">cm³"});
    const auto row = [&](Phrase name, const std::optional<double>& mm3) {
      if (!mm3) return;
      table.row({words(name), words.is_inch() ? words.fixed(words.shown(*mm3, "mm3"), 4)
                                              : words.fixed(*mm3 / 1e3, 3)});
    };
    row("Blank", volumes.blank);
    row("Removed", volumes.removed);
    row("Finished", volumes.finished);
    column(words("Volumes"), table);
  }
  if (!report.budget.empty()) {
    Table table(words("Numbers budget"),
                {words("Approximation"), ">" + words("Bound"), ">" + words("Worst seen")});
    for (const BudgetEntry& entry : report.budget) {
      const auto cell = [&](double value) {
        if (!std::isfinite(value)) return std::string("–");
        const double shown = words.shown(value, entry.unit);
        return with_unit(words.number(fmt::format("{:.3g}", shown)), entry.unit, words);
      };
      table.row({html_text(words.word(entry.name)), cell(entry.bound),
                 entry.worst ? cell(*entry.worst) : ""});
    }
    column(words("Numbers budget"), table);
  }
  if (!report.timings.empty()) {
    Table table(words("Timings"), {words("Step"), ">" + words("Time")});
    double sum = 0.0;
    for (const Timing& timing : report.timings) {
      table.row(
          {html_text(words.word(timing.name)), with_unit(words.fixed(timing.seconds, 2), "s")});
      sum += timing.seconds;
    }
    table.row(
        {"<b>" + words("Together") + "</b>", "<b>" + with_unit(words.fixed(sum, 2), "s") + "</b>"});
    column(words("Timings"), table);
  }
  if (columns.empty()) return "";
  return section("process", words("Process"), "<div class=\"columns\">" + columns + "</div>\n");
}

}  // namespace

std::string html_sections(const RunReport& report) {
  const Wording words(report.style);
  std::string html = head_html(report, words) + "<main>\n";
  html += characteristics_html(report, words);
  html += measuring_html(report, words);
  html += cycle_html(report, words);
  html += collisions_html(report, words);
  html += form_html(report, words);
  html += profiles_html(report, words);
  html += surface_html(report, words);
  html += errors_html(report, words);
  html += axes_html(report, words);
  html += features_html(report, words);
  html += process_html(report, words);
  html += remarks_html(report, words);
  html += "</main>\n<footer><p>" + words("Made by Frustum");
  if (!report.version.empty()) html += " " + html_text(report.version);
  html +=
      words(
          ". Workpiece view: three.js (MIT licence). The notices of all bundled packages are in "
          "the source of this page.") +
      "</p></footer>\n";
  return html;
}

}  // namespace frustum::report
