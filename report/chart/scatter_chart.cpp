#include "report/chart/scatter_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart/plot_frame.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

PlotRange range_of(const ScatterSeries& series) {
  PlotRange range = PlotRange::empty();
  for (const double value : series.values) range.include(value);
  const double wide = range.high - range.low;
  for (const double limit : series.limits) {
    if (limit > range.low - wide && limit < range.high + wide) range.include(limit);
  }
  return range.widened(0.04, 1e-6);
}

}  // namespace

std::string scatter_figure(const std::string& title, const ScatterSeries& along,
                           const ScatterSeries& up, const Wording& words) {
  const char sign = words.decimal_sign();
  const PlotScale on_x{range_of(along), along.title, 8, 0.0, sign};
  const PlotScale on_y{range_of(up), up.title, 6, 0.0, sign};
  const PlotFrame frame{900.0, 420.0, 76.0, 884.0, 10.0, 378.0};
  SvgDrawing drawing(frame.width, frame.height, title);
  draw_x_scale(drawing, frame, on_x);
  draw_y_scale(drawing, frame, on_y);
  for (std::size_t i = 0; i < std::min(along.values.size(), up.values.size()); ++i) {
    drawing.circle(frame.at(along.values[i], up.values[i], on_x, on_y), 2.4, "spot s1");
  }
  const auto within = [](double value, const PlotRange& range) {
    return value >= range.low && value <= range.high;
  };
  for (const double limit : along.limits) {
    if (!within(limit, on_x.range)) continue;
    const double x = frame.at(limit, on_y.range.low, on_x, on_y).x;
    drawing.line({x, frame.top}, {x, frame.bottom}, "limit");
  }
  for (const double limit : up.limits) {
    if (!within(limit, on_y.range)) continue;
    const double y = frame.at(on_x.range.low, limit, on_x, on_y).y;
    drawing.line({frame.left, y}, {frame.right, y}, "limit");
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b></figcaption>\n{}</figure>\n",
                     html_text(title), drawing.html());
}

}  // namespace frustum::report
