#include "report/exchange/sections_dxf.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "report/exchange/dxf_drawing.hpp"

namespace frustum::report {
namespace {

// The gap from the last to the first is not much larger than the largest between neighbours.
bool goes_round(const std::vector<Vec3>& points) {
  if (points.size() < 3) return false;
  double largest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    largest = std::max(largest, (points[i] - points[i - 1]).norm());
  }
  constexpr double kUneven = 1.5;
  return (points.front() - points.back()).norm() <= kUneven * largest;
}

bool is_round(const std::string& kind) {
  return kind == "cylinder" || kind == "cone" || kind == "circle" || kind == "sphere";
}

}  // namespace

std::string sections_dxf(const metrology::Measurement& measurement) {
  constexpr int kBlack = 7, kBlue = 5;
  DxfDrawing drawing;
  for (const metrology::MeasuredFeature& feature : measurement.features) {
    std::map<std::size_t, std::vector<Vec3>> sections;
    for (const metrology::MeasuredPoint& p : feature.points) {
      if (!p.point.allFinite()) continue;
      drawing.point(feature.name, kBlack, p.point);
      sections[p.section].push_back(p.point);
    }
    // A layer's name has 31 characters: the ending is kept.
    const std::string layer = feature.name.substr(0, 23) + "_SECTION";
    for (const auto& [number, points] : sections) {
      drawing.polyline(layer, kBlue, points, is_round(feature.kind) && goes_round(points));
    }
  }
  return drawing.file();
}

}  // namespace frustum::report
