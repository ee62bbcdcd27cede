#include "report/player/path_drawing.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "report/chart/svg.hpp"
#include "report/page/oblique_view.hpp"

namespace frustum::report {
namespace {

constexpr double kWidth = 900.0, kHeight = 540.0, kMargin = 24.0;  // pixels
constexpr std::size_t kMostPlaces = 4000;  // a drawing of that many is a picture, not the data

}  // namespace

std::string path_drawing(const PlayerPage& page) {
  SvgDrawing drawing(kWidth, kHeight, "Tool path in the workpiece frame, seen obliquely");
  if (page.points.empty()) return drawing.html();
  std::vector<Vec3> tips;
  tips.reserve(page.points.size());
  for (const PlayerPoint& point : page.points) tips.push_back(point.tip);
  const ObliqueView view(tips, kWidth, kHeight, kMargin);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t every = 1 + tips.size() / kMostPlaces;
  std::vector<SvgPoint> feeds, rapids;
  std::size_t begin = 0;  // of the line that is drawn
  for (std::size_t k = 1; k < page.points.size(); ++k) {
    if (page.points[k].starts) {
      begin = k;
      continue;
    }
    const bool is_rapid = page.blocks[page.points[k].block].is_rapid;
    const bool ends = k + 1 == page.points.size() || page.points[k + 1].starts ||
                      page.blocks[page.points[k + 1].block].is_rapid != is_rapid;
    if (k % every != 0 && !ends) continue;
    std::vector<SvgPoint>& line = is_rapid ? rapids : feeds;
    if (line.empty() || std::isnan(line.back().x)) line.push_back(view.at(tips[begin]));
    line.push_back(view.at(tips[k]));
    if (!ends) continue;
    line.push_back({kNan, kNan});
    begin = k;
  }
  drawing.polyline(rapids, "wire");
  drawing.polyline(feeds, "wire s1 displaced");
  return drawing.html();
}

}  // namespace frustum::report
