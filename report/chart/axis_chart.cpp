#include "report/chart/axis_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

PlotScale scale_of(const AxisTrace& trace, bool rotary, const Wording& words) {
  PlotRange range = PlotRange::empty();
  for (const AxisSeries& series : trace.axes) {
    if (series.rotary != rotary) continue;
    for (const double value : series.values) {
      range.include(rotary ? value : words.shown(value, "mm"));
    }
  }
  // Not the same room: an axis that rests would lie under one of the other scale.
  PlotScale scale{
      range.widened(rotary ? 0.13 : 0.05, rotary ? 1.0 : words.shown(1.0, "mm")),
      rotary ? words("rotary axes, degrees") : words("linear axes, {0}", words.symbol("mm"))};
  scale.decimal_sign = words.decimal_sign();
  return scale;
}

}  // namespace

std::string axis_figure(const AxisTrace& trace, const Wording& words) {
  const bool is_cone = trace.abscissa_kind == Abscissa::cone_angle;
  PlotRange along = PlotRange::empty();
  for (const double place : trace.abscissa) along.include(place);
  PlotScale on_x{along.widened(0.0, 1.0), is_cone ? words("cone angle φ, degrees") : words("block"),
                 8};
  if (is_cone) on_x.step = 45.0;
  const bool is_short = along.high - along.low <= 10.0;
  if (!is_cone && is_short) on_x.step = 1.0;  // there is no half block
  const auto has = [&](bool rotary) {
    return std::any_of(trace.axes.begin(), trace.axes.end(),
                       [&](const AxisSeries& s) { return s.rotary == rotary; });
  };
  const PlotScale linear = scale_of(trace, false, words), rotary = scale_of(trace, true, words);
  const PlotFrame frame{900.0, 330.0, 62.0, has(true) ? 838.0 : 888.0, 10.0, 288.0};
  SvgDrawing drawing(frame.width, frame.height, words("Axis positions of {0}", trace.operation));
  draw_x_scale(drawing, frame, on_x);
  if (has(false)) draw_y_scale(drawing, frame, linear);
  if (has(true)) draw_y_scale(drawing, frame, rotary, PlotSide::right);
  std::vector<std::string> names, marks;
  for (std::size_t k = 0; k < trace.axes.size(); ++k) {
    const AxisSeries& series = trace.axes[k];
    names.push_back(series.axis);
    marks.emplace_back(series.rotary ? "dashed" : "");
    std::vector<SvgPoint> line;
    for (std::size_t i = 0; i < std::min(series.values.size(), trace.abscissa.size()); ++i) {
      const double value = series.rotary ? series.values[i] : words.shown(series.values[i], "mm");
      line.push_back(frame.at(trace.abscissa[i], value, on_x, series.rotary ? rotary : linear));
    }
    drawing.polyline(line, series_class(series.rotary ? "trace dashed" : "trace", k));
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(trace.operation), series_key(names, marks), drawing.html());
}

}  // namespace frustum::report
