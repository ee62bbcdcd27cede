#include "report/page/page_parts.hpp"

#include <fmt/format.h>

#include <array>

#include "core/program_version.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {

Table::Table(std::string_view label, const std::vector<std::string>& headings, TableStyle style) {
  html_ = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table{}><thead><tr>",
      label, style == TableStyle::cards ? " class=\"cards\"" : "");
  for (const std::string& heading : headings) {
    const bool is_number = heading.front() == '>';
    numbers_.push_back(is_number);
    headings_.push_back(heading.substr(is_number ? 1 : 0));
    html_ += fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"n\"" : "",
                         headings_.back());
  }
  html_ += "</tr></thead><tbody>\n";
}

void Table::row(const std::vector<std::string>& cells) {
  html_ += "<tr>";
  for (std::size_t k = 0; k < cells.size(); ++k) {
    html_ += fmt::format("<td data-label=\"{}\"{}>{}</td>", headings_[k],
                         numbers_[k] ? " class=\"n\"" : "", cells[k]);
  }
  html_ += "</tr>\n";
}

std::string section(std::string_view id, std::string_view heading, const std::string& content) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, heading, content);
}

namespace {

std::string with_symbol(const std::string& number, const std::string& unit) {
  const std::string symbol = html_text(unit);
  if (number == "-") return "–";
  const std::string shown = number.front() == '-' ? "\u2212" + number.substr(1) : number;
  if (symbol.empty() || symbol == "°") return shown + symbol;
  return shown + "\u202f" + symbol;
}

}  // namespace

std::string with_unit(const std::string& number, std::string_view unit) {
  return with_symbol(number, unit_symbol(unit));
}

std::string with_unit(const std::string& number, std::string_view unit, const Wording& words) {
  return with_symbol(number, words.symbol(unit));
}

std::string fact(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value);
}

std::string page_end(const Wording& words) {
  return "</main>\n<footer><p>" +
         words(
             "Made by Frustum {0}. The licences of the bundled packages are in the source of this "
             "page.",
             program_version()) +
         "</p></footer>\n";
}

std::string capital(metrology::Verdict verdict, const Wording& words) {
  constexpr std::array<Phrase, 3> kWords{"Pass", "Fail", "Uncertain"};
  return words(kWords.at(static_cast<std::size_t>(verdict)));
}

}  // namespace frustum::report
