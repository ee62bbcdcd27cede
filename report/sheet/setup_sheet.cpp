#include "report/sheet/setup_sheet.hpp"

#include <fmt/format.h>

#include "core/made_by.hpp"
#include "core/whole_file.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"
#include "report/sheet/setup_drawing.hpp"

namespace frustum::report {
namespace {

constexpr const char* kStyle = R"(
:root { --ink: #1b2129; --faint: #5d6875; --rule: #d9dee3; --accent: #1f5fa8; --cut: #c2410c; }
* { box-sizing: border-box; }
body { margin: 0; background: #eef0f2; color: var(--ink); font: 13.5px/1.45 "Inter", "Helvetica Neue",
  "Segoe UI", "Liberation Sans", Arial, sans-serif; font-variant-numeric: tabular-nums lining-nums; }
main { max-width: 1120px; margin: 24px auto; padding: 34px 40px 26px; background: #fff;
  border: 1px solid var(--rule); }
h1 { font: 600 24px/1.25 "Charter", "Bitstream Charter", Georgia, "Liberation Serif", serif; margin: 0; }
h2 { font-size: 12px; letter-spacing: .06em; text-transform: uppercase; color: var(--faint);
  margin: 26px 0 8px; font-weight: 600; }
.kind { color: var(--faint); margin: 0 0 2px; }
.top { display: grid; grid-template-columns: 1fr 1.15fr; gap: 28px; align-items: start; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 3px 16px; margin: 0; }
dt { color: var(--faint); } dd { margin: 0; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 6px; }
table { border-collapse: collapse; width: 100%; }
th { text-align: left; font-weight: 600; color: var(--faint); border-bottom: 1px solid var(--ink);
  padding: 3px 10px 3px 0; }
td { border-bottom: 1px solid var(--rule); padding: 3px 10px 3px 0; white-space: nowrap; }
td.wide { white-space: normal; min-width: 13em; } .n { text-align: right; }
td.b { font-weight: 600; }
.cards { display: grid; grid-template-columns: 1fr 1fr; gap: 14px 22px; }
.card { border-top: 1px solid var(--ink); padding-top: 5px; break-inside: avoid; }
.card h3 { font-size: 14px; margin: 0; display: flex; justify-content: space-between; }
.card h3 span { font-weight: 400; color: var(--faint); }
.card p { margin: 0; color: var(--faint); font-size: 12px; }
svg { width: 100%; height: auto; display: block; }
.face { stroke: #7f8b98; stroke-width: .7; stroke-linejoin: round; }
.tool { stroke: var(--accent); stroke-width: 1.2; fill: rgba(31, 95, 168, .20); }
.tool.end { fill: none; stroke-dasharray: 4 3; stroke-width: 1; }
.axis { stroke: #1b2129; stroke-width: .7; stroke-dasharray: 9 3 2 3; }
.cut { stroke: var(--cut); stroke-width: 2.2; stroke-linecap: round; } .cut-end { fill: var(--cut); }
.feed { stroke: var(--accent); stroke-width: 1.4; fill: none; } .feed-head { fill: var(--accent); }
.extension, .dimension { stroke: #5d6875; stroke-width: .7; } .dimension-head { fill: #5d6875; }
.triad { stroke: #1b2129; stroke-width: .9; } .triad-head { fill: #1b2129; }
.crossing { fill: #1b2129; }
text { font-size: 12px; fill: var(--ink); paint-order: stroke; stroke: #fff; stroke-width: 3.5px;
  stroke-linejoin: round; } .note { fill: var(--faint); } .size { fill: #3a4450; }
.axis-name { font-weight: 600; }
.legend { color: var(--faint); font-size: 12px; margin: 10px 0 0; }
.legend b.c { color: var(--cut); } .legend b.t { color: var(--accent); }
@media screen and (max-width: 760px) { .top, .cards { grid-template-columns: 1fr; } main { padding: 20px; }
  .scroll { overflow-x: auto; } }
@page { size: A4; margin: 11mm 11mm 15mm;
  @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #5d6875; } }
@media print { body { background: #fff; font-size: 8.5pt; }
  main { border: 0; margin: 0; padding: 0; max-width: none; } .cards { gap: 4px 18px; }
  h2 { margin: 12px 0 5px; break-after: avoid; } th, td { padding: 1.5px 8px 1.5px 0; } h1 { font-size: 17pt; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; } }
)";

std::string number(double mm) {
  std::string text = fixed_text(mm, 3);
  if (text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

std::string facts_of(const SetupSheet& sheet) {
  std::string html = "<dl>";
  for (const auto& [heading, text] : sheet.facts) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>", html_text(heading), html_text(text));
  }
  return html + "</dl>\n";
}

std::string step_table(const SetupSheet& sheet) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Steps\"><table><thead><tr><th>Step</th><th>Table</th>"
      "<th class=\"n\">X from</th><th class=\"n\">Y from</th><th class=\"n\">Z from</th>"
      "<th class=\"n\">X to</th><th class=\"n\">Y to</th><th class=\"n\">Z to</th>"
      "<th class=\"n\">NC lines</th><th>Cuts</th></tr></thead><tbody>\n";
  for (const SheetStep& step : sheet.steps) {
    html += fmt::format("<tr><td class=\"b\">{}</td><td>{}</td>", html_text(step.name),
                        html_text(step.table));
    for (const Vec3& p : {step.from, step.to}) {
      for (const Eigen::Index k : {0, 1, 2}) {
        html += fmt::format("<td class=\"n\">{}</td>", number(p[k]));
      }
    }
    html += fmt::format("<td class=\"n\">{}\u2013{}</td><td class=\"wide\">{}</td></tr>\n",
                        step.first_line, step.last_line, html_text(step.cuts));
  }
  return html + "</tbody></table></div>\n";
}

std::string card_of(const SetupSheet& sheet, const SheetStep& step) {
  return fmt::format(
      "<div class=\"card\"><h3>{} <span>{} \u00b7 {}</span></h3><p>{}</p>"
      "<div class=\"pair\">{}{}</div></div>\n",
      html_text(step.name), html_text(step.table), html_text(step.size), html_text(step.cuts),
      step_drawing(sheet, step, engagement_view(sheet, step)),
      step_drawing(sheet, step, SheetView::from_top));
}

}  // namespace

std::string setup_sheet(const SetupSheet& sheet) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{0}: setup sheet</title><style>{1}</style></head><body><main>\n"
      "<p class=\"kind\">Setup sheet</p><h1>{0}</h1>\n",
      html_text(sheet.title), kStyle);
  html += "<div class=\"top\"><div><h2>Setup</h2>" + facts_of(sheet) + "</div>";
  html += "<div><h2>Workpiece on the table, all rotary axes at zero</h2><div class=\"pair\">" +
          placement_drawing(sheet, sheet.tilts_about_x ? SheetView::along_x : SheetView::along_y) +
          placement_drawing(sheet, SheetView::from_top) + "</div></div></div>\n";
  html += "<h2>Steps in order, G54 positions of the tool tip in mm</h2>" + step_table(sheet);
  html += "<h2>Drawings, machine directions</h2><div class=\"cards\">\n";
  for (const SheetStep& step : sheet.steps) html += card_of(sheet, step);
  html +=
      "</div>\n<p class=\"legend\"><b class=\"c\">Red</b>: the line that the step is measured by. "
      "<b class=\"t\">Blue</b>: the tool where the pass begins (filled) and ends (dashed), and its "
      "feed; \u2297 runs away from the viewer, \u2299 toward. H: height above the tilt axis at "
      "rotary zero.</p>\n";
  return html + "<p class=\"legend\">" + made_by() + ".</p></main></body></html>\n";
}

Result<std::filesystem::path> write_setup_sheet(const std::filesystem::path& path,
                                                const SetupSheet& sheet) {
  return write_whole_file(path, setup_sheet(sheet));
}

}  // namespace frustum::report
