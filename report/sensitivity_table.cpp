#include "report/sensitivity_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/colour_scale.hpp"
#include "report/html_text.hpp"
#include "report/number_text.hpp"
#include "report/page_bundle.hpp"

namespace frustum::report {
namespace {

using Json = nlohmann::ordered_json;

// What a heat map takes as one step of each parameter, so that um and urad can share a scale.
constexpr double kTypicalLength = 15.0;  // um
constexpr double kTypicalAngle = 30.0;   // urad

// Below this a derivative is rounding: 1e-9 um per urad is a picometre for a milliradian.
constexpr double kNothing = 1e-7;

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

bool answers(const SensitivityTable& table, Eigen::Index column) {
  return (table.odd.col(column).array().abs() > kNothing).any() ||
         (table.even.col(column).array().abs() > kNothing).any();
}

std::string padded(const std::string& text, std::size_t width, std::size_t shown) {
  return std::string(width > shown ? width - shown : 0, ' ') + text;
}

// The background of a cell: the row's largest effect of a typical error is the end of the scale.
std::string cell_style(double effect, double largest) {
  if (largest <= 0.0 || std::abs(effect) <= 0.0) return {};
  const Colour colour = deviation_colour(effect, largest);
  const auto channel = [&](std::size_t i) { return std::lround(colour[i] * 255.0); };
  const bool dark = std::abs(effect) > 0.6 * largest;
  return fmt::format(" style=\"background:rgb({},{},{});color:{}\"", channel(0), channel(1),
                     channel(2), dark ? "#fff" : "#1a1c1f");
}

std::string heat_map(const SensitivityTable& table, const Eigen::MatrixXd& matrix) {
  std::string html = "<div class=\"scroll\"><table class=\"heat\"><thead><tr><th></th>";
  for (const NamedUnit& p : table.parameters) {
    html += fmt::format("<th scope=\"col\" class=\"n\">{}<br><small>{}</small></th>",
                        html_text(p.name), html_text(unit_symbol(p.unit)));
  }
  html += "</tr></thead><tbody>\n";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const NamedUnit& c = table.characteristics[static_cast<std::size_t>(i)];
    html += fmt::format("<tr><th scope=\"row\">{} <small>{}</small></th>", html_text(c.name),
                        html_text(unit_symbol(c.unit)));
    double largest = 0.0;
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      const double effect =
          std::abs(matrix(i, k)) * typical(table.parameters[static_cast<std::size_t>(k)]);
      if (std::isfinite(effect)) largest = std::max(largest, effect);
    }
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      const double value = std::abs(matrix(i, k)) < kNothing ? 0.0 : matrix(i, k);
      const double effect = value * typical(table.parameters[static_cast<std::size_t>(k)]);
      html += fmt::format("<td class=\"n\"{}>{}</td>", cell_style(effect, largest),
                          cell_text(matrix(i, k)));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string sensitivity_json(const SensitivityTable& table) {
  Json json;
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

std::string sensitivity_text(const SensitivityTable& table, int width) {
  std::vector<Eigen::Index> shown;
  std::string silent;
  for (Eigen::Index k = 0; k < table.odd.cols(); ++k) {
    if (answers(table, k)) {
      shown.push_back(k);
    } else {
      silent += (silent.empty() ? "" : ", ") + table.parameters[static_cast<std::size_t>(k)].name;
    }
  }
  std::size_t name_width = 0, cell_width = 10;
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
  std::string out = fmt::format("{}\n{}, {}\n", table.title, table.machine, table.method);
  for (std::size_t first = 0; first < shown.size(); first += columns) {
    const std::size_t last = std::min(first + columns, shown.size());
    std::string names(name_width, ' '), units(name_width, ' ');
    for (std::size_t j = first; j < last; ++j) {
      const NamedUnit& p = table.parameters[static_cast<std::size_t>(shown[j])];
      names += padded(p.name, cell_width, p.name.size());
      units += padded("/" + p.unit, cell_width, p.unit.size() + 1);
    }
    out += '\n' + names + '\n' + units + '\n';
    for (Eigen::Index i = 0; i < table.odd.rows(); ++i) {
      const NamedUnit& c = table.characteristics[static_cast<std::size_t>(i)];
      std::string line = fmt::format("{:<{}}", fmt::format("{} [{}]", c.name, c.unit), name_width);
      for (std::size_t j = first; j < last; ++j) {
        const std::string cell = cell_text(table.odd(i, shown[j]));
        line += padded(cell, cell_width, cell == "·" ? 1 : cell.size());
      }
      out += line + '\n';
    }
  }
  if (!silent.empty()) out += fmt::format("\nNo characteristic answers: {}\n", silent);
  return out;
}

std::string sensitivity_html(const SensitivityTable& table) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>{1}\n.heat td{{min-width:4.2em}} .heat small{{opacity:.7;font-weight:400}}</style>"
      "</head><body><main class=\"sheet\"><header><h1>{0}</h1><p>{2}, {3}</p></header>\n",
      html_text(table.title), page_style(), html_text(table.machine), html_text(table.method));
  html += fmt::format(
      "<section><h2>Derivatives</h2><p>Change of each characteristic for one unit of each error. "
      "Colours compare, within a row, the effect of {:.0f} µm or {:.0f} µrad.</p>\n{}</section>\n",
      kTypicalLength, kTypicalAngle, heat_map(table, table.odd));
  if ((table.even.array().abs() > kNothing).any()) {
    html += fmt::format(
        "<section><h2>What either sign does</h2><p>Change for one unit of either sign, beside the "
        "derivative: the dish that a leaning end face cuts, and the form of a part that was "
        "perfect.</p>\n{}</section>\n",
        heat_map(table, table.even));
  }
  return html + "</main></body></html>\n";
}

}  // namespace frustum::report
