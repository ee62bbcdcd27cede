#include "report/page/volume_drawing.hpp"

#include <limits>
#include <vector>

#include "core/units.hpp"
#include "report/chart/svg.hpp"
#include "report/page/oblique_view.hpp"

namespace frustum::report {
namespace {

constexpr double kWidth = 900.0, kHeight = 540.0, kMargin = 24.0;  // pixels

// The rows of the grid in all three directions as one line with breaks.
std::vector<SvgPoint> rows(const ObliqueView& view, const std::vector<Vec3>& points,
                           const std::array<int, 3>& counts) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::array<int, 3> strides{1, counts[0], counts[0] * counts[1]};
  std::vector<SvgPoint> line;
  for (std::size_t along = 0; along < 3; ++along) {
    const std::size_t second = (along + 1) % 3, third = (along + 2) % 3;
    for (int j = 0; j < counts[second]; ++j) {
      for (int k = 0; k < counts[third]; ++k) {
        const int first = j * strides[second] + k * strides[third];
        for (int i = 0; i < counts[along]; ++i) {
          line.push_back(view.at(points[static_cast<std::size_t>(first + i * strides[along])]));
        }
        line.push_back({kNan, kNan});
      }
    }
  }
  return line;
}

}  // namespace

std::string volume_drawing(const VolumetricPage& page) {
  const auto [nx, ny, nz] = page.counts;
  const bool is_grid =
      nx > 0 && ny > 0 && nz > 0 && page.places.size() == static_cast<std::size_t>(nx * ny * nz);
  if (!is_grid || page.views.empty() || page.views.front().relative.size() != page.places.size()) {
    return {};
  }
  const double factor = magnification(page) / kUmPerMm;
  std::vector<Vec3> ends = page.places;
  for (std::size_t i = 0; i < ends.size(); ++i) ends[i] += factor * page.views.front().relative[i];
  std::vector<Vec3> all = page.places;
  all.insert(all.end(), ends.begin(), ends.end());
  const ObliqueView view(all, kWidth, kHeight, kMargin);
  SvgDrawing drawing(kWidth, kHeight, "Grid of the working volume with magnified errors");
  drawing.polyline(rows(view, page.places, page.counts), "wire");
  drawing.polyline(rows(view, ends, page.counts), "wire s1 displaced");
  for (std::size_t i = 0; i < ends.size(); ++i) {
    drawing.line(view.at(page.places[i]), view.at(ends[i]), "trace s2");
    drawing.circle(view.at(ends[i]), 2.2, "dot s2");
  }
  return drawing.html();
}

}  // namespace frustum::report
