#include "report/chart/mode_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/chart/plot_frame.hpp"
#include "report/chart/series_key.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 12> kEdges{{{0, 1},
                                                             {2, 3},
                                                             {4, 5},
                                                             {6, 7},
                                                             {0, 2},
                                                             {1, 3},
                                                             {4, 6},
                                                             {5, 7},
                                                             {0, 4},
                                                             {1, 5},
                                                             {2, 6},
                                                             {3, 7}}};

// Right and up on the page.
SvgPoint projected(const Vec3& p) {
  const double c = std::cos(std::numbers::pi / 6.0);
  return {c * (p.x() - p.y()), p.z() + 0.5 * (p.x() + p.y())};
}

}  // namespace

std::string mode_figure(const ModeDrawing& mode) {
  PlotRange across = PlotRange::empty(), up = PlotRange::empty();
  for (const SwingingBody& body : mode.bodies) {
    for (std::size_t i = 0; i < body.corners.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const SvgPoint p = projected(body.corners[i] + side * body.swing[i]);
        across.include(p.x);
        up.include(p.y);
      }
    }
  }
  constexpr double kHeight = 360.0, kWidth = 620.0, kRim = 10.0;
  const double scale = std::min((kHeight - 2.0 * kRim) / std::max(up.high - up.low, 1.0),
                                (kWidth - 2.0 * kRim) / std::max(across.high - across.low, 1.0));
  const double left = 0.5 * (kWidth - scale * (across.high - across.low));
  SvgDrawing drawing(kWidth, kHeight, mode.title);
  std::vector<std::string> names;
  for (std::size_t b = 0; b < mode.bodies.size(); ++b) {
    const SwingingBody& body = mode.bodies[b];
    const auto strokes = [&](double side) {
      std::vector<SvgStroke> found;
      for (const auto& [from, to] : kEdges) {
        const auto at = [&](std::size_t i) {
          const SvgPoint p = projected(body.corners[i] + side * body.swing[i]);
          return SvgPoint{left + scale * (p.x - across.low), kRim + scale * (up.high - p.y)};
        };
        found.push_back({at(from), at(to)});
      }
      return found;
    };
    // The first is the bed, which stands behind all others.
    drawing.swinging(strokes(-1.0), strokes(1.0), b == 0 ? "bed" : series_class("trace", b - 1));
    if (b > 0) names.push_back(body.name);
  }
  return fmt::format("<figure class=\"axes\"><figcaption><b>{}</b>{}</figcaption>\n{}</figure>\n",
                     html_text(mode.title), series_key(names), drawing.html());
}

}  // namespace frustum::report
