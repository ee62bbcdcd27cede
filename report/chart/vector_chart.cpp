#include "report/chart/vector_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/chart/series_key.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

constexpr double kSize = 440.0, kRadius = 120.0;  // pixels
constexpr double kLongest = 56.0;                 // of an arrow
constexpr double kLabels = 192.0;                 // radius of the angles written around
constexpr SvgPoint kMiddle{220.0, 214.0};

// A line with two strokes at its end.
void draw_arrow(SvgDrawing& drawing, SvgPoint from, SvgPoint to, const std::string& classes) {
  drawing.line(from, to, classes);
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < 2.0) {
    drawing.circle(to, 1.6, classes);
    return;
  }
  const double head = std::min(6.0, 0.4 * length) / length;
  for (const double side : {-0.5, 0.5}) {
    drawing.line(to, {to.x - head * (dx - side * dy), to.y - head * (dy + side * dx)}, classes);
  }
}

}  // namespace

std::string vector_figure(const std::string& title, const std::vector<ArrowSeries>& series,
                          const Wording& words) {
  double longest = 1e-4;  // um: rounding is no arrow
  for (const ArrowSeries& each : series) {
    for (const CircleArrow& a : each.arrows) longest = std::max(longest, std::hypot(a.x, a.y));
  }
  const double unit = round_up_125(longest / 3.0);  // um of the scale
  const double scale = kLongest / longest;
  SvgDrawing drawing(kSize, kSize + 24.0, title);
  drawing.circle(kMiddle, kRadius, "zero");
  for (int degrees = 0; degrees < 360; degrees += 30) {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    drawing.text(
        {kMiddle.x + kLabels * std::cos(angle), kMiddle.y - kLabels * std::sin(angle) + 4.0},
        fmt::format("{}°", degrees));
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < series.size(); ++k) {
    names.push_back(series[k].name);
    for (const CircleArrow& a : series[k].arrows) {
      const SvgPoint from{kMiddle.x + kRadius * std::cos(a.angle),
                          kMiddle.y - kRadius * std::sin(a.angle)};
      draw_arrow(drawing, from, {from.x + scale * a.x, from.y - scale * a.y},
                 series_class("trace", k));
    }
  }
  const double y = kSize + 8.0;
  drawing.line({20.0, y}, {20.0 + scale * unit, y}, "axis");
  drawing.text({28.0 + scale * unit, y + 4.0}, words.general(unit) + " " + words.symbol("um"),
               SvgAnchor::start);
  return fmt::format("<figure class=\"polar\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(title), series_key(names), drawing.html());
}

}  // namespace frustum::report
