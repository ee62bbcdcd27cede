#include "report/page/sensitivity_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/made_by.hpp"
#include "core/program_version.hpp"
#include "report/colour_scale.hpp"
#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/number_text.hpp"
#include "report/picture/image.hpp"

namespace frustum::report {
namespace {

using Json = nlohmann::ordered_json;

// What a heat map takes as one step of each parameter, so that um and urad can share a scale.
constexpr double kTypicalLength = 15.0;  // um
constexpr double kTypicalAngle = 30.0;   // urad

// Below this a derivative is rounding, or nothing: a nanometre for a millimetre or a milliradian.
constexpr double kNothing = 1e-6;

double typical(const NamedUnit& parameter) {
  return parameter.unit == "urad" ? kTypicalAngle : kTypicalLength;
}

Json matrix_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      row.push_back(std::isfinite(matrix(i, k)) ? Json(matrix(i, k)) : Json(nullptr));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json names_json(const std::vector<NamedUnit>& list) {
  Json names = Json::array();
  for (const NamedUnit& item : list) names.push_back(item.name);
  return names;
}

Json units_json(const std::vector<NamedUnit>& list) {
  Json units = Json::array();
  for (const NamedUnit& item : list) units.push_back(item.unit);
  return units;
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

// Four significant digits, a dot where nothing is.
std::string cell_text(double value) {
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) < kNothing) return "·";
  return fmt::format("{:.4g}", value);
}

// What is no number is no zero.
bool answers(const Eigen::MatrixXd& matrix, Eigen::Index column) {
  return !(matrix.col(column).array().abs() <= kNothing).all();
}

// Columns with an answer in either matrix, and the names of the others.
struct Columns {
  std::vector<Eigen::Index> shown{};
  std::string silent{};
};
Columns columns_of(const SensitivityTable& table) {
  Columns columns;
  for (Eigen::Index k = 0; k < table.odd.cols(); ++k) {
    if (answers(table.odd, k) || answers(table.even, k)) {
      columns.shown.push_back(k);
    } else {
      columns.silent +=
          (columns.silent.empty() ? "" : ", ") + table.parameters[static_cast<std::size_t>(k)].name;
    }
  }
  return columns;
}

std::string padded(const std::string& text, std::size_t width, std::size_t shown) {
  return std::string(width > shown ? width - shown : 0, ' ') + text;
}

// Whether white is read better on it than black: the contrast of WCAG 2.2, with its luminance.
bool is_dark(const Colour& colour) {
  const double luminance = 0.2126 * static_cast<double>(linear_from_srgb(colour[0])) +
                           0.7152 * static_cast<double>(linear_from_srgb(colour[1])) +
                           0.0722 * static_cast<double>(linear_from_srgb(colour[2]));
  return 1.05 / (luminance + 0.05) > (luminance + 0.05) / 0.05;
}

// The background of a cell: the row's largest effect of a typical error is the end of the scale.
std::string cell_style(double effect, double largest) {
  if (largest <= 0.0 || std::abs(effect) <= 0.0) return {};
  const Colour colour = deviation_colour(effect, largest);
  const auto channel = [&](std::size_t i) { return std::lround(colour[i] * 255.0); };
  return fmt::format(" style=\"background:rgb({},{},{});color:{}\"", channel(0), channel(1),
                     channel(2), is_dark(colour) ? "#fff" : "#000");
}

// Three significant digits, of small numbers four decimals or one digit; nothing where nothing is.
std::string page_cell(double value) {
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) < kNothing) return {};
  constexpr double kSmallest = 5e-5;  // four decimals show it
  const double rounded = std::round(value * 1e4) / 1e4;
  const std::string text = std::abs(value) < kSmallest ? fmt::format("{:.1g}", value)
                           : std::abs(value) < 0.01    ? fmt::format("{:g}", rounded)
                                                       : fmt::format("{:.3g}", value);
  return text.front() == '-' ? "\u2212" + text.substr(1) : text;
}

// A name over a narrow column: it may break before each underscore.
std::string broken_name(const std::string& name) {
  std::string html;
  for (const char c : html_text(name)) {
    if (c == '_' && !html.empty()) html += "<br>";
    html += c;
  }
  return html;
}

// "1-a" of "1-a.dL".
std::string_view group_of(const NamedUnit& characteristic) {
  return std::string_view(characteristic.name).substr(0, characteristic.name.rfind('.'));
}

std::string heat_map_head(const SensitivityTable& table, std::span<const Eigen::Index> columns) {
  std::string html = "<thead><tr><td></td>";
  for (const Eigen::Index k : columns) {
    const NamedUnit& p = table.parameters[static_cast<std::size_t>(k)];
    html += fmt::format("<th scope=\"col\" class=\"n\">{}<br><small>{}</small></th>",
                        broken_name(p.name), html_text(unit_symbol(p.unit)));
  }
  return html + "</tr></thead>";
}

// How much a typical error changes a characteristic.
double effect_of(const SensitivityTable& table, const Eigen::MatrixXd& matrix, Eigen::Index i,
                 Eigen::Index k) {
  const double value = std::abs(matrix(i, k)) < kNothing ? 0.0 : matrix(i, k);
  return value * typical(table.parameters[static_cast<std::size_t>(k)]);
}

// The largest effect of each row: the end of its scale.
std::vector<double> row_scales(const SensitivityTable& table, const Eigen::MatrixXd& matrix) {
  std::vector<double> scales(static_cast<std::size_t>(matrix.rows()), 0.0);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      const double effect = std::abs(effect_of(table, matrix, i, k));
      double& scale = scales[static_cast<std::size_t>(i)];
      if (std::isfinite(effect)) scale = std::max(scale, effect);
    }
  }
  return scales;
}

std::string heat_block(const SensitivityTable& table, const Eigen::MatrixXd& matrix,
                       std::span<const Eigen::Index> columns, const std::vector<double>& scales) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Derivatives by " +
      html_text(table.parameters[static_cast<std::size_t>(columns.front())].name) +
      " and others\"><table class=\"heat\">" + heat_map_head(table, columns) + "<tbody>\n";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const NamedUnit& c = table.characteristics[static_cast<std::size_t>(i)];
    const bool begins =
        i > 0 && group_of(c) != group_of(table.characteristics[static_cast<std::size_t>(i - 1)]);
    html += fmt::format("<tr{}><th scope=\"row\">{} <small>{}</small></th>",
                        begins ? " class=\"begins\"" : "", html_text(c.name),
                        html_text(unit_symbol(c.unit)));
    for (const Eigen::Index k : columns) {
      html += fmt::format(
          "<td class=\"n\"{}>{}</td>",
          cell_style(effect_of(table, matrix, i, k), scales[static_cast<std::size_t>(i)]),
          page_cell(matrix(i, k)));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// Columns without an answer are left out; what does not fit the width of a sheet is a table below.
std::string heat_map(const SensitivityTable& table, const Eigen::MatrixXd& matrix) {
  constexpr std::size_t kMostColumns = 18;  // of a landscape sheet
  std::vector<Eigen::Index> columns;
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    if (answers(matrix, k)) columns.push_back(k);
  }
  const std::vector<double> scales = row_scales(table, matrix);
  const std::size_t blocks = (columns.size() + kMostColumns - 1) / kMostColumns;
  std::string html;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t first = b * columns.size() / blocks;
    const std::size_t last = (b + 1) * columns.size() / blocks;
    html += heat_block(table, matrix, std::span(columns).subspan(first, last - first), scales);
  }
  return html;
}

// On a narrow screen the names stay while the columns are scrolled.
constexpr const char* kStyle = R"(
.sheet { padding-left: 24px; padding-right: 24px; }
.heat { width: auto; font-size: 11px; line-height: 1.35; }
.heat th { padding: 2px 3px; font-size: 11px; line-height: 1.15; }
.heat small { font-weight: 400; font-size: 10px; }
.heat td { padding: 2px 3px; min-width: 2.9em; border-top: 0; }
.heat th:last-child, .heat td:last-child { padding-right: 3px; }
.scroll + .scroll { margin-top: 18px; }
.heat thead th { border-bottom: 1px solid var(--faint); }
.heat tbody tr:last-child td { border-bottom: 0; }
.heat .begins > * { border-top: 1px solid var(--rule); }
.heat th[scope=row] { padding: 2px 6px 2px 0; position: sticky; left: 0; background: var(--paper);
  color: var(--ink); vertical-align: top; line-height: 1.35; }
.heat th[scope=row] small { line-height: 1; }
@page { size: A4 landscape; margin: 12mm 10mm 14mm; }
@media print {
  .sheet { padding: 0; }
  .heat, .heat th { font-size: 8pt; }
  .heat th, .heat td { padding: 2px 4px; }
  .heat { break-inside: avoid; }
  section { margin-top: 20px; }
}
)";

}  // namespace

std::string sensitivity_json(const SensitivityTable& table) {
  Json json;
  json["schema"] = "frustum/sensitivity/1";
  json["version"] = program_version();
  json["title"] = table.title;
  json["machine"] = table.machine;
  json["method"] = table.method;
  json["characteristics"] = names_json(table.characteristics);
  json["errors"] = names_json(table.parameters);
  json["units"] = units_json(table.parameters);
  json["characteristic_units"] = units_json(table.characteristics);
  json["matrix"] = matrix_json(table.odd);
  json["even"] = matrix_json(table.even);
  return json.dump() + '\n';
}

std::string sensitivity_csv(const SensitivityTable& table) {
  std::string out = "characteristic,unit";
  for (const NamedUnit& p : table.parameters) {
    out += ',' + csv_text(fmt::format("{} [per {}]", p.name, p.unit));
  }
  out += '\n';
  for (Eigen::Index i = 0; i < table.odd.rows(); ++i) {
    const NamedUnit& c = table.characteristics[static_cast<std::size_t>(i)];
    out += csv_text(c.name) + ',' + c.unit;
    for (Eigen::Index k = 0; k < table.odd.cols(); ++k) out += fmt::format(",{}", table.odd(i, k));
    out += '\n';
  }
  return out;
}

// Rows of characteristics, columns of errors, as many beside each other as the width holds.
std::string text_blocks(const SensitivityTable& table, const Eigen::MatrixXd& matrix,
                        std::span<const Eigen::Index> shown, int width) {
  std::size_t name_width = 0, cell_width = 12;
  for (const NamedUnit& c : table.characteristics) {
    name_width = std::max(name_width, c.name.size() + c.unit.size() + 3);
  }
  for (const Eigen::Index k : shown) {
    cell_width =
        std::max(cell_width, table.parameters[static_cast<std::size_t>(k)].name.size() + 2);
  }
  const auto room = static_cast<std::size_t>(std::max(width, 40));
  const std::size_t columns =
      std::max<std::size_t>(1, room > name_width ? (room - name_width) / cell_width : 1);
  std::string out;
  for (std::size_t first = 0; first < shown.size(); first += columns) {
    const std::size_t last = std::min(first + columns, shown.size());
    std::string names(name_width, ' '), units(name_width, ' ');
    for (std::size_t j = first; j < last; ++j) {
      const NamedUnit& p = table.parameters[static_cast<std::size_t>(shown[j])];
      names += padded(p.name, cell_width, p.name.size());
      units += padded("/" + p.unit, cell_width, p.unit.size() + 1);
    }
    out += fmt::format("\n{}\n{}\n", names, units);
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      const NamedUnit& c = table.characteristics[static_cast<std::size_t>(i)];
      std::string line = fmt::format("{:<{}}", fmt::format("{} [{}]", c.name, c.unit), name_width);
      for (std::size_t j = first; j < last; ++j) {
        const std::string cell = cell_text(matrix(i, shown[j]));
        line += padded(cell, cell_width, cell == "·" ? 1 : cell.size());
      }
      out += line + '\n';
    }
  }
  return out;
}

std::string sensitivity_text(const SensitivityTable& table, int width) {
  const auto [shown, silent] = columns_of(table);
  std::string out = fmt::format("{}\n{}, {}\n", table.title, table.machine, table.method);
  out += text_blocks(table, table.odd, shown, width);
  std::vector<Eigen::Index> of_either_sign;
  for (const Eigen::Index k : shown) {
    if (answers(table.even, k)) of_either_sign.push_back(k);
  }
  if (!of_either_sign.empty()) {
    // The form of a part that was perfect grows with any error.
    out += "\nBeside that, of either sign\n";
    out += text_blocks(table, table.even, of_either_sign, width);
  }
  if (!silent.empty()) out += fmt::format("\nNo characteristic answers: {}\n", silent);
  return out;
}

std::string sensitivity_html(const SensitivityTable& table) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>{0}</title>\n"
      "<style>{1}{4}</style>"
      "</head><body><main class=\"sheet\"><header><h1>{0}</h1><p>{2}, {3}</p></header>\n",
      html_text(table.title), page_style(), html_text(table.machine), html_text(table.method),
      kStyle);
  const std::string silent = columns_of(table).silent;
  html += fmt::format(
      "<section><h2>Derivatives</h2><p>Change of each characteristic for one unit of each error; "
      "nothing where it is zero. Colours compare, within a row, the effect of {:.0f} µm or {:.0f} "
      "µrad.</p>\n{}{}</section>\n",
      kTypicalLength, kTypicalAngle, heat_map(table, table.odd),
      silent.empty() ? ""
                     : fmt::format("<p class=\"note\">No characteristic answers: {}.</p>\n",
                                   html_text(silent)));
  if ((table.even.array().abs() > kNothing).any()) {
    html += fmt::format(
        "<section><h2>What either sign does</h2><p>Change for one unit of either sign, beside the "
        "derivative: the dish that a leaning end face cuts, and the form of a part that was "
        "perfect.</p>\n{}</section>\n",
        heat_map(table, table.even));
  }
  return html + "<footer><p>" + made_by() + ".</p></footer></main></body></html>\n";
}

}  // namespace frustum::report
