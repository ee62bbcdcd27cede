#include "report/chart/risk_chart.hpp"

#include <fmt/format.h>

#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/chart/svg.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {

std::string risk_figure(const std::string& title, const RiskCurve& curve, const Wording& words) {
  PlotRange along = PlotRange::empty(), risks{0.0, 1e-4};
  for (const double guard : curve.guard) along.include(guard);
  for (const auto* values : {&curve.consumer, &curve.producer}) {
    for (const double value : *values) risks.include(value);
  }
  const char sign = words.decimal_sign();
  const PlotScale on_x{along.widened(0.0, 0.1),
                       words("guard band, in U = 2 u (negative: beyond the limit)"), 8, 0.0, sign};
  const PlotScale on_y{{0.0, 1.05 * risks.high}, words("risk"), 5, 0.0, sign};
  const PlotFrame frame{900.0, 330.0, 76.0, 884.0, 10.0, 288.0};
  SvgDrawing drawing(frame.width, frame.height, title);
  draw_x_scale(drawing, frame, on_x);
  draw_y_scale(drawing, frame, on_y);
  const auto draw = [&](const std::vector<double>& values, const char* classes) {
    std::vector<SvgPoint> line;
    for (std::size_t i = 0; i < values.size(); ++i) {
      line.push_back(frame.at(curve.guard[i], values[i], on_x, on_y));
    }
    drawing.polyline(line, classes);
  };
  draw(curve.consumer, "trace s1");
  draw(curve.producer, "trace dashed s2");
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(title),
                     series_key({words("consumer: a bad part is accepted"),
                                 words("producer: a good part is rejected")},
                                {"", "dashed"}),
                     drawing.html());
}

}  // namespace frustum::report
