#include "report/chart/control_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "report/chart/plot_frame.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

using Days = std::chrono::sys_days;

std::chrono::year_month_day calendar_day(double day) {
  return std::chrono::year_month_day(Days(std::chrono::days(static_cast<int>(std::floor(day)))));
}

// First days of months within the range, every month or every so many, or days when it is short.
std::vector<double> date_marks(const PlotRange& range) {
  std::vector<double> marks;
  const double span = range.high - range.low;
  constexpr double kMonth = 30.44;
  if (span < 2.5 * kMonth) {
    const double step = std::max(1.0, std::ceil(span / 8.0));
    for (double day = std::ceil(range.low); day <= range.high; day += step) marks.push_back(day);
    return marks;
  }
  int months = 1;
  for (const int each : {2, 3, 6, 12, 24, 60, 120}) {
    if (span / kMonth / months > 9.0) months = each;
  }
  const auto first = calendar_day(range.low);
  for (int month = int(first.year()) * 12 + int(unsigned(first.month())) - 1;; ++month) {
    if (month % months != 0) continue;
    const std::chrono::year_month_day at{std::chrono::year(month / 12),
                                         std::chrono::month(unsigned(month % 12 + 1)),
                                         std::chrono::day(1)};
    const auto day = static_cast<double>(Days(at).time_since_epoch().count());
    if (day > range.high) return marks;
    if (day >= range.low) marks.push_back(day);
  }
}

std::string day_text(double day) {
  const auto at = calendar_day(day);
  return fmt::format("{:04}-{:02}-{:02}", int(at.year()), unsigned(at.month()), unsigned(at.day()));
}

struct Drawn {
  SvgDrawing& drawing;
  const PlotFrame& frame;
  const PlotScale &on_x, &on_y;
  const Wording& words;

  void level(double value, const char* classes, Phrase text) const {
    if (value < on_y.range.low || value > on_y.range.high) return;
    const SvgPoint from = frame.at(on_x.range.low, value, on_x, on_y);
    drawing.line(from, {frame.right, from.y}, classes);
    drawing.text({frame.right + 6.0, from.y + 4.0}, words(text), SvgAnchor::start,
                 std::string_view(classes) == "limit" ? "limit-text" : "");
  }
};

void draw_dates(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& scale, bool named) {
  for (const double day : date_marks(scale.range)) {
    const double x = frame.at(day, 0.0, scale, PlotScale{}).x;
    drawing.line({x, frame.top}, {x, frame.bottom}, "grid");
    if (named) drawing.text({x, frame.bottom + 18.0}, day_text(day));
  }
  drawing.line({frame.left, frame.bottom}, {frame.right, frame.bottom}, "axis");
}

PlotRange values_of(const ControlChart& chart) {
  PlotRange range = PlotRange::empty();
  for (const ControlPoint& p : chart.points) {
    range.include(p.value - p.half_width.value_or(0.0));
    range.include(p.value + p.half_width.value_or(0.0));
  }
  for (const double limit : chart.control_limits) range.include(limit);
  // A tolerance far beyond all values would press them together.
  const double wide = range.high - range.low;
  for (const double limit : chart.tolerance_limits) {
    if (limit > range.low - 2.0 * wide && limit < range.high + 2.0 * wide) range.include(limit);
  }
  return range.widened(0.08, 1e-3);
}

void draw_values(const Drawn& on, const ControlChart& chart) {
  for (const double limit : chart.tolerance_limits) on.level(limit, "limit", "tolerance");
  for (const double limit : chart.control_limits) {
    on.level(limit, "extreme",
             limit == chart.control_limits.front() ? Phrase("LCL") : Phrase("UCL"));
  }
  if (chart.mean) on.level(*chart.mean, "zero", "mean");
  std::vector<SvgPoint> line;
  for (const ControlPoint& p : chart.points) {
    line.push_back(on.frame.at(p.day, p.value, on.on_x, on.on_y));
  }
  on.drawing.polyline(line, "trace s1");
  if (chart.trend) {
    std::vector<SvgPoint> ends;
    for (const auto& [day, value] : *chart.trend) {
      ends.push_back(on.frame.at(day, value, on.on_x, on.on_y));
    }
    on.drawing.polyline(ends, "trace dashed s3");
  }
  for (std::size_t i = 0; i < line.size(); ++i) {
    const ControlPoint& p = chart.points[i];
    if (p.half_width) {
      on.drawing.line(on.frame.at(p.day, p.value - *p.half_width, on.on_x, on.on_y),
                      on.frame.at(p.day, p.value + *p.half_width, on.on_x, on.on_y), "trace s1");
    }
    const char* const series = p.fails ? "s2" : "s1";
    on.drawing.circle(line[i],
                      p.as_left ? 5.0
                      : p.fails ? 5.0
                                : 3.4,
                      fmt::format("{} {}", p.as_left ? "ring" : "dot", series));
  }
}

void draw_ranges(const Drawn& on, const ControlChart& chart) {
  if (chart.moving_range_limit) on.level(*chart.moving_range_limit, "extreme", "UCL");
  // Broken where a value begins anew.
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SvgPoint> line;
  for (const ControlPoint& p : chart.points) {
    if (p.as_left) continue;
    line.push_back(p.moving_range ? on.frame.at(p.day, *p.moving_range, on.on_x, on.on_y)
                                  : SvgPoint{kNan, kNan});
  }
  on.drawing.polyline(line, "trace s1");
  for (const SvgPoint& at : line) {
    if (std::isfinite(at.x)) on.drawing.circle(at, 2.6, "dot s1");
  }
}

}  // namespace

std::string control_figure(const ControlChart& chart, const Wording& words) {
  if (chart.points.empty()) return {};
  PlotRange dates = PlotRange::empty(), ranges = PlotRange::empty();
  ranges.include(0.0);
  for (const ControlPoint& p : chart.points) {
    dates.include(p.day);
    if (p.moving_range) ranges.include(*p.moving_range);
  }
  if (chart.moving_range_limit) ranges.include(*chart.moving_range_limit);
  const bool has_ranges = ranges.high > 0.0;
  ranges.high *= 1.08;
  const PlotScale on_x{dates.widened(0.02, 2.0), "", 8};
  const PlotScale on_y{values_of(chart), chart.value_title, 6, 0.0, words.decimal_sign()};
  const PlotScale on_range{ranges, words("moving range"), 3, 0.0, words.decimal_sign()};
  const double height = has_ranges ? 400.0 : 300.0;
  const PlotFrame values{900.0, height, 84.0, 820.0, 10.0, 266.0};
  const PlotFrame below{900.0, height, 84.0, 820.0, 292.0, 366.0};
  SvgDrawing drawing(900.0, height,
                     words("{0}: {1} over the date", chart.title, chart.value_title));
  draw_dates(drawing, values, on_x, !has_ranges);
  draw_y_scale(drawing, values, on_y);
  draw_values({drawing, values, on_x, on_y, words}, chart);
  if (has_ranges) {
    draw_dates(drawing, below, on_x, true);
    draw_y_scale(drawing, below, on_range);
    draw_ranges({drawing, below, on_x, on_range, words}, chart);
  }
  return fmt::format(
      "<figure class=\"axes\"><figcaption><b>{}</b><span class=\"scale\">{}</span></figcaption>\n"
      "{}</figure>\n",
      html_text(chart.title), html_text(chart.caption), drawing.html());
}

}  // namespace frustum::report
