#include "report/chart/distribution_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart/plot_frame.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

std::string framed(const std::string& title, const SvgDrawing& drawing) {
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b></figcaption>\n{}</figure>\n",
                     html_text(title), drawing.html());
}

void draw_box(SvgDrawing& drawing, const PlotFrame& frame, const PlotScale& on_x, const BoxRow& row,
              double y) {
  constexpr double kHalf = 11.0;  // pixels
  const PlotScale any{};
  const auto x = [&](double value) { return frame.at(value, 0.0, on_x, any).x; };
  drawing.line({x(row.min), y}, {x(row.low), y}, "trace s1");
  drawing.line({x(row.high), y}, {x(row.max), y}, "trace s1");
  for (const double end : {row.min, row.max}) {
    drawing.line({x(end), y - 6.0}, {x(end), y + 6.0}, "trace s1");
  }
  drawing.rectangle({x(row.low), y - kHalf}, {x(row.high), y + kHalf}, "box s1");
  drawing.line({x(row.middle), y - kHalf}, {x(row.middle), y + kHalf}, "middle s1");
  for (const double limit : row.limits) {
    drawing.line({x(limit), y - 18.0}, {x(limit), y + 18.0}, "limit");
  }
  drawing.text({frame.left - 10.0, y + 4.0}, row.label, SvgAnchor::end);
}

}  // namespace

std::string box_figure(const std::string& title, const std::string& scale_title,
                       std::span<const BoxRow> rows, const Wording& words) {
  PlotRange range = PlotRange::empty();
  for (const BoxRow& row : rows) {
    for (const double value : {row.min, row.max}) range.include(value);
    // A limit far beyond all values would leave nothing of them.
    const double far = 2.0 * (row.max - row.min);
    for (const double limit : row.limits) {
      if (limit > row.min - far && limit < row.max + far) range.include(limit);
    }
  }
  const PlotScale on_x{range.widened(0.03, 1e-3), scale_title, 8, 0.0, words.decimal_sign()};
  constexpr double kRow = 46.0;
  const double height = kRow * static_cast<double>(rows.size());
  const PlotFrame frame{900.0, height + 60.0, 220.0, 884.0, 8.0, 8.0 + height};
  SvgDrawing drawing(frame.width, frame.height, title);
  draw_x_scale(drawing, frame, on_x);
  double y = frame.top + 0.5 * kRow;
  for (const BoxRow& row : rows) {
    BoxRow shown = row;
    std::erase_if(shown.limits,
                  [&](double limit) { return limit < on_x.range.low || limit > on_x.range.high; });
    draw_box(drawing, frame, on_x, shown, y);
    y += kRow;
  }
  return framed(title, drawing);
}

std::string distribution_figure(const std::string& title, const std::string& scale_title,
                                const DistributionLine& line, const Wording& words) {
  if (line.value.empty()) return {};
  PlotRange range = PlotRange::empty();
  range.include(line.value.front());
  range.include(line.value.back());
  const double wide = range.high - range.low;
  std::vector<double> limits;
  for (const double limit : line.limits) {
    if (limit > range.low - wide && limit < range.high + wide) limits.push_back(limit);
  }
  for (const double limit : limits) range.include(limit);
  const char sign = words.decimal_sign();
  const PlotScale on_x{range.widened(0.02, 1e-6), scale_title, 8, 0.0, sign};
  const PlotScale on_y{{0.0, 1.0}, words("share of the machines"), 5, 0.0, sign};
  const PlotFrame frame{900.0, 330.0, 62.0, 884.0, 10.0, 288.0};
  SvgDrawing drawing(frame.width, frame.height, title);
  draw_x_scale(drawing, frame, on_x);
  draw_y_scale(drawing, frame, on_y);
  std::vector<SvgPoint> middle, band;
  for (std::size_t i = 0; i < line.value.size(); ++i) {
    const double p = line.p[i];
    if (i > 0) middle.push_back(frame.at(line.value[i], line.p[i - 1], on_x, on_y));
    middle.push_back(frame.at(line.value[i], p, on_x, on_y));
    band.push_back(frame.at(line.value[i], std::min(1.0, p + line.half_width), on_x, on_y));
  }
  for (std::size_t i = line.value.size(); i-- > 0;) {
    band.push_back(frame.at(line.value[i], std::max(0.0, line.p[i] - line.half_width), on_x, on_y));
  }
  drawing.area(band, "band s1");
  drawing.polyline(middle, "trace s1");
  for (const double limit : limits) {
    const double x = frame.at(limit, 0.0, on_x, on_y).x;
    drawing.line({x, frame.top}, {x, frame.bottom}, "limit");
    // Where the line is not: below it at the large values, above it at the small ones.
    const auto above = std::upper_bound(line.value.begin(), line.value.end(), limit);
    const bool is_low = above != line.value.begin() &&
                        line.p[static_cast<std::size_t>(above - line.value.begin()) - 1] > 0.5;
    const double y = is_low ? frame.bottom - 8.0 : frame.top + 14.0;
    drawing.text({x - 6.0, y}, words("limit"), SvgAnchor::end, "limit-text");
  }
  return framed(title, drawing);
}

}  // namespace frustum::report
