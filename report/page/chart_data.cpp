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

// Rounded to `step`, to keep the page small.
Json rounded(double value, double per_step) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * per_step) / per_step;
}

Json rounded(const std::vector<double>& values, double scale, double per_step) {
  Json array = Json::array();
  for (const double value : values) array.push_back(rounded(value * scale, per_step));
  return array;
}

Json polar_json(const metrology::CharacteristicResult& characteristic) {
  return {{"name", characteristic.name},
          {"angle", rounded(characteristic.plot_angle, 1.0, 1e6)},
          {"deviation_um", rounded(characteristic.plot_deviation, kUmPerMm, 1e5)}};
}

Json profile_json(const metrology::CharacteristicResult& characteristic) {
  Json lines = Json::array();
  for (const metrology::LineProfile& line : characteristic.profiles) {
    lines.push_back({{"feature", line.feature},
                     {"position_mm", rounded(line.position, 1.0, 1e4)},
                     {"deviation_um", rounded(line.deviation, kUmPerMm, 1e5)},
                     {"fit_offset_um", rounded(line.fit_offset * kUmPerMm, 1e5)},
                     {"fit_slope_urad", rounded(line.fit_slope * kUradPerRad, 1e5)}});
  }
  return {{"name", characteristic.name}, {"lines", std::move(lines)}};
}

bool same_lines(const metrology::CharacteristicResult& a,
                const metrology::CharacteristicResult& b) {
  return std::equal(a.profiles.begin(), a.profiles.end(), b.profiles.begin(), b.profiles.end(),
                    [](const auto& p, const auto& q) { return p.feature == q.feature; });
}

Json trace_json(const AxisTrace& trace) {
  Json axes = Json::array();
  for (const AxisSeries& series : trace.axes) {
    axes.push_back({{"axis", series.axis},
                    {"rotary", series.rotary},
                    {"values", rounded(series.values, 1.0, 1e4)}});
  }
  const bool is_cone_angle = trace.abscissa_kind == Abscissa::cone_angle;
  return {{"operation", trace.operation},
          {"abscissa", rounded(trace.abscissa, 1.0, 1e4)},
          {"abscissa_kind", is_cone_angle ? "cone_angle" : "block"},
          {"axes", std::move(axes)}};
}

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

bool has_polar_chart(const metrology::CharacteristicResult& characteristic) {
  return characteristic.plot_angle.size() > 2 &&
         characteristic.plot_angle.size() == characteristic.plot_deviation.size();
}

bool has_profile_chart(const RunReport& report,
                       const metrology::CharacteristicResult& characteristic) {
  const auto& profiles = characteristic.profiles;
  if (profiles.empty() || std::any_of(profiles.begin(), profiles.end(), [](const auto& line) {
        return line.position.empty() || line.position.size() != line.deviation.size();
      })) {
    return false;
  }
  if (characteristic.kind == "line_distance") return true;
  const auto& all = report.measurement.characteristics;
  return std::none_of(all.begin(), all.end(), [&](const auto& other) {
    return other.kind == "line_distance" && same_lines(other, characteristic);
  });
}

bool has_surface(const RunReport& report) {
  return !report.surface.empty() && report.surface.is_valid();
}

std::string chart_data(const RunReport& report) {
  Json json;
  json["polar"] = Json::array();
  for (const metrology::CharacteristicResult& c : report.measurement.characteristics) {
    if (has_polar_chart(c)) json["polar"].push_back(polar_json(c));
  }
  json["profiles"] = Json::array();
  for (const metrology::CharacteristicResult& c : report.measurement.characteristics) {
    if (has_profile_chart(report, c)) json["profiles"].push_back(profile_json(c));
  }
  json["traces"] = Json::array();
  for (const AxisTrace& trace : report.traces) json["traces"].push_back(trace_json(trace));
  json["surface"] = has_surface(report) ? surface_json(report.surface) : Json(nullptr);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace frustum::report
