#include "report/page/chart_data.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "report/colour_scale.hpp"
#include "report/page/packed_array.hpp"
#include "report/page/packed_mesh.hpp"

namespace frustum::report {
namespace {

using Json = nlohmann::ordered_json;

Json colour_json(const Colour& colour) { return Json::array({colour[0], colour[1], colour[2]}); }

// Deviations as 1..65535 from -limit to +limit; 0 means "none".
Json surface_json(const SurfacePicture& picture) {
  constexpr double kLevels = 65534.0;
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
  Json json = json_of<Json>(packed_mesh(picture.vertices, picture.triangles, kFineGrid));
  json["deviation"] = has_deviation ? Json(packed_array(levels, 1)) : Json(nullptr);
  json["limit_um"] = limit * kUmPerMm;
  json["span_um"] = natural_span(picture) * kUmPerMm;
  json["stops"] = std::move(stops);
  json["no_nominal"] = colour_json(kNoNominalColour);
  return json;
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
