#include "report/exchange/charts_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "core/made_by.hpp"
#include "report/chart/polar_chart.hpp"
#include "report/chart/profile_chart.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

// The colours and lines of the page, on paper.
constexpr std::string_view kStyle =
    "text{font:12px 'Liberation Sans',Arial,sans-serif;fill:#5d6875;stroke:none}"
    ".name{font-size:15px;font-weight:600;fill:#1b2129}.chart{fill:none}.grid{stroke:#dfe3e7}"
    ".axis,.zero{stroke:#7c8792}.extreme{stroke:#7c8792;stroke-dasharray:5 3}"
    ".trace,.fit{stroke-width:1.3;stroke-linejoin:round}.fit{stroke-dasharray:6 4}"
    ".ring{stroke-width:1.4}.dot{stroke:none}";
constexpr std::array<std::string_view, 5> kSeries{"#0072b2", "#d55e00", "#008f68", "#b4558f",
                                                  "#3a3f46"};

std::string style() {
  std::string text(kStyle);
  for (std::size_t k = 0; k < kSeries.size(); ++k) {
    text += fmt::format(".trace.s{0},.fit.s{0},.ring.s{0}{{stroke:{1}}}.dot.s{0}{{fill:{1}}}",
                        k + 1, kSeries[k]);
  }
  return text;
}

struct Chart {
  std::string name{};
  std::string attributes{}, content{};  // of its <svg>
  double width = 0.0, height = 0.0;
};

// The drawing of a figure: <svg class="chart" viewBox="0 0 W H" ..>..</svg>.
Chart chart_in(const std::string& name, const std::string& figure) {
  Chart chart{.name = name};
  const std::size_t begin = figure.find("<svg class=\"chart\"");
  const std::size_t open_end = figure.find('>', begin);
  const std::size_t end = figure.rfind("</svg>");
  if (begin == figure.npos || open_end == figure.npos || end == figure.npos) return chart;
  chart.attributes = figure.substr(begin + 4, open_end - begin - 4);
  chart.content = figure.substr(open_end + 1, end - open_end - 1);
  constexpr std::string_view kBox = "viewBox=\"0 0 ";
  const std::size_t box = chart.attributes.find(kBox);
  if (box == chart.attributes.npos) return chart;
  char* rest = nullptr;
  chart.width = std::strtod(chart.attributes.c_str() + box + kBox.size(), &rest);
  chart.height = std::strtod(rest, nullptr);
  return chart;
}

}  // namespace

std::string charts_svg(const RunReport& report) {
  std::vector<Chart> charts;
  for (const metrology::CharacteristicResult& c : report.measurement.characteristics) {
    if (has_polar_chart(c)) charts.push_back(chart_in(c.name, polar_figure(c)));
    if (has_profile_chart(report, c)) charts.push_back(chart_in(c.name, profile_figure(c)));
  }
  constexpr double kMargin = 16.0, kName = 28.0, kLeastWidth = 440.0;  // pixels
  double y = kMargin, width = kLeastWidth;
  std::string drawings;
  for (const Chart& chart : charts) {
    drawings += fmt::format("<text class=\"name\" x=\"{:g}\" y=\"{:g}\">{}</text>\n", kMargin,
                            y + kName - 10.0, html_text(chart.name));
    y += kName;
    drawings +=
        fmt::format("<svg x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\"{}>{}</svg>\n",
                    kMargin, y, chart.width, chart.height, chart.attributes, chart.content);
    y += chart.height + kMargin;
    width = std::max(width, chart.width);
  }
  if (charts.empty()) {
    drawings = fmt::format("<text x=\"{:g}\" y=\"{:g}\">no charts of forms or lines</text>\n",
                           kMargin, y + kMargin);
    y += 2.0 * kMargin;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\">\n<title>{2}</title>\n"
      "<desc>{5}</desc>\n<style>{3}</style>\n<rect width=\"{0:g}\" height=\"{1:g}\" "
      "fill=\"#ffffff\"/>\n{4}</svg>\n",
      width + 2.0 * kMargin, y, html_text(report.title), style(), drawings, html_text(made_by()));
}

}  // namespace frustum::report
