#include "report/chart/frequency_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> found;
  for (const double v : values) found.push_back(v > 0.0 ? std::log10(v) : std::nan(""));
  return found;
}

// The series of that name among the lines that are drawn through.
std::size_t series_of(const FrequencyChart& chart, const FrequencyLine& line) {
  std::size_t series = 0;
  for (const FrequencyLine& other : chart.lines) {
    if (other.dashed) continue;
    if (other.name == line.name) break;
    ++series;
  }
  return series;
}

// A phase that goes over at 180 degrees begins again at the other side: no line joins the two.
struct BrokenLine {
  std::vector<double> x{}, y{};
};
BrokenLine without_jumps(const std::vector<double>& x, const std::vector<double>& phase) {
  BrokenLine line;
  for (std::size_t i = 0; i < x.size() && i < phase.size(); ++i) {
    if (i > 0 && std::abs(phase[i] - phase[i - 1]) > 180.0) {
      line.x.push_back(x[i]);
      line.y.push_back(std::nan(""));
    }
    line.x.push_back(x[i]);
    line.y.push_back(phase[i]);
  }
  return line;
}

}  // namespace

std::string frequency_figure(const FrequencyChart& chart) {
  if (chart.lines.empty() || chart.lines.front().frequency.size() < 2) return {};
  PlotRange frequencies = PlotRange::empty(), sizes = PlotRange::empty();
  for (const FrequencyLine& line : chart.lines) {
    for (const double f : line.frequency) frequencies.include(f);
    for (const double m : logarithms(line.magnitude)) sizes.include(m);
  }
  constexpr double kDecades = 5.0;  // below the largest: what is less is no compliance
  sizes.low = std::max(sizes.low, sizes.high - kDecades);
  const PlotScale on_x{frequencies, "Hz", 10};
  const PlotScale on_size{sizes.widened(0.04, 0.1), "log₁₀ of " + chart.unit, 6};
  const PlotScale on_phase{{-180.0, 180.0}, "phase °", 4, 90.0};
  const PlotFrame above{900.0, 470.0, 62.0, 884.0, 10.0, 262.0};
  const PlotFrame below{900.0, 470.0, 62.0, 884.0, 286.0, 426.0};
  SvgDrawing drawing(above.width, above.height, chart.title);
  draw_y_scale(drawing, above, on_size);
  draw_x_scale(drawing, below, on_x);
  draw_y_scale(drawing, below, on_phase);
  const auto draw = [&](const PlotFrame& frame, const PlotScale& on_y, const std::vector<double>& x,
                        const std::vector<double>& y, const std::string& classes) {
    std::vector<SvgPoint> points;
    for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
      const bool shown = y[i] >= on_y.range.low && y[i] <= on_y.range.high;
      points.push_back(frame.at(x[i], shown ? y[i] : std::nan(""), on_x, on_y));
    }
    drawing.polyline(points, classes);
  };
  // What is below the floor, in grey.
  std::vector<SvgPoint> floor;
  const std::vector<double>& floor_x = chart.lines.front().frequency;
  const std::vector<double> floor_y = logarithms(chart.floor);
  for (std::size_t i = 0; i < floor_x.size() && i < floor_y.size(); ++i) {
    const double y = std::isfinite(floor_y[i]) ? floor_y[i] : on_size.range.low;
    floor.push_back(
        above.at(floor_x[i], std::clamp(y, on_size.range.low, on_size.range.high), on_x, on_size));
  }
  if (floor.size() > 1) {
    floor.push_back({floor.back().x, above.bottom});
    floor.push_back({floor.front().x, above.bottom});
    drawing.area(floor, "below");
  }
  std::vector<std::string> names;
  for (const FrequencyLine& line : chart.lines) {
    std::string classes = series_class("trace", series_of(chart, line));
    if (line.dashed) classes += " dashed";
    draw(above, on_size, line.frequency, logarithms(line.magnitude), classes);
    const BrokenLine phase = without_jumps(line.frequency, line.phase);
    draw(below, on_phase, phase.x, phase.y, classes);
    if (!line.dashed) names.push_back(line.name);
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(chart.title), series_key(names), drawing.html());
}

}  // namespace frustum::report
