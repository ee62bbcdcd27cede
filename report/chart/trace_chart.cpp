#include "report/chart/trace_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

// Points of a line on paper; a trace of a fast instrument has more than a page can show.
constexpr std::size_t kMostPoints = 1800;

std::size_t stride_of(const TraceLine& line) {
  return std::max<std::size_t>(1, line.along.size() / kMostPoints);
}

void draw_line(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& on_x,
               const PlotScale& on_y, const TraceLine& line, std::size_t series) {
  std::vector<SvgPoint> points, upper, lower;
  for (std::size_t i = 0; i < line.along.size(); i += stride_of(line)) {
    points.push_back(frame.at(line.along[i], line.value[i], on_x, on_y));
    if (line.half_width.empty()) continue;
    const double w = line.half_width[i];
    upper.push_back(frame.at(line.along[i], line.value[i] + w, on_x, on_y));
    lower.push_back(frame.at(line.along[i], line.value[i] - w, on_x, on_y));
  }
  if (!upper.empty()) {
    upper.insert(upper.end(), lower.rbegin(), lower.rend());
    drawing.area(upper, series_class("band", series));
  }
  drawing.polyline(points, series_class(line.dashed ? "trace dashed" : "trace", series));
  for (std::size_t i = 0; line.dots && i < points.size(); ++i) {
    drawing.circle(points[i], 2.6, series_class("dot", series));
  }
}

}  // namespace

std::string trace_figure(const TraceChart& chart, const Wording& words) {
  PlotRange along = PlotRange::empty(), values = PlotRange::empty();
  values.include(0.0);
  for (const TraceLine& line : chart.lines) {
    for (const double x : line.along) along.include(x);
    for (std::size_t i = 0; i < line.value.size(); ++i) {
      const double w = line.half_width.empty() ? 0.0 : line.half_width[i];
      values.include(line.value[i] - w);
      values.include(line.value[i] + w);
    }
  }
  constexpr double kLeast = 1e-3;  // um: rounding does not look like an error
  const char sign = words.decimal_sign();
  const PlotScale on_x{along.widened(0.01, 1e-6), chart.along_title, 8, 0.0, sign};
  const PlotScale on_y{values.widened(0.06, kLeast), chart.value_title, 6, 0.0, sign};
  const PlotFrame frame{720.0, 300.0, 70.0, 704.0, 10.0, 252.0};
  SvgDrawing drawing(frame.width, frame.height,
                     words("{0}: {1} over {2}", chart.title, chart.value_title, chart.along_title));
  draw_x_scale(drawing, frame, on_x);
  draw_y_scale(drawing, frame, on_y);
  std::vector<std::string> names, marks;
  for (std::size_t k = 0; k < chart.lines.size(); ++k) {
    draw_line(drawing, frame, on_x, on_y, chart.lines[k], k);
    names.push_back(chart.lines[k].name);
    marks.emplace_back(chart.lines[k].dashed ? "dashed" : "");
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(chart.title), series_key(names, marks), drawing.html());
}

std::string bar_figure(const std::string& title, const std::vector<BarRow>& rows) {
  constexpr double kWidth = 720.0, kRow = 26.0, kLabels = 210.0, kBars = 360.0;
  SvgDrawing drawing(kWidth, kRow * static_cast<double>(rows.size()) + 8.0, title);
  double y = 4.0;
  for (const BarRow& row : rows) {
    const double length = kBars * std::clamp(row.share, 0.0, 1.0);
    drawing.text({kLabels - 10.0, y + 16.0}, row.label, SvgAnchor::end);
    drawing.rectangle({kLabels, y + 4.0}, {kLabels + length, y + kRow - 4.0}, "column s1");
    drawing.text({kLabels + length + 8.0, y + 16.0}, row.text, SvgAnchor::start);
    y += kRow;
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b></figcaption>\n{}</figure>\n",
                     html_text(title), drawing.html());
}

}  // namespace frustum::report
