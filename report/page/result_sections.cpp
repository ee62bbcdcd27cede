#include "report/page/result_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "report/form_parameter.hpp"
#include "report/html/html_text.hpp"
#include "report/html/tolerance_symbol.hpp"
#include "report/number_text.hpp"
#include "report/page/page_parts.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

using Characteristic = metrology::CharacteristicResult;

std::string verdict_mark(metrology::Verdict verdict) {
  return fmt::format("<span class=\"mark {}\">{}</span>", metrology::name_of(verdict),
                     capital(verdict));
}

// The head of a form: what is not stated is there, too, to be seen as such.
std::string stated_facts(const RunReport& report) {
  std::string html;
  for (const metrology::HeaderKey& row : metrology::kHeaderKeys) {
    const std::string& value = report.evidence.header.*row.value;
    html += fact(row.label,
                 value.empty() ? "<span class=\"none\">not stated</span>" : html_text(value));
  }
  return html;
}

std::string made_facts(const RunReport& report) {
  std::size_t points = 0;
  for (const auto& feature : report.measurement.features) points += feature.points.size();
  std::string tools;
  for (const auto& [number, tool] : report.tools) {
    tools += fmt::format("{}T{} {}", tools.empty() ? "" : "<br>", number,
                         html_text(cutter::description(tool)));
  }
  std::string html = fact("Machine tool", html_text(report.machine));
  html += fact("Structure",
               report.structure.empty() ? "" : "<code>" + html_text(report.structure) + "</code>");
  html += fact("Program", html_text(report.program));
  html += fact("Tool", tools);
  html += fact("Points probed", points > 0 ? std::to_string(points) : "");
  return html + fact("Cycle time", report.cycle_time ? duration_text(*report.cycle_time) : "");
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

std::string value_cell(const Characteristic& c) {
  const std::string text = with_unit(result_text(c), c.unit);
  if (!c.without_seam) return text;
  return fmt::format("<span>{}<small>{} without the seam at {:g}° ± {:g}°</small></span>", text,
                     with_unit(value_text(c.without_seam->value, c.unit), c.unit),
                     c.without_seam->at * kDegPerRad, c.without_seam->within * kDegPerRad);
}

// `words` in small letters below.
std::string remarked(const std::string& text, std::string_view words) {
  return words.empty() ? text : fmt::format("<span>{}<small>{}</small></span>", text, words);
}

std::string page_uncertainty_cell(const Characteristic& c, bool is_unstated) {
  const std::string text =
      c.is_accuracy_unknown ? "–" : with_unit(uncertainty_text(c.expanded_uncertainty), c.unit);
  return remarked(text, is_unstated ? "not stated" : doubt_of(c));
}

std::string interval_cell(const Characteristic& c) {
  if (!c.interval) return "";
  return remarked(with_unit(interval_text(c), c.unit),
                  c.is_value_in_interval() ? "" : "corrected, without the value");
}

// What U and the interval say, and of which values they do not.
std::string uncertainty_note(const std::vector<Characteristic>& all) {
  std::string note =
      "U is the expanded measurement uncertainty: value ± U holds the true value in 95\u202f% of "
      "measurements";
  const auto any = [&](auto holds) { return std::any_of(all.begin(), all.end(), holds); };
  if (any([](const Characteristic& c) { return !doubt_of(c).empty(); })) {
    note += "; of those beside which “not proven” stands that is not shown";
  }
  note += ".";
  if (any([](const Characteristic& c) { return c.interval.has_value(); })) {
    note +=
        " The interval holds it too; of forms and zones, which noise makes larger, it reaches "
        "farther down than up, and 95\u202f% is the least.";
  }
  if (any([](const Characteristic& c) { return !c.is_value_in_interval(); })) {
    note +=
        " One without the value is corrected for a known bias of the measurement; the value is "
        "not.";
  }
  return note;
}

}  // namespace

std::string head_html(const RunReport& report) {
  std::string reason = counts_text(report.measurement);
  if (!report.collisions.empty()) {
    reason += fmt::format("{}{} collision{}", reason.empty() ? "" : ", ", report.collisions.size(),
                          report.collisions.size() == 1 ? "" : "s");
  }
  const metrology::Verdict verdict = report.verdict();
  const std::string title = html_text(report.title.empty() ? "Untitled run" : report.title);
  std::string html = "<header><p class=\"brand\"><b>Frustum</b> Measurement report</p>\n";
  html +=
      fmt::format("<div class=\"top\"><h1>{}</h1><p class=\"verdict {}\"><b>{}</b>{}</p></div>\n",
                  title, metrology::name_of(verdict), capital(verdict), reason);
  return html + "<dl class=\"facts\">" + stated_facts(report) + "</dl>\n<dl class=\"facts made\">" +
         made_facts(report) + "</dl></header>\n";
}

std::string characteristics_html(const RunReport& report) {
  if (report.measurement.characteristics.empty()) return "";
  const auto& all = report.measurement.characteristics;
  const bool nominals = std::any_of(
      all.begin(), all.end(), [](const Characteristic& c) { return !nominal_text(c).empty(); });
  const bool is_unstated = has_no_uncertainty(report.measurement);
  std::vector<std::string> headings{"Characteristic", ">Value"};
  const bool geometric =
      std::ranges::any_of(all, [](const Characteristic& c) { return c.geometric.has_value(); });
  if (geometric) headings.emplace_back(">Geometric");
  if (nominals) headings.emplace_back(">Nominal");
  const bool intervals = std::any_of(
      all.begin(), all.end(), [](const Characteristic& c) { return c.interval.has_value(); });
  headings.emplace_back(">Tolerance");
  const bool is_unknown = is_accuracy_unknown(report.measurement);
  headings.emplace_back(is_unknown ? ">U" : ">U (95\u202f%)");
  if (intervals) headings.emplace_back(">95\u202f% interval");
  headings.emplace_back(">Used");
  headings.emplace_back("Verdict");
  Table table("Characteristics", headings, TableStyle::cards);
  for (const Characteristic& c : all) {
    std::string words = kind_text(c);
    if (const std::string subject = subject_text(c); !subject.empty()) words += " of " + subject;
    const std::string kind =
        c.kind.empty() ? "" : fmt::format("<small>{}</small>", html_text(words));
    std::vector<std::string> cells{fmt::format("<span class=\"what\">{}<span><b>{}</b>{}</span>"
                                               "</span>",
                                               tolerance_symbol(c.kind), html_text(c.name), kind),
                                   value_cell(c)};
    if (geometric) {
      cells.push_back(c.geometric ? with_unit(value_text(*c.geometric, c.unit), c.unit) : "");
    }
    if (nominals) {
      cells.push_back(nominal_text(c).empty() ? "" : with_unit(nominal_text(c), c.unit));
    }
    cells.push_back((c.nominal ? "± " : "") + with_unit(value_text(c.tolerance, c.unit), c.unit));
    cells.push_back(page_uncertainty_cell(c, is_unstated));
    if (intervals) cells.push_back(interval_cell(c));
    cells.push_back(used_cell(c));
    cells.push_back(verdict_mark(c.verdict()));
    table.row(cells);
  }
  std::string notes;
  for (const Fact& fact : report.evidence.measuring) {
    if (fact.key == "decision_rule") notes += "Decision rule: " + html_text(fact.value) + ". ";
  }
  if (!is_unknown) notes += uncertainty_note(all) + " ";
  notes +=
      "Used: share of the tolerance taken by the value, or by its distance from the nominal where "
      "there is one.";
  if (geometric) {
    notes +=
        " Geometric: what the way of milling leaves where the machine makes no error; the value "
        "holds it.";
  }
  std::string warning;
  if (is_unknown) {
    warning =
        "<p class=\"caution\"><b>U is not known: no accuracy of the CMM is stated.</b> Nothing is "
        "said of how far the values are from the truth. State it by <code>--e0</code> and "
        "<code>--l-per-um</code>, or by <code>--cmm</code>.</p>\n";
  } else if (is_unstated) {
    warning =
        "<p class=\"caution\"><b>U = 0: no error of the CMM is stated.</b> The values are those of "
        "an ideal machine; no real CMM measures so. State one by <code>e0</code> and "
        "<code>l_per_um</code>.</p>\n";
  }
  return section("characteristics", "Characteristics",
                 warning + table.html() + "<p class=\"note\">" + notes + "</p>\n");
}

std::string measuring_html(const RunReport& report) {
  const Evidence& evidence = report.evidence;
  std::string html;
  if (const std::vector<Fact> facts = made_and_measured(evidence); !facts.empty()) {
    html += "<dl class=\"statement\">";
    for (const Fact& stated : facts) {
      html += fact(stated.label, html_text(stated.value));
    }
    html += "</dl>\n";
  }
  if (!evidence.files.empty()) {
    Table table("Files", {"File", "Name", "SHA-256"});
    for (const HashedFile& file : evidence.files) {
      table.row({html_text(file.role), html_text(file.name),
                 "<code class=\"hash\">" + fingerprint_text(file) + "</code>"});
    }
    html += "<h3>Files</h3>" + table.html();
  }
  return html.empty() ? "" : section("measuring", "How it was measured", html);
}

}  // namespace frustum::report
