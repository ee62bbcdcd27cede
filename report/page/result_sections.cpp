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
#include "report/tool_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

using Characteristic = metrology::CharacteristicResult;
using metrology::SeamlessValue;

std::string verdict_mark(metrology::Verdict verdict, const Wording& words) {
  return fmt::format("<span class=\"mark {}\">{}</span>", metrology::name_of(verdict),
                     capital(verdict, words));
}

// The head of a form: what is not stated is there, too, to be seen as such.
std::string stated_facts(const RunReport& report, const Wording& words) {
  std::string html;
  for (const metrology::HeaderKey& row : metrology::kHeaderKeys) {
    const std::string& value = report.evidence.header.*row.value;
    html += fact(words.word(row.label),
                 value.empty() ? fmt::format("<span class=\"none\">{}</span>", words("not stated"))
                               : html_text(value));
  }
  return html;
}

std::string made_facts(const RunReport& report, const Wording& words) {
  std::size_t points = 0;
  for (const auto& feature : report.measurement.features) points += feature.points.size();
  std::string tools;
  for (const auto& [number, tool] : report.tools) {
    tools += fmt::format("{}T{} {}", tools.empty() ? "" : "<br>", number,
                         html_text(tool_text(tool, words)));
  }
  std::string html = fact(words("Machine tool"), html_text(report.machine));
  html += fact(words("Structure"),
               report.structure.empty() ? "" : "<code>" + html_text(report.structure) + "</code>");
  html += fact(words("Program"), html_text(report.program));
  html += fact(words("Tool"), tools);
  html += fact(words("Points probed"), points > 0 ? std::to_string(points) : "");
  return html + fact(words("Cycle time"),
                     report.cycle_time ? words.number(duration_text(*report.cycle_time)) : "");
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

std::string value_cell(const Characteristic& c, const Wording& words) {
  const std::string text = with_unit(words.result(c), c.unit, words);
  if (!c.without_seam) return text;
  const SeamlessValue& seamless = *c.without_seam;
  const std::string seam =
      words("{0} without the seam at {1}° ± {2}°",
            with_unit(words.value(seamless.value, c.unit), c.unit, words),
            words.general(seamless.at * kDegPerRad), words.general(seamless.within * kDegPerRad));
  return fmt::format("<span>{}<small>{}</small></span>", text, seam);
}

// `remark` in small letters below.
std::string remarked(const std::string& text, const std::string& remark) {
  return remark.empty() ? text : fmt::format("<span>{}<small>{}</small></span>", text, remark);
}

std::string page_uncertainty_cell(const Characteristic& c, bool is_unstated, const Wording& words) {
  const std::string text =
      c.is_accuracy_unknown
          ? "–"
          : with_unit(words.uncertainty(c.expanded_uncertainty, c.unit), c.unit, words);
  return remarked(text, is_unstated ? words("not stated") : words.word(doubt_of(c)));
}

std::string interval_cell(const Characteristic& c, const Wording& words) {
  if (!c.interval) return "";
  return remarked(with_unit(words.interval(c), c.unit, words),
                  c.is_value_in_interval() ? "" : words("corrected, without the value"));
}

// What U and the interval say, and of which values they do not.
std::string uncertainty_note(const std::vector<Characteristic>& all, const Wording& words) {
  std::string note = words(
      "U is the expanded measurement uncertainty: value ± U holds the true value in 95\u202f% of "
      "measurements");
  const auto any = [&](auto holds) { return std::any_of(all.begin(), all.end(), holds); };
  if (any([](const Characteristic& c) { return !doubt_of(c).empty(); })) {
    note += words("; of those beside which “not proven” stands that is not shown");
  }
  note += ".";
  if (any([](const Characteristic& c) { return c.interval.has_value(); })) {
    note += words(
        " The interval holds it too; of forms and zones, which noise makes larger, it reaches "
        "farther down than up, and 95\u202f% is the least.");
  }
  if (any([](const Characteristic& c) { return !c.is_value_in_interval(); })) {
    note += words(
        " One without the value is corrected for a known bias of the measurement; the value is "
        "not.");
  }
  return note;
}

}  // namespace

std::string head_html(const RunReport& report, const Wording& words) {
  std::string reason = counts_text(report.measurement, words);
  if (!report.collisions.empty()) {
    const std::size_t count = report.collisions.size();
    reason += (reason.empty() ? "" : ", ") +
              (count == 1 ? words("1 collision") : words("{0} collisions", count));
  }
  const metrology::Verdict verdict = report.verdict();
  const std::string title = html_text(report.title.empty() ? words("Untitled run") : report.title);
  std::string html = fmt::format("<header><p class=\"brand\"><b>Frustum</b> {}</p>\n",
                                 words("Measurement report"));
  html +=
      fmt::format("<div class=\"top\"><h1>{}</h1><p class=\"verdict {}\"><b>{}</b>{}</p></div>\n",
                  title, metrology::name_of(verdict), capital(verdict, words), reason);
  return html + "<dl class=\"facts\">" + stated_facts(report, words) +
         "</dl>\n<dl class=\"facts made\">" + made_facts(report, words) + "</dl></header>\n";
}

std::string characteristics_html(const RunReport& report, const Wording& words) {
  if (report.measurement.characteristics.empty()) return "";
  const auto& all = report.measurement.characteristics;
  const bool nominals = std::any_of(
      all.begin(), all.end(), [](const Characteristic& c) { return !nominal_text(c).empty(); });
  const bool is_unstated = has_no_uncertainty(report.measurement);
  std::vector<std::string> headings{words("Characteristic"), ">" + words("Value")};
  const bool geometric =
      std::ranges::any_of(all, [](const Characteristic& c) { return c.geometric.has_value(); });
  if (geometric) headings.push_back(">" + words("Geometric"));
  if (nominals) headings.push_back(">" + words("Nominal"));
  const bool intervals = std::any_of(
      all.begin(), all.end(), [](const Characteristic& c) { return c.interval.has_value(); });
  headings.push_back(">" + words("Tolerance"));
  const bool is_unknown = is_accuracy_unknown(report.measurement);
  headings.emplace_back(is_unknown ? ">U" : ">U (95\u202f%)");
  if (intervals) headings.push_back(">" + words("95\u202f% interval"));
  headings.push_back(">" + words("Used"));
  headings.push_back(words("Verdict"));
  Table table(words("Characteristics"), headings, TableStyle::cards);
  for (const Characteristic& c : all) {
    std::string what = kind_text(c, words);
    if (const std::string subject = subject_text(c, words); !subject.empty()) {
      what = words("{0} of {1}", what, subject);
    }
    const std::string kind =
        c.kind.empty() ? "" : fmt::format("<small>{}</small>", html_text(what));
    std::vector<std::string> cells{
        fmt::format("<span class=\"what\">{}<span><b>{}</b>{}</span>"
                    "</span>",
                    tolerance_symbol(c.kind, words), html_text(c.name), kind),
        value_cell(c, words)};
    if (geometric) {
      cells.push_back(c.geometric ? with_unit(words.value(*c.geometric, c.unit), c.unit, words)
                                  : "");
    }
    if (nominals) {
      cells.push_back(nominal_text(c).empty() ? "" : with_unit(words.nominal(c), c.unit, words));
    }
    cells.push_back((c.nominal ? "± " : "") +
                    with_unit(words.value(c.tolerance, c.unit), c.unit, words));
    cells.push_back(page_uncertainty_cell(c, is_unstated, words));
    if (intervals) cells.push_back(interval_cell(c, words));
    cells.push_back(used_cell(c));
    cells.push_back(verdict_mark(c.verdict(), words));
    table.row(cells);
  }
  std::string notes;
  for (const Fact& fact : shown_measuring(report.evidence)) {
    if (fact.key == "decision_rule") {
      notes += words("Decision rule: {0}. ", html_text(fact.value));
    }
  }
  if (!is_unknown) notes += uncertainty_note(all, words) + " ";
  notes += words(
      "Used: share of the tolerance taken by the value, or by its distance from the nominal where "
      "there is one.");
  if (geometric) {
    notes += words(
        " Geometric: what the way of milling leaves where the machine makes no error; the value "
        "holds it.");
  }
  std::string warning;
  if (is_unknown) {
    warning = words(
        "<p class=\"caution\"><b>U is not known: no accuracy of the CMM is stated.</b> Nothing is "
        "said of how far the values are from the truth. State it by <code>--e0</code> and "
        "<code>--l-per-um</code>, or by <code>--cmm</code>.</p>\n");
  } else if (is_unstated) {
    warning = words(
        "<p class=\"caution\"><b>U = 0: no error of the CMM is stated.</b> The values are those of "
        "an ideal machine; no real CMM measures so. State one by <code>e0</code> and "
        "<code>l_per_um</code>.</p>\n");
  }
  return section("characteristics", words("Characteristics"),
                 warning + table.html() + "<p class=\"note\">" + notes + "</p>\n");
}

std::string measuring_html(const RunReport& report, const Wording& words) {
  const Evidence& evidence = report.evidence;
  std::string html;
  if (const auto facts = shown_made_and_measured(evidence, words); !facts.empty()) {
    html += "<dl class=\"statement\">";
    for (const Fact& stated : facts) {
      html += fact(stated.label, html_text(stated.value));
    }
    html += "</dl>\n";
  }
  if (!evidence.files.empty()) {
    Table table(words("Files"), {words("File"), words("Name"), "SHA-256"});
    for (const HashedFile& file : evidence.files) {
      table.row({html_text(words.word(file.role)), html_text(file.name),
                 "<code class=\"hash\">" + fingerprint_text(file, words) + "</code>"});
    }
    html += fmt::format("<h3>{}</h3>", words("Files")) + table.html();
  }
  return html.empty() ? "" : section("measuring", words("How it was measured"), html);
}

}  // namespace frustum::report
