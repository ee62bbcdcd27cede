#include "report/chart/tornado_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {

std::string tornado_figure(const std::string& title, std::span<const TornadoRow> rows,
                           const Wording& words) {
  PlotRange range{0.0, 0.05};
  for (const TornadoRow& row : rows) {
    range.include(row.share);
    range.include(row.total);
  }
  const PlotScale on_x{{0.0, 1.02 * range.high}, words("share"), 8, 0.0, words.decimal_sign()};
  const PlotScale any{};
  constexpr double kRow = 30.0;
  const double height = kRow * static_cast<double>(rows.size());
  const PlotFrame frame{900.0, height + 60.0, 150.0, 884.0, 8.0, 8.0 + height};
  SvgDrawing drawing(frame.width, frame.height, title);
  draw_x_scale(drawing, frame, on_x);
  double y = frame.top + 0.5 * kRow;
  for (const TornadoRow& row : rows) {
    const auto bar = [&](double value, double from, double to, const char* classes) {
      const double x = frame.at(std::max(value, 0.0), 0.0, on_x, any).x;
      drawing.rectangle({frame.left, y + from}, {x, y + to}, classes);
    };
    bar(row.total, -10.0, -1.0, "column s1");
    bar(row.share, 1.0, 10.0, "column s2");
    drawing.text({frame.left - 10.0, y + 4.0}, row.label, SvgAnchor::end);
    y += kRow;
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(title),
                     series_key({words("total index"), words("share of the mean square")}),
                     drawing.html());
}

}  // namespace frustum::report
