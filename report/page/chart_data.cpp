#include "report/page/chart_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "report/colour_scale.hpp"
#include "report/page/packed_array.hpp"

namespace frustum::report {
namespace {

using Json = nlohmann::ordered_json;

Json colour_json(const Colour& colour) { return Json::array({colour[0], colour[1], colour[2]}); }

// Positions on a grid of 2^18 steps over the longest side of the bounding box: half a micrometre
// for a workpiece of 100 mm. Deviations as 1..65535 from -limit to +limit; 0 means "none".
Json surface_json(const SurfacePicture& picture) {
  constexpr double kGrid = 262143.0;
  constexpr double kLevels = 65534.0;
  std::array<float, 3> low = picture.vertices.front();
  std::array<float, 3> high = low;
  for (const auto& vertex : picture.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], vertex[k]);
      high[k] = std::max(high[k], vertex[k]);
    }
  }
  double side = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, static_cast<double>(high[k] - low[k]));
  const double step = side / kGrid;
  std::vector<std::uint32_t> positions;
  positions.reserve(picture.vertices.size() * 3);
  for (const auto& vertex : picture.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      positions.push_back(
          static_cast<std::uint32_t>(std::lround(static_cast<double>(vertex[k] - low[k]) / step)));
    }
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(picture.triangles.size() * 3);
  for (const auto& triangle : picture.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  double limit = 0.0;
  for (const auto& deviation : picture.deviation) {
    if (deviation && std::isfinite(*deviation)) {
      limit = std::max(limit, static_cast<double>(std::abs(*deviation)));
    }
  }
  limit = std::max(limit, 1e-9);  // mm; all at nominal
  std::vector<std::uint32_t> levels;
  levels.reserve(picture.deviation.size());
  for (const auto& deviation : picture.deviation) {
    const bool is_known = deviation && std::isfinite(*deviation);
    const double share = is_known ? (static_cast<double>(*deviation) / limit + 1.0) / 2.0 : 0.0;
    levels.push_back(is_known ? static_cast<std::uint32_t>(std::lround(share * kLevels)) + 1 : 0);
  }
  Json stops = Json::array();
  for (const Colour& stop : kDeviationStops) stops.push_back(colour_json(stop));
  const bool has_deviation =
      std::any_of(levels.begin(), levels.end(), [](auto v) { return v > 0; });
  return {{"vertices", picture.vertices.size()},
          {"triangles", picture.triangles.size()},
          {"origin", Json::array({low[0], low[1], low[2]})},
          {"step", step},
          {"positions", packed_array(positions, 3)},
          {"corners", packed_array(corners, 3)},
          {"deviation", has_deviation ? Json(packed_array(levels, 1)) : Json(nullptr)},
          {"limit_um", limit * kUmPerMm},
          {"span_um", natural_span(picture) * kUmPerMm},
          {"stops", std::move(stops)},
          {"no_nominal", colour_json(kNoNominalColour)}};
}

}  // namespace

bool has_surface(const RunReport& report) {
  return !report.surface.empty() && report.surface.is_valid();
}

std::string chart_data(const RunReport& report) {
  const Wording words(report.style);
  Json json;
  json["surface"] = has_surface(report) ? surface_json(report.surface) : Json(nullptr);
  // What the script says itself.
  json["words"] = {
      {"language", words.code()},
      {"no_nominal", words("no nominal")},
      {"length", {{"unit", words.symbol("mm")}, {"per_mm", words.shown(1.0, "mm")}}},
      {"deviation", {{"unit", words.symbol("um")}, {"per_um", words.shown(1.0, "um")}}},
      {"small_deviation",
       {{"unit", words.symbol("nm")}, {"per_um", 1e3 * words.shown(1.0, "nm")}}}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace frustum::report
